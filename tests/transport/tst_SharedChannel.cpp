// SPDX-License-Identifier: Apache-2.0
#include "TransportFixtures.h"
#include "realtime/Host.h"
#include "realtime/InterruptibleWaits.h"
#include "transport/LocalLink.h"
#include "transport/LocalName.h"
#include "transport/LocalTransport.h"
#include "transport/StreamTransport.h"
#include "transport/UdpTransport.h"

#include <QtTest/QtTest>

#include <fcntl.h>
#include <poll.h>
#include <thread>
#include <unistd.h>

using qplc::CyclicHub;
using qplc::CyclicLink;
using qplc::Descriptor;
using qplc::Doorbell;
using qplc::HubFrame;
using qplc::HubPeer;
using qplc::HubTransport;
using qplc::LocalLink;
using qplc::LocalName;
using qplc::LocalTransport;
using qplc::SharedChannel;
using qplc::SharedMemory;
using qplc::SharedRing;
using qplc::StreamTransport;
using qplc::UdpTransport;

class tst_SharedChannel : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void memoryIsSharedByAllUsers();
    void memoryOfAnotherSizeIsRefused();
    void memoryCannotBeMadeSmaller();
    void ringHasRoomForTwoCycles_data();
    void ringHasRoomForTwoCycles();
    void twoCyclesOfTheLargestFramesPass_data();
    void twoCyclesOfTheLargestFramesPass();
    void tooManyValuesAreRefused();
    void framesComeInOrderAroundTheEnd();
    void aFullRingRefuses();
    void aRingWithMoreTakenThanGivenRefuses();
    void aFrameWithoutBytesIsSkipped();
    void invalidRingContentIsSkipped_data();
    void invalidRingContentIsSkipped();
    void millionFramesPassUnchangedBetweenTwoThreads();
    void lastAnswerWakesTheHub();
    void aSleeperInPollIsWokenThroughThePipe();
    void aLinkSleepsUntilItsRequestComes();
    void hubAndLinksExchangeFrames();
    void localAndOtherPeersAreServedTogether();
    void sleepingNodeDoesNotBlockOthers();
    void portIsFoundByName();
};

namespace {

/// A hub with local nodes at their links.
struct LocalPlant
{
    explicit LocalPlant(int count, const qplc::CycleVolume &volume = {})
    {
        QString error;
        const quint64 session = qplc::Host::machine().random();
        ok = hub.open(qplc::SocketAddress(QHostAddress(QHostAddress::LocalHost), 0), &error)
            && hub.find<LocalTransport>()->listen(session, &error);
        for (int i = 0; i < count; ++i) {
            std::unique_ptr<LocalLink> link = LocalLink::begin(session, &error);
            ok = ok && link;
            peers.push_back(ok ? hub.find<LocalTransport>()->link(link->key(), volume, &error) : nullptr);
            ok = ok && peers.back() && link->finish(volume, &error);
            if (!ok)
                qFatal("%s", qPrintable(error));
            hub.attach(peers.back().get());
            links.push_back(std::move(link));
        }
    }
    void ask(const QByteArray &request)
    {
        for (const auto &peer : peers)
            hub.send(peer.get(), request.constData(), std::size_t(request.size()));
        hub.flush();
    }
    static void answer(CyclicLink &link, const QByteArray &bytes)
    {
        link.send(bytes.constData(), std::size_t(bytes.size()));
        link.flush();
    }
    QVector<QByteArray> take(std::int64_t timeout)
    {
        QVector<QByteArray> frames;
        HubFrame incoming;
        if (hub.wait(timeout)) {
            while (hub.next(&incoming))
                frames << QByteArray(incoming.bytes, int(incoming.size));
        }
        return frames;
    }
    CyclicHub hub;
    std::vector<std::unique_ptr<HubPeer>> peers;
    std::vector<std::unique_ptr<CyclicLink>> links;
    bool ok = false;
};

/// A ring in memory of its own.
struct LonelyRing : SharedRing
{
    LonelyRing() { static_cast<SharedRing &>(*this) = SharedRing(memory.data(), SmallestCapacity); }
    alignas(64) std::array<char, HeaderSize + SmallestCapacity> memory{};
};

QByteArray pop(SharedRing &ring)
{
    char bytes[2048];
    return QByteArray(bytes, int(ring.pop(bytes, sizeof bytes)));
}

QByteArray receive(CyclicLink &link)
{
    const char *frame = nullptr;
    std::size_t size = 0;
    return link.receive(&frame, &size) == CyclicLink::Received ? QByteArray(frame, int(size)) : QByteArray();
}

}  // namespace

void tst_SharedChannel::initTestCase()
{
    QStandardPaths::setTestModeEnabled(true);
}

