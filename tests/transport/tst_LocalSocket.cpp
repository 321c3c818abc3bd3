// SPDX-License-Identifier: Apache-2.0
// How a master passes descriptors to local nodes, and what strangers can do to it.
#include "../common/Waiting.h"
#include "realtime/Host.h"
#include "transport/DescriptorMessage.h"
#include "transport/LocalConnection.h"
#include "transport/LocalListener.h"
#include "transport/LocalSocket.h"

#include <QtCore/QDir>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <functional>
#include <grp.h>
#include <sys/resource.h>
#include <sys/wait.h>

using qplc::Descriptor;
using qplc::DescriptorMessage;
using qplc::LocalConnection;
using qplc::LocalListener;
using qplc::receiveDescriptors;
using qplc::sendDescriptors;
namespace LocalSocket = qplc::LocalSocket;

namespace {

constexpr uid_t otherUser = 65534;  // nobody

int openDescriptors()
{
    return QDir("/proc/self/fd").entryList(QDir::Files | QDir::System | QDir::Dirs | QDir::NoDotAndDotDot).size();
}

/// Two ends that are connected.
struct Pair
{
    explicit Pair(int type = SOCK_SEQPACKET)
    {
        int ends[2] = {-1, -1};
        if (::socketpair(AF_UNIX, type | SOCK_CLOEXEC, 0, ends) < 0)
            qFatal("no pair of sockets");
        one = Descriptor(ends[0]);
        other = Descriptor(ends[1]);
    }
    Descriptor one;
    Descriptor other;
};

/// A plain connection to the listener of \a session.
Descriptor connectTo(quint64 session)
{
    sockaddr_un address;
    const socklen_t length = LocalSocket::addressOf(session, &address);
    Descriptor socket = LocalSocket::make();
    if (::connect(socket.number(), reinterpret_cast<sockaddr *>(&address), length) < 0)
        return {};
    return socket;
}

/// Runs \a code as another user. \return what it returns; -1: there is no such process
int asOtherUser(const std::function<int()> &code)
{
    const pid_t process = ::fork();
    if (process == 0) {
        const bool isOther = ::setgroups(0, nullptr) == 0 && ::setgid(otherUser) == 0 && ::setuid(otherUser) == 0;
        ::_exit(isOther ? code() : 255);
    }
    int status = 0;
    ::waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// A listener for a session of its own.
struct Master
{
    Master() { isOpen = listener.open(session, &error); }
    bool pass(quint64 key) { return listener.pass(key, {STDIN_FILENO, STDOUT_FILENO}, &error); }
    const quint64 session = qplc::Host::machine().random();
    LocalListener listener;
    QString error;
    bool isOpen = false;
};

}  // namespace

class tst_LocalSocket : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void descriptorsArriveAndAreNotInherited();
    void messageOfAnotherLengthIsRefusedWithItsDescriptors_data();
    void messageOfAnotherLengthIsRefusedWithItsDescriptors();
    void tooManyDescriptorsAreClosed();
    void descriptorsForWhichThereIsNoRoomAreRefused();
    void messageThatIsNotThereIsNotWaitedFor();
    void aNodeGetsWhatItsMasterPasses();
    void nodesAreToldApartByTheirKeys();
    void anUnknownKeyIsRefused();
    void aKeyWithDescriptorsIsRefused();
    void aNodeThatIsGoneIsRefused();
    void aNodeOfAnotherUserIsRefused();
    void aMasterOfAnotherUserGetsNoKey();
    void manyNodesRegisterAtATime();
    void silentConnectionsAreLimitedInNumber();
    void silentConnectionsAreLimitedInTime();
    void strangersDoNotFillTheQueue();
    void wantOfDescriptorsIsOvercome();
    void theNameIsFreeAgainAfterItsProcess();
    void aNameInUseIsReported();
};

