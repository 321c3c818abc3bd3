// SPDX-License-Identifier: Apache-2.0
// What a program of this machine names is looked at before it is opened.
#include "../common/Waiting.h"
#include "transport/PeerFile.h"

#include "transport/PeerUser.h"
#include "transport/SharedChannel.h"

#include <QtCore/QTemporaryDir>
#include <QtNetwork/QTcpServer>
#include <QtNetwork/QTcpSocket>

#include <csignal>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

using qplc::PeerFile;
using qplc::SharedMemory;
using qplc::SocketAddress;
using qplc::userOfPeer;

namespace {

constexpr uid_t otherUser = 65534;  // nobody
constexpr std::size_t memorySize = 4096;

QString pathOf(int descriptor)
{
    return QStringLiteral("/proc/%1/fd/%2").arg(::getpid()).arg(descriptor);
}

/// A descriptor that is closed in the end.
struct Descriptor
{
    explicit Descriptor(int opened)
        : number(opened)
    {
    }
    ~Descriptor() { ::close(number); }
    Descriptor(const Descriptor &) = delete;
    Descriptor &operator=(const Descriptor &) = delete;
    const int number;
};

std::optional<uid_t> userAt(const QTcpSocket &socket)
{
    return userOfPeer(SocketAddress(socket.localAddress(), socket.localPort()),
                      SocketAddress(socket.peerAddress(), socket.peerPort()));
}

}  // namespace

class tst_PeerFile : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void onlyDescriptorPathsAreAccepted_data();
    void onlyDescriptorPathsAreAccepted();
    void memoryHasToBeSealed();
    void memoryHasToHaveItsSize();
    void fileOfTheWrongKindIsRefused();
    void fileHasToBelongToTheUserOfTheMaster();
    void aFileThatIsSwappedInIsNotOpened();
    void findOpensNoFile();
    void theKernelTellsTheUserOfAPeer_data();
    void theKernelTellsTheUserOfAPeer();
    void theKernelTellsAnotherUser();
    void aPeerThatHasClosedHasNoUser();
};

void tst_PeerFile::onlyDescriptorPathsAreAccepted_data()
{
    QTest::addColumn<QString>("path");
    const QString self = QString::number(::getpid());
    QTest::newRow("nothing") << QString();
    QTest::newRow("a file") << "/etc/passwd";
    QTest::newRow("a relative path") << "../fd/0";
    QTest::newRow("a device") << "/dev/null";
    QTest::newRow("a way up") << "/proc/" + self + "/fd/../fd/0";
    QTest::newRow("a folder behind a descriptor") << "/proc/" + self + "/fd/0/etc/passwd";
    QTest::newRow("a folder of a process") << "/proc/" + self + "/root/etc/passwd";
    QTest::newRow("the process itself") << "/proc/self/fd/0";
    QTest::newRow("the folder of descriptors") << "/proc/" + self + "/fd/";
    QTest::newRow("two slashes") << "/proc/" + self + "//fd/0";
    QTest::newRow("a line feed") << "/proc/" + self + "/fd/0\n";
    QTest::newRow("a zero") << QString("/proc/" + self + "/fd/0") + QChar(0);
    QTest::newRow("a very long number") << "/proc/" + self + "/fd/" + QString(100000, '1');
    QTest::newRow("digits of another script") << "/proc/" + self + "/fd/" + QChar(0x0661);
}

void tst_PeerFile::onlyDescriptorPathsAreAccepted()
{
    QFETCH(QString, path);
    PeerFile file;
    QString error;
    QVERIFY(!file.find(path, "memory", ::geteuid(), &error));
    QVERIFY2(error.contains("it has to be a descriptor of the master"), qPrintable(error));
    QVERIFY2(error.size() < 300, qPrintable(error));
}

