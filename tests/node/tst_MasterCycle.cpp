// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "node/cycle/MasterCycle.h"
#include "protocol/CyclicFrame.h"
#include "transport/StreamTransport.h"

#include <sys/socket.h>
#include <unistd.h>

using namespace qplc;

// The cycle of a master over a stream whose kernel takes little at a time, as on a slow network.
class tst_MasterCycle : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void lockstepSendsTheRestAfterAFullStreamDrains();
    void anAbandonedSignalIsSafeWhenItsHoldIsOver();
    void theHubForgetsTheNodesOfACycleThatIsGone();
    void aNodeThatHasLeftIsFreedAtOnceWhileNoCycleRuns();
};

void tst_MasterCycle::lockstepSendsTheRestAfterAFullStreamDrains()
{
    constexpr quint64 session = 5;
    QByteArray ini = "[out]\ntype = Int32\n";
    QVector<QPlcSignalIndex> inputs;
    for (int i = 0; i < 40; ++i) {
        ini += "[in" + QByteArray::number(i) + "]\ntype = Real64[125]\n";
        inputs << QPlcSignalIndex(i + 1);
    }
    const QPlcSignalTable table = QPlcSignalTable::fromIni(ini);
    int ends[2] = {-1, -1};
    QCOMPARE(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends), 0);
    const int smallest = 1;
    ::setsockopt(ends[0], SOL_SOCKET, SO_SNDBUF, &smallest, sizeof smallest);

    CyclicHub hub;
    MasterCycle cycle(table, hub, false);
    const auto slot = std::make_shared<NodeSlot>();
    slot->id = 1;
    slot->inputLayout = PayloadLayout(table, inputs);
    slot->outputLayout = PayloadLayout(table, {0});
    slot->prepare(cycle.image(), session);
    slot->peer = StreamTransport::peer(ends[0], slot->outputCutter(), MaximumCyclicFrame);
    slot->peer->owner = slot.get();
    cycle.setRoster({{slot}});
    MasterCycle::Phase phase;
    phase.period = std::chrono::milliseconds(10);
    phase.clock = QPlcClock::lockstep();
    phase.cycleLimit = 1;
    QVERIFY(cycle.start(phase));

    FrameDecoder decoder(FrameKind::Inputs, {session, 1, slot->inputLayout.hash()},
                         slot->inputLayout.partBorders(MaximumCyclicPayload));
    QByteArray stream;
    FrameStatus status = FrameStatus::Incomplete;
    QTRY_VERIFY(([&] {
        char bytes[4096];
        for (ssize_t count; (count = ::recv(ends[1], bytes, sizeof bytes, MSG_DONTWAIT)) > 0;)
            stream.append(bytes, int(count));
        while (stream.size() >= int(CyclicHeaderSize) && status != FrameStatus::Complete) {
            const int size = int(decoder.frameSize(stream.constData()));
            if (size == 0 || stream.size() < size)
                break;
            status = decoder.decode(stream.constData(), std::size_t(size));
            stream.remove(0, size);
        }
        return status == FrameStatus::Complete;
    }()));
    QVERIFY(slot->peer->sendFailures > 0);  // else this test has shown nothing
    const FrameEncoder encoder(FrameKind::Outputs, {session, 1, slot->outputLayout.hash()}, {0, 4});
    FrameHeader header;
    header.cycle = std::uint32_t(decoder.cycle());
    char answer[20];
    encoder.encode(0, header, QPlcValue(77).toBytes().constData(), answer);
    QCOMPARE(::send(ends[1], answer, sizeof answer, MSG_NOSIGNAL), ssize_t(sizeof answer));
    QTRY_COMPARE(cycle.statistics().cycles, quint64(1));
    cycle.stop();
    QCOMPARE(cycle.value(0).toInt(), 77);
    cycle.setRoster({});
    ::close(ends[1]);
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