void tst_LocalSocket::descriptorsArriveAndAreNotInherited()
{
    Pair pair;
    QVERIFY(sendDescriptors(pair.one.number(), 0x0123456789abcdef, {STDIN_FILENO, pair.one.number()}));
    const std::optional<DescriptorMessage> message = receiveDescriptors(pair.other.number());
    QVERIFY(message);
    QCOMPARE(message->key, std::uint64_t(0x0123456789abcdef));
    QCOMPARE(message->descriptors.size(), std::size_t(2));
    for (const Descriptor &each : message->descriptors)
        QCOMPARE(::fcntl(each.number(), F_GETFD), int(FD_CLOEXEC));
}

void tst_LocalSocket::messageOfAnotherLengthIsRefusedWithItsDescriptors_data()
{
    QTest::addColumn<int>("length");
    for (const int length : {1, 7, 9, 4096})
        QTest::addRow("%d bytes", length) << length;
}

void tst_LocalSocket::messageOfAnotherLengthIsRefusedWithItsDescriptors()
{
    QFETCH(int, length);
    Pair pair;
    const int before = openDescriptors();
    QByteArray bytes(length, 'x');
    iovec data{bytes.data(), std::size_t(length)};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))] = {};
    msghdr message{nullptr, 0, &data, 1, control, sizeof control, 0};
    cmsghdr *header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof(int));
    *reinterpret_cast<int *>(CMSG_DATA(header)) = STDIN_FILENO;
    QCOMPARE(::sendmsg(pair.one.number(), &message, 0), ssize_t(length));
    QVERIFY(!receiveDescriptors(pair.other.number()));
    QCOMPARE(errno, EBADMSG);
    QCOMPARE(openDescriptors(), before);
}

void tst_LocalSocket::tooManyDescriptorsAreClosed()
{
    Pair pair;
    const int before = openDescriptors();
    std::array<int, 250> many{};  // all STDIN_FILENO
    std::uint64_t key = 1;
    iovec data{&key, sizeof key};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof many)] = {};
    msghdr message{nullptr, 0, &data, 1, control, sizeof control, 0};
    cmsghdr *header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof many);
    std::memcpy(CMSG_DATA(header), many.data(), sizeof many);
    QCOMPARE(::sendmsg(pair.one.number(), &message, 0), ssize_t(sizeof key));
    QVERIFY(!receiveDescriptors(pair.other.number()));
    QCOMPARE(errno, EBADMSG);
    QCOMPARE(openDescriptors(), before);
}

void tst_LocalSocket::descriptorsForWhichThereIsNoRoomAreRefused()
{
    Pair pair;
    QVERIFY(sendDescriptors(pair.one.number(), 1, {STDIN_FILENO, STDIN_FILENO, STDIN_FILENO}));
    rlimit before{};
    QCOMPARE(::getrlimit(RLIMIT_NOFILE, &before), 0);
    const Descriptor last(::dup(STDIN_FILENO));
    rlimit few = before;
    few.rlim_cur = rlim_t(last.number()) + 2;  // room for one
    QCOMPARE(::setrlimit(RLIMIT_NOFILE, &few), 0);
    const bool isTaken = receiveDescriptors(pair.other.number()).has_value();
    const int error = errno;
    QCOMPARE(::setrlimit(RLIMIT_NOFILE, &before), 0);
    QVERIFY(!isTaken);
    QCOMPARE(error, EBADMSG);
}

void tst_LocalSocket::messageThatIsNotThereIsNotWaitedFor()
{
    Pair pair;
    QVERIFY(!receiveDescriptors(pair.other.number()));
    QCOMPARE(errno, EAGAIN);
    pair.one = Descriptor();
    QVERIFY(!receiveDescriptors(pair.other.number()));
    QCOMPARE(errno, ECONNRESET);
}

void tst_LocalSocket::aNodeGetsWhatItsMasterPasses()
{
    Master master;
    LocalConnection node;
    QVERIFY2(master.isOpen && node.open(master.session, &master.error), qPrintable(master.error));
    QVERIFY2(master.pass(node.key()), qPrintable(master.error));
    QCOMPARE(node.take(2, &master.error).size(), std::size_t(2));
    QCOMPARE(master.listener.waiting(), std::size_t(0));
}

