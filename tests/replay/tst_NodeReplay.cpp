// SPDX-License-Identifier: Apache-2.0
#include "RecordedMaster.h"
#include "SecurityFixtures.h"
#include "Stepping.h"
#include "node/cycle/RingReader.h"
#include "replay/NodeReplay.h"

#include <QtTest/QtTest>

using namespace qplc;

// A node of this process computes again what a recording says.
class tst_NodeReplay : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void aReplayComputesTheSameBits_data();
    void aReplayComputesTheSameBits();
    void anotherGainDiffersFromTheFirstInputOn();
    void onlyWhatFollowsTheTimeIsCompared();
    void aChangedBitOfAnInputIsFoundInItsCycle();
    void whatIsVolatileIsNotCompared();
    void aNodeThatIsNotInTheRecordingIsRefused();
    void anotherVersionOfANodeIsRefused();
    void aNodeWithDevicesIsRefused();
    void aRecordingFromTheMiddleOfAPhaseIsRefused();
    void theFilesOfAPhaseAreOneRecording();
    void aSecuredPlantIsReplayedWithoutKeys();
    void aNodeThatHasLostItsConnectionIsReplayedAsOne();

private:
    static ReplayResult replay(const QString &file, QPlcSlaveNode &node)
    {
        ReplayRequest request;
        request.file = file;
        request.node = &node;
        return replayNode(request);
    }
    std::unique_ptr<RecordedMaster> m_flight;  // in real time, with nodes that are late
};

/// Cycles are skipped, answers are late, a signal is set, and one moves on its slope.
void tst_NodeReplay::initTestCase()
{
    Chain chain;
    chain.first.onStep = [](const QPlcCycle &cycle) {
        if (cycle.number() % 17 == 5)
            beBusyFor(7ms);
    };
    chain.second.onStep = [](const QPlcCycle &cycle) {
        if (cycle.number() % 23 == 7)
            beBusyFor(3ms);
    };
    m_flight = std::make_unique<RecordedMaster>(QPlcClock::realTime());
    QVERIFY(m_flight->listen());
    const char *const kinds[] = {"udp", "shared memory", "in process", "tcp"};
    const std::vector<QPlcSlaveNode *> nodes = chain.all();
    for (std::size_t i = 0; i < nodes.size(); ++i)
        QVERIFY2(m_flight->admitOver(*nodes[i], kinds[i]), qPrintable(nodes[i]->errorString()));
    m_flight->startRealTime();
    QVERIFY(m_flight->waitForState(QPlcMasterNode::RealTime));
    QVERIFY(m_flight->waitForCycles(40));
    QVERIFY(m_flight->setSignalValue("set", QPlcValue(2.5)) && m_flight->setSignalValue("moved", QPlcValue(-2.0)));
    QVERIFY(m_flight->waitForCycles(300));
    QVERIFY2(m_flight->finish(), qPrintable(m_flight->error));
}

void tst_NodeReplay::aReplayComputesTheSameBits_data()
{
    QTest::addColumn<int>("node");
    for (int i = 0; i < 4; ++i)
        QTest::newRow(qPrintable(Chain().all()[std::size_t(i)]->name())) << i;
}

void tst_NodeReplay::aReplayComputesTheSameBits()
{
    QFETCH(int, node);
    Chain chain;
    const ReplayResult result = replay(m_flight->recording(), *chain.all()[std::size_t(node)]);
    QVERIFY2(result.kind == ReplayResult::Done, qPrintable(result.error));
    QVERIFY2(!result.first,
             qPrintable(result.first ? QString("%1 in cycle %2: %3, now %4")
                                           .arg(result.first->signal)
                                           .arg(result.first->cycle)
                                           .arg(result.first->recorded, result.first->computed)
                                     : QString()));
    QCOMPARE(result.differences, quint64(0));
    QVERIFY2(result.compared > 50, qPrintable(QString::number(result.compared)));
    QVERIFY2(result.compared + result.unknown + 2 >= result.cycles, "each answer is in the recording");
}

/// "set" is the first of its inputs that is not 0.
void tst_NodeReplay::anotherGainDiffersFromTheFirstInputOn()
{
    Chain chain;
    chain.third.gain = 0.11;
    const ReplayResult result = replay(m_flight->recording(), chain.third);
    QVERIFY2(result.kind == ReplayResult::Done, qPrintable(result.error));
    QVERIFY(result.first);
    QCOMPARE(result.first->signal, QString("s4"));
    QVERIFY(result.first->recorded != result.first->computed);
    QVERIFY(result.differences > 50);
}

void tst_NodeReplay::onlyWhatFollowsTheTimeIsCompared()
{
    Chain chain;
    chain.third.gain = 0.11;
    ReplayRequest request;
    request.file = m_flight->recording();
    request.node = &chain.third;
    request.from = 0.4;
    const ReplayResult result = replayNode(request);
    QVERIFY(result.first);
    QVERIFY(result.first->time >= 0.4);
}

