// SPDX-License-Identifier: Apache-2.0
// A master on this machine that passes other things than its own memory and pipe, or runs as
// another user, to let a node write into them.
#include "../common/Waiting.h"
#include "ScriptedMaster.h"
#include "protocol/ControlFrame.h"
#include "realtime/Host.h"
#include "transport/DescriptorMessage.h"
#include "transport/LocalListener.h"
#include "transport/LocalSocket.h"
#include "transport/SharedChannel.h"

#include <fcntl.h>
#include <functional>
#include <grp.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>

using qplc::Descriptor;
using qplc::Doorbell;
using qplc::LocalListener;
using qplc::SharedChannel;
using qplc::SharedMemory;

namespace {

constexpr uid_t otherUser = 65534;  // nobody
constexpr int allSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;
const QStringList roles{"channel", "doorbell", "pipe"};

std::size_t sizeOf(const QString &role)
{
    return role == "doorbell" ? sizeof(Doorbell) : SharedChannel::sizeFor({});
}

/// What an honest master has.
struct HonestFiles
{
    HonestFiles()
    {
        QString error;
        int ends[2] = {-1, -1};
        isThere = channel.create({}, &error) && bell.create(sizeof(Doorbell), &error) && ::pipe2(ends, O_NONBLOCK) == 0;
        read = Descriptor(ends[0]);
        pipe = Descriptor(ends[1]);
    }
    std::vector<int> descriptors() const { return {channel.descriptor(), bell.descriptor(), pipe.number()}; }

