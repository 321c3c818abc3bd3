// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "NodeFixtures.h"

#include <QtCore/QStandardPaths>
#include <QtNetwork/QTcpServer>
#include <QtNetwork/QTcpSocket>
#include <QtNetwork/QUdpSocket>

#include <cerrno>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

// The same plant over every transport gives the same bits.
class tst_Transports : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void sameDigestOverEveryTransport_data();
    void sameDigestOverEveryTransport();
    void udpAndTcpNodesRunTogether();
    void manyNodesRunTogether();
    void aMasterOnThisMachineIsFoundByItsName();
    void spinningChangesNoValue_data();
    void spinningChangesNoValue();
    void portInUseIsReported();
    void masterListensOnLoopbackUnlessOpenedExplicitly();
    void theServerStopsAndStartsAgain();
};

namespace {

quint64 flyInProcess()
{
    TestMaster master;
    CounterNode counter;
    EchoNode echo;
    master.setCycleLimit(1000);
    master.setTimeSignal("time");
    if (!master.addLocalNode(&echo) || !master.addLocalNode(&counter) || !master.startRealTime()
        || !master.waitForState(QPlcMasterNode::Off))
        qFatal("%s", qPrintable(master.errorString()));
    return master.statistics().imageDigest;
}

bool hasIpv6()
{
    QTcpServer server;
    return server.listen(QHostAddress::LocalHostIPv6, 0);
}

// An emulator of another processor has none.
bool hasMulticast()
{
    const int probe = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const in_addr loopback = {htonl(INADDR_LOOPBACK)};
    const bool has
        = ::setsockopt(probe, IPPROTO_IP, IP_MULTICAST_IF, &loopback, sizeof loopback) == 0 || errno != ENOPROTOOPT;
    ::close(probe);
    return has;
}

}  // namespace

void tst_Transports::sameDigestOverEveryTransport_data()
{
    QTest::addColumn<QString>("counterKind");
    QTest::addColumn<QString>("echoKind");
    QTest::addColumn<bool>("ipv6");
    QTest::newRow("tcp") << "tcp"
                         << "tcp" << false;
    QTest::newRow("udp") << "udp"
                         << "udp" << false;
    QTest::newRow("tcp and udp") << "tcp"
                                 << "udp" << false;
    QTest::newRow("udp and in process") << "udp"
                                        << "local" << false;
    QTest::newRow("multicast") << "multicast"
                               << "multicast" << false;
    QTest::newRow("multicast and udp") << "multicast"
                                       << "udp" << false;
    QTest::newRow("multicast and in process") << "multicast"
                                              << "local" << false;
    QTest::newRow("shared memory") << "shared"
                                   << "shared" << false;
    QTest::newRow("shared memory and udp") << "shared"
                                           << "udp" << false;
    QTest::newRow("tcp and shared memory") << "tcp"
                                           << "shared" << false;
    QTest::newRow("udp, IPv6") << "udp"
                               << "udp" << true;
    QTest::newRow("tcp, IPv6") << "tcp"
                               << "tcp" << true;
}

void tst_Transports::sameDigestOverEveryTransport()
{
    QFETCH(QString, counterKind);
    QFETCH(QString, echoKind);
    QFETCH(bool, ipv6);
    if (ipv6 && !hasIpv6())
        QSKIP("no IPv6 here", "");
    if (counterKind == "multicast" && !hasMulticast())
        QSKIP("no multicast here", "");
    const QHostAddress address = ipv6 ? QHostAddress::LocalHostIPv6 : QHostAddress::LocalHost;
    TestMaster master;
    master.setCycleLimit(1000);
    QVERIFY(master.setTimeSignal("time"));
    if (counterKind == "multicast")
        master.setMulticastGroup(QHostAddress("239.255.76.68"));
    QVERIFY2(master.listen(address), qPrintable(master.errorString()));
    CounterNode counter;
    EchoNode echo;
    for (const auto &[node, kind] : {std::pair<QPlcSlaveNode *, QString>(&counter, counterKind),
                                     std::pair<QPlcSlaveNode *, QString>(&echo, echoKind)}) {
        const auto protocol = kind == "udp" ? QPlcUnderlyingProtocol::udp(address, master.serverPort())
            : kind == "multicast"           ? QPlcUnderlyingProtocol::udpMulticast(address, master.serverPort())
            : kind == "shared"              ? QPlcUnderlyingProtocol::local(QString::number(master.serverPort()))
                                            : QPlcUnderlyingProtocol::tcp(address, master.serverPort());
        if (kind == "local")
            QVERIFY(master.addLocalNode(node));
        else
            QVERIFY2(node->connectToMasterAndWaitForConnected(protocol), qPrintable(node->errorString()));
    }
    QVERIFY2(master.startRealTime(), qPrintable(master.errorString()));
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(master.statistics().cycles, quint64(1000));
    QCOMPARE(master.signalValue("count").toInt(), 1000);
    QCOMPARE(master.statistics().imageDigest, flyInProcess());
    counter.disconnectFromMaster();
    echo.disconnectFromMaster();
}

