// SPDX-License-Identifier: Apache-2.0
#include "TransportFixtures.h"
#include "realtime/InterruptibleWaits.h"
#include "transport/LocalTransport.h"
#include "transport/StreamLink.h"
#include "transport/StreamTransport.h"
#include "transport/UdpLink.h"
#include "transport/UdpTransport.h"

#include <QtCore/QElapsedTimer>
#include <QtTest/QtTest>

#include <poll.h>

using qplc::CyclicHub;
using qplc::CyclicLink;
using qplc::HubFrame;
using qplc::HubPeer;
using qplc::HubTransport;
using qplc::InterruptibleWaits;
using qplc::LocalTransport;
using qplc::SocketAddress;
using qplc::StreamLink;
using qplc::StreamTransport;
using qplc::UdpLink;
using qplc::UdpTransport;

// What the tables of the hub hold and what happens beyond; peers that come, go and come again.
class tst_TransportLimits : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void datagramsBeyondABatchComeInOrder();
    void requestsBeyondTheTableAreSentImmediately();
    void peersBeyondTheTableAreStrangers();
    void aDatagramThatIsTooLongIsCut();
    void peersCanBeDetachedAndAttachedAgain();
    void closedPeerCausesNoFurtherWakeUps();
    void aClosedHubSendsNothingAndMayOpenAgain();
    void allAddressesOfIpv6AreNotThoseOfIpv4();
    void ipv4PeersAreKnownOnADualStackSocket();
    void udpLinkReconnectsToItsMaster();
    void waitsLastUntilTheirTimeout();
    void pollNeverWaits();
};

