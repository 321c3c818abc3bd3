// SPDX-License-Identifier: Apache-2.0
#include "TransportFixtures.h"
#include "transport/LocalTransport.h"
#include "transport/StreamTransport.h"
#include "transport/UdpTransport.h"

#include <QtTest/QtTest>

#include <cerrno>
#include <sys/syscall.h>

using qplc::CyclicHub;
using qplc::HubFrame;
using qplc::HubPeer;
using qplc::HubTransport;
using qplc::LocalTransport;
using qplc::SharedChannel;
using qplc::SocketAddress;
using qplc::StreamTransport;
using qplc::UdpTransport;

namespace {

int interruptions = 0;  // so many calls of sendmmsg() end with EINTR

}  // namespace

/// In the place of the one of the C library: a signal that comes at the right time cannot be sent
/// from a test.
extern "C" int sendmmsg(int descriptor, mmsghdr *messages, unsigned count, int flags)
{
    if (interruptions > 0) {
        --interruptions;
        errno = EINTR;
        return -1;
    }
    return int(::syscall(SYS_sendmmsg, descriptor, messages, count, flags));
}

class tst_CyclicHub : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void datagramsGoToAndComeFromPeers();
    void strangersAreCounted();
    void strangersWakeNobodyAndTakeNoRoom_data();
    void strangersWakeNobodyAndTakeNoRoom();
    void aPeerThatIsDeletedIsAStranger();
    void aFloodOfAPeerIsReadInPortions();
    void floodOfALocalNodeDoesNotDelayOthers();
    void datagramsThatTheKernelDropsAreCounted();
    void ipv6PeersAreFound();
    void anyAddressServesIpv4AndIpv6();
    void manyPeersAreServedWithFewCalls();
    void aDetachedPeerIsAStranger();
    void streamsGiveWholeFrames();
    void garbageClosesTheStream();
    void hubReportsAPeerThatClosed();
    void peerThatDoesNotReadDelaysNoOtherPeer();
    void waitEndsInTime();
    void aHubThatWasNeverOpenWaitsInVain();
    void alarmEndsTheWaitWithoutAFrame();
    void refusedDatagramIsCountedAndOthersAreSent();
    void anInterruptedCallIsMadeAgain();
    void portInUseIsReported();

private:
    static QVector<QPair<HubPeer *, QByteArray>> take(CyclicHub &hub, int atLeast)
    {
        QVector<QPair<HubPeer *, QByteArray>> all;
        for (int tries = 0; tries < 100 && all.size() < atLeast; ++tries) {
            hub.wait(50'000'000);
            HubFrame incoming;
            while (hub.next(&incoming))
                all.append({incoming.peer, QByteArray(incoming.bytes, int(incoming.size))});
        }
        return all;
    }
    /// Opens \a hub on a free port of \a address.
    static SocketAddress open(CyclicHub &hub, const QHostAddress &address = QHostAddress(QHostAddress::LocalHost))
    {
        QString error;
        for (int tries = 0; tries < 20; ++tries) {
            SocketAddress self;
            {
                const UdpSocket free(address);
                self = free.self;
            }
            if (hub.open(self, &error))
                return self;
        }
        return {};
    }
};

void tst_CyclicHub::datagramsGoToAndComeFromPeers()
{
    CyclicHub hub;
    const SocketAddress self = open(hub);
    UdpSocket a;
    UdpSocket b;
    const auto peerA = hub.find<UdpTransport>()->peer(a.self);
    const auto peerB = hub.find<UdpTransport>()->peer(b.self);
    hub.attach(peerA.get());
    hub.attach(peerB.get());
    hub.send(peerA.get(), "one", 3);
    hub.send(peerB.get(), "two", 3);
    QCOMPARE(a.receive(MSG_DONTWAIT), QByteArray("nothing"));  // until flush()
    hub.flush();
    QCOMPARE(a.receive(), QByteArray("one"));
    QCOMPARE(b.receive(), QByteArray("two"));
    QVERIFY(b.send("from b", self));
    QVERIFY(a.send("", self));
    const auto taken = take(hub, 2);
    QCOMPARE(taken.size(), 2);
    QCOMPARE(taken.at(0).first, peerB.get());
    QCOMPARE(taken.at(0).second, QByteArray("from b"));
    QCOMPARE(taken.at(1).first, peerA.get());
    QVERIFY(taken.at(1).second.isEmpty());
}

