// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "transport/ConnectionGate.h"
#include "transport/ControlListener.h"

#include <QtNetwork/QTcpSocket>

#include <sys/resource.h>
#include <unistd.h>

using qplc::ConnectionGate;

namespace {

constexpr qint64 second = 1'000'000'000;

const QHostAddress far(const char *address = "192.0.2.1")
{
    return QHostAddress(QLatin1String(address));
}

}  // namespace

// Who may come in, on a clock of the test.
class tst_ConnectionGate : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void strangersPerAddressAreLimited();
    void aNetworkOfIPv6IsOneAddress();
    void localStrangersHaveNoAddressLimit();
    void numberOfStrangersIsLimited();
    void allConnectionsTogetherAreLimited();
    void connectionsOfOneIdentityAreLimited();
    void theRateIsLimited();
    void strangersAreOverdueAfterTwoSeconds();
    void handshakeStepRenewsTheTimeOfAStranger();
    void knownPeerIsNeverOverdue();
    void expiredTicketHasNoEffect();
    void aConnectionWithoutADescriptorIsClosed();

private:
    ConnectionGate m_gate;
    ConnectionGate::Refusal m_refusal = ConnectionGate::Admitted;
    quint64 admit(const QHostAddress &address, qint64 now = 0)
    {
        return m_gate.admit(address, now, &m_refusal).value_or(0);
    }
    void cleanup() { m_gate = ConnectionGate(); }
};

void tst_ConnectionGate::strangersPerAddressAreLimited()
{
    cleanup();
    quint64 first = admit(far());
    for (int i = 1; i < 8; ++i)
        QVERIFY(admit(far()) != 0);
    QCOMPARE(admit(far()), quint64(0));
    QCOMPARE(m_refusal, ConnectionGate::TooManyOfAddress);
    QCOMPARE(admit(far("::ffff:192.0.2.1")), quint64(0));  // the same one
    QVERIFY(admit(far("192.0.2.2")) != 0);
    m_gate.know(first);
    QVERIFY(admit(far()) != 0);
}

void tst_ConnectionGate::aNetworkOfIPv6IsOneAddress()
{
    cleanup();
    for (int i = 0; i < 8; ++i)
        QVERIFY(admit(QHostAddress(QStringLiteral("2001:db8:0:1::%1").arg(i + 1))) != 0);
    QCOMPARE(admit(QHostAddress(QStringLiteral("2001:db8:0:1:ffff::9"))), quint64(0));
    QCOMPARE(m_refusal, ConnectionGate::TooManyOfAddress);
    QVERIFY(admit(QHostAddress(QStringLiteral("2001:db8:0:2::9"))) != 0);
}

void tst_ConnectionGate::localStrangersHaveNoAddressLimit()
{
    cleanup();
    for (int i = 0; i < 32; ++i)
        QVERIFY(admit(QHostAddress::LocalHost) != 0);
}

void tst_ConnectionGate::numberOfStrangersIsLimited()
{
    cleanup();
    quint64 last = 0;
    for (int i = 0; i < 32; ++i) {
        QVERIFY(m_gate.hasRoom());
        last = admit(QHostAddress::LocalHost);
    }
    QVERIFY(!m_gate.hasRoom());
    m_gate.leave(last);
    QVERIFY(m_gate.hasRoom());
    QCOMPARE(m_gate.strangers(), 31);
}

void tst_ConnectionGate::allConnectionsTogetherAreLimited()
{
    cleanup();
    quint64 last = 0;
    for (int i = 0; i < ConnectionGate::Limits().connections; ++i) {
        last = admit(QHostAddress::LocalHost);
        QVERIFY(last != 0);
        m_gate.know(last);
    }
    QCOMPARE(admit(QHostAddress::LocalHost), quint64(0));
    QCOMPARE(m_refusal, ConnectionGate::TooManyConnections);
    m_gate.leave(last);
    QVERIFY(admit(QHostAddress::LocalHost) != 0);
}

void tst_ConnectionGate::connectionsOfOneIdentityAreLimited()
{
    cleanup();
    quint64 last = 0;
    for (int i = 0; i < 32; ++i) {
        last = admit(QHostAddress::LocalHost);
        QVERIFY(m_gate.prove(last, QStringLiteral("anna")));
        if (i % 2 == 0)
            m_gate.know(last);
    }
    const quint64 further = admit(QHostAddress::LocalHost);
    QVERIFY(!m_gate.prove(further, QStringLiteral("anna")));
    QVERIFY(m_gate.prove(further, QStringLiteral("bert")));
    m_gate.leave(last);
    QVERIFY(m_gate.prove(admit(QHostAddress::LocalHost), QStringLiteral("anna")));
    QVERIFY(!m_gate.prove(last, QStringLiteral("carl")));  // who is gone proves nothing
}

