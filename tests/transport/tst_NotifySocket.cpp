// SPDX-License-Identifier: Apache-2.0
#include "../common/NotifyListener.h"
#include "transport/NotifySocket.h"

#include <QtTest/QtTest>

#include <cstddef>

using qplc::NotifySocket;

class tst_NotifySocket : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void messageReachesAPathAddress();
    void messageReachesAnAbstractAddress();
    void socketWithoutAnAddressSendsNothing();
    void invalidAddressIsReported_data();
    void invalidAddressIsReported();
    void missingReceiverIsReported();
    void receiverThatDoesNotReadDelaysNoSender();
};

void tst_NotifySocket::messageReachesAPathAddress()
{
    NotifyListener listener;
    QVERIFY(listener.isOpen());
    NotifySocket socket(QFile::encodeName(listener.path()));
    QVERIFY(socket.isWanted());
    QVERIFY2(socket.send("READY=1\nSTATUS=up"), qPrintable(socket.errorString()));
    QVERIFY(socket.send("WATCHDOG=1"));
    QCOMPARE(listener.take(), QStringList({"READY=1", "STATUS=up", "WATCHDOG=1"}));
}

void tst_NotifySocket::messageReachesAnAbstractAddress()
{
    const QByteArray name = "@qtplc-test-" + QByteArray::number(qint64(::getpid()));
    sockaddr_un address = {};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path + 1, name.constData() + 1, std::size_t(name.size() - 1));
    const int listener = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    const auto size = socklen_t(offsetof(sockaddr_un, sun_path) + std::size_t(name.size()));
    QCOMPARE(::bind(listener, reinterpret_cast<const sockaddr *>(&address), size), 0);
    NotifySocket socket(name);
    QVERIFY2(socket.send("READY=1"), qPrintable(socket.errorString()));
    char text[16];
    QCOMPARE(::recv(listener, text, sizeof text, 0), ssize_t(7));
    ::close(listener);
}

void tst_NotifySocket::socketWithoutAnAddressSendsNothing()
{
    NotifySocket socket("");
    QVERIFY(!socket.isWanted());
    QVERIFY(socket.send("READY=1"));
}

void tst_NotifySocket::invalidAddressIsReported_data()
{
    QTest::addColumn<QByteArray>("address");
    QTest::newRow("relative") << QByteArray("run/notify");
    QTest::newRow("no name") << QByteArray("@");
    QTest::newRow("too long") << QByteArray("/") + QByteArray(200, 'x');
}

void tst_NotifySocket::invalidAddressIsReported()
{
    QFETCH(QByteArray, address);
    NotifySocket socket(address);
    QVERIFY(!socket.send("READY=1"));
    QVERIFY2(socket.errorString().contains(QString::fromLatin1(address)), qPrintable(socket.errorString()));
    QVERIFY2(socket.errorString().contains("at most 107 bytes"), qPrintable(socket.errorString()));
}

void tst_NotifySocket::missingReceiverIsReported()
{
    QByteArray path;
    {
        NotifyListener listener;
        path = QFile::encodeName(listener.path());
    }
    NotifySocket socket(path);
    QVERIFY(!socket.send("READY=1"));
    QCOMPARE(socket.errorString(),
             QStringLiteral("NOTIFY_SOCKET=%1: No such file or directory").arg(QFile::decodeName(path)));
}

void tst_NotifySocket::receiverThatDoesNotReadDelaysNoSender()
{
    NotifyListener listener;
    NotifySocket socket(QFile::encodeName(listener.path()));
    int sent = 0;
    while (sent < 1'000'000 && socket.send("WATCHDOG=1"))
        ++sent;
    QVERIFY(sent > 0 && sent < 1'000'000);
    QVERIFY(!listener.take().isEmpty());
    QVERIFY(socket.send("WATCHDOG=1"));
}

QTEST_GUILESS_MAIN(tst_NotifySocket)
#include "tst_NotifySocket.moc"
