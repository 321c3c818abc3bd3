// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "PhaseFixtures.h"

using qplc::NodeSession;
using Answers = NodeSession::Answers;

// A phase with a thread of cycles; the first cycle begins at once.
class tst_RealTimePhase : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void itRunsFromItsStartToItsEnd();
    void theEndComesBetweenTwoCycles();
    void theEndIsTakenOnce();
    void aNodeThatHasLeftKeepsItsNameInThePhase();
    void theNextPhaseForgetsWhoHasLeft();
    void aNodeThatLeavesWhileItJoinsAbandonsItsSignals_data();
    void aNodeThatLeavesWhileItJoinsAbandonsItsSignals();
    void theWishedNumberOfCyclesGoesBeforeTheLimit_data();
    void theWishedNumberOfCyclesGoesBeforeTheLimit();
    void ownSignalsHaveValuesInEachCycle();
    void anOwnSignalIsGoodWhateverItWasBefore();
    void alarmsOfBeforeAreOver();
};

void tst_RealTimePhase::itRunsFromItsStartToItsEnd()
{
    PhaseBench bench;
    QVERIFY(!bench.phase.isRunning());
    QCOMPARE(bench.phase.cycleText(), QString());
    QVERIFY(bench.start());
    QVERIFY(bench.phase.isRunning());
    QVERIFY(bench.image.isRunning());
    QVERIFY2(bench.phase.cycleText().startsWith(" in cycle "), qPrintable(bench.phase.cycleText()));
    bench.phase.end();
    QVERIFY(!bench.phase.isRunning());
    QVERIFY(!bench.image.isRunning());
    QCOMPARE(bench.phase.cycleText(), QString());
}

void tst_RealTimePhase::theEndComesBetweenTwoCycles()
{
    PhaseBench bench;  // the second cycle is far away
    QVERIFY(bench.start());
    QTRY_COMPARE(bench.image.statistics().cycles, quint64(1));
    bench.phase.end();
    QCOMPARE(bench.image.statistics().cycles, quint64(1));
}

void tst_RealTimePhase::theEndIsTakenOnce()
{
    PhaseBench bench;
    bench.phase.end();  // there was no phase
    QVERIFY(!bench.phase.takeEnd());
    QVERIFY(bench.start());
    QVERIFY(!bench.phase.takeEnd());
    bench.phase.end();
    QVERIFY(bench.phase.takeEnd());
    QVERIFY(!bench.phase.takeEnd());
}

void tst_RealTimePhase::aNodeThatHasLeftKeepsItsNameInThePhase()
{
    PhaseBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    const auto viewer = bench.add("Viewer", Answers::Later, "", "sum", true);
    QVERIFY(bench.start());
    QCOMPARE(bench.phase.nodeName(winch->slot()->id), QString("Winch"));
    QVERIFY(!bench.phase.hasLeft("Winch"));
    bench.phase.nodeLeft(winch.get(), *winch->slot());
    bench.phase.nodeLeft(nullptr, *viewer->slot());
    bench.remove(winch);
    bench.remove(viewer);
    QCOMPARE(bench.phase.nodeName(winch->slot()->id), QString("Winch"));
    QVERIFY(bench.phase.hasLeft("Winch"));
    QVERIFY(!bench.phase.hasLeft("Kite"));
    QVERIFY(!bench.phase.wasListener(winch->slot()->id));
    QVERIFY(bench.phase.wasListener(viewer->slot()->id));
    QVERIFY(!bench.phase.wasListener(99));
    QCOMPARE(bench.phase.nodeName(99), QString("number 99"));
}

void tst_RealTimePhase::theNextPhaseForgetsWhoHasLeft()
{
    PhaseBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    bench.phase.nodeLeft(winch.get(), *winch->slot());
    bench.rosters.abandon(*winch->slot());
    bench.remove(winch);
    QVERIFY(bench.start());
    QVERIFY(!bench.phase.hasLeft("Winch"));
    QVERIFY(bench.rosters.make().abandoned.empty());
}

void tst_RealTimePhase::aNodeThatLeavesWhileItJoinsAbandonsItsSignals_data()
{
    QTest::addColumn<bool>("inAPhase");
    QTest::addColumn<int>("stage");
    QTest::addColumn<bool>("abandons");
    QTest::newRow("no phase") << false << int(NodeSession::Initialized) << false;
    QTest::newRow("outputs not given yet") << true << int(NodeSession::GivingOutputs) << false;
    QTest::newRow("outputs given") << true << int(NodeSession::OutputsGiven) << true;
    QTest::newRow("not started yet") << true << int(NodeSession::Starting) << true;
    QTest::newRow("in the cycles") << true << int(NodeSession::Running) << false;  // these know what it has written
}

