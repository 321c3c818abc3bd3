// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "SecurityFixtures.h"
#include "VirtualTime.h"
#include "protocol/ControlFrame.h"
#include "transport/ControlNetwork.h"

using namespace std::chrono_literals;

// What anybody who reaches the port may try: a master with security and one without bear it, and go
// on. tst_HostileBytes has what needs sockets of the machine.
class tst_Strangers : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase_data();
    void init();
    void silentConnectionIsClosed();
    void slowGreetingIsClosed();
    void silentConnectionsDoNotBlockOthers();
    void silentConnectionsAreClosedDuringAFlood();
    void repeatedRefusalsDoNotFillTheLog();
    void aLongGreetingIsRefusedBeforeItIsRead();
    void excessConnectionsAreClosedImmediately();
    void toolThatSendsTooManyRequestsIsDisconnected();
    void nodeThatSendsTooManyRequestsIsDisconnected_data();
    void nodeThatSendsTooManyRequestsIsDisconnected();
    void aNodeThatDoesNotAttachKeepsItsNameForAWhileOnly();

private:
    /// A plain connection to the master.
    std::unique_ptr<QTcpSocket> connected() const
    {
        std::unique_ptr<QTcpSocket> socket(qplc::ControlNetwork::current().makeSocket(nullptr));
        socket->connectToHost(QHostAddress(QHostAddress::LocalHost), m_master->serverPort());
        if (!waitUntil([&] { return socket->state() == QAbstractSocket::ConnectedState; }))
            qFatal("cannot connect");
        return socket;
    }
    static bool isClosed(const std::unique_ptr<QTcpSocket> &socket)
    {
        return socket->state() == QAbstractSocket::UnconnectedState;
    }
    bool lets(const QString &name)
    {
        CounterNode node(name);
        node.setSecurity(m_isSecured ? m_files.counter() : QPlcSecurity());
        return m_master->admit(node, datagrams());
    }
    static constexpr std::chrono::milliseconds patience = 2s;  // with a stranger
    static constexpr std::chrono::milliseconds sweep = 200ms;  // until a master looks who is too slow, at the latest
    SecurityFiles m_files;
    bool m_isSecured = false;
    QScopedPointer<LogCapture> m_log;
    QScopedPointer<TestMaster> m_master;
};

void tst_Strangers::initTestCase_data()
{
    QTest::addColumn<bool>("isSecured");
    QTest::newRow("without security") << false;
    QTest::newRow("with keys") << true;
}

void tst_Strangers::init()
{
    QFETCH_GLOBAL(bool, isSecured);
    m_isSecured = isSecured;
    m_log.reset();  // which puts back what was there before it
    m_log.reset(new LogCapture);
    m_master.reset(new TestMaster);
    if (isSecured)
        m_master->setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(m_master->listen());
}

void tst_Strangers::silentConnectionIsClosed()
{
    const auto socket = connected();
    pass(patience - 10ms);
    QVERIFY(!isClosed(socket));
    QVERIFY(waitUntil([&] { return isClosed(socket); }, sweep));
    QCOMPARE(m_log->matching("it has not greeted in time").size(), 1);
    QCOMPARE(m_master->statistics().failedHandshakes, quint64(1));
}