    SharedChannel channel;
    SharedMemory bell;
    Descriptor read;
    Descriptor pipe;
    bool isThere = false;
};

/// A file of this user that no other user may read. It has the size of the memory for which it is
/// passed.
class SecretFile
{
public:
    explicit SecretFile(const QString &role)
        : m_content(int(sizeOf(role)), 's')
        , m_file(m_folder.filePath("secret"))
    {
        if (!m_file.open(QIODevice::ReadWrite) || m_file.write(m_content) != m_content.size() || !m_file.flush())
            qFatal("cannot write %s", qPrintable(m_file.fileName()));
        m_file.setPermissions(QFile::ReadOwner | QFile::WriteOwner);
    }
    int descriptor() const { return m_file.handle(); }
    QByteArray folder() const { return QFile::encodeName(m_folder.path()); }
    bool isUntouched() const
    {
        QFile file(m_file.fileName());
        return file.open(QIODevice::ReadOnly) && file.readAll() == m_content;
    }

private:
    const QTemporaryDir m_folder;
    const QByteArray m_content;
    QFile m_file;
};

int memory(std::size_t size, int seals)
{
    const int descriptor = ::memfd_create("test", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    return ::ftruncate(descriptor, off_t(size)) == 0 && ::fcntl(descriptor, F_ADD_SEALS, seals) == 0 ? descriptor : -1;
}

int reopened(int descriptor, int flags)
{
    return ::open(("/proc/self/fd/" + QByteArray::number(descriptor)).constData(), flags | O_CLOEXEC);
}

int pipeEnd(int end, int flags)
{
    int ends[2] = {-1, -1};
    if (::pipe2(ends, flags | O_CLOEXEC) == 0)
        ::close(ends[1 - end]);
    return ends[end];
}

/// What a hostile master may pass in the place of \a role.
Descriptor hostile(const QString &thing, const QString &role, const SecretFile &secret)
{
    const std::size_t size = sizeOf(role);
    const Descriptor sealed(memory(size, allSeals));
    const QMap<QString, std::function<int()>> makers{
        {"file", [&] { return ::dup(secret.descriptor()); }},
        {"file to write to", [&] { return reopened(secret.descriptor(), O_WRONLY | O_NONBLOCK); }},
        {"device", [] { return ::open("/dev/zero", O_RDWR | O_CLOEXEC); }},
        {"directory", [&] { return ::open(secret.folder().constData(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); }},
        {"handle of a file", [&] { return ::open(secret.folder().constData(), O_PATH | O_CLOEXEC); }},
        {"socket", [] { return ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0); }},
        {"memory without seals", [&] { return memory(size, 0); }},
        {"memory that may shrink", [&] { return memory(size, F_SEAL_GROW | F_SEAL_SEAL); }},
        {"memory that may get other seals", [&] { return memory(size, F_SEAL_GROW | F_SEAL_SHRINK); }},
        {"memory to read only", [&] { return reopened(sealed.number(), O_RDONLY); }},
        {"memory sealed against writing", [&] { return memory(size, allSeals | F_SEAL_WRITE); }},
        {"shorter memory", [&] { return memory(size - 1, allSeals); }},
        {"longer memory", [&] { return memory(size + 4096, allSeals); }},
        {"empty memory", [&] { return memory(0, allSeals); }},
        {"end to read", [] { return pipeEnd(0, O_NONBLOCK); }},
        {"pipe that blocks", [] { return pipeEnd(1, 0); }}};
    return Descriptor(makers.value(thing)());
}

int openDescriptors()
{
    return QDir("/proc/self/fd").entryList(QDir::Files | QDir::System | QDir::Dirs | QDir::NoDotAndDotDot).size();
}

/// A process of another user that plays a master at \a listener, step by step: it sends \a hello,
/// and \a registered as soon as the node has registered. It also listens at the Unix socket of its
/// session, and passes its descriptors to each program that connects.
class MasterOfAnotherUser
{
public:
    MasterOfAnotherUser(int listener, quint64 session, const QByteArray &hello, const QByteArray &registered)
        : m_process(::fork())
    {
        if (m_process != 0)
            return;
        if (::setgroups(0, nullptr) != 0 || ::setgid(otherUser) != 0 || ::setuid(otherUser) != 0)
            ::_exit(NoUser);
        const HonestFiles files;  // of the other user
        sockaddr_un address;
        const socklen_t length = qplc::LocalSocket::addressOf(session, &address);
        const Descriptor local = qplc::LocalSocket::make();
        if (::bind(local.number(), reinterpret_cast<sockaddr *>(&address), length) < 0
            || ::listen(local.number(), 5) < 0)
            ::_exit(NoUser);
        pollfd incoming{listener, POLLIN, 0};
        const int node = ::poll(&incoming, 1, -1) == 1 ? ::accept(listener, nullptr, nullptr) : -1;
        for (const QByteArray &answer : {hello, registered}) {
            char bytes[65536];
            if (::read(node, bytes, sizeof bytes) <= 0)
                break;
            if (::write(node, answer.constData(), size_t(answer.size())) < 0)
                ::_exit(NoUser);
        }
        ::_exit(sees(local.number(), files.descriptors()));
    }
    ~MasterOfAnotherUser() { (void)result(); }
    enum Result { Nothing = 0, Bytes, NoConnection, NoUser };
    /// What it has got over its Unix socket.
    int result()
    {
        int status = 0;
        if (m_process > 0)
            ::waitpid(m_process, &status, 0);
        m_process = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

private:
    static int sees(int listener, const std::vector<int> &descriptors)
    {
        const int node = ::accept(listener, nullptr, nullptr);
        if (node < 0)
            return NoConnection;
        (void)qplc::sendDescriptors(node, 0, descriptors);
        char byte = 0;
        return ::read(node, &byte, 1) > 0 ? Bytes : Nothing;
    }
    pid_t m_process;
};

}  // namespace

class tst_HostileMaster : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void anHonestMasterGetsItsNode();
    void thingsOfOtherKindsAreRefused_data();
    void thingsOfOtherKindsAreRefused();
    void wrongNumberOfDescriptorsIsRefused_data();
    void wrongNumberOfDescriptorsIsRefused();
    void anotherKeyIsRefused();
    void aMasterThatPassesNothingIsRefused();
    void aMasterWithoutAUnixSocketIsRefused();
    void aMasterOfAnotherUserGetsNothing();

private:
    /// A master that passes \a descriptors to \a node with its Registered; null: it passes nothing.
    struct Play
    {
        bool begin()
        {
            QString error;
            node.connectToMaster(master.over("local"));
            if (master.next().kind() != QPlcMessage::Hello || !listener.open(session, &error))
                return false;
            QJsonObject hello = master.helloFields();
            hello.insert("session", QPlcMessage::fromHex64(session));
            master.send(QPlcMessage::Hello, hello);
            request = master.next();
            return request.kind() == QPlcMessage::Register;
        }
        bool pass(const std::vector<int> &descriptors)
        {
            QString error;
            return listener.pass(request.hex64("localKey"), descriptors, &error);
        }
        void finish()
        {
            master.send(QPlcMessage::Registered, master.registeredFields(request));
            master.send(QPlcMessage::CyclicChannelAttached);
        }
        QString refusal()
        {
            finish();
            const bool isRejected = waitUntil([this] { return node.state() == QPlcSlaveNode::Rejected; });
            return isRejected ? node.errorString() : QStringLiteral("not refused");
        }
        ~Play() { node.disconnectFromMaster(); }

        ScriptedMaster master;
        CounterNode node;
        LocalListener listener;
        const quint64 session = qplc::Host::machine().random();
        QPlcMessage request;
    };
};

void tst_HostileMaster::anHonestMasterGetsItsNode()
{
    Play play;
    const HonestFiles files;
    QVERIFY(files.isThere && play.begin() && play.pass(files.descriptors()));
    play.finish();
    QTRY_COMPARE(play.node.state(), QPlcSlaveNode::Off);
    QCOMPARE(play.node.error(), QPlcSlaveNode::NoError);
}

void tst_HostileMaster::thingsOfOtherKindsAreRefused_data()
{
    QTest::addColumn<QString>("role");
    QTest::addColumn<QString>("thing");
    QTest::addColumn<QString>("reason");
    for (const QString &role : roles) {
        const auto row = [&](const char *thing, const QString &reason) {
            QTest::addRow("%s: %s", qPrintable(role), thing) << role << thing << reason;
        };
        const bool isPipe = role == "pipe";
        const QString kind
            = isPipe ? QString("passed as pipe is not a pipe") : "passed as " + role + " is not sealed memory";
        for (const char *thing : {"file", "device", "directory", "handle of a file", "socket", "memory without seals"})
            row(thing, kind);
        if (isPipe) {
            row("file to write to", kind);
            row("end to read", kind);
            row("pipe that blocks", kind);
            continue;
        }
        row("memory that may shrink", kind);
        row("memory that may get other seals", kind);
        row("memory to read only", "cannot map");
        row("memory sealed against writing", "cannot map");
        for (const char *thing : {"shorter memory", "longer memory", "empty memory"})
            row(thing, QStringLiteral("bytes instead of %1").arg(sizeOf(role)));
    }
}

void tst_HostileMaster::thingsOfOtherKindsAreRefused()
{
    QFETCH(QString, role);
    QFETCH(QString, thing);
    QFETCH(QString, reason);
    const SecretFile secret(role);
    const HonestFiles files;
    const Descriptor wrong = hostile(thing, role, secret);
    QVERIFY(files.isThere && wrong.isOpen());
    std::vector<int> descriptors = files.descriptors();
    descriptors[std::size_t(roles.indexOf(role))] = wrong.number();
    LogCapture log;
    Play play;
    QVERIFY(play.begin() && play.pass(descriptors));
    const int before = openDescriptors();
    const QString refusal = play.refusal();
    QVERIFY2(refusal.contains(reason), qPrintable(refusal));
    QVERIFY(secret.isUntouched());
    QVERIFY(openDescriptors() <= before);
}

void tst_HostileMaster::wrongNumberOfDescriptorsIsRefused_data()
{
    QTest::addColumn<int>("count");
    for (const int count : {0, 1, 2, 4})
        QTest::addRow("%d", count) << count;
}

void tst_HostileMaster::wrongNumberOfDescriptorsIsRefused()
{
    QFETCH(int, count);
    const HonestFiles files;
    std::vector<int> descriptors = files.descriptors();
    descriptors.resize(std::size_t(count), files.channel.descriptor());
    LogCapture log;
    Play play;
    QVERIFY(files.isThere && play.begin() && play.pass(descriptors));
    const int before = openDescriptors();
    const QString refusal = play.refusal();
    QVERIFY2(refusal.contains(QStringLiteral("%1 descriptors instead of 3").arg(count)), qPrintable(refusal));
    QVERIFY(openDescriptors() <= before);
}

void tst_HostileMaster::anotherKeyIsRefused()
{
    const HonestFiles files;
    const quint64 session = qplc::Host::machine().random();
    QString error;
    sockaddr_un address;
    const socklen_t length = qplc::LocalSocket::addressOf(session, &address);
    const Descriptor local = qplc::LocalSocket::make();
    QVERIFY(::bind(local.number(), reinterpret_cast<sockaddr *>(&address), length) == 0
            && ::listen(local.number(), 5) == 0);
    ScriptedMaster master;
    CounterNode node;
    node.connectToMaster(master.over("local"));
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);
    QJsonObject hello = master.helloFields();
    hello.insert("session", QPlcMessage::fromHex64(session));
    master.send(QPlcMessage::Hello, hello);
    const QPlcMessage request = master.next();
    const Descriptor connection(::accept(local.number(), nullptr, nullptr));
    QVERIFY(qplc::sendDescriptors(connection.number(), request.hex64("localKey") + 1, files.descriptors()));
    LogCapture log;
    master.send(QPlcMessage::Registered, master.registeredFields(request));
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Rejected);
    QVERIFY2(node.errorString().contains("for another registration"), qPrintable(node.errorString()));
    node.disconnectFromMaster();
}

