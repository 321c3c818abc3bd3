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
    void anAddressWithManyStrangersCrowdsOutItsOwn();
    void silentStrangersMakeRoomFirst();
    void addressesOfIPv6DifferInAllBitsAndTheirScope();
    void localStrangersHaveNoAddressLimit();
    void provenAddressesHaveAReserve();
    void aCrowdOfAProvenAddressIsNotProtected();
    void theLastConnectionsAreForNodesAndOperators();
    void manyAddressesNeedBoundedMemory();
    void allConnectionsTogetherAreLimited();
    void connectionsOfOneIdentityAreLimited();
    void theRateOfAnAddressIsLimited();
    void handshakesOfAnAddressAreLimited();
    void localHandshakesAreNotLimited();
    void strangersAreOverdueAfterTwoSeconds();
    void handshakeStepRenewsTheTimeOfAStranger();
    void knownPeerIsNeverOverdue();
    void expiredTicketHasNoEffect();
    void aConnectionWithoutADescriptorIsClosed();

private:
    ConnectionGate m_gate;
    ConnectionGate::Admission m_admission;
    quint64 admit(const QHostAddress &address, qint64 now = 0)
    {
        m_admission = m_gate.admit(address, now);
        return m_admission.ticket;
    }
    void cleanup() { m_gate = ConnectionGate(); }
};

void tst_ConnectionGate::anAddressWithManyStrangersCrowdsOutItsOwn()
{
    cleanup();
    const quint64 other = admit(far("192.0.2.2"));
    const quint64 first = admit(far());
    for (int i = 1; i < 64; ++i)
        admit(far());
    QCOMPARE(m_admission.crowdedOut, quint64(0));
    QVERIFY(admit(far("::ffff:192.0.2.1")) != 0);  // the same one
    QCOMPARE(m_admission.crowdedOut, first);
    QVERIFY(admit(far("192.0.2.2")) != other);
    QCOMPARE(m_admission.crowdedOut, quint64(0));
    m_gate.leave(first);
    QVERIFY(admit(far()) != 0);
    QCOMPARE(m_admission.crowdedOut, quint64(first + 1));
    m_gate.leave(m_admission.crowdedOut);
    QVERIFY(m_gate.know(first + 2, ConnectionGate::NodeOrOperator));  // no stranger any more
    QVERIFY(admit(far()) != 0);
    QCOMPARE(m_admission.crowdedOut, quint64(0));
}

void tst_ConnectionGate::silentStrangersMakeRoomFirst()
{
    cleanup();
    const quint64 entered = admit(far());
    const quint64 begun = admit(far());
    for (int i = 2; i < 64; ++i)
        admit(far());
    m_gate.hear(begun, 0);
    m_gate.hear(entered, 0);
    m_gate.renew(entered, 0);
    quint64 silent = begun;
    for (int i = 2; i < 64; ++i) {
        const quint64 next = admit(far());
        QCOMPARE(m_admission.crowdedOut, ++silent);
        m_gate.leave(silent);
        m_gate.hear(next, 0);
    }
    for (const quint64 victim : {begun, silent + 1}) {  // of those that have begun, the oldest
        m_gate.hear(admit(far()), 0);
        QCOMPARE(m_admission.crowdedOut, victim);
        m_gate.leave(victim);
    }
}

void tst_ConnectionGate::addressesOfIPv6DifferInAllBitsAndTheirScope()
{
    cleanup();
    const auto fill = [this](const QHostAddress &address) {
        quint64 first = 0;
        for (int i = 0; i < 64; ++i) {
            const quint64 ticket = admit(address);
            first = first == 0 ? ticket : first;
            QCOMPARE(m_admission.crowdedOut, quint64(0));
        }
        admit(address);
        QCOMPARE(m_admission.crowdedOut, first);
        m_gate.leave(first);
    };
    fill(far("2001:db8::1"));
    fill(far("2001:db8::2"));
    fill(far("fe80::1%eth0"));
    cleanup();
    fill(far("fe80::1%eth1"));
    fill(far("fe80::1%eth0"));
}

void tst_ConnectionGate::localStrangersHaveNoAddressLimit()
{
    cleanup();
    for (int i = 0; i < 256; ++i) {
        QVERIFY(admit(QHostAddress::LocalHost) != 0);
        QCOMPARE(m_admission.crowdedOut, quint64(0));
    }
}

/// Many addresses together leave room for those that have proven themselves.
void tst_ConnectionGate::provenAddressesHaveAReserve()
{
    cleanup();
    const QHostAddress friendly = far("192.0.2.200");
    const quint64 node = admit(friendly);
    m_gate.trust(node);
    QVERIFY(m_gate.know(node, ConnectionGate::NodeOrOperator));
    quint64 first = 0;
    for (int i = 0; i < 256; ++i) {
        const quint64 ticket = admit(far(qPrintable(QStringLiteral("192.0.3.%1").arg(i / 32))));
        first = first == 0 ? ticket : first;
    }
    QCOMPARE(m_gate.strangers(), 256);
    for (int i = 0; i < 64; ++i) {
        QVERIFY(admit(friendly) != 0);
        QCOMPARE(m_admission.crowdedOut, quint64(0));
    }
    QVERIFY(admit(far("192.0.2.201")) != 0);
    QCOMPARE(m_admission.crowdedOut, first);  // not one of the proven address
    m_gate.leave(first);
    m_gate.leave(node);
    QVERIFY(admit(friendly) != 0);
    QCOMPARE(m_admission.crowdedOut, node + 257);  // one of its own: they are too many
}

