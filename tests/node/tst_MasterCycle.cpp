// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "node/cycle/MasterCycle.h"
#include "protocol/CyclicFrame.h"
#include "transport/StreamTransport.h"

#include <limits>
#include <optional>
#include <sys/socket.h>
#include <unistd.h>
#include <vector>

using namespace qplc;

namespace {

constexpr quint64 session = 5;

/// A node at the other end of a stream: it reads requests and answers them when the test says so.
class PipedNode
{
public:
    PipedNode(MasterCycle &cycle, const QPlcSignalTable &table, const QVector<QPlcSignalIndex> &inputs)
        : slot(std::make_shared<NodeSlot>())
    {
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, m_ends) != 0)
            qFatal("no pair of sockets");
        slot->id = 1;
        slot->inputLayout = PayloadLayout(table, inputs);
        slot->outputLayout = PayloadLayout(table, {0});
        slot->prepare(cycle.image(), session);
        slot->peer = StreamTransport::peer(m_ends[0], slot->outputCutter(), MaximumCyclicFrame);
        slot->peer->owner = slot.get();
        m_decoder.emplace(FrameKind::Inputs, FrameSeed{session, 1, slot->inputLayout.hash()},
                          slot->inputLayout.partBorders(MaximumCyclicPayload));
    }
    ~PipedNode() { ::close(m_ends[1]); }
    PipedNode(const PipedNode &) = delete;
    PipedNode &operator=(const PipedNode &) = delete;

    void setSmallestBuffer()
    {
        const int smallest = 1;
        ::setsockopt(m_ends[0], SOL_SOCKET, SO_SNDBUF, &smallest, sizeof smallest);
    }
    /// Whether the next request is here: its flags are flags() then.
    bool readRequest()
    {
        char bytes[4096];
        for (ssize_t count; (count = ::recv(m_ends[1], bytes, sizeof bytes, MSG_DONTWAIT)) > 0;)
            m_stream.append(bytes, int(count));
        while (m_stream.size() >= int(CyclicHeaderSize)) {
            const int size = int(m_decoder->frameSize(m_stream.constData()));
            if (size == 0 || m_stream.size() < size)
                return false;
            const FrameStatus status = m_decoder->decode(m_stream.constData(), std::size_t(size));
            m_stream.remove(0, size);
            if (status == FrameStatus::Complete)
                return true;
        }
        return false;
    }
    std::uint8_t flags() const { return m_decoder->header().flags; }
    /// Answers the request that was read last.
    bool answer(const QPlcValue &output, std::uint8_t answerFlags = 0)
    {
        FrameHeader header;
        header.cycle = std::uint32_t(m_decoder->cycle());
        header.flags = answerFlags;
        const FrameEncoder encoder(FrameKind::Outputs, {session, 1, slot->outputLayout.hash()}, {0, 4});
        std::vector<char> frame(encoder.totalSize());
        encoder.encode(0, header, output.toBytes().constData(), frame.data());
        return ::send(m_ends[1], frame.data(), frame.size(), MSG_NOSIGNAL) == ssize_t(frame.size());
    }

    std::shared_ptr<NodeSlot> slot;

private:
    int m_ends[2] = {-1, -1};
    std::optional<FrameDecoder> m_decoder;
    QByteArray m_stream;
};

/// Time passes only while a cycle sleeps: each of them begins exactly when it should.
class SleptTime : public TimeSource
{
public:
    std::int64_t now() noexcept override { return m_now; }
    bool sleepUntil(std::int64_t deadline) noexcept override
    {
        m_now = deadline;
        return true;
    }

private:
    std::int64_t m_now = 0;
};

/// A signal that somebody has taken over, and that no node writes.
Roster rosterWithLease(std::int64_t deadline)
{
    Roster roster;
    roster.held = roster.safe = {true};
    roster.terms = {{0, std::make_shared<LeaseTerm>(deadline)}};
    return roster;
}

}  // namespace

// The cycle of a master over a stream whose kernel takes little at a time, as on a slow network.
class tst_MasterCycle : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void lockstepSendsTheRestAfterAFullStreamDrains();
    void aCriticalNodeThatCannotWorkStopsThePlantFromTheNextCycleOn_data();
    void aCriticalNodeThatCannotWorkStopsThePlantFromTheNextCycleOn();
    void anAbandonedSignalIsSafeWhenItsHoldIsOver();
    void leaseEndsInTheFirstCycleAfterItsDeadline_data();
    void leaseEndsInTheFirstCycleAfterItsDeadline();
    void valueOfALostHolderIsNotTaken();
    void theHubForgetsTheNodesOfACycleThatIsGone();
    void aNodeThatHasLeftIsFreedAtOnceWhileNoCycleRuns();
};

