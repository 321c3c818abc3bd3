// SPDX-License-Identifier: Apache-2.0
#include "PhaseFixtures.h"
#include "node/session/MasterFaults.h"

#include <QtTest/QtTest>

using qplc::CycleEvent;
using qplc::MasterEvent;
using qplc::MasterFaults;
using qplc::NodeSession;
using Answers = NodeSession::Answers;

namespace {

/// A master whose state the test sets, and that writes down events.
class FaultControl final : public qplc::MasterControl
{
public:
    QPlcMasterNode::State now = QPlcMasterNode::RealTime;
    QStringList log;

    QPlcMasterNode::State state() const override { return now; }
    bool apply(MasterEvent event, const QString &reason) override
    {
        log << QStringLiteral("%1: %2").arg(QLatin1String(qplc::nameOf(event)), reason);
        return true;
    }
    void announce(const qplc::messages::StatesInitialized &) override {}
    QStringList takeLog() { return std::exchange(log, {}); }
};

struct FaultBench : PhaseBench
{
    FaultControl control;
    qplc::MasterError error{journal, [this](QPlcMasterNode::Error value) { write(value); }};
    MasterFaults faults{control, error, nodes, phase};

private:
    /// The error and its event, the newest one.
    void write(QPlcMasterNode::Error value)
    {
        const qplc::JournalEvent event = journal.events().after(journal.events().newest() - 1, 1).front();
        control.log << QStringLiteral("%1 %2 of %3: %4")
                           .arg(value == QPlcMasterNode::NodeError ? "node error" : "real-time error",
                                qplc::kindName(event.kind), event.source, event.text);
    }
};

CycleEvent happened(CycleEvent::Kind kind, const std::shared_ptr<ScriptedSession> &node = {})
{
    CycleEvent event;
    event.kind = kind;
    event.node = node ? node->slot()->id : 0;
    event.cycle = 12;
    event.duration = 34'000'000;
    return event;
}

}  // namespace

class tst_MasterFaults : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aNodeThatFailsIsAnErrorOfAPhaseOnly();
    void aFaultAfterASafeStopIsNoFurtherError();
    void whatFollowsWhenANodeLeaves_data();
    void whatFollowsWhenANodeLeaves();
    void eachLimitNamesItsCause_data();
    void eachLimitNamesItsCause();
    void nothingTripsOutsideOfAPhaseOrInASafeStop();
    void anOverrunTellsItsFiguresAndEndsThePhase();
    void aSafeStopInAnInitializationSaysSo();
    void aNodeThatIsLateIsInTheWayOfAReset();
    void aLostCriticalNodeMustComeBack();
    void aNodeThatTrippedIsNeededOnlyIfItWasSafe_data();
    void aNodeThatTrippedIsNeededOnlyIfItWasSafe();
    void theFirstFaultIsTheOneToRepair();
    void aSafeStopByAPersonHasNoCause();
};

void tst_MasterFaults::aNodeThatFailsIsAnErrorOfAPhaseOnly()
{
    FaultBench bench;
    bench.faults.nodeFailed("Winch", false, "it threw");
    QCOMPARE(bench.control.takeLog(), QStringList{"NodeFailed: it threw"});
    QVERIFY(bench.start());
    bench.faults.nodeFailed("Winch", false, "it threw");
    QCOMPARE(bench.control.takeLog(), QStringList({"node error fault of Winch: it threw", "NodeFailed: it threw"}));
    bench.faults.nodeFailed("Winch", true, "it threw");
    QCOMPARE(bench.control.takeLog(),
             QStringList({"node error fault of Winch: it threw", "CriticalNodeFailed: it threw"}));
}

void tst_MasterFaults::aFaultAfterASafeStopIsNoFurtherError()
{
    FaultBench bench;
    QVERIFY(bench.start());
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    winch->slot()->critical = true;
    bench.control.now = QPlcMasterNode::SafeStop;
    bench.faults.nodeFailed("Winch", true, "it threw");
    bench.faults.nodeLeft(*winch->slot(), NodeSession::Running, false, "node 'Winch' has left");
    QCOMPARE(bench.control.takeLog(),
             QStringList({"CriticalNodeFailed: it threw", "CriticalNodeLeft: critical node 'Winch' has left"}));
}