/// Friend and foe on one computer: its crowd is not protected from strangers elsewhere.
void tst_ConnectionGate::aCrowdOfAProvenAddressIsNotProtected()
{
    cleanup();
    const quint64 first = admit(QHostAddress::LocalHost);
    m_gate.trust(first);
    for (int i = 1; i < 256; ++i)
        admit(QHostAddress::LocalHost);
    QVERIFY(admit(far()) != 0);
    QCOMPARE(m_admission.crowdedOut, first);
}

void tst_ConnectionGate::theLastConnectionsAreForNodesAndOperators()
{
    cleanup();
    const int all = ConnectionGate::Limits().connections;
    const int reserved = ConnectionGate::Limits().reserved();
    QCOMPARE(reserved, 40);
    for (int i = 0; i < all - reserved; ++i)
        QVERIFY(m_gate.know(admit(QHostAddress::LocalHost), ConnectionGate::Observer));
    QVERIFY(!m_gate.know(admit(QHostAddress::LocalHost), ConnectionGate::Observer));
    m_gate.leave(m_admission.ticket);
    for (int i = 0; i < reserved; ++i)
        QVERIFY(m_gate.know(admit(QHostAddress::LocalHost), ConnectionGate::NodeOrOperator));
    QCOMPARE(admit(QHostAddress::LocalHost), quint64(0));
}

/// Budgets of addresses that are gone are forgotten, those of others are not.
void tst_ConnectionGate::manyAddressesNeedBoundedMemory()
{
    cleanup();
    const quint64 node = admit(far());
    m_gate.trust(node);
    m_gate.leave(node);
    for (quint32 i = 0; i < 3000; ++i)
        m_gate.leave(admit(QHostAddress(0x0A000000U + i)));
    QVERIFY2(m_gate.origins() <= 1024, qPrintable(QString::number(m_gate.origins())));
    for (quint32 i = 0; i < 256; ++i)
        admit(QHostAddress(0x0A000000U + i));
    QVERIFY(admit(far()) != 0);
    QCOMPARE(m_admission.crowdedOut, quint64(0));  // it is trusted still
}

void tst_ConnectionGate::allConnectionsTogetherAreLimited()
{
    cleanup();
    quint64 last = 0;
    for (int i = 0; i < ConnectionGate::Limits().connections; ++i) {
        last = admit(QHostAddress::LocalHost);
        QVERIFY(last != 0);
        m_gate.know(last, ConnectionGate::NodeOrOperator);
    }
    QCOMPARE(admit(QHostAddress::LocalHost), quint64(0));
    QCOMPARE(m_admission.refusal, ConnectionGate::TooManyConnections);
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
            m_gate.know(last, ConnectionGate::NodeOrOperator);
    }
    const quint64 further = admit(QHostAddress::LocalHost);
    QVERIFY(!m_gate.prove(further, QStringLiteral("anna")));
    QVERIFY(m_gate.prove(further, QStringLiteral("bert")));
    m_gate.leave(last);
    QVERIFY(m_gate.prove(admit(QHostAddress::LocalHost), QStringLiteral("anna")));
    QVERIFY(!m_gate.prove(last, QStringLiteral("carl")));  // who is gone proves nothing
}

void tst_ConnectionGate::theRateOfAnAddressIsLimited()
{
    cleanup();
    const auto comeAndGo = [this](qint64 now, const char *address = "192.0.2.1") {
        const quint64 ticket = admit(far(address), now);
        m_gate.leave(ticket);
        return ticket != 0;
    };
    for (int i = 0; i < 1000; ++i)
        QVERIFY(comeAndGo(100 * second));
    QVERIFY(!comeAndGo(100 * second));
    QCOMPARE(m_admission.refusal, ConnectionGate::TooFast);
    QVERIFY(comeAndGo(100 * second, "192.0.2.2"));
    QVERIFY(!comeAndGo(100 * second + second / 5001));
    int admitted = 0;
    for (qint64 now = 101 * second; now < 111 * second; now += second / 10'000)  // ten thousand in a second
        admitted += comeAndGo(now) ? 1 : 0;
    QVERIFY2(admitted >= 50'000 && admitted <= 51'000, qPrintable(QString::number(admitted)));
    QVERIFY(admit(QHostAddress::LocalHost, 111 * second) != 0);
}

/// Each costs the event loop about 1 ms: 100 in a second are a tenth of it.
void tst_ConnectionGate::handshakesOfAnAddressAreLimited()
{
    cleanup();
    const auto greets = [this](qint64 now, const char *address = "192.0.2.1") {
        const quint64 ticket = admit(far(address), now);
        const bool mayBegin = m_gate.hear(ticket, now);
        m_gate.leave(ticket);
        return mayBegin;
    };
    for (int i = 0; i < 320; ++i)  // all nodes and tools of a plant behind a router
        QVERIFY(greets(100 * second));
    QVERIFY(!greets(100 * second));
    QVERIFY(greets(100 * second, "192.0.2.2"));
    QVERIFY(admit(far(), 100 * second) != 0);  // it may speak without TLS
    int begun = 0;
    for (qint64 now = 100 * second; now < 110 * second; now += second / 1000)
        begun += greets(now) ? 1 : 0;
    QVERIFY2(begun >= 999 && begun <= 1001, qPrintable(QString::number(begun)));
    QVERIFY(!m_gate.hear(12345, 111 * second));  // who is gone begins nothing
}

void tst_ConnectionGate::localHandshakesAreNotLimited()
{
    cleanup();
    for (int i = 0; i < 1000; ++i) {
        const quint64 ticket = admit(QHostAddress::LocalHost);
        QVERIFY(m_gate.hear(ticket, 0));
        m_gate.leave(ticket);
    }
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
    m_gate.know(ticket, ConnectionGate::NodeOrOperator);
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
        m_gate.know(ticket, ConnectionGate::NodeOrOperator);
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
