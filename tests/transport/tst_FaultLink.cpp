// SPDX-License-Identifier: Apache-2.0
#include "../realtime/FakeTime.h"
#include "TransportFixtures.h"
#include "transport/FaultLink.h"
#include "transport/UdpTransport.h"

#include <QtTest/QtTest>

#include <deque>

using namespace qplc;

// Links and hubs on a network that is as bad as a plan says, on a clock of the test.
class tst_FaultLink : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void unaffectedFramesPassWithoutDelay();
    void lostFramesDoNotBlockTheReceiver();
    void duplicatesAreDeliveredOnce();
    void reorderedFrameArrivesAfterTheNext();
    void delayedFramesComeWhenTheyAreDue();
    void jitterReordersFrames();
    void corruptedFramesHaveOtherBitsAndTheSameLength();
    void aCutOfOneDirectionLeavesTheOther();
    void aFullLineLosesFrames();
    void endOfTheLinkIsReported();
    void hubInjectsFaultsForEachPeerSeparately();
    void hubWaitsOnlyUntilTheNextDelayedFrame();
    void detachedPeerDropsItsDelayedFrames();
};

namespace {

/// Frames that came are given by the test; frames that were sent are kept.
class ToyLink final : public CyclicLink
{
public:
    ToyLink()
        : CyclicLink(-1)
    {
    }
    Status receive(const char **frame, std::size_t *size) noexcept override { return poll(frame, size); }
    Status poll(const char **frame, std::size_t *size) noexcept override
    {
        if (isClosed)
            return Closed;
        if (arrived.empty())
            return Nothing;
        m_frame = arrived.front();
        arrived.pop_front();
        *frame = m_frame.constData();
        *size = std::size_t(m_frame.size());
        return Received;
    }
    bool send(const char *frame, std::size_t size) noexcept override
    {
        sent << QByteArray(frame, int(size));
        return true;
    }
    std::deque<QByteArray> arrived;
    QVector<QByteArray> sent;
    bool isClosed = false;

private:
    QByteArray m_frame;
};

struct Fixture
{
    explicit Fixture(const char *text)
    {
        QString error;
        const auto plan = FaultPlan::fromText(QString::fromLatin1(text), &error);
        QVERIFY2(plan, qPrintable(error));
        auto inner = std::make_unique<ToyLink>();
        toy = inner.get();
        link = std::make_unique<FaultLink>(std::move(inner), *plan, 1, time);
    }
    /// What a node would have received until \a until [ns].
    QVector<QByteArray> receive(std::int64_t until)
    {
        QVector<QByteArray> got;
        const char *frame = nullptr;
        std::size_t size = 0;
        while (true) {
            const CyclicLink::Status status = link->receive(&frame, &size);
            if (status == CyclicLink::Received)
                got << QByteArray(frame, int(size));
            else if (status == CyclicLink::Closed || time.time >= until)
                return got;
            else if (toy->arrived.empty())
                time.time += 1000;  // a link that waits for nothing lets the time go by
        }
    }
    void arrive(int count)
    {
        for (int i = 0; i < count; ++i)
            toy->arrived.push_back(QByteArray::number(i));
    }
    FakeTime time;
    ToyLink *toy = nullptr;
    std::unique_ptr<FaultLink> link;
};

QVector<QByteArray> numbers(std::initializer_list<int> all)
{
    QVector<QByteArray> result;
    for (const int each : all)
        result << QByteArray::number(each);
    return result;
}

}  // namespace

void tst_FaultLink::unaffectedFramesPassWithoutDelay()
{
    Fixture fixture("loss-sent=100%");
    fixture.arrive(4);
    QCOMPARE(fixture.receive(0), numbers({0, 1, 2, 3}));
    QCOMPARE(fixture.time.time, std::int64_t(0));
    QVERIFY(fixture.link->send("x", 1));  // lost on the way is not refused
    QVERIFY(fixture.toy->sent.isEmpty());
    QCOMPARE(fixture.link->sent().count(FaultInjector::Lost), std::uint64_t(1));
}