void tst_MasterFaults::whatFollowsWhenANodeLeaves_data()
{
    QTest::addColumn<bool>("critical");
    QTest::addColumn<bool>("listener");
    QTest::addColumn<int>("stage");
    QTest::addColumn<bool>("wasAwaited");
    QTest::addColumn<QStringList>("told");
    const QStringList critical{"node error fault of Winch: critical it has left",
                               "CriticalNodeLeft: critical it has left"};
    const QStringList left{"NodeLeft: it has left"};
    const QStringList failed{"SequenceFailed: it has left"};
    QTest::newRow("in cycles") << false << false << int(NodeSession::Running) << false << left;
    QTest::newRow("critical, in cycles") << true << false << int(NodeSession::Running) << false << critical;
    QTest::newRow("critical, not in cycles") << true << false << int(NodeSession::Initialized) << false << left;
    QTest::newRow("a sequence waits for it") << false << false << int(NodeSession::Starting) << true << failed;
    QTest::newRow("critical, a sequence waits for it") << true << false << int(NodeSession::Running) << true << failed;
    QTest::newRow("listener") << false << true << int(NodeSession::Running) << false << QStringList();
}

void tst_MasterFaults::whatFollowsWhenANodeLeaves()
{
    QFETCH(bool, critical);
    QFETCH(bool, listener);
    QFETCH(int, stage);
    QFETCH(bool, wasAwaited);
    QFETCH(QStringList, told);
    FaultBench bench;
    const auto winch = bench.add("Winch", Answers::Later, listener ? "" : "sum", "echo", listener);
    winch->slot()->critical = critical;
    bench.faults.nodeLeft(*winch->slot(), NodeSession::Stage(stage), wasAwaited, "it has left");
    QCOMPARE(bench.control.takeLog(), told);
}

void tst_MasterFaults::eachLimitNamesItsCause_data()
{
    QTest::addColumn<int>("kind");
    QTest::addColumn<QString>("error");
    QTest::addColumn<QString>("text");
    const QString ofNode = "node error late of Winch";
    const QString ofMaster = "real-time error overrun of Master";
    QTest::newRow("late once") << int(CycleEvent::TrippedByLateAnswer) << ofNode << "node 'Winch' was late in cycle 12";
    QTest::newRow("late too often") << int(CycleEvent::TrippedByLateAnswers) << ofNode
                                    << "critical node 'Winch' was late too often, last in cycle 12";
    QTest::newRow("waited for") << int(CycleEvent::TrippedByWait) << ofNode
                                << "node 'Winch' did not answer cycle 12 within 34 ms";
    QTest::newRow("wanted") << int(CycleEvent::TrippedByNode) << ofNode << "node 'Winch' asked for it in cycle 12";
    const QString fault = "node error fault of Winch";
    QTest::newRow("failed") << int(CycleEvent::TrippedByFailure) << fault
                            << "the code of critical node 'Winch' failed in cycle 12";
    QTest::newRow("safe") << int(CycleEvent::TrippedBySafeNode) << fault
                          << "critical node 'Winch' is in its safe state since cycle 12";
    QTest::newRow("gap") << int(CycleEvent::TrippedByGap) << ofMaster
                         << "the master stood still for 34 ms before cycle 12";
    QTest::newRow("overruns") << int(CycleEvent::TrippedByOverruns) << ofMaster
                              << "4 overruns in a row, the last one of them in cycle 12";
}

void tst_MasterFaults::eachLimitNamesItsCause()
{
    QFETCH(int, kind);
    QFETCH(QString, error);
    QFETCH(QString, text);
    FaultBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    QVERIFY(bench.start());
    bench.faults.tripped(happened(CycleEvent::Kind(kind), winch), 3);
    QCOMPARE(bench.control.takeLog(), QStringList({error + ": " + text, "CyclesTripped: " + text}));
}

void tst_MasterFaults::nothingTripsOutsideOfAPhaseOrInASafeStop()
{
    FaultBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    bench.faults.tripped(happened(CycleEvent::TrippedByNode, winch), 3);
    bench.faults.overrun(happened(CycleEvent::Overrun), 10'000'000);
    QVERIFY(bench.start());
    bench.control.now = QPlcMasterNode::SafeStop;
    bench.faults.tripped(happened(CycleEvent::TrippedByNode, winch), 3);
    QCOMPARE(bench.control.takeLog(), QStringList());
}

void tst_MasterFaults::anOverrunTellsItsFiguresAndEndsThePhase()
{
    FaultBench bench;
    QVERIFY(bench.start());
    bench.faults.overrun(happened(CycleEvent::Overrun), 10'500'000);
    const QStringList log = bench.control.takeLog();
    QCOMPARE(log.size(), 2);
    const QString begin = "cycle 12 could begin only 34.000 ms after its time, and a period is 10.500 ms";
    QVERIFY2(log[0].startsWith("real-time error overrun of Master: " + begin), qPrintable(log[0]));
    QVERIFY2(log[1].startsWith("OverrunStop: " + begin), qPrintable(log[1]));
}