void tst_CyclicHub::strangersAreCounted()
{
    CyclicHub hub;
    const SocketAddress self = open(hub);
    UdpSocket known;
    UdpSocket stranger;
    const auto peer = hub.find<UdpTransport>()->peer(known.self);
    hub.attach(peer.get());
    for (int i = 0; i < 40; ++i)
        QVERIFY(stranger.send("x", self));
    QVERIFY(known.send("y", self));
    const auto taken = take(hub, 1);
    QCOMPARE(taken.size(), 1);
    QCOMPARE(taken.at(0).second, QByteArray("y"));
    QCOMPARE(hub.keptOff(), std::uint64_t(40));
    hub.close();
    QCOMPARE(hub.keptOff(), std::uint64_t(40));
}

void tst_CyclicHub::strangersWakeNobodyAndTakeNoRoom_data()
{
    QTest::addColumn<QString>("master");
    QTest::addColumn<QString>("node");
    QTest::addColumn<QString>("stranger");
    QTest::addColumn<int>("others");  // peers
    const auto add = [](const char *name, const char *master, const char *node, const char *stranger, int others = 0) {
        QTest::newRow(name) << QString(master) << QString(node) << QString(stranger) << others;
    };
    add("another port", "127.0.0.1", "127.0.0.1", "127.0.0.1");
    add("another address", "127.0.0.1", "127.0.0.1", "127.0.0.2");
    add("IPv6", "::1", "::1", "::1");
    add("IPv4 at a socket of IPv6", "::", "127.0.0.1", "127.0.0.2");
    add("IPv6 and IPv4", "::", "127.0.0.1", "::1");
    add("IPv4 and IPv6", "::", "::1", "127.0.0.1");
    add("250 peers", "127.0.0.1", "127.0.0.1", "127.0.0.2", 250);
    add("850 peers", "127.0.0.1", "127.0.0.1", "127.0.0.2", 850);
    add("400 peers of IPv6", "::", "::1", "::1", 400);
}

void tst_CyclicHub::strangersWakeNobodyAndTakeNoRoom()
{
    QFETCH(QString, master);
    QFETCH(QString, node);
    QFETCH(QString, stranger);
    QFETCH(int, others);
    UdpSocket known{QHostAddress(node)};
    UdpSocket foe{QHostAddress(stranger)};
    if (!known.ok || !foe.ok)
        QSKIP("no IPv6 here", "");
    CyclicHub hub;
    SocketAddress self = open(hub, QHostAddress(master));
    SocketAddress goal = self;
    if (master == QLatin1String("::")) {
        self = SocketAddress(QHostAddress(node), self.port());
        goal = SocketAddress(QHostAddress(stranger == QLatin1String("::1") ? "::1" : "127.0.0.1"), self.port());
    }
    const auto peer = hub.find<UdpTransport>()->peer(known.self);
    std::vector<std::unique_ptr<HubPeer>> further;
    for (int i = 0; i < others; ++i) {
        const QHostAddress address(node == QLatin1String("::1")
                                       ? QStringLiteral("fe80::1:%1").arg(i, 0, 16)
                                       : QStringLiteral("10.0.%1.%2").arg(i / 250).arg(i % 250));
        further.push_back(hub.find<UdpTransport>()->peer(SocketAddress(address, quint16(1 + i))));
    }
    hub.attach(peer.get());
    for (int i = 0; i < 5000; ++i)
        foe.send("x", goal);
    QVERIFY(!hub.wait(0));
    QVERIFY(known.send("y", self));
    const auto taken = take(hub, 1);
    QCOMPARE(taken.size(), 1);
    QCOMPARE(taken.at(0).second, QByteArray("y"));
    QCOMPARE(hub.keptOff(), std::uint64_t(5000));
    QCOMPARE(hub.unread(), std::uint64_t(0));
    QCOMPARE(hub.strangers(), std::uint64_t(0));
}

