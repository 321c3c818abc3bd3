// SPDX-License-Identifier: Apache-2.0
// A master on this machine that names other things than its own memory and pipe, to let a node
// write into them.
#include "../common/Waiting.h"
#include "ScriptedMaster.h"
#include "protocol/ControlFrame.h"
#include "transport/SharedChannel.h"

#include <fcntl.h>
#include <functional>
#include <grp.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>

using qplc::Doorbell;
using qplc::SharedChannel;
using qplc::SharedMemory;

namespace {

constexpr uid_t otherUser = 65534;  // nobody
const QStringList roles{"channel", "doorbell", "pipe"};

QString pathOf(int descriptor)
{
    return QStringLiteral("/proc/%1/fd/%2").arg(::getpid()).arg(descriptor);
}

std::size_t sizeOf(const QString &role)
{
    return role == "doorbell" ? sizeof(Doorbell) : sizeof(SharedChannel);
}

/// What an honest master has.
struct HonestFiles
{
    HonestFiles()
    {
        QString error;
        isThere = channel.create(sizeof(SharedChannel), &error) && bell.create(sizeof(Doorbell), &error)
            && ::pipe2(pipe, O_NONBLOCK | O_CLOEXEC) == 0;
    }
    ~HonestFiles()
    {
        ::close(pipe[0]);
        ::close(pipe[1]);
    }
    QJsonObject fields() const
    {
        return {{"channel", channel.path()}, {"doorbell", bell.path()}, {"pipe", pathOf(pipe[1])}};
    }

    SharedMemory channel;
    SharedMemory bell;
    int pipe[2] = {-1, -1};
    bool isThere = false;
};

/// A file of this user that no other user may read. It has the size of the memory for which it is
/// given out.
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
    QString name() const { return m_file.fileName(); }
    int descriptor() const { return m_file.handle(); }
    QString path(const QString &other) const { return m_folder.filePath(other); }
    bool isUntouched() const
    {
        QFile file(name());
        return file.open(QIODevice::ReadOnly) && file.readAll() == m_content;
    }

private:
    const QTemporaryDir m_folder;
    const QByteArray m_content;
    QFile m_file;
};

/// Descriptors of a row, closed in the end.
struct Descriptors : QVector<int>
{
    ~Descriptors()
    {
        for (const int descriptor : *this)
            ::close(descriptor);
    }
    QString add(int descriptor)
    {
        append(descriptor);
        return pathOf(descriptor);
    }
};