void tst_SharedChannel::memoryIsSharedByAllUsers()
{
    QString error;
    SharedMemory made;
    SharedMemory adopted;
    QVERIFY2(made.create(100, &error), qPrintable(error));
    QVERIFY2(adopted.adopt(Descriptor(::dup(made.descriptor())), "memory", 100, &error), qPrintable(error));
    std::memcpy(made.data(), "hello", 5);
    QCOMPARE(QByteArray(static_cast<char *>(adopted.data()), 6), QByteArray("hello\0", 6));
}

void tst_SharedChannel::memoryOfAnotherSizeIsRefused()
{
    QString error;
    SharedMemory made;
    QVERIFY(made.create(100, &error));
    SharedMemory tooLong;
    QVERIFY(!tooLong.adopt(Descriptor(::dup(made.descriptor())), "memory", 200, &error));
    QVERIFY2(error.contains("100 bytes instead of 200"), qPrintable(error));
    SharedMemory closed;
    QVERIFY(!closed.adopt(Descriptor(), "memory", 100, &error));
    QVERIFY2(error.contains("not sealed memory"), qPrintable(error));
}

void tst_SharedChannel::memoryCannotBeMadeSmaller()
{
    QString error;
    SharedMemory made;
    QVERIFY(made.create(100, &error));
    QCOMPARE(::ftruncate(made.descriptor(), 0), -1);  // else the other one would die by SIGBUS
}