namespace {

/// A hub on a free port of \a host, and its address: the sender of its datagrams.
struct Hub : CyclicHub
{
    explicit Hub(const QHostAddress &host = QHostAddress(QHostAddress::LocalHost))
    {
        QString error;
        isOpen = open(SocketAddress(host, 0), &error);
        self.length = sizeof self.storage;
        const UdpSocket socket;
        const auto peer = find<UdpTransport>()->peer(socket.self);
        sendNow(*peer, "who are you?");
        char bytes[16];
        pollfd polled{socket.descriptor, POLLIN, 0};
        knowsItself = ::poll(&polled, 1, 1000) == 1
            && ::recvfrom(socket.descriptor, bytes, sizeof bytes, 0, self.data(), &self.length) > 0;
    }
    void sendNow(HubPeer &peer, const char *text)
    {
        send(&peer, text, std::strlen(text));
        flush();
    }
    /// What comes until there are \a count datagrams, those of strangers included.
    QVector<QByteArray> take(int count)
    {
        QVector<QByteArray> frames;
        const std::uint64_t before = strangers();
        while (frames.size() + int(strangers() - before) < count && wait(5'000'000'000)) {
            HubFrame incoming;
            while (next(&incoming))
                frames << QByteArray(incoming.bytes, int(incoming.size));
        }
        return frames;
    }
    SocketAddress self;
    bool isOpen = false;
    bool knowsItself = false;
};

}  // namespace

void tst_TransportLimits::datagramsBeyondABatchComeInOrder()
{
    Hub hub;
    const UdpSocket socket;
    const auto peer = hub.find<UdpTransport>()->peer(socket.self);
    hub.attach(peer.get());
    for (int count : {1, 31, 32, 33, 64, 100}) {
        QVector<QByteArray> sent;
        for (int i = 0; i < count; ++i) {
            sent << QByteArray::number(i);
            QVERIFY(socket.send(sent.last(), hub.self));
        }
        QCOMPARE(hub.take(count), sent);
        QVERIFY(!hub.wait(0));
    }
}

void tst_TransportLimits::requestsBeyondTheTableAreSentImmediately()
{
    Hub hub;
    const UdpSocket socket;
    const auto peer = hub.find<UdpTransport>()->peer(socket.self);
    for (std::size_t i = 0; i < CyclicHub::MaximumPeers; ++i)
        hub.send(peer.get(), "waits for flush()", 5);
    QCOMPARE(socket.receive(MSG_DONTWAIT), QByteArray("nothing"));
    hub.send(peer.get(), "one more", 8);
    QCOMPARE(socket.receive(), QByteArray("waits"));
    QCOMPARE(peer->sendFailures, std::uint64_t(0));
}

void tst_TransportLimits::peersBeyondTheTableAreStrangers()
{
    Hub hub;
    std::vector<std::unique_ptr<HubPeer>> peers;
    for (std::size_t i = 0; i < CyclicHub::MaximumPeers; ++i) {
        peers.push_back(hub.find<UdpTransport>()->peer(SocketAddress(QHostAddress("192.0.2.1"), quint16(1 + i))));
        hub.attach(peers.back().get());
    }
    const UdpSocket socket;
    const auto oneTooMany = hub.find<UdpTransport>()->peer(socket.self);
    hub.attach(oneTooMany.get());
    QVERIFY(socket.send("mine", hub.self));
    QCOMPARE(hub.take(1), QVector<QByteArray>());
    QCOMPARE(hub.strangers(), std::uint64_t(1));
    hub.detach(peers.back().get());
    hub.attach(oneTooMany.get());
    QVERIFY(socket.send("mine", hub.self));
    QCOMPARE(hub.take(1), QVector<QByteArray>{"mine"});
}

void tst_TransportLimits::aDatagramThatIsTooLongIsCut()
{
    Hub hub;
    const UdpSocket socket;
    const auto peer = hub.find<UdpTransport>()->peer(socket.self);
    hub.attach(peer.get());
    QVERIFY(socket.send(QByteArray(60000, 'z'), hub.self));
    QVERIFY(socket.send("next", hub.self));
    const QVector<QByteArray> frames = hub.take(2);
    QCOMPARE(frames.size(), 2);
    QCOMPARE(frames.at(0), QByteArray(2048, 'z'));  // longer than any frame: its decoder refuses it
    QCOMPARE(frames.at(1), QByteArray("next"));
}

void tst_TransportLimits::peersCanBeDetachedAndAttachedAgain()
{
    Hub hub;
    const UdpSocket sockets[3];
    auto *transport = hub.find<UdpTransport>();
    const std::unique_ptr<HubPeer> peers[3]
        = {transport->peer(sockets[0].self), transport->peer(sockets[1].self), transport->peer(sockets[2].self)};
    const auto heard = [&] {
        for (int i = 0; i < 3; ++i) {
            if (!sockets[i].send(QByteArray::number(i), hub.self))
                return QVector<QByteArray>{"not sent"};
        }
        return hub.take(3);
    };
    QCOMPARE(heard(), QVector<QByteArray>());
    for (const auto &peer : peers)
        hub.attach(peer.get());
    QCOMPARE(heard(), (QVector<QByteArray>{"0", "1", "2"}));
    hub.detach(peers[1].get());
    hub.detach(peers[1].get());  // a second time changes nothing
    QCOMPARE(heard(), (QVector<QByteArray>{"0", "2"}));
    hub.attach(peers[1].get());
    hub.detach(peers[0].get());
    QCOMPARE(heard(), (QVector<QByteArray>{"1", "2"}));
    QCOMPARE(hub.strangers(), std::uint64_t(3 + 1 + 1));
}

void tst_TransportLimits::closedPeerCausesNoFurtherWakeUps()
{
    Hub hub;
    StreamPair gone;
    StreamPair other;
    const auto gonePeer = StreamTransport::peer(gone.take(0), toyCutter, LargestToyFrame);
    const auto otherPeer = StreamTransport::peer(other.take(0), toyCutter, LargestToyFrame);
    hub.attach(gonePeer.get());
    gone.closeEnd(1);
    QVERIFY(hub.wait(5'000'000'000));
    HubFrame incoming;
    QVERIFY(!hub.next(&incoming));
    QVERIFY(gonePeer->isClosed());
    QVERIFY(!hub.wait(1'000'000));  // else a cycle thread would spin
    hub.attach(otherPeer.get());
    QVERIFY(!hub.wait(1'000'000));
    other.write(toyFrame(9, 'o'));
    QCOMPARE(hub.take(1), QVector<QByteArray>{toyFrame(9, 'o')});
    hub.detach(otherPeer.get());
    QVERIFY(!hub.wait(1'000'000));
}

void tst_TransportLimits::aClosedHubSendsNothingAndMayOpenAgain()
{
    Hub hub;
    const UdpSocket socket;
    const auto peer = hub.find<UdpTransport>()->peer(socket.self);
    hub.attach(peer.get());
    hub.send(peer.get(), "never", 5);
    hub.close();
    hub.flush();
    QVERIFY(!hub.wait(0));
    hub.sendNow(*peer, "nor this");
    QCOMPARE(peer->sendFailures, std::uint64_t(1));
    QString error;
    QVERIFY(hub.open(SocketAddress(QHostAddress(QHostAddress::LocalHost), 0), &error));
    hub.sendNow(*peer, "again");
    QCOMPARE(socket.receive(), QByteArray("again"));
}

void tst_TransportLimits::allAddressesOfIpv6AreNotThoseOfIpv4()
{
    const SocketAddress address(QHostAddress(QHostAddress::AnyIPv6), 50000);
    QCOMPARE(address.family(), AF_INET6);  // else nodes on IPv6 would never be heard
    QCOMPARE(address.toString(), QString(":::50000"));
    QCOMPARE(SocketAddress(QHostAddress(QHostAddress::AnyIPv4), 50000).toString(), QString("0.0.0.0:50000"));
}

void tst_TransportLimits::ipv4PeersAreKnownOnADualStackSocket()
{
    Hub hub{QHostAddress(QHostAddress::AnyIPv6)};
    if (!hub.isOpen || !hub.knowsItself)
        QSKIP("this machine has no IPv6, or keeps it apart from IPv4", "");
    const UdpSocket socket;
    const auto peer = hub.find<UdpTransport>()->peer(socket.self);
    hub.attach(peer.get());
    QVERIFY(socket.send("from ::ffff:127.0.0.1", hub.self));
    QCOMPARE(hub.take(1), QVector<QByteArray>{"from ::ffff:127.0.0.1"});
}

void tst_TransportLimits::udpLinkReconnectsToItsMaster()
{
    QString error;
    quint16 port = 0;
    Hub first;
    const auto link = UdpLink::open(first.self, &port, &error);
    QVERIFY2(link, qPrintable(error));
    const SocketAddress node(QHostAddress(QHostAddress::LocalHost), port);
    const auto former = first.find<UdpTransport>()->peer(node);
    const char *frame = nullptr;
    std::size_t size = 0;
    first.sendNow(*former, "one");
    QCOMPARE(link->receive(&frame, &size), CyclicLink::Received);
    first.close();
    QVERIFY(link->send("anybody?", 8));
    QCOMPARE(link->receive(&frame, &size), CyclicLink::Nothing);  // refused
    CyclicHub second;
    if (!second.open(first.self, &error))
        QSKIP("another program has taken the port meanwhile", "");
    const auto peer = second.find<UdpTransport>()->peer(node);
    second.attach(peer.get());
    second.send(peer.get(), "two", 3);
    second.flush();
    QCOMPARE(link->receive(&frame, &size), CyclicLink::Received);
    QCOMPARE(QByteArray(frame, int(size)), QByteArray("two"));
    QVERIFY(link->send("still here", 10));
    QVERIFY(second.wait(5'000'000'000));
}

void tst_TransportLimits::waitsLastUntilTheirTimeout()
{
    constexpr qint64 time = 10'000'000;  // [ns]
    Hub hub;
    StreamPair pair;
    QString error;
    quint16 port = 0;
    const std::unique_ptr<CyclicLink> links[]
        = {UdpLink::open(hub.self, &port, &error), StreamLink::make(pair.take(0), toyCutter, LargestToyFrame)};
    QElapsedTimer timer;
    timer.start();
    QVERIFY(!hub.wait(time));
    QVERIFY(timer.nsecsElapsed() >= time);
    for (const auto &link : links) {
        const char *frame = nullptr;
        std::size_t size = 0;
        const InterruptibleWaits interrupt(time);
        timer.start();
        QCOMPARE(link->receive(&frame, &size), CyclicLink::Nothing);
        QVERIFY2(timer.nsecsElapsed() >= time, qPrintable(QString::number(timer.nsecsElapsed())));
    }
}

void tst_TransportLimits::pollNeverWaits()
{
    Hub hub;
    StreamPair pair;
    QString error;
    quint16 port = 0;
    const std::unique_ptr<CyclicLink> links[]
        = {UdpLink::open(hub.self, &port, &error), StreamLink::make(pair.take(0), toyCutter, LargestToyFrame)};
    for (const auto &link : links) {
        const char *frame = nullptr;
        std::size_t size = 0;
        QCOMPARE(link->poll(&frame, &size), CyclicLink::Nothing);
    }
}

QTEST_APPLESS_MAIN(tst_TransportLimits)
#include "tst_TransportLimits.moc"