void tst_Transports::udpAndTcpNodesRunTogether()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.002);
    QVERIFY(master.listen());
    CounterNode counter;
    EchoNode echo;
    QVERIFY(counter.connectToMasterAndWaitForConnected(master.protocol("udp")));
    QVERIFY(echo.connectToMasterAndWaitForConnected(master.protocol("tcp")));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(20));
    QTRY_VERIFY(master.signalValue("echo").toReal() > 5.0);
    master.stop();
    counter.disconnectFromMaster();
    echo.disconnectFromMaster();
    QVERIFY(master.statistics().roundTripMaximum > 0);
}

void tst_Transports::manyNodesRunTogether()
{
    constexpr int count = 40;
    QByteArray ini = "[in]\ntype = Real64\n";
    for (int i = 0; i < count; ++i)
        ini += "[out" + QByteArray::number(i) + "]\ntype = Int32\n";
    class Small : public QPlcCompactSlaveNode
    {
    public:
        explicit Small(const QByteArray &output)
            : QPlcCompactSlaveNode(QString::fromLatin1(output))
            , m_name(output)
        {
        }
        QByteArray m_name;
        QPlcInput<double> m_in{this, "in"};
        QPlcOutput<int> m_out{this, m_name.constData()};
        void reset() override { m_out = 0; }
        void step(const QPlcCycle &) override { m_out = m_out + 1; }
    };
    TestMaster master(QPlcClock::lockstep(), QPlcSignalTable::fromIni(ini));
    master.setCycleLimit(100);
    QVERIFY(master.listen());
    std::vector<std::unique_ptr<Small>> nodes;
    for (int i = 0; i < count; ++i) {
        nodes.push_back(std::make_unique<Small>("out" + QByteArray::number(i)));
        QVERIFY(nodes.back()->connectToMasterAndWaitForConnected(master.protocol(i % 2 ? "udp" : "tcp")));
    }
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    for (int i = 0; i < count; ++i)
        QCOMPARE(master.signalValue(QString("out%1").arg(i)).toInt(), 100);
    for (const std::unique_ptr<Small> &node : nodes)
        node->disconnectFromMaster();
    QPlcSignalIndexTable::setCurrent({});
}

void tst_Transports::aMasterOnThisMachineIsFoundByItsName()
{
    QStandardPaths::setTestModeEnabled(true);
    const QString name = QStringLiteral("master-%1").arg(QCoreApplication::applicationPid());
    TestMaster master;
    master.setLocalName(name);
    QVERIFY(!QPlcUnderlyingProtocol::local(name).isValid());
    QVERIFY2(master.listen(), qPrintable(master.errorString()));
    CounterNode counter;
    QVERIFY2(counter.connectToMasterAndWaitForConnected(QPlcUnderlyingProtocol::local(name)),
             qPrintable(counter.errorString()));
    QCOMPARE(master.nodes().constFirst().transport, QStringLiteral("local"));
    counter.disconnectFromMaster();
    master.stopServer();
    QVERIFY(!QPlcUnderlyingProtocol::local(name).isValid());
    master.setLocalName(QStringLiteral("no/name"));
    QVERIFY(!master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)));
    QVERIFY2(master.errorString().contains("no/name"), qPrintable(master.errorString()));
    QCOMPARE(master.serverPort(), quint16(0));
}

