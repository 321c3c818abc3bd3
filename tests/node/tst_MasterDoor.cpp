// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "SecurityFixtures.h"
#include "node/session/MasterDoor.h"
#include "transport/ControlNetwork.h"

#include <QtNetwork/QSslSocket>

using qplc::MasterDoor;

namespace {

constexpr std::int64_t second = 1'000'000'000;

/// Connections of this machine that seem to come from one address elsewhere.
class FarNetwork : public qplc::ControlNetwork
{
public:
    QTcpSocket *makeSocket(QObject *parent) override { return m_kernel.makeSocket(parent); }
    qplc::Tls *makeTls(QObject *parent) override { return m_kernel.makeTls(parent); }
    std::unique_ptr<qplc::ControlPort> listen(const QHostAddress &address, quint16 port,
                                              QAbstractSocket::SocketError *error, QString *text) override
    {
        return m_kernel.listen(address, port, error, text);
    }
    QHostAddress peerOf(int) override { return QHostAddress(QStringLiteral("192.0.2.1")); }
    void close(int descriptor) override { m_kernel.close(descriptor); }

private:
    qplc::ControlNetwork &m_kernel = ControlNetwork::current();
};

/// This machine with that network, on a clock of the test.
class FarHost : public qplc::Host
{
public:
    FarHost() { enter(this); }
    ~FarHost() override { enter(nullptr); }
    std::int64_t time = 100 * second;

    std::int64_t now() noexcept override { return time; }
    std::int64_t slept() noexcept override { return machine().slept(); }
    bool sleepUntil(std::int64_t deadline) noexcept override { return machine().sleepUntil(deadline); }
    std::int64_t wallClock() noexcept override { return machine().wallClock(); }
    bool hasKernelTimers() const noexcept override { return false; }
    std::uint64_t random() override { return machine().random(); }
    int openWakeUp(int *error) noexcept override { return machine().openWakeUp(error); }
    void closeWakeUp(int descriptor) noexcept override { machine().closeWakeUp(descriptor); }
    void wake(int descriptor) noexcept override { machine().wake(descriptor); }
    bool consumeWakeUp(int descriptor) noexcept override { return machine().consumeWakeUp(descriptor); }
    qplc::ControlNetwork *controlNetwork() noexcept override { return &m_network; }

private:
    FarNetwork m_network;
};

/// A stranger whose ClientHello begins a handshake that fails.
std::unique_ptr<QTcpSocket> wrongHelloTo(quint16 port)
{
    auto socket = std::make_unique<QTcpSocket>();
    socket->connectToHost(QHostAddress::LocalHost, port);
    if (!socket->waitForConnected())
        qFatal("cannot connect");
    socket->write(QByteArray("\x16\x03\x01\x00\x40\x01\x00\x00\x3c\x03\x03", 11) + QByteArray(58, '\0'));
    socket->flush();
    return socket;
}

}  // namespace

// What handshakes of strangers may cost a master.
class tst_MasterDoor : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void fewHandshakesBeginInATurn();
    void anAddressIsClosedBeforeItsHandshakesCostTooMuch();
    void operatorsBehindOneAddressEnterAtOnce();

private:
    SecurityFiles m_files;
};

/// The event loop looks at everybody else in between.
void tst_MasterDoor::fewHandshakesBeginInATurn()
{
    MasterDoor door;
    door.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(door.listen(QHostAddress::LocalHost, 0));
    std::vector<std::unique_ptr<QTcpSocket>> strangers;
    for (int i = 0; i < 40; ++i)
        strangers.push_back(wrongHelloTo(door.port()));
    const auto begun = [&door] {  // what has failed is deleted already
        const auto sockets = door.findChildren<QSslSocket *>();
        return int(door.failedHandshakes())
            + int(std::count_if(sockets.begin(), sockets.end(),
                                [](const QSslSocket *socket) { return socket->mode() == QSslSocket::SslServerMode; }));
    };
    int most = 0;
    int last = 0;
    QVERIFY(waitUntil([&] {
        const int before = std::exchange(last, begun());
        most = std::max(most, last - before);
        return door.failedHandshakes() == strangers.size();
    }));
    QVERIFY2(most <= MasterDoor::HandshakesInATurn, qPrintable(QString::number(most)));
}

void tst_MasterDoor::anAddressIsClosedBeforeItsHandshakesCostTooMuch()
{
    FarHost host;
    MasterDoor door;
    door.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(door.listen(QHostAddress::LocalHost, 0));
    const auto greet = [&door](int times) {
        for (int i = 0; i < times; ++i) {
            const auto stranger = wrongHelloTo(door.port());
            if (!waitUntil([&] { return stranger->state() == QAbstractSocket::UnconnectedState; }))
                qFatal("a stranger stays");
        }
    };
    const int atOnce = qplc::ConnectionGate::Limits().handshakesAtOnce;
    const int inASecond = qplc::ConnectionGate::Limits().handshakesPerSecond;
    greet(atOnce);
    QCOMPARE(door.failedHandshakes(), quint64(atOnce));
    QSignalSpy refused(&door, &MasterDoor::refused);
    greet(10);
    QCOMPARE(door.failedHandshakes(), quint64(atOnce));
    QCOMPARE(door.turnedAway(), quint64(10));
    QVERIFY2(refused.last().at(2).toString().contains("too many TLS handshakes"),
             qPrintable(refused.last().at(2).toString()));
    host.time += second;
    greet(inASecond + 10);
    QCOMPARE(door.failedHandshakes(), quint64(atOnce + inASecond));
    QCOMPARE(door.turnedAway(), quint64(20));
}

/// A laboratory behind a router that translates addresses.
void tst_MasterDoor::operatorsBehindOneAddressEnterAtOnce()
{
    FarHost host;
    MasterDoor door;
    door.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(door.listen(QHostAddress::LocalHost, 0));
    std::vector<std::unique_ptr<QPlcSlaveSocket>> entered;
    int refused = 0;
    connect(&door, &MasterDoor::entered, this, [&](QPlcSlaveSocket *socket) { entered.emplace_back(socket); });
    connect(&door, &MasterDoor::refused, this, [&] { ++refused; });
    std::vector<std::unique_ptr<QPlcMasterSocket>> operators;
    for (int i = 0; i < 20; ++i) {
        operators.push_back(std::make_unique<QPlcMasterSocket>());
        operators.back()->setSecurity(m_files.anna());
        operators.back()->connectToMaster(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, door.port()));
    }
    QVERIFY(waitUntil([&] { return int(entered.size()) + refused == 20; }));
    QCOMPARE(refused, 0);
}

QTEST_GUILESS_MAIN(tst_MasterDoor)
#include "tst_MasterDoor.moc"