void tst_LocalSocket::nodesAreToldApartByTheirKeys()
{
    Master master;
    LocalConnection one;
    LocalConnection two;
    QVERIFY(one.open(master.session, &master.error) && two.open(master.session, &master.error));
    QVERIFY(one.key() != two.key());
    QVERIFY2(master.pass(two.key()), qPrintable(master.error));
    QVERIFY(one.take(2, &master.error).empty());
    QCOMPARE(two.take(2, &master.error).size(), std::size_t(2));
    QVERIFY(!master.pass(two.key()));
}

void tst_LocalSocket::anUnknownKeyIsRefused()
{
    Master master;
    LocalConnection node;
    QVERIFY(node.open(master.session, &master.error));
    QVERIFY(!master.pass(node.key() + 1));
    QVERIFY2(master.error.contains("no program of user " + QString::number(::geteuid())), qPrintable(master.error));
    QVERIFY(!master.pass(0));
    QVERIFY2(master.pass(node.key()), qPrintable(master.error));  // it waits still
}

void tst_LocalSocket::aKeyWithDescriptorsIsRefused()
{
    Master master;
    const Descriptor node = connectTo(master.session);
    const int before = openDescriptors();
    QVERIFY(sendDescriptors(node.number(), 4711, {STDIN_FILENO, STDIN_FILENO}));
    QVERIFY(!master.pass(4711));
    QCOMPARE(openDescriptors(), before);
}

void tst_LocalSocket::aNodeThatIsGoneIsRefused()
{
    Master master;
    quint64 key = 0;
    {
        LocalConnection node;
        QVERIFY(node.open(master.session, &master.error));
        key = node.key();
    }
    QVERIFY(!master.pass(key));
    QCOMPARE(master.listener.waiting(), std::size_t(0));
}

void tst_LocalSocket::aNodeOfAnotherUserIsRefused()
{
    if (::geteuid() != 0)
        QSKIP("only root can become another user");
    Master master;
    const auto connect = [&] {
        const Descriptor socket = connectTo(master.session);  // does not ask who the master is
        return socket.isOpen() && sendDescriptors(socket.number(), 4711, {}) ? 0 : 1;
    };
    QCOMPARE(asOtherUser(connect), 0);
    QVERIFY(!master.pass(4711));
    QVERIFY2(master.error.contains("no program of user 0 has connected"), qPrintable(master.error));
    QCOMPARE(master.listener.waiting(), std::size_t(0));
}

void tst_LocalSocket::aMasterOfAnotherUserGetsNoKey()
{
    if (::geteuid() != 0)
        QSKIP("only root can become another user");
    const quint64 session = qplc::Host::machine().random();
    sockaddr_un address;
    const socklen_t length = LocalSocket::addressOf(session, &address);
    const Descriptor listener = LocalSocket::make();
    QCOMPARE(::bind(listener.number(), reinterpret_cast<sockaddr *>(&address), length), 0);
    QCOMPARE(asOtherUser([&] { return ::listen(listener.number(), 5); }), 0);  // the kernel asks who calls this
    LocalConnection node;
    QString error;
    QVERIFY(!node.open(session, &error));
    QVERIFY2(error.contains("the master runs as user 65534, and this node as user 0"), qPrintable(error));
    const Descriptor connection(::accept(listener.number(), nullptr, nullptr));
    QVERIFY(connection.isOpen() && !receiveDescriptors(connection.number()));
    QCOMPARE(errno, EAGAIN);
}

/// All nodes of a computer connect before the first one of them registers.
void tst_LocalSocket::manyNodesRegisterAtATime()
{
    Master master;
    std::vector<std::unique_ptr<LocalConnection>> nodes;
    for (int i = 0; i < 250; ++i) {
        nodes.push_back(std::make_unique<LocalConnection>());
        QVERIFY2(nodes.back()->open(master.session, &master.error), qPrintable(master.error));
    }
    for (const std::unique_ptr<LocalConnection> &node : nodes)
        QVERIFY2(master.pass(node->key()), qPrintable(master.error));
}