void tst_NodeReplay::aChangedBitOfAnInputIsFoundInItsCycle()
{
    constexpr std::uint64_t changed = 31;
    Chain chain;
    RecordedMaster master(QPlcClock::external());
    QVERIFY(master.listen());
    for (QPlcSlaveNode *node : chain.all())
        QVERIFY(master.admitOver(*node, "in process"));
    master.startRealTime();
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    for (int i = 0; i < 60; ++i)
        master.step();
    RingReader reader;
    QVERIFY2(reader.open(master.ring, &master.error), qPrintable(master.error));
    const ProcessImage image(probeTable());
    std::uint64_t place = reader.memory().header()->cycles.oldest;
    for (bool isFound = false; !isFound;) {
        RecordHead head;
        std::memcpy(&head, reader.memory().cycles().at(place), sizeof head);
        char *body = reader.memory().cycles().at(place) + sizeof head;
        CycleView view;
        QVERIFY(head.size > 0);
        if (head.kind == RecordKind::Cycle && CycleView::read(body, head.size - std::uint32_t(sizeof head), &view)
            && view.cycle.number == changed - 1) {
            body[std::size_t(view.image - body) + image.offset(image.table().indexOf("s2")) + 5] ^= 1;
            isFound = true;
        }
        place += head.size;
    }
    QVERIFY2(master.finish(), qPrintable(master.error));

    Chain again;
    const ReplayResult result = replay(master.recording(), again.second);
    QVERIFY2(result.kind == ReplayResult::Done, qPrintable(result.error));
    QVERIFY(result.first);
    QCOMPARE(result.first->cycle, quint64(changed));
    QCOMPARE(result.first->signal, QString("s3"));
}

void tst_NodeReplay::whatIsVolatileIsNotCompared()
{
    const auto table = [](bool isVolatile) {
        return QPlcSignalTable::fromIni(QByteArray("[s5]\ntype = Real64\n") + (isVolatile ? "volatile = yes\n" : "")
                                        + "[s1]\ntype = Real64\nhold = 3\nsafe = 8\n");
    };
    for (const bool isVolatile : {true, false}) {
        Probe probe("Clock", {{"s1"}}, {"s5"});
        RecordedMaster master(QPlcClock::external(), table(isVolatile));
        QVERIFY(master.addLocalNode(&probe) && master.startRealTime());
        for (int i = 0; i < 20; ++i)
            master.step();
        QVERIFY2(master.finish(), qPrintable(master.error));
        Probe again("Clock", {{"s1"}}, {"s5"});
        again.offset = 1.0;
        const ReplayResult result = replay(master.recording(), again);
        QVERIFY2(result.kind == ReplayResult::Done, qPrintable(result.error));
        QCOMPARE(result.cycles, quint64(20));
        QCOMPARE(result.differences > 0, !isVolatile);
    }
}

void tst_NodeReplay::aNodeThatIsNotInTheRecordingIsRefused()
{
    Probe stranger("Stranger", {{"s0"}}, {"s5"});
    const ReplayResult result = replay(m_flight->recording(), stranger);
    QCOMPARE(result.kind, ReplayResult::Refused);
    QVERIFY2(result.error.contains("no node 'Stranger', but First, Integrator, Second, Third"),
             qPrintable(result.error));
}

void tst_NodeReplay::anotherVersionOfANodeIsRefused()
{
    Probe other("Third", {{"s3", QPlcInputTiming::SameCycle}, {"s2"}}, {"s4"});
    const ReplayResult result = replay(m_flight->recording(), other);
    QCOMPARE(result.kind, ReplayResult::Refused);
    QVERIFY2(result.error.contains("'s2' instead of 's1'"), qPrintable(result.error));
}

void tst_NodeReplay::aNodeWithDevicesIsRefused()
{
    Chain chain;
    chain.third.setHardware(true);
    const ReplayResult result = replay(m_flight->recording(), chain.third);
    QVERIFY(result.kind != ReplayResult::Done);
    QVERIFY2(result.error.contains("real devices"), qPrintable(result.error));
}

/// Its nodes have a state by then that nobody knows.
void tst_NodeReplay::aRecordingFromTheMiddleOfAPhaseIsRefused()
{
    Chain chain;
    RecordedMaster master(QPlcClock::external());
    master.recordsAtOnce = false;
    master.setInterval(std::chrono::seconds(1));  // the ring has 1 MiB
    for (QPlcSlaveNode *node : chain.all())
        QVERIFY(master.admitOver(*node, "in process"));
    master.startRealTime();
    for (int i = 0; i < 4000; ++i)
        master.step();
    master.record();
    for (int i = 0; i < 10; ++i)
        master.step();
    QVERIFY2(master.finish(), qPrintable(master.error));
    Chain again;
    const ReplayResult result = replay(master.recording(), again.third);
    QCOMPARE(result.kind, ReplayResult::Refused);
    QVERIFY2(result.error.contains("take a recording from the start of the phase"), qPrintable(result.error));
}