void tst_Transports::spinningChangesNoValue_data()
{
    QTest::addColumn<QString>("kind");
    for (const char *kind : {"udp", "tcp", "local"})
        QTest::newRow(kind) << QString::fromLatin1(kind);
}

void tst_Transports::spinningChangesNoValue()
{
    QFETCH(QString, kind);
    QPlcRealTimeOptions spinning;
    spinning.spin = 200'000;
    TestMaster master;
    master.setRealTimeOptions(spinning);
    master.setCycleLimit(1000);
    QVERIFY(master.setTimeSignal("time"));
    QVERIFY(master.listen());
    CounterNode counter;
    EchoNode echo;
    for (QPlcSlaveNode *node : {static_cast<QPlcSlaveNode *>(&counter), static_cast<QPlcSlaveNode *>(&echo)}) {
        node->setRealTimeOptions(spinning);
        QVERIFY2(node->connectToMasterAndWaitForConnected(QPlcUnderlyingProtocol::fromString(
                     QStringLiteral("%1://127.0.0.1:%2").arg(kind).arg(master.serverPort()))),
                 qPrintable(node->errorString()));
    }
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(master.statistics().imageDigest, flyInProcess());
    counter.disconnectFromMaster();
    echo.disconnectFromMaster();
}

void tst_Transports::portInUseIsReported()
{
    TestMaster first;
    QVERIFY(first.listen());
    TestMaster second;
    QVERIFY(!second.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, first.serverPort())));
    QCOMPARE(second.error(), QPlcMasterNode::ServerError);
    QVERIFY2(second.errorString().contains(QString::number(first.serverPort())), qPrintable(second.errorString()));
    QUdpSocket udpOnly;
    TestMaster third;
    do {  // until it has a port that nobody else uses for TCP
        udpOnly.close();
        QVERIFY(udpOnly.bind(QHostAddress::LocalHost, 0));
    } while (!QTcpServer().listen(QHostAddress::LocalHost, udpOnly.localPort()));
    QVERIFY(!third.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, udpOnly.localPort())));
    QVERIFY2(third.errorString().contains("UDP"), qPrintable(third.errorString()));
    QCOMPARE(third.serverPort(), quint16(0));
    QVERIFY(third.listen());
}

void tst_Transports::masterListensOnLoopbackUnlessOpenedExplicitly()
{
    LogCapture log;
    TestMaster master;
    QVERIFY(master.listen(QHostAddress::Any));
    QCOMPARE(log.matching("listening on 127.0.0.1 only").size(), 1);
    // Another address of this machine, which each machine has, with or without a network: who
    // listens on all of them answers there, too.
    QTcpSocket socket;
    socket.connectToHost(QHostAddress(QStringLiteral("127.0.0.2")), master.serverPort());
    QTRY_COMPARE(socket.error(), QAbstractSocket::ConnectionRefusedError);
    CounterNode counter;
    QVERIFY(counter.connectToMasterAndWaitForConnected(master.protocol("udp")));
    counter.disconnectFromMaster();
}

void tst_Transports::theServerStopsAndStartsAgain()
{
    TestMaster master;
    QVERIFY(master.listen());
    CounterNode counter;
    QVERIFY(counter.connectToMasterAndWaitForConnected(master.protocol("tcp")));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(3));
    master.stopServer();
    QCOMPARE(master.serverPort(), quint16(0));
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    QVERIFY(master.nodes().isEmpty());
    QTRY_COMPARE(counter.state(), QPlcSlaveNode::Disconnected);
    QVERIFY(master.listen());
    QVERIFY(counter.connectToMasterAndWaitForConnected(master.protocol("udp")));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(3));
    master.stop();
    counter.disconnectFromMaster();
}

QTEST_GUILESS_MAIN(tst_Transports)
#include "tst_Transports.moc"
