// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "SecurityFixtures.h"
#include "protocol/ControlFrame.h"

#include <QtCore/QDir>
#include <QtCore/QElapsedTimer>
#include <QtCore/QRandomGenerator>

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

// What anybody who reaches the port may try, with real sockets: a master with security and one
// without bear it, and go on.
class tst_Strangers : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase_data();
    void init();
    void thousandsOfConnectionsLeaveNoResources();
    void silentConnectionIsClosed();
    void slowGreetingIsClosed();
    void silentConnectionsDoNotBlockOthers();
    void repeatedRefusalsDoNotFillTheLog();
    void garbageEndsItsOwnConnectionOnly();
    void aLongGreetingIsRefusedBeforeItIsRead();
    void excessConnectionsAreClosedImmediately();
    void toolThatSendsTooManyRequestsIsDisconnected();
    void nodeThatSendsTooManyRequestsIsDisconnected_data();
    void nodeThatSendsTooManyRequestsIsDisconnected();
    void aNodeThatDoesNotAttachKeepsItsNameForAWhileOnly();

private:
    /// A plain connection to the master, of the system.
    int connected() const
    {
        sockaddr_in address = {};
        address.sin_family = AF_INET;
        address.sin_port = htons(m_master->serverPort());
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        const int descriptor = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        if (::connect(descriptor, reinterpret_cast<const sockaddr *>(&address), sizeof address) < 0)
            qFatal("cannot connect");
        return descriptor;
    }
    /// Whether the other end has closed the connection, whatever it said before.
    static bool isClosed(int descriptor)
    {
        char bytes[4096];
        ssize_t count = 0;
        do
            count = ::recv(descriptor, bytes, sizeof bytes, MSG_DONTWAIT);
        while (count > 0);
        return count == 0 || (errno != EAGAIN && errno != EWOULDBLOCK);
    }
    static qint64 residentKiB()
    {
        QFile file("/proc/self/statm");
        return file.open(QIODevice::ReadOnly)
            ? file.readAll().split(' ').at(1).toLongLong() * ::sysconf(_SC_PAGESIZE) / 1024
            : 0;
    }
    static int descriptors()
    {
        return int(QDir("/proc/self/fd").entryList(QDir::NoDotAndDotDot | QDir::System | QDir::Files).size());
    }
    bool lets(const QString &name)
    {
        CounterNode node(name);
        node.setSecurity(m_isSecured ? m_files.counter() : QPlcSecurity());
        return m_master->admit(node, "udp");
    }
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

void tst_Strangers::thousandsOfConnectionsLeaveNoResources()
{
    const auto comeAndGo = [this](int times) {
        for (int i = 0; i < times; ++i) {
            const int descriptor = connected();
            if (i % 3 == 1)
                (void)!::write(descriptor, "\x16\x03\x01\x02", 4);
            ::close(descriptor);
            if (i % 8 == 0)
                QTest::qWait(1);  // the queue of the system is not to be full: connected() would wait for this thread
        }
        QTest::qWait(20);
    };
    comeAndGo(300);  // buffers of the first ones stay
    const int openBefore = descriptors();
    const qint64 before = residentKiB();
    comeAndGo(2000);
    QTRY_COMPARE(descriptors(), openBefore);
    const qint64 growth = residentKiB() - before;
#if !defined(QTPLC_CALLS_SANITIZED) && !defined(__SANITIZE_ADDRESS__)
    QVERIFY2(growth < 256, qPrintable(QString("%1 KiB").arg(growth)));
#else
    Q_UNUSED(growth)
#endif
    QVERIFY(lets("Counter"));
}

void tst_Strangers::silentConnectionIsClosed()
{
    const int descriptor = connected();
    QTRY_VERIFY_WITH_TIMEOUT(isClosed(descriptor), 10000);
    ::close(descriptor);
    QTRY_VERIFY(!m_log->matching("it has not greeted in time").isEmpty());
    QCOMPARE(m_master->statistics().failedHandshakes, quint64(1));
}