void tst_RealTimePhase::aNodeThatLeavesWhileItJoinsAbandonsItsSignals()
{
    QFETCH(bool, inAPhase);
    QFETCH(int, stage);
    QFETCH(bool, abandons);
    PhaseBench bench;
    QVERIFY(!inAPhase || bench.start());
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    winch->setStage(NodeSession::Stage(stage));
    bench.nodes.remove(*winch);
    bench.phase.nodeLeft(winch.get(), *winch->slot());
    bench.registry.remove(winch->slot());
    QCOMPARE(bench.rosters.make().abandoned.size(), std::size_t(abandons ? 1 : 0));
}

void tst_RealTimePhase::theWishedNumberOfCyclesGoesBeforeTheLimit_data()
{
    QTest::addColumn<quint64>("limit");
    QTest::addColumn<quint64>("wanted");
    QTest::addColumn<quint64>("cycles");
    QTest::newRow("limit") << quint64(5) << quint64(0) << quint64(5);
    QTest::newRow("wish") << quint64(5) << quint64(3) << quint64(3);
    QTest::newRow("one cycle") << quint64(5) << quint64(1) << quint64(1);
}

void tst_RealTimePhase::theWishedNumberOfCyclesGoesBeforeTheLimit()
{
    QFETCH(quint64, limit);
    QFETCH(quint64, wanted);
    QFETCH(quint64, cycles);
    PhaseBench bench;
    bench.settings.clock = QPlcClock::lockstep();
    bench.settings.cycleLimit = limit;
    bench.settings.cyclesWanted = wanted;
    QVERIFY(bench.start());
    QTRY_VERIFY(bench.image.statistics().cycles >= cycles);
    bench.phase.end();
    QCOMPARE(bench.image.statistics().cycles, cycles);
}

void tst_RealTimePhase::ownSignalsHaveValuesInEachCycle()
{
    PhaseBench bench;
    QCOMPARE(bench.own.claim(qplc::OwnSignals::Time, "time"), QString());
    QCOMPARE(bench.own.claim(qplc::OwnSignals::Jitter, "jitter"), QString());
    QCOMPARE(bench.own.claim(qplc::OwnSignals::Workload, "masterWorkload"), QString());
    bench.settings.interval = std::chrono::milliseconds(1);
    const std::vector<char> before = bench.image.values();
    const auto hasChanged = [&](const char *signal) {
        const QPlcSignalIndex index = bench.index(signal);
        const std::vector<char> now = bench.image.values();
        const auto begin = std::ptrdiff_t(bench.image.offset(index));
        return !std::equal(now.begin() + begin, now.begin() + begin + std::ptrdiff_t(bench.table.at(index).type.size()),
                           before.begin() + begin);
    };
    QVERIFY(bench.start());
    QTRY_VERIFY(bench.image.statistics().cycles >= 2);
    bench.phase.end();
    QVERIFY(hasChanged("time"));
    QVERIFY(hasChanged("jitter"));
    QVERIFY(hasChanged("masterWorkload"));
    QVERIFY(!hasChanged("workload"));
}

void tst_RealTimePhase::anOwnSignalIsGoodWhateverItWasBefore()
{
    PhaseBench bench;
    const QPlcSignalIndex jitter = bench.index("jitter");
    QVERIFY(bench.image.setValues({{jitter, QPlcValue(float(0.0)), QPlcQuality::Safe}}));  // by a node that has left
    QCOMPARE(bench.own.claim(qplc::OwnSignals::Jitter, "jitter"), QString());
    QVERIFY(bench.start());
    bench.phase.end();
    QCOMPARE(bench.image.image().quality(jitter), QPlcQuality(QPlcQuality::Good));
}

void tst_RealTimePhase::alarmsOfBeforeAreOver()
{
    PhaseBench bench;
    bench.journal.raise("node Winch", qplc::JournalEvent::Error, qplc::JournalEvent::Node, "Winch",
                        "node Winch is gone");
    QVERIFY(bench.start());
    QVERIFY(bench.hasEvent("node Winch: over, a real-time phase has begun, after 0.0 s"));
}

QTEST_GUILESS_MAIN(tst_RealTimePhase)
#include "tst_RealTimePhase.moc"