/// A node that is no longer registered.
void tst_CyclicHub::aPeerThatIsDeletedIsAStranger()
{
    CyclicHub hub;
    const SocketAddress self = open(hub);
    UdpSocket socket;
    auto peer = hub.find<UdpTransport>()->peer(socket.self);
    auto again = hub.find<UdpTransport>()->peer(socket.self);  // it registers before its former self is gone
    peer.reset();
    QVERIFY(socket.send("x", self));
    QCOMPARE(hub.keptOff(), std::uint64_t(0));
    again.reset();
    QVERIFY(socket.send("x", self));
    QCOMPARE(hub.keptOff(), std::uint64_t(1));
}

void tst_CyclicHub::aFloodOfAPeerIsReadInPortions()
{
    CyclicHub hub;
    const SocketAddress self = open(hub);
    UdpSocket other;
    UdpSocket flood;
    auto *transport = hub.find<UdpTransport>();
    const std::unique_ptr<HubPeer> peers[2] = {transport->peer(flood.self), transport->peer(other.self, {100, 0})};
    for (const auto &peer : peers)
        hub.attach(peer.get());
    for (int i = 0; i < 300; ++i)
        flood.send("x", self);
    HubFrame incoming;
    QVERIFY(hub.wait(1'000'000'000));
    int frames = 0;
    while (hub.next(&incoming))
        ++frames;
    QCOMPARE(frames, int(HubTransport::FramesPerWait));
    QCOMPARE(hub.floods(), std::uint64_t(1));
    QVERIFY(other.send("y", self));
    QVERIFY(hub.wait(0));  // there is more
    while (hub.next(&incoming))
        ++frames;
    QCOMPARE(frames, 301);
    QCOMPARE(incoming.peer, peers[1].get());
    QCOMPARE(hub.floods(), std::uint64_t(1));
}

void tst_CyclicHub::floodOfALocalNodeDoesNotDelayOthers()
{
    CyclicHub hub;
    open(hub);
    QString error;
    QVERIFY2(hub.open(qplc::SocketAddress(QHostAddress(QHostAddress::LocalHost), 0), &error), qPrintable(error));
    std::array<std::unique_ptr<HubPeer>, 2> peers;
    std::array<SharedChannel *, 2> channels{};
    for (std::size_t i = 0; i < 2; ++i) {
        auto channel = std::make_unique<SharedChannel>();
        QVERIFY(channel->create({}, &error));
        channels[i] = channel.get();
        peers[i] = LocalTransport::peer(std::move(channel));
        hub.attach(peers[i].get());
    }
    for (int i = 0; i < 1000; ++i)
        QVERIFY(channels[0]->outputs.push("flood", 5));
    QVERIFY(channels[1]->outputs.push("other", 5));
    hub.wait(0);
    HubFrame incoming;
    int floods = 0;
    int others = 0;
    while (hub.next(&incoming))
        ++(incoming.peer == peers[0].get() ? floods : others);
    QCOMPARE(floods, int(HubTransport::FramesPerWait));
    QCOMPARE(others, 1);
    QCOMPARE(hub.floods(), std::uint64_t(1));
    while (hub.wait(0)) {  // says itself that there is more
        while (hub.next(&incoming))
            ++floods;
    }
    QCOMPARE(floods, 1000);
}

void tst_CyclicHub::datagramsThatTheKernelDropsAreCounted()
{
    CyclicHub hub;
    const SocketAddress self = open(hub);
    UdpSocket node;
    const auto peer = hub.find<UdpTransport>()->peer(node.self);
    hub.attach(peer.get());
    const QByteArray datagram(1400, 'x');
    for (int i = 0; i < 5000; ++i)
        node.send(datagram, self);
    HubFrame incoming;
    std::uint64_t frames = 0;
    for (int i = 0; i < 1000 && hub.wait(0); ++i)
        while (hub.next(&incoming))
            ++frames;
    QVERIFY(hub.unread() > 0);
    QCOMPARE(frames + hub.unread(), std::uint64_t(5000));
}

void tst_CyclicHub::ipv6PeersAreFound()
{
    UdpSocket node{QHostAddress(QHostAddress::LocalHostIPv6)};
    if (!node.ok)
        QSKIP("no IPv6 here", "");
    CyclicHub hub;
    const SocketAddress self = open(hub, QHostAddress(QHostAddress::LocalHostIPv6));
    QCOMPARE(self.family(), AF_INET6);
    const auto peer = hub.find<UdpTransport>()->peer(node.self);
    hub.attach(peer.get());
    hub.send(peer.get(), "six", 3);
    hub.flush();
    QCOMPARE(node.receive(), QByteArray("six"));
    QVERIFY(node.send("back", self));
    QCOMPARE(take(hub, 1).at(0).first, peer.get());
}

void tst_CyclicHub::anyAddressServesIpv4AndIpv6()
{
    UdpSocket six{QHostAddress(QHostAddress::LocalHostIPv6)};
    if (!six.ok)
        QSKIP("no IPv6 here", "");
    UdpSocket four;
    CyclicHub hub;
    const SocketAddress self = open(hub, QHostAddress(QHostAddress::Any));
    const auto sixPeer = hub.find<UdpTransport>()->peer(six.self);
    const auto fourPeer = hub.find<UdpTransport>()->peer(four.self);
    hub.attach(sixPeer.get());
    hub.attach(fourPeer.get());
    hub.send(sixPeer.get(), "six", 3);
    hub.send(fourPeer.get(), "four", 4);
    hub.flush();
    QCOMPARE(six.receive(), QByteArray("six"));
    QCOMPARE(four.receive(), QByteArray("four"));
    QVERIFY(six.send("x", SocketAddress(QHostAddress(QHostAddress::LocalHostIPv6), self.port())));
    QCOMPARE(take(hub, 1).at(0).first, sixPeer.get());
    QVERIFY(four.send("x", SocketAddress(QHostAddress(QHostAddress::LocalHost), self.port())));
    QCOMPARE(take(hub, 1).at(0).first, fourPeer.get());
}

void tst_CyclicHub::manyPeersAreServedWithFewCalls()
{
    constexpr int count = 400;  // so many that some share a place of the table
    CyclicHub hub;
    const SocketAddress self = open(hub);
    std::vector<std::unique_ptr<UdpSocket>> sockets(count);
    std::vector<std::unique_ptr<StreamPair>> pairs(count);
    std::vector<std::unique_ptr<HubPeer>> peers(count);
    QVector<QByteArray> requests;
    for (std::size_t i = 0; i < count; ++i) {
        if (i % 4 != 0) {
            sockets[i] = std::make_unique<UdpSocket>();
            peers[i] = hub.find<UdpTransport>()->peer(sockets[i]->self);
        } else {
            pairs[i] = std::make_unique<StreamPair>();
            peers[i] = StreamTransport::peer(pairs[i]->take(0), toyCutter, LargestToyFrame);
        }
        peers[i]->owner = reinterpret_cast<void *>(quintptr(i + 1));
        hub.attach(peers[i].get());
        requests << toyFrame(4) + QByteArray::number(qulonglong(1000 + i));
        requests.last()[1] = char(requests.last().size());
    }
    for (std::size_t i = 0; i < count; ++i)
        hub.send(peers[i].get(), requests.at(int(i)).constData(), std::size_t(requests.at(int(i)).size()));
    hub.flush();
    QVector<QPair<HubPeer *, QByteArray>> taken;
    for (std::size_t i = 0; i < count; ++i) {
        const QByteArray request = requests.at(int(i));
        QCOMPARE(sockets[i] ? sockets[i]->receive() : pairs[i]->readAll(), request);
        if (sockets[i])
            QVERIFY(sockets[i]->send(request, self));
        else
            pairs[i]->write(request);
        if (i % 50 == 49)
            taken += take(hub, 50);  // before the socket is full
    }
    QCOMPARE(taken.size(), count);
    for (const auto &[peer, frame] : qAsConst(taken))
        QCOMPARE(frame, requests.at(int(reinterpret_cast<quintptr>(peer->owner)) - 1));
    QCOMPARE(hub.strangers(), std::uint64_t(0));
}

void tst_CyclicHub::aDetachedPeerIsAStranger()
{
    CyclicHub hub;
    const SocketAddress self = open(hub);
    UdpSocket socket;
    StreamPair pair;
    const auto udp = hub.find<UdpTransport>()->peer(socket.self);
    const auto tcp = StreamTransport::peer(pair.take(0), toyCutter, LargestToyFrame);
    const UdpSocket other;
    const auto stays = hub.find<UdpTransport>()->peer(other.self);
    hub.attach(udp.get());
    hub.attach(tcp.get());
    hub.attach(stays.get());
    hub.send(udp.get(), "last words", 10);
    hub.detach(udp.get());
    hub.detach(tcp.get());
    QCOMPARE(socket.receive(), QByteArray("last words"));
    QVERIFY(socket.send("x", self));
    pair.write(toyFrame(5));
    QVERIFY(hub.wait(1'000'000'000));
    HubFrame incoming;
    QVERIFY(!hub.next(&incoming));
    QCOMPARE(hub.strangers(), std::uint64_t(1));
}

void tst_CyclicHub::streamsGiveWholeFrames()
{
    CyclicHub hub;
    StreamPair pair;
    const auto peer = StreamTransport::peer(pair.take(0), toyCutter, LargestToyFrame);
    hub.attach(peer.get());
    const QByteArray frame = toyFrame(20, 'q');
    for (int i = 0; i < frame.size() - 1; ++i) {
        pair.write(frame.mid(i, 1));
        QVERIFY(hub.wait(1'000'000'000));
        HubFrame incoming;
        QVERIFY(!hub.next(&incoming));
    }
    pair.write(frame.right(1) + toyFrame(3) + toyFrame(4) + "F");
    const auto taken = take(hub, 3);
    QCOMPARE(taken.size(), 3);
    QCOMPARE(taken.at(0).second, frame);
    QCOMPARE(taken.at(2).second, toyFrame(4));
    QVERIFY(!peer->isClosed());
}

void tst_CyclicHub::garbageClosesTheStream()
{
    CyclicHub hub;
    StreamPair bad;
    StreamPair good;
    const auto badPeer = StreamTransport::peer(bad.take(0), toyCutter, LargestToyFrame);
    const auto goodPeer = StreamTransport::peer(good.take(0), toyCutter, LargestToyFrame);
    hub.attach(badPeer.get());
    hub.attach(goodPeer.get());
    bad.write(toyFrame(5) + "garbage");
    good.write(toyFrame(6));
    const auto taken = take(hub, 2);
    QCOMPARE(taken.size(), 2);  // what came before the garbage counts
    QVERIFY(badPeer->isClosed());
    QVERIFY(!goodPeer->isClosed());
    char byte = 0;
    QCOMPARE(::recv(bad.ends[1], &byte, 1, MSG_DONTWAIT), ssize_t(0));  // the other end is told
    hub.send(badPeer.get(), "x", 1);
    QCOMPARE(badPeer->sendFailures, std::uint64_t(1));
    QVERIFY(!hub.wait(1'000'000));  // and it wakes nobody any more
}

void tst_CyclicHub::hubReportsAPeerThatClosed()
{
    CyclicHub hub;
    StreamPair pair;
    const auto peer = StreamTransport::peer(pair.take(0), toyCutter, LargestToyFrame);
    hub.attach(peer.get());
    pair.write(toyFrame(5));
    pair.closeEnd(1);
    QCOMPARE(take(hub, 1).size(), 1);  // its last frame is not lost
    hub.wait(1'000'000'000);
    HubFrame incoming;
    QVERIFY(!hub.next(&incoming));
    QVERIFY(peer->isClosed());
    hub.send(peer.get(), "x", 1);  // and no SIGPIPE
    QVERIFY(!hub.wait(1'000'000));
}

void tst_CyclicHub::peerThatDoesNotReadDelaysNoOtherPeer()
{
    CyclicHub hub;
    StreamPair deaf;
    StreamPair eager;
    const auto deafPeer = StreamTransport::peer(deaf.take(0), toyCutter, LargestToyFrame);
    const auto eagerPeer = StreamTransport::peer(eager.take(0), toyCutter, LargestToyFrame);
    hub.attach(deafPeer.get());
    hub.attach(eagerPeer.get());
    const QByteArray frame = toyFrame(255);
    QByteArray heard;
    for (int i = 0; i < 5000; ++i) {
        hub.send(deafPeer.get(), frame.constData(), 255);
        hub.send(eagerPeer.get(), frame.constData(), 255);
        heard += eager.readAll();
    }
    QVERIFY(deafPeer->sendFailures > 0);
    QCOMPARE(eagerPeer->sendFailures, std::uint64_t(0));
    QCOMPARE(heard.size(), 5000 * 255);
    const int first = deaf.readAll().size();
    hub.send(deafPeer.get(), frame.constData(), 255);
    QCOMPARE((first + deaf.readAll().size()) % 255, 0);  // whole frames only
}

void tst_CyclicHub::waitEndsInTime()
{
    CyclicHub hub;
    open(hub);
    QVERIFY(!hub.wait(0));
    QVERIFY(!hub.wait(2'000'000));
    HubFrame incoming;
    QVERIFY(!hub.next(&incoming));
}

void tst_CyclicHub::aHubThatWasNeverOpenWaitsInVain()
{
    CyclicHub hub;
    QVERIFY(!hub.wait(1'000'000));
    HubFrame frame;
    QVERIFY(!hub.next(&frame));
}

void tst_CyclicHub::alarmEndsTheWaitWithoutAFrame()
{
    CyclicHub hub;
    const SocketAddress self = open(hub);
    const UdpSocket node;
    const std::unique_ptr<HubPeer> peer = hub.find<UdpTransport>()->peer(node.self);
    hub.attach(peer.get());
    int alarm[2];
    QCOMPARE(::pipe(alarm), 0);
    QCOMPARE(::write(alarm[1], "x", 1), ssize_t(1));
    QVERIFY(!hub.wait(1, alarm[0]));  // and not after 1 ns
    QVERIFY(node.send("answer", self));
    QVERIFY(hub.wait(1, alarm[0]));
    HubFrame incoming;
    QVERIFY(hub.next(&incoming));
    QCOMPARE(incoming.peer, peer.get());
    QVERIFY(!hub.next(&incoming));
    QVERIFY(!hub.wait(0));
    ::close(alarm[0]);
    ::close(alarm[1]);
}

void tst_CyclicHub::refusedDatagramIsCountedAndOthersAreSent()
{
    CyclicHub hub;
    open(hub);
    UdpSocket socket;
    const auto impossible = hub.find<UdpTransport>()->peer(
        SocketAddress(QHostAddress("255.255.255.255"), 9));  // a broadcast that nobody has allowed
    const auto good = hub.find<UdpTransport>()->peer(socket.self);
    hub.attach(impossible.get());
    hub.attach(good.get());
    hub.send(impossible.get(), "x", 1);
    hub.send(good.get(), "y", 1);
    hub.flush();
    QCOMPARE(socket.receive(), QByteArray("y"));
    QCOMPARE(impossible->sendFailures, std::uint64_t(1));
    QCOMPARE(good->sendFailures, std::uint64_t(0));
}

void tst_CyclicHub::anInterruptedCallIsMadeAgain()
{
    CyclicHub hub;
    open(hub);
    UdpSocket socket;
    const auto peer = hub.find<UdpTransport>()->peer(socket.self);
    hub.attach(peer.get());
    hub.send(peer.get(), "x", 1);
    interruptions = 2;
    hub.flush();
    QCOMPARE(interruptions, 0);
    QCOMPARE(socket.receive(), QByteArray("x"));
    QCOMPARE(peer->sendFailures, std::uint64_t(0));
}

void tst_CyclicHub::portInUseIsReported()
{
    UdpSocket other;
    CyclicHub hub;
    QString error;
    QVERIFY(!hub.open(other.self, &error));
    QVERIFY2(error.contains(QString::number(other.self.port())) && error.contains("in use"), qPrintable(error));
}

QTEST_APPLESS_MAIN(tst_CyclicHub)
#include "tst_CyclicHub.moc"