void tst_Strangers::slowGreetingIsClosed()
{
    const int descriptor = connected();
    const QByteArray begin = m_isSecured ? QByteArray("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11)
                                         : qplc::encodeControlFrame(QPlcMessage(QPlcMessage::Hello, {{"protocol", 1}}));
    QElapsedTimer clock;
    clock.start();
    int sent = 0;
    while (!isClosed(descriptor) && clock.elapsed() < 15000) {
        if (sent < begin.size() - 1)
            (void)!::send(descriptor, begin.constData() + sent++, 1, MSG_NOSIGNAL);
        QTest::qWait(200);
    }
    ::close(descriptor);
    QVERIFY2(clock.elapsed() < 12000, qPrintable(QString::number(clock.elapsed())));
    QVERIFY(lets("Counter"));
}

/// A crowd that says nothing fills the room for strangers; the next one waits in the queue of the
/// system until they are shown out.
void tst_Strangers::silentConnectionsDoNotBlockOthers()
{
    std::vector<int> crowd;
    for (int i = 0; i < 40; ++i) {
        crowd.push_back(connected());
        if (i % 8 == 0)
            QTest::qWait(1);
    }
    QVERIFY(lets("Counter"));
    for (int descriptor : crowd)
        ::close(descriptor);
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
        const int descriptor = connected();
        QCOMPARE(::write(descriptor, frame.constData(), std::size_t(frame.size())), ssize_t(frame.size()));
        QTRY_VERIFY(isClosed(descriptor));
        ::close(descriptor);
    }
    const QStringList told = m_log->matching("refused 127.0.0.1:");
    QVERIFY2(!told.isEmpty() && told.size() < 40, qPrintable(QString::number(told.size())));
    for (const QString &line : told)
        QVERIFY2(line.size() < 1000, qPrintable(line));
}

void tst_Strangers::garbageEndsItsOwnConnectionOnly()
{
    EchoNode echo;
    echo.setSecurity(m_isSecured ? m_files.echo() : QPlcSecurity());
    QVERIFY(m_master->admit(echo, "udp"));
    QRandomGenerator random(4711);
    for (int i = 0; i < 100; ++i) {
        QByteArray garbage(random.bounded(1, 600), '\0');
        for (char &byte : garbage)
            byte = char(random.bounded(256));
        if (i % 4 == 0)
            garbage.prepend(QByteArray("\x16\x03\x01\x00\x40\x01", 6));  // as TLS begins
        if (i % 4 == 1)
            garbage.prepend(QByteArray("\x20\x00\x00\x00\x01{", 6));  // as a greeting begins
        const int descriptor = connected();
        (void)!::send(descriptor, garbage.constData(), std::size_t(garbage.size()), MSG_NOSIGNAL);
        ::shutdown(descriptor, SHUT_WR);
        QTRY_VERIFY_WITH_TIMEOUT(isClosed(descriptor), 10000);
        ::close(descriptor);
    }
    QCOMPARE(echo.state(), QPlcSlaveNode::Off);
    QVERIFY(lets("Counter"));
}

void tst_Strangers::aLongGreetingIsRefusedBeforeItIsRead()
{
    const int descriptor = connected();
    const char kind = m_isSecured ? '\x05' : '\x01';                          // what is taken without TLS
    const QByteArray begin = QByteArray("\x01\x00\x01\x00", 4) + kind + "{";  // 65 537 bytes
    (void)!::send(descriptor, begin.constData(), std::size_t(begin.size()), MSG_NOSIGNAL);
    QTRY_VERIFY_WITH_TIMEOUT(isClosed(descriptor), 1500);  // earlier than by its silence
    ::close(descriptor);
    QTRY_VERIFY(!m_log->matching("at most 65536 are allowed").isEmpty());
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
    const int descriptor = connected();
    QTRY_VERIFY_WITH_TIMEOUT(isClosed(descriptor), 1500);
    ::close(descriptor);
    QCOMPARE(m_master->statistics().refusedConnections, quint64(1));
    QTRY_VERIFY(!m_log->matching("too many connections").isEmpty());
    tools[0].control.close();
    QVERIFY(waitUntil([this] { return lets("Counter"); }));
}

void tst_Strangers::toolThatSendsTooManyRequestsIsDisconnected()
{
    SecuredTool tool(m_isSecured ? m_files.anna() : QPlcSecurity());
    QVERIFY(tool.greetAt(m_master->serverPort()));
    QSignalSpy gone(&tool.control, &QPlcAbstractSocket::disconnected);
    for (int i = 0; i < 20000 && tool.control.isConnected(); ++i)
        tool.send(QPlcMessage::GetLeases);
    QTRY_VERIFY_WITH_TIMEOUT(!gone.isEmpty(), 20000);
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
    QTRY_VERIFY_WITH_TIMEOUT(!gone.isEmpty(), 20000);
    QTRY_COMPARE(lost.size(), 1);
    QTRY_VERIFY(!m_log->matching("too many messages").isEmpty());
    QVERIFY(lets("Counter"));
}

void tst_Strangers::aNodeThatDoesNotAttachKeepsItsNameForAWhileOnly()
{
    ScriptedNode node("Counter");
    node.control.setSecurity(m_isSecured ? m_files.counter() : QPlcSecurity());
    node.cyclic = "tcp";
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

QTEST_GUILESS_MAIN(tst_Strangers)
#include "tst_Strangers.moc"