void tst_FaultLink::lostFramesDoNotBlockTheReceiver()
{
    Fixture fixture("loss=100%");
    fixture.arrive(3);
    const char *frame = nullptr;
    std::size_t size = 0;
    QCOMPARE(fixture.link->receive(&frame, &size), CyclicLink::Nothing);  // so that a watchdog is looked at
    QVERIFY(fixture.receive(0).isEmpty());
    QCOMPARE(fixture.link->received().count(FaultInjector::Lost), std::uint64_t(3));
}

void tst_FaultLink::duplicatesAreDeliveredOnce()
{
    Fixture fixture("duplicate=100%");
    fixture.arrive(2);
    QCOMPARE(fixture.receive(0), numbers({0, 0, 1, 1}));
    fixture.link->send("x", 1);
    QCOMPARE(fixture.toy->sent.size(), 1);
    fixture.receive(0);
    QCOMPARE(fixture.toy->sent.size(), 2);
}

void tst_FaultLink::reorderedFrameArrivesAfterTheNext()
{
    Fixture fixture("reorder-received=100%");
    fixture.arrive(5);
    QCOMPARE(fixture.receive(0), numbers({1, 0, 3, 2}));  // 4 waits for the next
    fixture.toy->arrived.push_back("5");
    QCOMPARE(fixture.receive(0), numbers({5, 4}));
    QCOMPARE(fixture.link->received().count(FaultInjector::Reordered),
             std::uint64_t(3));  // 0, 2 and 4, no other could be
}

void tst_FaultLink::delayedFramesComeWhenTheyAreDue()
{
    Fixture fixture("delay=5ms");
    fixture.arrive(1);
    QVERIFY(fixture.receive(4'900'000).isEmpty());
    QCOMPARE(fixture.receive(5'100'000), numbers({0}));
    fixture.link->send("x", 1);
    const std::int64_t begin = fixture.time.time;
    fixture.receive(begin + 4'900'000);
    QVERIFY(fixture.toy->sent.isEmpty());
    fixture.receive(begin + 5'200'000);
    QCOMPARE(fixture.toy->sent.size(), 1);
    QVERIFY(fixture.time.longestSleep <= FaultLink::Look);
}

void tst_FaultLink::jitterReordersFrames()
{
    Fixture fixture("jitter-received=10ms,seed=3");
    fixture.arrive(50);
    const QVector<QByteArray> got = fixture.receive(11'000'000);
    QCOMPARE(got.size(), 50);
    QVector<QByteArray> sorted = got;
    std::sort(sorted.begin(), sorted.end(),
              [](const QByteArray &a, const QByteArray &b) { return a.toInt() < b.toInt(); });
    QVERIFY(got != sorted);
    for (int i = 0; i < 50; ++i)
        QCOMPARE(sorted.at(i).toInt(), i);
}

void tst_FaultLink::corruptedFramesHaveOtherBitsAndTheSameLength()
{
    Fixture fixture("corrupt=100%");
    for (int i = 0; i < 200; ++i)
        fixture.toy->arrived.push_back(QByteArray(30, 'x'));
    const QVector<QByteArray> got = fixture.receive(0);
    QCOMPARE(got.size(), 200);
    for (const QByteArray &frame : got) {
        QCOMPARE(frame.size(), 30);
        QVERIFY(frame != QByteArray(30, 'x'));
    }
}

void tst_FaultLink::aCutOfOneDirectionLeavesTheOther()
{
    Fixture fixture("cut-sent=1ms+2ms");
    for (int i = 0; i < 5; ++i) {
        fixture.link->send(QByteArray::number(i).constData(), 1);
        fixture.toy->arrived.push_back(QByteArray::number(i));
        QCOMPARE(fixture.receive(0), numbers({i}));
        fixture.time.time += 1'000'000;
    }
    QCOMPARE(fixture.toy->sent, numbers({0, 3, 4}));
}