void tst_Strangers::slowGreetingIsClosed()
{
    const auto socket = connected();
    const QByteArray begin = m_isSecured ? QByteArray("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11)
                                         : qplc::encodeControlFrame(QPlcMessage(QPlcMessage::Hello, {{"protocol", 2}}));
    constexpr int bytes = 8;
    for (int i = 0; i < bytes; ++i) {
        QVERIFY(!isClosed(socket));
        socket->write(begin.mid(i, 1));
        pass(patience / bytes - 1ms);
    }
    QVERIFY(waitUntil([&] { return isClosed(socket); }, sweep));
    QVERIFY(lets("Counter"));
}

/// A crowd that says nothing keeps nobody waiting, also when it comes again at once.
void tst_Strangers::silentConnectionsDoNotBlockOthers()
{
    std::vector<std::unique_ptr<QTcpSocket>> crowd;
    for (int i = 0; i < 200; ++i)
        crowd.push_back(connected());
    const std::int64_t begin = qplc::monotonicNow();
    for (const QString &name : {QStringLiteral("Counter"), QStringLiteral("Counter")}) {  // it is started again
        QVERIFY(lets(name));
        const std::chrono::nanoseconds waited(qplc::monotonicNow() - begin);
        QVERIFY2(waited < 100ms, qPrintable(QString::number(waited.count())));
    }
    QVERIFY(std::none_of(crowd.begin(), crowd.end(), isClosed));
}

/// A stranger who comes again and again keeps nobody in who is too slow.
void tst_Strangers::silentConnectionsAreClosedDuringAFlood()
{
    const auto silent = connected();
    const auto comesAndGoes = [this] {
        connected()->write("garbage");
        pass(10ms);
        return true;
    };
    const std::int64_t end = qplc::monotonicNow() + std::chrono::nanoseconds(patience + sweep).count();
    while (qplc::monotonicNow() < end)
        QVERIFY(comesAndGoes());
    QVERIFY(isClosed(silent));
}

void tst_Strangers::repeatedRefusalsDoNotFillTheLog()
{
    // What a stranger may say first, to masters of both kinds.
    const QString longName(20000, 'n');
    const QPlcMessage tooNew(QPlcMessage::Hello, {{"name", longName}, {"protocol", 99}});
    const QPlcMessage wrongToken(QPlcMessage::AttachCyclicChannel, {{"node", 1}, {"name", longName}});
    const QByteArray frame = qplc::encodeControlFrame(m_isSecured ? wrongToken : tooNew);
    constexpr int times = 200;
    for (int i = 0; i < times; ++i) {
        const auto socket = connected();
        socket->write(frame);
        QTRY_VERIFY(isClosed(socket));
    }
    const QStringList told = m_log->matching("refused 127.0.0.1:");
    QCOMPARE(told.size(), 17);  // 16 one by one, then the first of those that are told together
    for (const QString &line : told)
        QVERIFY2(line.size() < 1000, qPrintable(line));
}

void tst_Strangers::aLongGreetingIsRefusedBeforeItIsRead()
{
    const auto socket = connected();
    const char kind = m_isSecured ? '\x05' : '\x01';                // what is taken without TLS
    socket->write(QByteArray("\x01\x00\x01\x00", 4) + kind + "{");  // 65 537 bytes
    QVERIFY(waitUntil([&] { return isClosed(socket); }, 10ms));     // earlier than by its silence
    QCOMPARE(m_log->matching("at most 65536 are allowed").size(), 1);
}

void tst_Strangers::excessConnectionsAreClosedImmediately()
{
    m_master.reset(new TestMaster);
    m_master->setMaximumConnections(2);
    if (m_isSecured)
        m_master->setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(m_master->listen());
    SecuredTool tools[] = {SecuredTool(m_isSecured ? m_files.anna() : QPlcSecurity()),
                           SecuredTool(m_isSecured ? m_files.bert() : QPlcSecurity())};
    QVERIFY(tools[0].greetAt(m_master->serverPort()) && tools[1].greetAt(m_master->serverPort()));
    const auto socket = connected();
    QVERIFY(waitUntil([&] { return isClosed(socket); }, 10ms));
    QCOMPARE(m_master->statistics().refusedConnections, quint64(1));
    QCOMPARE(m_log->matching("too many connections").size(), 1);
    tools[0].control.close();
    QVERIFY(waitUntil([&] { return lets("Counter"); }));
}

void tst_Strangers::toolThatSendsTooManyRequestsIsDisconnected()
{
    SecuredTool tool(m_isSecured ? m_files.anna() : QPlcSecurity());
    QVERIFY(tool.greetAt(m_master->serverPort()));
    QSignalSpy gone(&tool.control, &QPlcAbstractSocket::disconnected);
    for (int i = 0; i < 20000 && tool.control.isConnected(); ++i)
        tool.send(QPlcMessage::GetLeases);
    QTRY_VERIFY(!gone.isEmpty());
    QTRY_VERIFY(!m_log->matching("too many messages").isEmpty());  // it may not have read it before the end
    QVERIFY(lets("Counter"));
}

void tst_Strangers::nodeThatSendsTooManyRequestsIsDisconnected_data()
{
    QTest::addColumn<int>("kind");
    QTest::newRow("questions") << int(QPlcMessage::GetLeases);
    QTest::newRow("answers that nobody has asked for") << int(QPlcMessage::Initialized);
}

void tst_Strangers::nodeThatSendsTooManyRequestsIsDisconnected()
{
    QFETCH(int, kind);
    ScriptedNode node("Counter");
    node.control.setSecurity(m_isSecured ? m_files.counter() : QPlcSecurity());
    QVERIFY(node.registerAt(m_master->serverPort()));
    QSignalSpy gone(&node.control, &QPlcAbstractSocket::disconnected);
    QSignalSpy lost(m_master.data(), &QPlcMasterNode::nodeLost);
    for (int i = 0; i < 20000 && node.control.isConnected(); ++i)
        node.send(QPlcMessage::Kind(kind));
    QTRY_VERIFY(!gone.isEmpty());
    QTRY_COMPARE(lost.size(), 1);
    QTRY_VERIFY(!m_log->matching("too many messages").isEmpty());
    QVERIFY(lets("Counter"));
}

void tst_Strangers::aNodeThatDoesNotAttachKeepsItsNameForAWhileOnly()
{
    ScriptedNode node("Counter");
    node.control.setSecurity(m_isSecured ? m_files.counter() : QPlcSecurity());
    node.cyclic = "sim-auto";
    QVERIFY(node.connectTo(m_master->serverPort()));
    node.send(QPlcMessage::Hello, node.helloFields());
    QCOMPARE(node.next().kind(), QPlcMessage::Hello);
    node.send(QPlcMessage::Register, node.registerFields());
    QCOMPARE(node.next().kind(), QPlcMessage::Registered);
    const QPlcMessage end = node.next(15000);
    QCOMPARE(end.kind(), QPlcMessage::Rejected);
    QCOMPARE(end.text("error"), QString("TimedOut"));
    QVERIFY(lets("Counter"));
}

QTPLC_VIRTUAL_TIME_MAIN(tst_Strangers)
#include "tst_Strangers.moc"