/// What a hostile master may name: a path for each word.
QString hostilePath(const QString &thing, const SecretFile &secret, const SharedMemory &memory, Descriptors *open)
{
    const QByteArray link = QFile::encodeName(secret.path("link"));
    if (thing == "file")
        return secret.name();
    if (thing == "descriptor of a file")
        return pathOf(secret.descriptor());
    if (thing == "link to a file")
        return ::symlink(QFile::encodeName(secret.name()).constData(), link.constData()) == 0 ? QString(link)
                                                                                              : QString();
    if (thing == "link to memory")
        return ::symlink(memory.path().toLatin1().constData(), link.constData()) == 0 ? QString(link) : QString();
    if (thing == "descriptor of a link") {
        if (::symlink(memory.path().toLatin1().constData(), link.constData()) != 0)
            return {};
        return open->add(::open(link.constData(), O_PATH | O_NOFOLLOW | O_CLOEXEC));
    }
    if (thing == "device")
        return open->add(::open("/dev/zero", O_RDWR | O_CLOEXEC));
    if (thing == "directory")
        return open->add(::open(QFile::encodeName(secret.path(".")).constData(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    return {};
}

/// A process of another user that plays a master at \a listener, step by step: it sends \a hello,
/// and then what \a registered makes.
class MasterOfAnotherUser
{
public:
    MasterOfAnotherUser(int listener, const QByteArray &hello, const std::function<QByteArray()> &registered)
        : m_process(::fork())
    {
        if (m_process != 0)
            return;
        if (::setgroups(0, nullptr) != 0 || ::setgid(otherUser) != 0 || ::setuid(otherUser) != 0)
            ::_exit(1);
        pollfd incoming{listener, POLLIN, 0};
        const int node = ::poll(&incoming, 1, -1) == 1 ? ::accept(listener, nullptr, nullptr) : -1;
        for (const QByteArray &answer : {hello, registered()}) {
            char bytes[65536];
            if (::read(node, bytes, sizeof bytes) <= 0 || ::write(node, answer.constData(), size_t(answer.size())) < 0)
                ::_exit(1);
        }
        char byte = 0;
        while (::read(node, &byte, 1) > 0)
            continue;
        ::_exit(0);
    }
    ~MasterOfAnotherUser()
    {
        ::kill(m_process, SIGKILL);
        int status = 0;
        ::waitpid(m_process, &status, 0);
    }

private:
    const pid_t m_process;
};

/// The fields of Registered that fit the declaration of \a node.
QJsonObject layoutFields(QPlcSlaveNode &node)
{
    ScriptedMaster master;
    node.connectToMaster(master.tcp());
    if (master.next().kind() != QPlcMessage::Hello)
        return {};
    master.send(QPlcMessage::Hello, master.helloFields());
    const QPlcMessage request = master.next();
    node.disconnectFromMaster();
    return master.registeredFields(request);
}

QPlcUnderlyingProtocol localAddress(quint16 port)
{
    return QPlcUnderlyingProtocol::local(QString::number(port));
}

}  // namespace

class tst_HostileMaster : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void anHonestMasterGetsItsNode();
    void filesOfOtherKindsAreNotOpened_data();
    void filesOfOtherKindsAreNotOpened();
    void filesOfAnotherUserAreNotOpened_data();
    void filesOfAnotherUserAreNotOpened();
    void aMasterOfAnotherUserCannotReachFilesOfThisOne_data();
    void aMasterOfAnotherUserCannotReachFilesOfThisOne();
    void aMasterOfAnotherUserMayNameItsOwnMemory();

private:
    /// Lets \a node register at \a master, which then names \a fields.
    static bool answer(ScriptedMaster &master, QPlcSlaveNode &node, const QJsonObject &fields)
    {
        node.connectToMaster(localAddress(master.tcp().port()));
        if (master.next().kind() != QPlcMessage::Hello)
            return false;
        master.send(QPlcMessage::Hello, master.helloFields());
        QJsonObject registered = master.registeredFields(master.next());
        for (const QString &name : fields.keys())
            registered.insert(name, fields.value(name));
        master.send(QPlcMessage::Registered, registered);
        return true;
    }
};

void tst_HostileMaster::anHonestMasterGetsItsNode()
{
    ScriptedMaster master;
    CounterNode node;
    const HonestFiles files;
    QVERIFY(files.isThere);
    QVERIFY(answer(master, node, files.fields()));
    master.send(QPlcMessage::CyclicChannelAttached);
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Off);
    QCOMPARE(node.error(), QPlcSlaveNode::NoError);
    node.disconnectFromMaster();
}

void tst_HostileMaster::filesOfOtherKindsAreNotOpened_data()
{
    QTest::addColumn<QString>("role");
    QTest::addColumn<QString>("thing");
    QTest::addColumn<QString>("reason");
    for (const QString &role : roles) {
        const auto row = [&](const char *thing, const char *reason) {
            QTest::addRow("%s: %s", qPrintable(role), thing) << role << thing << reason;
        };
        row("file", "it has to be a descriptor of the master");
        row("link to a file", "it has to be a descriptor of the master");
        row("link to memory", "it has to be a descriptor of the master");
        row("descriptor of a file", role == "pipe" ? "it is a file and not a pipe" : "not sealed memory");
        row("descriptor of a link", "it is a symbolic link");
        row("device", "it is a device");
        row("directory", "it is a directory");
    }
}

void tst_HostileMaster::filesOfOtherKindsAreNotOpened()
{
    QFETCH(QString, role);
    QFETCH(QString, thing);
    QFETCH(QString, reason);
    if (::geteuid() != 0 && thing == "device")
        reason = "it belongs to user 0";
    ScriptedMaster master;
    CounterNode node;
    const SecretFile secret(role);
    const HonestFiles files;
    QVERIFY(files.isThere);
    Descriptors open;
    QJsonObject fields = files.fields();
    const QString path = hostilePath(thing, secret, role == "doorbell" ? files.bell : files.channel, &open);
    fields.insert(role, path);
    LogCapture log;
    QVERIFY(answer(master, node, fields));
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Rejected);
    QVERIFY2(node.errorString().contains("'" + path + "', is not opened: ") && node.errorString().contains(reason),
             qPrintable(node.errorString()));
    QVERIFY(secret.isUntouched());
    node.disconnectFromMaster();
}