void tst_MasterFaults::aSafeStopInAnInitializationSaysSo()
{
    FaultBench bench;
    bench.faults.safeStop("smoke");
    bench.control.now = QPlcMasterNode::Initializing;
    bench.faults.safeStop("smoke");
    QCOMPARE(bench.control.takeLog(), QStringList({"SafeStop: smoke", "SafeStop: stopped safely: smoke"}));
}

void tst_MasterFaults::aNodeThatIsLateIsInTheWayOfAReset()
{
    FaultBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    const auto kite = bench.add("Kite", Answers::Later, "echo");
    QVERIFY(bench.start());
    bench.faults.tripped(happened(CycleEvent::TrippedByLateAnswers, winch), 0);
    winch->slot()->bucket = 1;
    kite->slot()->bucket = 0;
    QCOMPARE(bench.faults.remainingCause(), QString());  // the master goes on
    bench.control.now = QPlcMasterNode::SafeStop;
    QCOMPARE(bench.faults.remainingCause(), QString("node 'Winch' still answers late, or not at all"));
    winch->slot()->bucket = 0;
    kite->slot()->bucket = 1;
    QCOMPARE(bench.faults.remainingCause(), QString());
    winch->slot()->bucket = 1;
    bench.remove(winch);
    QCOMPARE(bench.faults.remainingCause(), QString());  // it is not needed
}

void tst_MasterFaults::aLostCriticalNodeMustComeBack()
{
    FaultBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    winch->slot()->critical = true;
    QVERIFY(bench.start());
    bench.faults.nodeLeft(*winch->slot(), NodeSession::Running, false, "node 'Winch' has left");
    bench.remove(winch);
    bench.control.now = QPlcMasterNode::SafeStop;
    QCOMPARE(bench.faults.remainingCause(), QString("node 'Winch' is not back; start it again"));
    const auto viewer = bench.add("Winch", Answers::Later, "", "sum", true);
    QCOMPARE(bench.faults.remainingCause(), QString("node 'Winch' is not back; start it again"));
    bench.remove(viewer);
    bench.add("Winch", Answers::Later, "sum");
    QCOMPARE(bench.faults.remainingCause(), QString());
}

void tst_MasterFaults::aNodeThatTrippedIsNeededOnlyIfItWasSafe_data()
{
    QTest::addColumn<int>("kind");
    QTest::addColumn<QString>("cause");
    QTest::newRow("safe") << int(CycleEvent::TrippedBySafeNode) << "node 'Winch' is not back; start it again";
    QTest::newRow("failed") << int(CycleEvent::TrippedByFailure) << "";
}

void tst_MasterFaults::aNodeThatTrippedIsNeededOnlyIfItWasSafe()
{
    QFETCH(int, kind);
    QFETCH(QString, cause);
    FaultBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    winch->slot()->critical = true;
    QVERIFY(bench.start());
    bench.faults.tripped(happened(CycleEvent::Kind(kind), winch), 0);
    bench.remove(winch);
    bench.control.now = QPlcMasterNode::SafeStop;
    QCOMPARE(bench.faults.remainingCause(), cause);
    bench.add("Winch", Answers::Later, "sum");
    QCOMPARE(bench.faults.remainingCause(), QString());
}

void tst_MasterFaults::theFirstFaultIsTheOneToRepair()
{
    FaultBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    const auto kite = bench.add("Kite", Answers::Later, "echo");
    QVERIFY(bench.start());
    bench.faults.tripped(happened(CycleEvent::TrippedByWait, winch), 0);
    bench.control.now = QPlcMasterNode::SafeStop;
    bench.faults.nodeFailed("Kite", true, "it threw");
    winch->slot()->bucket = kite->slot()->bucket = 1;
    QCOMPARE(bench.faults.remainingCause(), QString("node 'Winch' still answers late, or not at all"));
}

void tst_MasterFaults::aSafeStopByAPersonHasNoCause()
{
    FaultBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    QVERIFY(bench.start());
    bench.faults.tripped(happened(CycleEvent::TrippedByWait, winch), 0);
    winch->slot()->bucket = 1;
    bench.faults.safeStop("smoke");
    bench.control.now = QPlcMasterNode::SafeStop;
    QCOMPARE(bench.faults.remainingCause(), QString());
    bench.control.now = QPlcMasterNode::RealTime;
    bench.faults.tripped(happened(CycleEvent::TrippedByWait, winch), 0);
    bench.faults.tripped(happened(CycleEvent::TrippedByGap), 0);
    bench.control.now = QPlcMasterNode::SafeStop;
    QCOMPARE(bench.faults.remainingCause(), QString());
}

QTEST_GUILESS_MAIN(tst_MasterFaults)
#include "tst_MasterFaults.moc"
