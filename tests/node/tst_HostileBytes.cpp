// SPDX-License-Identifier: Apache-2.0
#include "SecurityFixtures.h"

#include <QtCore/QDir>
#include <QtCore/QRandomGenerator>
#include <QtCore/QTimer>
#include <QtNetwork/QTcpServer>
#include <QtNetwork/QTcpSocket>
#include <QtTest/QtTest>

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

using namespace std::chrono_literals;

namespace {

/// A network that brings what a client sends byte by byte, each in a segment of its own.
class ByteByByte
{
public:
    explicit ByteByByte(quint16 master)
    {
        m_server.listen(QHostAddress::LocalHost);
        QObject::connect(&m_server, &QTcpServer::newConnection, &m_server, [this, master] {
            m_client.reset(m_server.nextPendingConnection());
            m_master.connectToHost(QHostAddress::LocalHost, master);
            m_master.setSocketOption(QAbstractSocket::LowDelayOption, 1);
            QObject::connect(&m_master, &QIODevice::readyRead, m_client.get(),
                             [this] { m_client->write(m_master.readAll()); });
            QObject::connect(&m_master, &QAbstractSocket::disconnected, m_client.get(), &QAbstractSocket::close);
            m_pace.start(0);
        });
        QObject::connect(&m_pace, &QTimer::timeout, &m_server, [this] {
            char byte = 0;
            if (m_master.state() != QAbstractSocket::ConnectedState || m_client->read(&byte, 1) != 1)
                return;
            m_master.write(&byte, 1);
            m_master.flush();
            ++bytes;
        });
    }
    quint16 port() const { return m_server.serverPort(); }

    int bytes = 0;  // that were brought

private:
    QTcpServer m_server;
    QTcpSocket m_master;
    std::unique_ptr<QTcpSocket> m_client;
    QTimer m_pace;
};

}  // namespace

// What strangers may send to sockets of the machine, and to OpenSSL: see tst_Strangers.
class tst_HostileBytes : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void thousandsOfConnectionsLeaveNoResources_data() { addSecurities(); }
    void thousandsOfConnectionsLeaveNoResources();
    void slowTlsGreetingIsClosed();
    void greetingInSingleBytesIsAccepted_data() { addSecurities(); }
    void greetingInSingleBytesIsAccepted();
    void garbageEndsItsOwnConnectionOnly_data() { addSecurities(); }
    void garbageEndsItsOwnConnectionOnly();

private:
    static void addSecurities()
    {
        QTest::addColumn<bool>("isSecured");
        QTest::newRow("without security") << false;
        QTest::newRow("with keys") << true;
    }
    bool listen(bool isSecured)
    {
        m_master.reset(new TestMaster);
        m_security = isSecured ? m_files.counter() : QPlcSecurity();
        if (isSecured)
            m_master->setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
        return m_master->listen();
    }
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
        node.setSecurity(m_security);
        return m_master->admit(node, "udp");
    }
    SecurityFiles m_files;
    QPlcSecurity m_security;  // of Counter
    QScopedPointer<TestMaster> m_master;
};

void tst_HostileBytes::thousandsOfConnectionsLeaveNoResources()
{
    QFETCH(bool, isSecured);
    const LogCapture log;
    QVERIFY(listen(isSecured));
    const auto comeAndGo = [this](int times) {
        for (int i = 0; i < times; ++i) {
            const int descriptor = connected();
            if (i % 3 == 1)
                (void)!::write(descriptor, "\x16\x03\x01\x02", 4);
            ::close(descriptor);
            if (i % 8 == 0)
                pass(1ms);  // the queue of the system is not to be full: connected() would wait for this thread
        }
        pass(20ms);
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

void tst_HostileBytes::slowTlsGreetingIsClosed()
{
    const LogCapture log;
    QVERIFY(listen(true));
    const int descriptor = connected();
    const QByteArray begin("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11);
    const std::int64_t last = qplc::monotonicNow() + std::chrono::nanoseconds(12s).count();
    for (int sent = 0; !isClosed(descriptor) && qplc::monotonicNow() < last; pass(200ms)) {
        if (sent < begin.size() - 1)
            (void)!::send(descriptor, begin.constData() + sent++, 1, MSG_NOSIGNAL);
    }
    ::close(descriptor);
    QVERIFY(qplc::monotonicNow() < last);
    QVERIFY(lets("Counter"));
}

void tst_HostileBytes::greetingInSingleBytesIsAccepted()
{
    QFETCH(bool, isSecured);
    QVERIFY(listen(isSecured));
    ByteByByte network(m_master->serverPort());
    QVERIFY(network.port() != 0);
    SecuredTool tool(isSecured ? m_files.anna() : QPlcSecurity());
    QVERIFY(tool.greetAt(network.port()));
    QCOMPARE(tool.ask(QPlcMessage::GetState).kind(), QPlcMessage::State);
    QVERIFY(network.bytes > 50);
}

void tst_HostileBytes::garbageEndsItsOwnConnectionOnly()
{
    QFETCH(bool, isSecured);
    const LogCapture log;
    QVERIFY(listen(isSecured));
    EchoNode echo;
    echo.setSecurity(isSecured ? m_files.echo() : QPlcSecurity());
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

QTEST_GUILESS_MAIN(tst_HostileBytes)
#include "tst_HostileBytes.moc"