void tst_HostileMaster::filesOfAnotherUserAreNotOpened_data()
{
    QTest::addColumn<QString>("role");
    for (const QString &role : roles)
        QTest::newRow(qPrintable(role)) << role;
}

void tst_HostileMaster::filesOfAnotherUserAreNotOpened()
{
    if (::geteuid() != 0)
        QSKIP("only root can give a file to another user");
    QFETCH(QString, role);
    ScriptedMaster master;
    CounterNode node;
    const HonestFiles files;
    QVERIFY(files.isThere);
    const QString path = files.fields().value(role).toString();
    const int descriptor = path.section('/', -1).toInt();
    QCOMPARE(::fchown(descriptor, otherUser, otherUser), 0);
    LogCapture log;
    QVERIFY(answer(master, node, files.fields()));
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Rejected);
    QVERIFY2(node.errorString().contains("it belongs to user 65534, and the master runs as user 0"),
             qPrintable(node.errorString()));
    char byte = 0;
    QCOMPARE(::read(files.pipe[0], &byte, 1), ssize_t(-1));  // nothing was written
    node.disconnectFromMaster();
}

void tst_HostileMaster::aMasterOfAnotherUserCannotReachFilesOfThisOne_data()
{
    QTest::addColumn<QString>("role");
    QTest::addColumn<bool>("isByDescriptor");
    QTest::addColumn<QString>("reason");
    for (const QString &role : roles) {
        QTest::addRow("%s: file by its name", qPrintable(role))
            << role << false << "it has to be a descriptor of the master";
        QTest::addRow("%s: descriptor of a program of root", qPrintable(role))
            << role << true << "it belongs to user 0, and the master runs as user 65534";
    }
}

void tst_HostileMaster::aMasterOfAnotherUserCannotReachFilesOfThisOne()
{
    if (::geteuid() != 0)
        QSKIP("only root can become another user");
    QFETCH(QString, role);
    QFETCH(bool, isByDescriptor);
    QFETCH(QString, reason);
    CounterNode node;
    const SecretFile secret(role);
    const QJsonObject layout = layoutFields(node);
    QTcpServer server;
    QVERIFY(server.listen(QHostAddress::LocalHost));
    server.pauseAccepting();  // the other user does that
    const QString path = isByDescriptor ? pathOf(secret.descriptor()) : secret.name();
    const MasterOfAnotherUser master(
        int(server.socketDescriptor()),
        qplc::encodeControlFrame(QPlcMessage(QPlcMessage::Hello, ScriptedMaster().helloFields())), [&] {
            auto *files = new HonestFiles;  // of the other user
            QJsonObject fields = layout;
            const QJsonObject own = files->fields();
            for (const QString &name : roles)
                fields.insert(name, name == role ? QJsonValue(path) : own.value(name));
            return qplc::encodeControlFrame(QPlcMessage(QPlcMessage::Registered, fields));
        });
    LogCapture log;
    node.connectToMaster(localAddress(server.serverPort()));
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Rejected);
    QVERIFY2(node.errorString().contains(reason), qPrintable(node.errorString()));
    QVERIFY(secret.isUntouched());
    node.disconnectFromMaster();
}

void tst_HostileMaster::aMasterOfAnotherUserMayNameItsOwnMemory()
{
    if (::geteuid() != 0)
        QSKIP("only root can become another user");
    CounterNode node;
    const QJsonObject layout = layoutFields(node);
    QTcpServer server;
    QVERIFY(server.listen(QHostAddress::LocalHost));
    server.pauseAccepting();  // the other user does that
    const MasterOfAnotherUser master(
        int(server.socketDescriptor()),
        qplc::encodeControlFrame(QPlcMessage(QPlcMessage::Hello, ScriptedMaster().helloFields())), [&] {
            auto *files = new HonestFiles;
            QJsonObject fields = layout;
            const QJsonObject own = files->fields();
            for (const QString &name : roles)
                fields.insert(name, own.value(name));
            return qplc::encodeControlFrame(QPlcMessage(QPlcMessage::Registered, fields))
                + qplc::encodeControlFrame(QPlcMessage(QPlcMessage::CyclicChannelAttached));
        });
    node.connectToMaster(localAddress(server.serverPort()));
    QTRY_VERIFY2(node.state() == QPlcSlaveNode::Off, qPrintable(node.errorString()));
    node.disconnectFromMaster();
}

QTEST_GUILESS_MAIN(tst_HostileMaster)
#include "tst_HostileMaster.moc"