void tst_MasterCycle::lockstepSendsTheRestAfterAFullStreamDrains()
{
    QByteArray ini = "[out]\ntype = Int32\n";
    QVector<QPlcSignalIndex> inputs;
    for (int i = 0; i < 40; ++i) {
        ini += "[in" + QByteArray::number(i) + "]\ntype = Real64[125]\n";
        inputs << QPlcSignalIndex(i + 1);
    }
    const QPlcSignalTable table = QPlcSignalTable::fromIni(ini);
    CyclicHub hub;
    MasterCycle cycle(table, hub, false);
    PipedNode node(cycle, table, inputs);
    node.setSmallestBuffer();
    cycle.setRoster({{node.slot}});
    MasterCycle::Phase phase;
    phase.period = std::chrono::milliseconds(10);
    phase.clock = QPlcClock::lockstep();
    phase.cycleLimit = 1;
    QVERIFY(cycle.start(phase));

    QVERIFY(waitUntil([&] { return node.readRequest(); }));
    QVERIFY(node.slot->peer->sendFailures > 0);  // else this test has shown nothing
    QVERIFY(node.answer(QPlcValue(77)));
    QTRY_COMPARE(cycle.statistics().cycles, quint64(1));
    cycle.stop();
    QCOMPARE(cycle.value(0).toInt(), 77);
    cycle.setRoster({});
}

void tst_MasterCycle::aCriticalNodeThatCannotWorkStopsThePlantFromTheNextCycleOn_data()
{
    QTest::addColumn<bool>("critical");
    QTest::addColumn<int>("flags");
    QTest::addColumn<bool>("stops");
    QTest::newRow("its code has failed") << true << int(FaultFlag) << true;
    QTest::newRow("it is in its safe state") << true << int(SafeStopFlag) << true;
    QTest::newRow("it works") << true << 0 << false;
    QTest::newRow("code of another node has failed") << false << int(FaultFlag) << false;
    QTest::newRow("another node is in its safe state") << false << int(SafeStopFlag) << false;
}

/// The thread of the master is busy here: it reads no report.
void tst_MasterCycle::aCriticalNodeThatCannotWorkStopsThePlantFromTheNextCycleOn()
{
    QFETCH(bool, critical);
    QFETCH(int, flags);
    QFETCH(bool, stops);
    const QPlcSignalTable table = QPlcSignalTable::fromIni("[out]\ntype = Int32\n[in]\ntype = Int32\n");
    CyclicHub hub;
    MasterCycle cycle(table, hub, false);
    PipedNode node(cycle, table, {1});
    node.slot->critical = critical;
    cycle.setRoster({{node.slot}});
    MasterCycle::Phase phase;
    phase.period = std::chrono::milliseconds(1);
    phase.clock = QPlcClock::lockstep();
    QVERIFY(cycle.start(phase));

    for (int i = 0; i < 3; ++i) {
        QVERIFY(waitUntil([&] { return node.readRequest(); }));
        QVERIFY(!(node.flags() & SafeStopFlag));
        QVERIFY(node.answer(QPlcValue(i), i == 2 ? std::uint8_t(flags) : 0));
    }
    QVERIFY(waitUntil([&] { return node.readRequest(); }));
    QCOMPARE(bool(node.flags() & SafeStopFlag), stops);
    cycle.stop();
    cycle.setRoster({});
}

/// Its writer gave the initial value, and left before it took part in the cycles.
void tst_MasterCycle::anAbandonedSignalIsSafeWhenItsHoldIsOver()
{
    const QPlcSignalTable table = QPlcSignalTable::fromIni("[speed]\ntype = Real64\nhold = 2\nsafe = 1.5\n");
    CyclicHub hub;
    MasterCycle cycle(table, hub, false);
    NodeSlot writer;
    writer.outputLayout = PayloadLayout(table, {0});
    writer.prepare(cycle.image(), 5);
    cycle.forgetOutputs(3);
    cycle.storeInitialOutputs(writer, QPlcValue(9.0).toBytes().constData(), {});
    MasterCycle::Phase phase;
    phase.period = std::chrono::milliseconds(1);
    QVERIFY(cycle.start(phase));
    QTRY_VERIFY(cycle.statistics().cycles >= 5);
    QCOMPARE(cycle.value(0).toReal(), 9.0);  // it may still come
    Roster roster;
    roster.abandoned = {0};
    cycle.setRoster(roster);
    QTRY_COMPARE(cycle.value(0).toReal(), 1.5);
    cycle.stop();
    cycle.setRoster({});
}