/// The node begins in the first of three files.
void tst_NodeReplay::theFilesOfAPhaseAreOneRecording()
{
    Chain chain;
    RecordedMaster master(QPlcClock::external());
    for (QPlcSlaveNode *node : chain.all())
        QVERIFY(master.admitOver(*node, "in process"));
    master.startRealTime();
    for (const char *next : {"flight-2.mcap", "flight-3.mcap"}) {
        for (int i = 0; i < 20; ++i)
            master.step();
        while (master.recorder.proceed(&master.error) == PlantRecorder::Recorded)
            continue;
        QVERIFY2(master.recorder.finish(&master.error)
                     && master.recorder.begin(mcap::FileSink::create(master.folder.filePath(next), &master.error),
                                              &master.error),
                 qPrintable(master.error));
    }
    for (int i = 0; i < 20; ++i)
        master.step();
    QVERIFY2(master.finish(), qPrintable(master.error));

    const QString folder = master.folder.path();
    Chain again;
    ReplayResult result = replay(folder, again.second);
    QVERIFY2(result.kind == ReplayResult::Done, qPrintable(result.error));
    QCOMPARE(result.cycles, quint64(60));
    QCOMPARE(result.compared, quint64(60));
    QCOMPARE(result.differences, quint64(0));
    QVERIFY2(result.notes.join(' ').contains("3 files"), qPrintable(result.notes.join(' ')));

    Chain alone;
    result = replay(master.folder.filePath("flight-3.mcap"), alone.second);
    QCOMPARE(result.kind, ReplayResult::Refused);

    QVERIFY(QFile::remove(master.folder.filePath("flight-2.mcap")));
    Chain until;
    result = replay(folder, until.second);
    QVERIFY2(result.kind == ReplayResult::Done, qPrintable(result.error));
    QCOMPARE(result.cycles, quint64(20));
    QCOMPARE(result.differences, quint64(0));
    QVERIFY2(result.notes.join(' ').contains("the cycles from 20 to 39 are not in the recording"),
             qPrintable(result.notes.join(' ')));
}

void tst_NodeReplay::aSecuredPlantIsReplayedWithoutKeys()
{
    const SecurityFiles files;
    Probe echo("Echo", {{"s0"}, {"moved"}, {"jitter"}}, {"s1"});
    echo.setSecurity(files.echo());
    RecordedMaster master(QPlcClock::lockstep());
    master.setSecurity(QPlcSecurity::preSharedKeys(files.masterKeys()));
    QVERIFY2(master.listen(), qPrintable(master.errorString()));
    QVERIFY2(master.admitOver(echo, "udp"), qPrintable(echo.errorString()));
    master.initializeAllStates();
    QVERIFY(master.waitForState(QPlcMasterNode::Ready));
    QVERIFY(master.arm());
    master.startRealTime();
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    QVERIFY(master.waitForCycles(200));
    QVERIFY2(master.finish(), qPrintable(master.error));

    Probe again("Echo", {{"s0"}, {"moved"}, {"jitter"}}, {"s1"});
    const ReplayResult result = replay(master.recording(), again);
    QVERIFY2(result.kind == ReplayResult::Done, qPrintable(result.error));
    QVERIFY(result.compared >= 199);
    QCOMPARE(result.differences, quint64(0));
}

/// It is the same program before and after, with the state that it had.
void tst_NodeReplay::aNodeThatHasLostItsConnectionIsReplayedAsOne()
{
    Probe echo("Echo", {{"s0"}, {"moved"}, {"jitter"}}, {"s1"});
    echo.missedGain = 0.0;  // it counts them anew after a connection
    RecordedMaster master(QPlcClock::realTime());
    QVERIFY(master.listen() && master.admitOver(echo, "tcp"));
    master.startRealTime();
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    QVERIFY(master.waitForCycles(100));
    echo.disconnectFromMaster();
    QTRY_VERIFY(master.nodes().isEmpty());
    const quint64 left = master.statistics().cycles;
    QVERIFY(master.admitOver(echo, "tcp"));
    QTRY_COMPARE(echo.state(), QPlcSlaveNode::RealTime);
    const quint64 back = master.statistics().cycles;
    QVERIFY(master.waitForCycles(int(back) + 100));
    QVERIFY2(master.finish(), qPrintable(master.error));

    Probe again("Echo", {{"s0"}, {"moved"}, {"jitter"}}, {"s1"});
    again.missedGain = 0.0;
    const ReplayResult result = replay(master.recording(), again);
    QVERIFY2(result.kind == ReplayResult::Done, qPrintable(result.error));
    QVERIFY2(result.compared > left, "what it has computed later is compared, too");
    QVERIFY2(!result.first, result.first ? qPrintable(QString::number(result.first->cycle)) : "");
}

QTEST_GUILESS_MAIN(tst_NodeReplay)
#include "tst_NodeReplay.moc"