void tst_HostileMaster::aMasterThatPassesNothingIsRefused()
{
    LogCapture log;
    Play play;
    QVERIFY(play.begin());
    const QString refusal = play.refusal();
    QVERIFY2(refusal.contains("passed no memory"), qPrintable(refusal));
}

void tst_HostileMaster::aMasterWithoutAUnixSocketIsRefused()
{
    LogCapture log;
    ScriptedMaster master;
    CounterNode node;
    node.connectToMaster(master.over("local"));
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);
    QJsonObject hello = master.helloFields();
    hello.insert("session", QPlcMessage::fromHex64(qplc::Host::machine().random()));
    master.send(QPlcMessage::Hello, hello);
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Rejected);
    QVERIFY2(node.errorString().contains("takes no local nodes here: Connection refused; use udp"),
             qPrintable(node.errorString()));
    node.disconnectFromMaster();
}

void tst_HostileMaster::aMasterOfAnotherUserGetsNothing()
{
    if (::geteuid() != 0)
        QSKIP("only root can become another user");
    CounterNode node;
    QTcpServer server;
    QVERIFY(server.listen(QHostAddress::LocalHost));
    server.pauseAccepting();  // the other user does that
    const quint64 session = qplc::Host::machine().random();
    QJsonObject hello = ScriptedMaster().helloFields();
    hello.insert("session", QPlcMessage::fromHex64(session));
    MasterOfAnotherUser master(int(server.socketDescriptor()), session,
                               qplc::encodeControlFrame(QPlcMessage(QPlcMessage::Hello, hello)),
                               qplc::encodeControlFrame(QPlcMessage(QPlcMessage::Registered)));
    LogCapture log;
    const int before = openDescriptors();
    node.connectToMaster(QPlcUnderlyingProtocol::local(QString::number(server.serverPort())));
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Rejected);
    QVERIFY2(node.errorString().contains("the master runs as user 65534, and this node as user 0"),
             qPrintable(node.errorString()));
    node.disconnectFromMaster();
    QCOMPARE(master.result(), int(MasterOfAnotherUser::Nothing));
    QVERIFY(openDescriptors() <= before);
}

QTEST_GUILESS_MAIN(tst_HostileMaster)
#include "tst_HostileMaster.moc"