void tst_MasterCycle::leaseEndsInTheFirstCycleAfterItsDeadline_data()
{
    QTest::addColumn<QString>("slope");
    QTest::addColumn<qint64>("deadline");
    QTest::addColumn<double>("value");
    constexpr qint64 lastCycle = 10'000'000;  // [ns]
    QTest::newRow("before") << "" << lastCycle + 1 << 9.0;
    QTest::newRow("at the deadline") << "" << lastCycle << 1.5;
    QTest::newRow("behind it") << "" << lastCycle - 3'500'000 << 1.5;
    QTest::newRow("with a slope, in the first cycle") << "slope = 1000 per second\n" << lastCycle << 8.0;
    QTest::newRow("with a slope, in the fourth cycle") << "slope = 1000 per second\n" << lastCycle - 3'500'000 << 5.0;
}

/// The thread of the master does nothing meanwhile.
void tst_MasterCycle::leaseEndsInTheFirstCycleAfterItsDeadline()
{
    QFETCH(QString, slope);
    QFETCH(qint64, deadline);
    QFETCH(double, value);
    const QPlcSignalTable table = QPlcSignalTable::fromIni("[speed]\ntype = Real64\nsafe = 1.5\n" + slope.toUtf8());
    CyclicHub hub;
    SleptTime time;
    MasterCycle cycle(table, hub, false, &time);
    QVERIFY(cycle.setValues({{0, QPlcValue(9.0)}}));
    cycle.setRoster(rosterWithLease(deadline));
    MasterCycle::Phase phase;
    phase.period = std::chrono::milliseconds(1);
    phase.cycleLimit = 11;  // the last one begins at 10 ms
    QVERIFY(cycle.start(phase));
    QTRY_COMPARE(cycle.cycle(), quint64(10));
    QCOMPARE(cycle.value(0).toReal(), value);
    cycle.stop();
    cycle.setRoster({});
}

void tst_MasterCycle::valueOfALostHolderIsNotTaken()
{
    const QPlcSignalTable table = QPlcSignalTable::fromIni("[speed]\ntype = Real64\n");
    CyclicHub hub;
    MasterCycle cycle(table, hub, false);
    const Roster roster = rosterWithLease(0);
    cycle.setRoster(roster);
    MasterCycle::Phase phase;
    phase.period = std::chrono::milliseconds(1);
    QVERIFY(cycle.start(phase));
    QTRY_VERIFY(roster.terms.at(0).term->hasEnded());
    QVERIFY(cycle.setValues({{0, QPlcValue(9.0)}}));
    const quint64 given = cycle.cycle();
    QTRY_VERIFY(cycle.cycle() > given + 1);
    QCOMPARE(cycle.value(0).toReal(), 0.0);
    cycle.setRoster(rosterWithLease(std::numeric_limits<std::int64_t>::max()));  // somebody takes it over
    QVERIFY(cycle.setValues({{0, QPlcValue(7.0)}}));
    QTRY_COMPARE(cycle.value(0).toReal(), 7.0);
    cycle.stop();
    cycle.setRoster({});
}

void tst_MasterCycle::theHubForgetsTheNodesOfACycleThatIsGone()
{
    const QPlcSignalTable table = QPlcSignalTable::fromIni("[speed]\ntype = Real64\n");
    CyclicHub hub;
    const auto slot = std::make_shared<NodeSlot>();
    {
        MasterCycle cycle(table, hub, false);
        slot->outputLayout = PayloadLayout(table, {0});
        slot->prepare(cycle.image(), 5);
        slot->peer = StreamTransport::peer(-1, slot->outputCutter(), MaximumCyclicFrame);
        slot->peer->owner = slot.get();
        cycle.setRoster({{slot}});
        QCOMPARE(hub.find<StreamTransport>()->peerCount(), std::size_t(1));
    }
    QCOMPARE(hub.find<StreamTransport>()->peerCount(), std::size_t(0));
}

/// With its peer: the other end of a connection sees that it is closed.
void tst_MasterCycle::aNodeThatHasLeftIsFreedAtOnceWhileNoCycleRuns()
{
    const QPlcSignalTable table = QPlcSignalTable::fromIni("[speed]\ntype = Real64\n");
    CyclicHub hub;
    MasterCycle cycle(table, hub, false);
    const auto slot = std::make_shared<NodeSlot>();
    slot->outputLayout = PayloadLayout(table, {0});
    slot->prepare(cycle.image(), 5);
    cycle.setRoster({{slot}});
    QVERIFY(slot.use_count() > 1);
    cycle.setRoster({});
    QCOMPARE(slot.use_count(), 1L);
}

QTEST_GUILESS_MAIN(tst_MasterCycle)
#include "tst_MasterCycle.moc"