void tst_LocalSocket::silentConnectionsAreLimitedInNumber()
{
    Master master;
    std::vector<Descriptor> silent;
    constexpr std::size_t tooMany = LocalListener::MaximumWaiting + 50;
    while (silent.size() < tooMany) {
        const bool isThere = waitUntil([&] {
            Descriptor socket = connectTo(master.session);
            const bool isOpen = socket.isOpen();
            if (isOpen)
                silent.push_back(std::move(socket));
            return isOpen;
        });
        QVERIFY(isThere);
    }
    LocalConnection node;
    QVERIFY2(waitUntil([&] { return node.open(master.session, &master.error); }), qPrintable(master.error));
    QVERIFY2(master.pass(node.key()), qPrintable(master.error));
    QCOMPARE(master.listener.waiting(), LocalListener::MaximumWaiting - 1);
}

void tst_LocalSocket::silentConnectionsAreLimitedInTime()
{
    Master master;
    const Descriptor silent = connectTo(master.session);
    QVERIFY(waitUntil([&] { return master.listener.waiting() == 1; }));
    QVERIFY(waitUntil([&] { return master.listener.waiting() == 0; }, 60'000));
}

void tst_LocalSocket::strangersDoNotFillTheQueue()
{
    if (::geteuid() != 0)
        QSKIP("only root can become another user");
    Master master;
    // They connect until the queue is full, and keep their ends.
    const auto fill = [&] {
        std::vector<Descriptor> ends;
        do
            ends.push_back(connectTo(master.session));
        while (ends.back().isOpen());
        return int(ends.size());
    };
    QVERIFY(asOtherUser(fill) > 1);
    LocalConnection node;
    QVERIFY2(waitUntil([&] { return node.open(master.session, &master.error); }), qPrintable(master.error));
    QVERIFY2(master.pass(node.key()), qPrintable(master.error));
}

void tst_LocalSocket::wantOfDescriptorsIsOvercome()
{
    Master master;
    LocalConnection node;
    QVERIFY(node.open(master.session, &master.error));
    rlimit before{};
    QCOMPARE(::getrlimit(RLIMIT_NOFILE, &before), 0);
    rlimit none = before;
    none.rlim_cur = 1;
    QCOMPARE(::setrlimit(RLIMIT_NOFILE, &none), 0);
    const bool isPassed = master.pass(node.key());
    QCOMPARE(::setrlimit(RLIMIT_NOFILE, &before), 0);
    QVERIFY(!isPassed);
    QVERIFY(waitUntil([&] { return master.listener.waiting() == 1; }, 30'000));  // it looks again by itself
    QVERIFY2(master.pass(node.key()), qPrintable(master.error));
}

void tst_LocalSocket::theNameIsFreeAgainAfterItsProcess()
{
    const quint64 session = qplc::Host::machine().random();
    sockaddr_un address;
    const socklen_t length = LocalSocket::addressOf(session, &address);
    const pid_t process = ::fork();
    if (process == 0) {
        const Descriptor listener = LocalSocket::make();
        if (::bind(listener.number(), reinterpret_cast<sockaddr *>(&address), length) < 0
            || ::listen(listener.number(), 5) < 0)
            ::_exit(1);
        for (;;)
            ::pause();
    }
    QVERIFY(waitUntil([&] { return connectTo(session).isOpen(); }));
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
    QVERIFY(!connectTo(session).isOpen());
    LocalListener listener;
    QString error;
    QVERIFY2(listener.open(session, &error), qPrintable(error));
}

void tst_LocalSocket::aNameInUseIsReported()
{
    Master master;
    LocalListener second;
    QVERIFY(!second.open(master.session, &master.error));
    QVERIFY2(master.error.contains("cannot listen for local nodes: Address already in use"), qPrintable(master.error));
    QVERIFY(!second.pass(1, {}, &master.error));
}

QTEST_GUILESS_MAIN(tst_LocalSocket)
#include "tst_LocalSocket.moc"