void tst_ConnectionGate::theRateIsLimited()
{
    cleanup();
    const auto comeAndGo = [this](qint64 now) {
        const quint64 ticket = admit(far(), now);
        m_gate.leave(ticket);
        return ticket != 0;
    };
    for (int i = 0; i < 64; ++i)
        QVERIFY(comeAndGo(100 * second));
    QVERIFY(!comeAndGo(100 * second));
    QCOMPARE(m_refusal, ConnectionGate::TooFast);
    QVERIFY(!comeAndGo(100 * second + second / 51));
    int admitted = 0;
    for (qint64 now = 101 * second; now < 111 * second; now += second / 1000)  // a thousand in a second
        admitted += comeAndGo(now) ? 1 : 0;
    QVERIFY2(admitted >= 500 && admitted <= 550, qPrintable(QString::number(admitted)));
    QVERIFY(admit(QHostAddress::LocalHost, 111 * second) != 0);
}

void tst_ConnectionGate::strangersAreOverdueAfterTwoSeconds()
{
    cleanup();
    const quint64 first = admit(far(), 0);
    const quint64 next = admit(far(), second);
    QVERIFY(m_gate.overdue(2 * second - 1).isEmpty());
    QCOMPARE(m_gate.overdue(2 * second), QVector<ConnectionGate::Ticket>{first});
    QCOMPARE(m_gate.overdue(3 * second), (QVector<ConnectionGate::Ticket>{first, next}));
    m_gate.leave(first);
    QCOMPARE(m_gate.overdue(3 * second), QVector<ConnectionGate::Ticket>{next});
}

void tst_ConnectionGate::handshakeStepRenewsTheTimeOfAStranger()
{
    cleanup();
    const quint64 ticket = admit(far(), 0);
    m_gate.renew(ticket, second);
    QVERIFY(m_gate.overdue(3 * second - 1).isEmpty());
    QCOMPARE(m_gate.overdue(3 * second).size(), 1);
}

void tst_ConnectionGate::knownPeerIsNeverOverdue()
{
    cleanup();
    const quint64 ticket = admit(far(), 0);
    m_gate.know(ticket);
    QVERIFY(m_gate.overdue(1000 * second).isEmpty());
    QCOMPARE(m_gate.connections(), 1);
    QCOMPARE(m_gate.strangers(), 0);
}

void tst_ConnectionGate::expiredTicketHasNoEffect()
{
    cleanup();
    const quint64 ticket = admit(far(), 0);
    for (int i = 0; i < 2; ++i) {
        m_gate.leave(ticket);
        m_gate.know(ticket);
        m_gate.renew(ticket, 0);
        QCOMPARE(m_gate.connections(), 0);
        QCOMPARE(m_gate.strangers(), 0);
    }
}

/// Otherwise the listener would be told at once that somebody waits, for ever.
void tst_ConnectionGate::aConnectionWithoutADescriptorIsClosed()
{
    qplc::ControlListener listener;
    QVERIFY(listener.listen(QHostAddress::LocalHost, 0));
    int wakeUps = 0;
    connect(&listener, &qplc::ControlListener::arrived, this, [&] {
        ++wakeUps;
        const int descriptor = listener.take();
        if (descriptor >= 0)
            ::close(descriptor);
    });
    std::vector<std::unique_ptr<QTcpSocket>> clients;
    for (int i = 0; i < 3; ++i) {
        clients.push_back(std::make_unique<QTcpSocket>());
        clients.back()->connectToHost(QHostAddress::LocalHost, listener.port());
        QVERIFY(clients.back()->waitForConnected());
    }
    rlimit former = {};
    QCOMPARE(::getrlimit(RLIMIT_NOFILE, &former), 0);
    const int free = ::dup(0);
    ::close(free);
    const rlimit none = {rlim_t(free), former.rlim_max};  // the lowest free descriptor is out of bounds
    QCOMPARE(::setrlimit(RLIMIT_NOFILE, &none), 0);
    // Each client that ends gives a descriptor back, with which the next one may be taken as usual.
    const bool areClosed = waitUntil(
        [&] {
            return std::all_of(clients.begin(), clients.end(), [](const std::unique_ptr<QTcpSocket> &client) {
                return client->state() == QAbstractSocket::UnconnectedState;
            });
        },
        5000);
    ::setrlimit(RLIMIT_NOFILE, &former);
    QVERIFY(areClosed);
    QVERIFY(listener.withoutDescriptor() > 0);
    QVERIFY2(wakeUps <= 6, qPrintable(QString::number(wakeUps)));
    QTcpSocket next;
    next.connectToHost(QHostAddress::LocalHost, listener.port());
    QTRY_VERIFY(next.state() == QAbstractSocket::UnconnectedState && wakeUps > 3);  // taken, and closed by the test
}

QTEST_GUILESS_MAIN(tst_ConnectionGate)
#include "tst_ConnectionGate.moc"