void tst_FaultLink::aFullLineLosesFrames()
{
    Fixture fixture("delay=1s");
    fixture.arrive(1000);
    const int got = fixture.receive(1'100'000'000).size();
    QVERIFY2(got > 100 && got < 1000, qPrintable(QString::number(got)));
}

void tst_FaultLink::endOfTheLinkIsReported()
{
    Fixture fixture("delay=1ms");
    fixture.toy->isClosed = true;
    const char *frame = nullptr;
    std::size_t size = 0;
    QCOMPARE(fixture.link->receive(&frame, &size), CyclicLink::Closed);
    QCOMPARE(fixture.link->poll(&frame, &size), CyclicLink::Closed);
}

// ---- hub ----

namespace {

struct FaultyHub
{
    explicit FaultyHub(const char *text)
    {
        QString error;
        const auto plan = FaultPlan::fromText(QString::fromLatin1(text), &error);
        QVERIFY2(plan, qPrintable(error));
        hub.setFaults(plan, time);
        QVERIFY2(hub.open(SocketAddress(QHostAddress(QHostAddress::LocalHost), 0), &error), qPrintable(error));
        a = hub.find<UdpTransport>()->peer(socketA.self);
        b = hub.find<UdpTransport>()->peer(socketB.self);
        hub.exposeToFaults(*a, 1);
        hub.exposeToFaults(*b, 2);
        hub.attach(a.get());
        hub.attach(b.get());
    }
    void send(HubPeer *peer, const QByteArray &frame)
    {
        hub.send(peer, frame.constData(), std::size_t(frame.size()));
        hub.flush();
    }
    FakeTime time;
    UdpSocket socketA;
    UdpSocket socketB;
    std::unique_ptr<HubPeer> a, b;
    CyclicHub hub;
};

QByteArray allOf(const UdpSocket &socket)
{
    QByteArray all;
    for (QByteArray next = socket.receive(MSG_DONTWAIT); next != "nothing"; next = socket.receive(MSG_DONTWAIT))
        all += next;
    return all;
}

}  // namespace

void tst_FaultLink::hubInjectsFaultsForEachPeerSeparately()
{
    FaultyHub fixture("loss-sent=50%,seed=11");
    const QByteArray alphabet = "abcdefghijklmnopqrstuvwxyz";
    for (const char letter : alphabet) {
        fixture.send(fixture.a.get(), QByteArray(1, letter));
        fixture.send(fixture.b.get(), QByteArray(1, letter));
    }
    const QByteArray forA = allOf(fixture.socketA);
    const QByteArray forB = allOf(fixture.socketB);
    QVERIFY(forA.size() > 5 && forA.size() < 21);
    QVERIFY(forB.size() > 5 && forB.size() < 21);
    QVERIFY(forA != forB);
}

void tst_FaultLink::hubWaitsOnlyUntilTheNextDelayedFrame()
{
    FaultyHub fixture("delay=3ms");
    fixture.send(fixture.a.get(), "x");
    QCOMPARE(allOf(fixture.socketA), QByteArray());
    fixture.time.time += 3'000'000;
    QVERIFY(!fixture.hub.wait(0));
    QCOMPARE(allOf(fixture.socketA), QByteArray("x"));

    // An answer is under way: the wait of an hour ends with it, on the clock of the test at once.
    fixture.send(fixture.a.get(), "y");
    fixture.time.time += 2'999'999;
    QVERIFY(!fixture.hub.wait(3'600'000'000'000));
    fixture.time.time += 1;
    QVERIFY(!fixture.hub.wait(0));
    QCOMPARE(allOf(fixture.socketA), QByteArray("y"));
}

void tst_FaultLink::detachedPeerDropsItsDelayedFrames()
{
    FaultyHub fixture("delay=3ms");
    fixture.send(fixture.a.get(), "x");
    fixture.send(fixture.b.get(), "y");
    fixture.hub.detach(fixture.a.get());
    fixture.a.reset();
    fixture.time.time += 3'000'000;
    fixture.hub.wait(0);
    QCOMPARE(allOf(fixture.socketA), QByteArray());
    QCOMPARE(allOf(fixture.socketB), QByteArray("y"));
}

QTEST_APPLESS_MAIN(tst_FaultLink)
#include "tst_FaultLink.moc"