void tst_SharedChannel::ringHasRoomForTwoCycles_data()
{
    QTest::addColumn<quint64>("frames");
    QTest::addColumn<quint64>("bytes");
    QTest::addColumn<quint32>("capacity");
    QTest::newRow("nothing") << quint64(1) << quint64(16) << quint32(65536);
    QTest::newRow("just in the smallest") << quint64(22) << quint64(32768 - 22 * 4) << quint32(65536);
    QTest::newRow("a byte more") << quint64(22) << quint64(32768 - 22 * 4 + 1) << quint32(131072);
    QTest::newRow("64 kB") << quint64(46) << quint64(64'000 + 46 * 16) << quint32(131072);
    QTest::newRow("30 MB") << quint64(20834) << quint64(30'333'344) << quint32(64 << 20);
    QTest::newRow("most") << quint64(1) << quint64((1 << 29) - 4) << (quint32(1) << 30);
    QTest::newRow("too many") << quint64(1) << quint64((1 << 29) - 3) << quint32(0);
    QTest::newRow("far too many") << quint64(1) << quint64(1) * (quint64(1) << 40) << quint32(0);
}

void tst_SharedChannel::ringHasRoomForTwoCycles()
{
    QFETCH(quint64, frames);
    QFETCH(quint64, bytes);
    QFETCH(quint32, capacity);
    QCOMPARE(SharedRing::capacityFor({frames, bytes}), capacity);
}

void tst_SharedChannel::twoCyclesOfTheLargestFramesPass_data()
{
    QTest::addColumn<int>("frames");
    for (const int frames : {1, 30, 31, 46, 1000, 23000})
        QTest::addRow("%d frames", frames) << frames;
}

void tst_SharedChannel::twoCyclesOfTheLargestFramesPass()
{
    QFETCH(int, frames);
    const std::size_t count = std::size_t(frames);
    const QByteArray frame(1472, 'f');
    LocalPlant plant(1, {{count, count * 1472}, {count, count * 1472}});
    for (int i = 0; i < 2 * frames; ++i)
        QVERIFY(plant.hub.send(plant.peers[0].get(), frame.constData(), 1472));
    plant.hub.flush();
    for (int i = 0; i < 2 * frames; ++i)
        QCOMPARE(receive(*plant.links[0]), frame);
    for (int i = 0; i < 2 * frames; ++i)
        QVERIFY(plant.links[0]->send(frame.constData(), 1472));
    plant.links[0]->flush();
    int answers = 0;
    for (QVector<QByteArray> taken; !(taken = plant.take(0)).isEmpty();)
        answers += taken.size();
    QCOMPARE(answers, 2 * frames);
}

void tst_SharedChannel::tooManyValuesAreRefused()
{
    SharedChannel channel;
    QString error;
    QVERIFY(!channel.create({{1, 10}, {1, std::size_t(1) << 32}}, &error));
    QVERIFY2(error.contains("use tcp"), qPrintable(error));
}

void tst_SharedChannel::framesComeInOrderAroundTheEnd()
{
    LonelyRing ring;
    QCOMPARE(pop(ring), QByteArray());
    for (int i = 0; i < 1000; ++i) {  // 1.5 MB through 64 KiB
        const QByteArray one(1 + (i * 37) % 1472, char('a' + i % 26));
        const QByteArray two = QByteArray::number(i);
        QVERIFY(ring.push(one.constData(), std::size_t(one.size())));
        QVERIFY(ring.push(two.constData(), std::size_t(two.size())));
        QCOMPARE(pop(ring), one);
        QCOMPARE(pop(ring), two);
    }
}

void tst_SharedChannel::aFullRingRefuses()
{
    LonelyRing ring;
    const QByteArray frame(1020, 'x');  // 1024 with its length
    int accepted = 0;
    while (ring.push(frame.constData(), std::size_t(frame.size())))
        ++accepted;
    QCOMPARE(accepted, 64);
    QCOMPARE(pop(ring), frame);
    QVERIFY(ring.push(frame.constData(), std::size_t(frame.size())));
    QVERIFY(!ring.push("x", 1));
}

void tst_SharedChannel::aRingWithMoreTakenThanGivenRefuses()
{
    LonelyRing ring;
    const quint32 taken = 1;
    std::memcpy(ring.memory.data(), &taken, sizeof taken);  // as a hostile reader writes it
    QVERIFY(!ring.push("x", 1));
}

void tst_SharedChannel::aFrameWithoutBytesIsSkipped()
{
    LonelyRing ring;
    QVERIFY(ring.push("", 0));
    QCOMPARE(pop(ring), QByteArray());
    QVERIFY(ring.push("good", 4));
    QCOMPARE(pop(ring), QByteArray("good"));
}

void tst_SharedChannel::invalidRingContentIsSkipped_data()
{
    QTest::addColumn<quint32>("length");
    QTest::newRow("nothing") << quint32(0);
    QTest::newRow("longer than what is there") << quint32(5);
    QTest::newRow("longer than a frame") << quint32(2049);
    QTest::newRow("longer than the ring") << (quint32(1) << 31);
    QTest::newRow("longest") << std::numeric_limits<quint32>::max();
}

void tst_SharedChannel::invalidRingContentIsSkipped()
{
    QFETCH(quint32, length);
    LonelyRing ring;
    QVERIFY(ring.push("four", 4));
    std::memcpy(ring.memory.data() + 128, &length, sizeof length);  // where the bytes of the ring begin
    QCOMPARE(pop(ring), QByteArray());
    QVERIFY(ring.push("good", 4));
    QCOMPARE(pop(ring), QByteArray("good"));
}

void tst_SharedChannel::millionFramesPassUnchangedBetweenTwoThreads()
{
    constexpr std::uint32_t count = 1'000'000;
    LonelyRing ring;
    std::thread producer([&] {
        for (std::uint32_t i = 1; i <= count;) {
            char frame[64] = {};
            std::memcpy(frame, &i, sizeof i);
            if (ring.push(frame, 4 + i % 60)) {
                ring.wake();
                ++i;
            } else {
                std::this_thread::yield();
            }
        }
    });
    bool good = true;
    for (std::uint32_t i = 1; i <= count;) {
        char frame[64] = {};
        const std::size_t size = ring.pop(frame, sizeof frame);
        if (size == 0) {
            ring.wait();
            continue;
        }
        std::uint32_t number = 0;
        std::memcpy(&number, frame, sizeof number);
        good = good && number == i && size == 4 + i % 60;
        ++i;
    }
    producer.join();
    QVERIFY(good);
}

void tst_SharedChannel::lastAnswerWakesTheHub()
{
    constexpr int nodes = 10;
    LocalPlant plant(nodes);
    QVERIFY(plant.ok);
    std::thread thread([&] {
        for (int cycle = 0; cycle < 200; ++cycle) {
            for (const auto &link : plant.links) {
                QByteArray request;
                while (request.isEmpty())
                    request = receive(*link);
                LocalPlant::answer(*link, request + "!");
            }
        }
    });
    int wakes = 0;
    for (int cycle = 0; cycle < 200; ++cycle) {
        plant.ask(QByteArray::number(cycle));
        int answers = 0;
        for (; answers < nodes; ++wakes)
            answers += plant.take(5'000'000'000).size();
        QCOMPARE(answers, nodes);
    }
    thread.join();
    QVERIFY2(wakes < 400, qPrintable(QString::number(wakes)));  // not once for each of 2000 answers
}

void tst_SharedChannel::aSleeperInPollIsWokenThroughThePipe()
{
    int pipe[2];
    QCOMPARE(::pipe2(pipe, O_NONBLOCK), 0);
    Doorbell bell;
    pollfd polled{pipe[0], POLLIN, 0};
    bell.want(1);
    QVERIFY(bell.beginPoll());
    bell.ring(pipe[1]);
    QCOMPARE(::poll(&polled, 1, 5000), 1);
    QVERIFY(!bell.beginPoll());  // it has rung: no sleep
    bell.endPoll();
    char byte = 0;
    QCOMPARE(::read(pipe[0], &byte, 1), ssize_t(1));
    bell.ring(pipe[1]);  // awake: no system call
    QCOMPARE(::poll(&polled, 1, 0), 0);
    ::close(pipe[0]);
    ::close(pipe[1]);
}

void tst_SharedChannel::aLinkSleepsUntilItsRequestComes()
{
    LocalPlant plant(1);
    QVERIFY(plant.ok);
    std::thread master([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        plant.ask("request");
    });
    const QByteArray request = receive(*plant.links[0]);
    master.join();
    QCOMPARE(request, QByteArray("request"));
}

void tst_SharedChannel::hubAndLinksExchangeFrames()
{
    LocalPlant plant(2);
    QVERIFY(plant.ok);
    plant.ask("question");
    QVERIFY(!plant.hub.wait(1'000'000));  // nobody has answered
    for (const auto &link : plant.links) {
        QCOMPARE(receive(*link), QByteArray("question"));
        LocalPlant::answer(*link, "answer");
    }
    QCOMPARE(plant.take(5'000'000'000), (QVector<QByteArray>{"answer", "answer"}));
    QVERIFY(plant.take(0).isEmpty());
    LocalPlant::answer(*plant.links[1], "once more");  // nobody asked
    QCOMPARE(plant.take(5'000'000'000), QVector<QByteArray>{"once more"});
    plant.hub.detach(plant.peers[0].get());
    LocalPlant::answer(*plant.links[0], "gone");
    QVERIFY(plant.take(1'000'000).isEmpty());
}

void tst_SharedChannel::localAndOtherPeersAreServedTogether()
{
    LocalPlant plant(1);
    StreamPair pair;
    const auto stream = StreamTransport::peer(pair.take(0), toyCutter, LargestToyFrame);
    plant.hub.attach(stream.get());
    plant.ask("question");
    pair.write(toyFrame(5));
    QCOMPARE(plant.take(5'000'000'000), QVector<QByteArray>{toyFrame(5)});
    QCOMPARE(receive(*plant.links[0]), QByteArray("question"));
    std::thread thread([&] { LocalPlant::answer(*plant.links[0], "answer"); });
    QCOMPARE(plant.take(5'000'000'000), QVector<QByteArray>{"answer"});
    thread.join();
    QVERIFY(plant.take(1'000'000).isEmpty());
}

void tst_SharedChannel::sleepingNodeDoesNotBlockOthers()
{
    LocalPlant plant(2);
    const QByteArray question(1000, 'q');
    int refused = 0;
    for (int cycle = 0; cycle < 200; ++cycle) {
        const bool taken = plant.hub.send(plant.peers[0].get(), question.constData(), 1000);  // it sleeps
        refused += taken ? 0 : 1;
        plant.hub.send(plant.peers[1].get(), "q", 1);
        plant.hub.flush();
        QCOMPARE(receive(*plant.links[1]), QByteArray("q"));
        LocalPlant::answer(*plant.links[1], "a");
        QCOMPARE(plant.take(1'000'000), QVector<QByteArray>{"a"});
    }
    QVERIFY(refused > 100);
    QCOMPARE(plant.peers[0]->sendFailures, std::uint64_t(refused));
    QCOMPARE(receive(*plant.links[0]), question);  // what had room waits for it
}

void tst_SharedChannel::portIsFoundByName()
{
    QString error;
    const QString name = QStringLiteral("tst-%1").arg(QCoreApplication::applicationPid());
    QCOMPARE(LocalName::portOf(name, &error), quint16(0));
    QVERIFY2(error.contains(name), qPrintable(error));
    {
        LocalName held;
        QVERIFY2(held.hold(name, 4711, &error), qPrintable(error));
        QCOMPARE(LocalName::portOf(name, &error), quint16(4711));
        LocalName taken;  // over from one that died
        QVERIFY(taken.hold(name, 4712, &error));
        QCOMPARE(LocalName::portOf(name, &error), quint16(4712));
    }
    QCOMPARE(LocalName::portOf(name, &error), quint16(0));
    LocalName bad;
    for (const char *nonsense : {"", "../x", "a b", ".hidden", "a/b"}) {
        QVERIFY(!bad.hold(QString::fromLatin1(nonsense), 1, &error));
        QCOMPARE(LocalName::portOf(QString::fromLatin1(nonsense), &error), quint16(0));
    }
}

QTEST_GUILESS_MAIN(tst_SharedChannel)
#include "tst_SharedChannel.moc"