void tst_PeerFile::memoryHasToBeSealed()
{
    QString error;
    const QTemporaryDir folder;
    const Descriptor plain(::memfd_create("test", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    const Descriptor half(::memfd_create("test", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    const Descriptor file(::open(QFile::encodeName(folder.filePath("file")).constData(), O_RDWR | O_CREAT, 0600));
    for (const int descriptor : {plain.number, half.number, file.number})
        QCOMPARE(::ftruncate(descriptor, memorySize), 0);
    QCOMPARE(::fcntl(half.number, F_ADD_SEALS, F_SEAL_GROW | F_SEAL_SEAL), 0);  // it can be made smaller
    for (const int descriptor : {plain.number, half.number, file.number}) {
        PeerFile found;
        QVERIFY2(found.find(pathOf(descriptor), "memory", ::geteuid(), &error), qPrintable(error));
        QCOMPARE(found.openMemory(memorySize, &error), -1);
        QVERIFY2(error.contains("not sealed memory"), qPrintable(error));
    }
    SharedMemory sealed;
    QVERIFY2(sealed.create(memorySize, &error), qPrintable(error));
    PeerFile found;
    QVERIFY2(found.find(sealed.path(), "memory", ::geteuid(), &error), qPrintable(error));
    const Descriptor opened(found.openMemory(memorySize, &error));
    QVERIFY2(opened.number >= 0, qPrintable(error));
}

void tst_PeerFile::memoryHasToHaveItsSize()
{
    QString error;
    SharedMemory memory;
    QVERIFY2(memory.create(memorySize, &error), qPrintable(error));
    PeerFile found;
    QVERIFY(found.find(memory.path(), "memory", ::geteuid(), &error));
    QCOMPARE(found.openMemory(memorySize + 1, &error), -1);
    QVERIFY2(error.contains("4096 bytes instead of 4097"), qPrintable(error));
}

void tst_PeerFile::fileOfTheWrongKindIsRefused()
{
    QString error;
    int ends[2];
    QCOMPARE(::pipe2(ends, O_CLOEXEC), 0);
    const Descriptor out(ends[0]), in(ends[1]);
    SharedMemory memory;
    QVERIFY2(memory.create(memorySize, &error), qPrintable(error));
    const Descriptor folder(::open("/tmp", O_RDONLY | O_DIRECTORY));
    const Descriptor device(::open("/dev/zero", O_RDWR));
    const auto open = [&](const QString &path, bool isPipe) {
        PeerFile found;
        struct stat status = {};
        ::stat(QFile::encodeName(path).constData(), &status);
        if (!found.find(path, isPipe ? "pipe" : "memory", status.st_uid, &error))
            return error;
        const int descriptor = isPipe ? found.openPipe(&error) : found.openMemory(memorySize, &error);
        if (descriptor < 0)
            return error;
        ::close(descriptor);
        return QString("opened");
    };
    QVERIFY2(open(pathOf(in.number), false).contains("a pipe and not memory"), qPrintable(error));
    QVERIFY2(open(memory.path(), true).contains("a file and not a pipe"), qPrintable(error));
    for (const bool isPipe : {false, true}) {
        QVERIFY2(open(pathOf(folder.number), isPipe).contains("it is a directory"), qPrintable(error));
        QVERIFY2(open(pathOf(device.number), isPipe).contains("it is a device"), qPrintable(error));
    }
    QCOMPARE(open(pathOf(in.number), true), QString("opened"));
}

void tst_PeerFile::fileHasToBelongToTheUserOfTheMaster()
{
    QString error;
    SharedMemory memory;
    QVERIFY2(memory.create(memorySize, &error), qPrintable(error));
    PeerFile found;
    QVERIFY(!found.find(memory.path(), "memory", otherUser, &error));
    QVERIFY2(error.contains(QString("belongs to user %1, and the master runs as user 65534").arg(::geteuid())),
             qPrintable(error));
}

void tst_PeerFile::aFileThatIsSwappedInIsNotOpened()
{
    QString error;
    const QTemporaryDir folder;
    const Descriptor victim(::open(QFile::encodeName(folder.filePath("victim")).constData(), O_RDWR | O_CREAT, 0600));
    QCOMPARE(::write(victim.number, "secret", 6), ssize_t(6));
    int ends[2];
    QCOMPARE(::pipe2(ends, O_CLOEXEC | O_NONBLOCK), 0);
    const Descriptor out(ends[0]);
    const Descriptor in(ends[1]);
    const Descriptor named(::dup(in.number));

    PeerFile found;
    QVERIFY2(found.find(pathOf(named.number), "pipe", ::geteuid(), &error), qPrintable(error));
    QCOMPARE(::dup2(victim.number, named.number), named.number);  // the path leads to the victim now
    const Descriptor opened(found.openPipe(&error));
    QVERIFY2(opened.number >= 0, qPrintable(error));
    QCOMPARE(::write(opened.number, "x", 1), ssize_t(1));

    char byte = 0;
    QCOMPARE(::read(out.number, &byte, 1), ssize_t(1));
    QFile file(folder.filePath("victim"));
    QVERIFY(file.open(QIODevice::ReadOnly));
    QCOMPARE(file.readAll(), QByteArray("secret"));
}

void tst_PeerFile::findOpensNoFile()
{
    QString error;
    const QTemporaryDir folder;
    const QByteArray name = QFile::encodeName(folder.filePath("fifo"));
    QCOMPARE(::mkfifo(name.constData(), 0600), 0);
    const Descriptor held(::open(name.constData(), O_PATH));
    PeerFile found;
    QVERIFY2(found.find(pathOf(held.number), "pipe", ::geteuid(), &error), qPrintable(error));
    // A pipe without a reader: to wait for one would hold the node.
    QCOMPARE(found.openPipe(&error), -1);
    QVERIFY2(error.contains("No such device or address"), qPrintable(error));
}

void tst_PeerFile::theKernelTellsTheUserOfAPeer_data()
{
    QTest::addColumn<QString>("listening");
    QTest::addColumn<QString>("address");
    QTest::newRow("IPv4") << "127.0.0.1"
                          << "127.0.0.1";
    QTest::newRow("IPv6") << "::1"
                          << "::1";
    QTest::newRow("IPv4 at a server of both") << ""
                                              << "127.0.0.1";
}

void tst_PeerFile::theKernelTellsTheUserOfAPeer()
{
    QFETCH(QString, listening);
    QFETCH(QString, address);
    QTcpServer server;
    if (!server.listen(listening.isEmpty() ? QHostAddress(QHostAddress::Any) : QHostAddress(listening)))
        QSKIP("this machine has no such address");
    QTcpSocket socket;
    socket.connectToHost(QHostAddress(address), server.serverPort());
    QVERIFY(socket.waitForConnected());
    QVERIFY(server.waitForNewConnection(5000));
    QCOMPARE(userAt(socket), std::optional<uid_t>(::geteuid()));
}

void tst_PeerFile::theKernelTellsAnotherUser()
{
    if (::geteuid() != 0)
        QSKIP("only root can become another user");
    QTcpServer server;
    QVERIFY(server.listen(QHostAddress::LocalHost));
    QTcpSocket socket;
    socket.connectToHost(QHostAddress::LocalHost, server.serverPort());
    QVERIFY(socket.waitForConnected());
    int ready[2];
    QCOMPARE(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        if (::setuid(otherUser) != 0)
            ::_exit(1);
        const int accepted = ::accept(int(server.socketDescriptor()), nullptr, nullptr);
        [[maybe_unused]] const ssize_t written = ::write(ready[1], "x", 1);
        ::pause();
        ::_exit(accepted);
    }
    char byte = 0;
    QCOMPARE(::read(ready[0], &byte, 1), ssize_t(1));
    QCOMPARE(userAt(socket), std::optional<uid_t>(otherUser));
    ::kill(child, SIGKILL);
    int status = 0;
    QCOMPARE(::waitpid(child, &status, 0), child);
    ::close(ready[0]);
    ::close(ready[1]);
}

void tst_PeerFile::aPeerThatHasClosedHasNoUser()
{
    QTcpServer server;
    QVERIFY(server.listen(QHostAddress::LocalHost));
    QTcpSocket socket;
    socket.connectToHost(QHostAddress::LocalHost, server.serverPort());
    QVERIFY(socket.waitForConnected());
    QVERIFY(server.waitForNewConnection(5000));
    const SocketAddress self(socket.localAddress(), socket.localPort());
    const SocketAddress peer(socket.peerAddress(), socket.peerPort());
    QVERIFY(userOfPeer(self, peer));
    QTcpSocket *other = server.nextPendingConnection();
    QVERIFY(other);
    other->close();
    QTRY_VERIFY(!userOfPeer(self, peer));  // the kernel still lists it, with user 0
    QVERIFY(!userOfPeer(self, SocketAddress(QHostAddress("192.0.2.1"), 50000)));
}

QTEST_GUILESS_MAIN(tst_PeerFile)
#include "tst_PeerFile.moc"
