// SPDX-License-Identifier: Apache-2.0
#include "SequenceFixtures.h"

using qplc::MasterEvent;
using qplc::NodeSession;
using Answers = NodeSession::Answers;

// The sequences of a master with scripted sessions: who is asked what, in which order, and how each
// of them can end.
class tst_Sequences : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    // initialize
    void nodesGetTheirInputsWhenAllHaveGivenTheirOutputs();
    void nodesThatAnswerImmediatelyAreAskedLast();
    void aNodeWithoutAnAnswerIsNamedAndDropped();
    void outputsOfTheWrongSizeDropTheirNode();
    void outputsThatAreNotFiniteEndTheInitialization();
    void aFaultOfANodeEndsTheInitialization_data();
    void aFaultOfANodeEndsTheInitialization();
    void nodeMayCancelTheInitializationInItsHandler();
    void cancelledInitializationStopsAllNodes();
    void aNodeThatLeavesIsNotWaitedFor();
    // start
    void cyclesStartWhenAllNodesAreReady();
    void faultOfANodeEndsTheStart();
    void nodeMayEndTheStartWhileTheOthersAreAsked();
    void missingThreadEndsTheStart();
    void nodesAreNotNotifiedOfEndedCycles();
    void nobodyHearsTwiceOfCyclesThatWereStartedAnew();
    void aNodeThatCameDuringTheStartJoinsAfterwards();
    void noNodeJoinsAnEndedPhase();
    // join
    void listenersAndNodesDoNotWaitForEachOther();
    void aListenerIsStartedWithTheOthers();
    void aNodeJoinsAtItsOwnPace();
    void returningNodeMayContinueInASimulation_data();
    void returningNodeMayContinueInASimulation();
    void aNodeThatJoinsAgainHasNotFailed();
    void wrongOutputsOfAJoinerDropIt();
    void aSilentJoinerIsDropped();
    void answersOfAJoinerGiveItNewTime();
    void theTimeOfJoinersIsNotThatOfAStart();
    // stop
    void cancelledSequenceIsReportedToItsNodes_data();
    void cancelledSequenceIsReportedToItsNodes();
    void phaseEndIsReportedToAllNodes();
    void nodesMayLeaveDuringTheEndOfAPhase();
};

void tst_Sequences::nodesGetTheirInputsWhenAllHaveGivenTheirOutputs()
{
    SequenceBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum", "echo");
    const auto kite = bench.add("Kite", Answers::Later, "echo", "sum");
    QSignalSpy told(&bench.initialization, &qplc::InitializeSequence::statesInitialized);
    QSignalSpy done(&bench.initialization, &qplc::InitializeSequence::done);
    bench.initialization.begin();
    QCOMPARE(bench.takeLog(), QStringList({"Winch askOutputs", "Kite askOutputs"}));
    bench.initialization.handleAnswer(*winch, bench.bytes("sum", 3.0));
    QCOMPARE(bench.takeLog(), QStringList());
    bench.initialization.handleAnswer(*kite, bench.bytes("echo", 4.0));
    QCOMPARE(bench.takeLog(), QStringList({"Winch giveInputs", "Kite giveInputs"}));
    QCOMPARE(winch->lastInputs, bench.bytes("echo", 4.0));
    QCOMPARE(kite->lastInputs, bench.bytes("sum", 3.0));
    bench.initialization.handleAnswer(*kite, {});
    QVERIFY(bench.timer.isRunning());
    QCOMPARE(done.size(), 0);
    bench.initialization.handleAnswer(*winch, {});
    QCOMPARE(bench.takeLog(), QStringList("all: initialized"));
    QCOMPARE(told.size(), 1);
    QCOMPARE(done.size(), 1);
    QVERIFY(!bench.step.isUnderWay() && !bench.timer.isRunning());
    QCOMPARE(winch->stage(), NodeSession::Initialized);
}

void tst_Sequences::nodesThatAnswerImmediatelyAreAskedLast()
{
    SequenceBench bench;
    bench.add("Local", Answers::AtOnce, "sum");
    const auto remote = bench.add("Remote", Answers::Later, "echo");
    bench.initialization.begin();
    QCOMPARE(bench.takeLog(), QStringList({"Remote askOutputs", "Local askOutputs"}));
    bench.initialization.handleAnswer(*remote, remote->outputs);
    QCOMPARE(bench.takeLog(), QStringList({"Remote giveInputs", "Local giveInputs"}));
    bench.initialization.handleAnswer(*remote, {});
    QCOMPARE(bench.takeLog(), QStringList("all: initialized"));
}

void tst_Sequences::aNodeWithoutAnAnswerIsNamedAndDropped()
{
    SequenceBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    bench.add("Kite", Answers::Later, "echo");
    bench.add("Tower", Answers::Later, "setpoint");
    bench.initialization.begin();
    bench.initialization.handleAnswer(*winch, winch->outputs);
    bench.takeLog();
    bench.timer.elapse();
    const QString text = "no answer to SendYourInitialOutputStates within 2000 ms from node 'Kite', 'Tower'; is it "
                         "busy, or stopped?";
    QCOMPARE(bench.takeLog(),
             QStringList({"master SequenceFailed: " + text, "Kite drop: " + text, "Tower drop: " + text}));
}

void tst_Sequences::outputsOfTheWrongSizeDropTheirNode()
{
    SequenceBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    bench.initialization.begin();
    bench.takeLog();
    bench.initialization.handleAnswer(*winch, QByteArray(3, 0));
    QCOMPARE(bench.takeLog(), QStringList("Winch drop: it sent 3 bytes of initial outputs instead of 8"));
    QVERIFY(bench.step.isUnderWay());
}

void tst_Sequences::outputsThatAreNotFiniteEndTheInitialization()
{
    SequenceBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    bench.initialization.begin();
    bench.takeLog();
    bench.initialization.handleAnswer(*winch, bench.bytes("sum", qQNaN()));
    QCOMPARE(bench.log.size(), 1);
    QVERIFY2(bench.log.first().startsWith("master SequenceFailed: node 'Winch': the initial value of signal 'sum': "),
             qPrintable(bench.log.first()));
}

void tst_Sequences::aFaultOfANodeEndsTheInitialization_data()
{
    QTest::addColumn<QString>("request");
    QTest::newRow("its initial state") << "askOutputs";
    QTest::newRow("its inputs") << "giveInputs";
}

void tst_Sequences::aFaultOfANodeEndsTheInitialization()
{
    QFETCH(QString, request);
    SequenceBench bench;
    const auto winch = bench.add("Winch", Answers::AtOnce, "sum");
    bench.add("Kite", Answers::AtOnce, "echo");
    winch->heard = [&](const QString &what) {
        if (what == request)
            winch->fault = QStringLiteral("no paper in the printer");
    };
    bench.initialization.begin();
    const QStringList log = bench.takeLog();
    QCOMPARE(log.last(), QString("master SequenceFailed: node 'Winch': no paper in the printer"));
    QVERIFY(!log.contains("all: initialized"));
}

void tst_Sequences::nodeMayCancelTheInitializationInItsHandler()
{
    SequenceBench bench;
    const auto winch = bench.add("Winch", Answers::AtOnce, "sum");
    bench.add("Kite", Answers::AtOnce, "echo");
    winch->heard = [&](const QString &what) {
        if (what == "askOutputs")
            bench.stopping.cancel("the program has removed it");
    };
    bench.initialization.begin();
    QCOMPARE(bench.takeLog(),
             QStringList({"Winch askOutputs", "all: the program has removed it",
                          "Winch cancel initialization: the program has removed it",
                          "Kite cancel initialization: the program has removed it"}));
    QVERIFY(!bench.step.isUnderWay());
}

void tst_Sequences::cancelledInitializationStopsAllNodes()
{
    SequenceBench bench;
    bench.add("Winch", Answers::AtOnce, "sum");
    QSignalSpy done(&bench.initialization, &qplc::InitializeSequence::done);
    connect(&bench.initialization, &qplc::InitializeSequence::statesInitialized, &bench.initialization,
            [&] { bench.stopping.cancel("enough"); });
    bench.initialization.begin();
    QVERIFY(bench.log.contains("Winch cancel initialization: enough"));
    QCOMPARE(done.size(), 0);
}

void tst_Sequences::aNodeThatLeavesIsNotWaitedFor()
{
    SequenceBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    const auto tool = bench.add("Viewer", Answers::Later, "", "sum", true);
    bench.initialization.begin();
    QVERIFY(!bench.step.leave(*tool));
    QVERIFY(bench.step.leave(*winch));
    QVERIFY(!bench.step.leave(*winch));
    QVERIFY(bench.step.complete());
}

void tst_Sequences::cyclesStartWhenAllNodesAreReady()
{
    SequenceBench bench;
    bench.settings.interval = std::chrono::milliseconds(20);
    const auto remote = bench.add("Remote", Answers::Later, "echo");
    const auto local = bench.add("Local", Answers::AtOnce, "sum");
    remote->setStage(NodeSession::Initialized);
    local->setStage(NodeSession::Initialized);
    QSignalSpy started(&bench.starting, &qplc::StartSequence::realTimeHasStarted);
    bench.starting.begin();
    QCOMPARE(bench.takeLog(), QStringList({"Remote start", "Local start"}));
    QCOMPARE(remote->lastStart.period.count(), 20'000'000);
    QCOMPARE(quint64(remote->lastStart.cycleZero), quint64(1000));
    QCOMPARE(quint64(remote->lastStart.firstCycle), quint64(1000));
    QVERIFY(!bench.cycles.running);
    bench.starting.handleAnswer(*remote);
    QCOMPARE(
        bench.takeLog(),
        QStringList({"master CyclesStarted", "Remote cyclesStarted Simulation", "Local cyclesStarted Simulation"}));
    QVERIFY(bench.cycles.running && !bench.step.isUnderWay() && !bench.timer.isRunning());
    QCOMPARE(started.size(), 1);
    QCOMPARE(remote->stage(), NodeSession::Running);
}

void tst_Sequences::faultOfANodeEndsTheStart()
{
    SequenceBench bench;
    const auto winch = bench.add("Winch", Answers::AtOnce, "sum");
    winch->setStage(NodeSession::Initialized);
    winch->fault = QStringLiteral("no paper in the printer");
    bench.add("Kite", Answers::AtOnce, "echo")->setStage(NodeSession::Initialized);
    bench.starting.begin();
    QCOMPARE(bench.takeLog(),
             QStringList({"Winch start", "master SequenceFailed: node 'Winch': no paper in the printer"}));
    QVERIFY(!bench.cycles.running);
}

void tst_Sequences::nodeMayEndTheStartWhileTheOthersAreAsked()
{
    SequenceBench bench;
    const auto winch = bench.add("Winch", Answers::AtOnce, "sum");
    winch->setStage(NodeSession::Initialized);
    bench.add("Kite", Answers::AtOnce, "echo")->setStage(NodeSession::Initialized);
    winch->heard = [&](const QString &what) {
        if (what == "start")
            bench.stopping.cancel("the program has removed it");
    };
    bench.starting.begin();
    QVERIFY(!bench.log.contains("Kite start"));
    QVERIFY(!bench.cycles.running && !bench.step.isUnderWay());
}

void tst_Sequences::missingThreadEndsTheStart()
{
    SequenceBench bench;
    bench.cycles.threadError = QStringLiteral("no thread left");
    bench.add("Local", Answers::AtOnce, "sum")->setStage(NodeSession::Initialized);
    bench.master.heard = [&](MasterEvent) { bench.stopping.cancel("no thread left"); };
    QSignalSpy done(&bench.starting, &qplc::StartSequence::done);
    bench.starting.begin();
    QCOMPARE(bench.takeLog(),
             QStringList({"Local start", "master ThreadFailed: no thread left", "Local cancel start: no thread left"}));
    QCOMPARE(done.size(), 0);
}

void tst_Sequences::nodesAreNotNotifiedOfEndedCycles()
{
    SequenceBench bench;
    const auto winch = bench.add("Winch", Answers::AtOnce, "sum");
    const auto kite = bench.add("Kite", Answers::AtOnce, "echo");
    winch->setStage(NodeSession::Initialized);
    kite->setStage(NodeSession::Initialized);
    winch->heard = [&](const QString &what) {
        if (what.startsWith("cyclesStarted"))
            bench.cycles.running = false;
    };
    QSignalSpy started(&bench.starting, &qplc::StartSequence::realTimeHasStarted);
    bench.starting.begin();
    QCOMPARE(bench.takeLog(),
             QStringList({"Winch start", "Kite start", "master CyclesStarted", "Winch cyclesStarted Simulation"}));
    QCOMPARE(started.size(), 0);
}

void tst_Sequences::nobodyHearsTwiceOfCyclesThatWereStartedAnew()
{
    SequenceBench bench;
    const auto winch = bench.add("Winch", Answers::AtOnce, "sum");
    winch->setStage(NodeSession::Initialized);
    QSignalSpy started(&bench.starting, &qplc::StartSequence::realTimeHasStarted);
    bool isFirst = true;
    bench.master.heard = [&](MasterEvent event) {
        if (event != MasterEvent::CyclesStarted || !std::exchange(isFirst, false))
            return;
        winch->setStage(NodeSession::Initialized);  // the program has stopped the phase, and starts the next one
        bench.starting.begin();
    };
    bench.starting.begin();
    QCOMPARE(bench.takeLog(),
             QStringList({"Winch start", "master CyclesStarted", "Winch start", "master CyclesStarted",
                          "Winch cyclesStarted Simulation"}));
    QCOMPARE(started.size(), 1);
}

void tst_Sequences::aNodeThatCameDuringTheStartJoinsAfterwards()
{
    SequenceBench bench;
    const auto remote = bench.add("Remote", Answers::Later, "echo");
    remote->setStage(NodeSession::Initialized);
    bench.starting.begin();
    const auto late = bench.add("Late", Answers::Later, "sum");
    bench.takeLog();
    bench.starting.handleAnswer(*remote);
    QCOMPARE(bench.takeLog(),
             QStringList({"master CyclesStarted", "Remote cyclesStarted Simulation", "Late askOutputs"}));
    QCOMPARE(late->stage(), NodeSession::GivingOutputs);
}

void tst_Sequences::noNodeJoinsAnEndedPhase()
{
    SequenceBench bench;
    const auto remote = bench.add("Remote", Answers::Later, "echo");
    remote->setStage(NodeSession::Initialized);
    connect(&bench.starting, &qplc::StartSequence::realTimeHasStarted, &bench.starting, [&] {
        bench.cycles.running = false;
        bench.stopping.stop("enough");
    });
    bench.starting.begin();
    bench.starting.handleAnswer(*remote);
    QCOMPARE(bench.takeLog().last(), QString("Remote stop: enough"));
    QCOMPARE(remote->stage(), NodeSession::Idle);
}

void tst_Sequences::listenersAndNodesDoNotWaitForEachOther()
{
    SequenceBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    const auto viewer = bench.add("Viewer", Answers::Later, "", "sum", true);
    bench.initialization.begin();
    QCOMPARE(bench.takeLog(), QStringList({"Viewer askOutputs", "Winch askOutputs"}));
    bench.joining.handleAnswer(*viewer, {}, false);
    QCOMPARE(bench.takeLog(), QStringList());  // its inputs are not there yet
    bench.initialization.handleAnswer(*winch, bench.bytes("sum", 5.0));
    QCOMPARE(bench.takeLog(), QStringList({"Viewer giveInputs", "Winch giveInputs"}));
    QCOMPARE(viewer->lastInputs, bench.bytes("sum", 5.0));
    bench.initialization.handleAnswer(*winch, {});
    QCOMPARE(bench.takeLog(), QStringList("all: initialized"));
    bench.joining.handleAnswer(*viewer, {}, false);
    QCOMPARE(bench.takeLog(), QStringList());  // there is no start yet
    QCOMPARE(viewer->stage(), NodeSession::Initialized);
}

void tst_Sequences::aListenerIsStartedWithTheOthers()
{
    SequenceBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    const auto viewer = bench.add("Viewer", Answers::Later, "", "sum", true);
    const auto slow = bench.add("Slow", Answers::Later, "", "sum", true);
    winch->setStage(NodeSession::Initialized);
    viewer->setStage(NodeSession::Initialized);
    slow->setStage(NodeSession::Initializing);
    bench.starting.begin();
    QCOMPARE(bench.takeLog(), QStringList({"Winch start", "Viewer start"}));
    bench.joining.handleAnswer(*slow, {}, false);
    QCOMPARE(bench.takeLog(), QStringList("Slow start"));
    bench.starting.handleAnswer(*winch);
    QVERIFY(bench.cycles.running);
    QCOMPARE(bench.cycles.rosters, 0);
    bench.joining.handleAnswer(*viewer, {}, false);
    QCOMPARE(bench.cycles.rosters, 1);
    QCOMPARE(viewer->stage(), NodeSession::Running);
}

void tst_Sequences::aNodeJoinsAtItsOwnPace()
{
    SequenceBench bench;
    bench.cycles.running = true;
    bench.cycles.newest = 50;
    const auto winch = bench.add("Winch", Answers::Later, "sum", "echo");
    bench.joining.begin(*winch);
    bench.joining.handleAnswer(*winch, bench.bytes("sum", 2.0), false);
    bench.joining.handleAnswer(*winch, {}, false);
    QCOMPARE(bench.takeLog(), QStringList({"Winch askOutputs", "Winch giveInputs", "Winch start"}));
    QCOMPARE(quint64(winch->lastStart.firstCycle), quint64(1050));
    QCOMPARE(winch->slot()->initialOutputs.size(), std::size_t(8));
    QCOMPARE(bench.cycles.rosters, 0);
    bench.joining.handleAnswer(*winch, {}, false);
    QCOMPARE(bench.cycles.rosters, 1);
}

void tst_Sequences::returningNodeMayContinueInASimulation_data()
{
    QTest::addColumn<QPlcProfile::Value>("profile");
    QTest::addColumn<bool>("isAsked");
    QTest::newRow("simulation") << QPlcProfile::Simulation << true;
    QTest::newRow("plant") << QPlcProfile::Plant << false;
}

void tst_Sequences::returningNodeMayContinueInASimulation()
{
    QFETCH(QPlcProfile::Value, profile);
    QFETCH(bool, isAsked);
    SequenceBench bench;
    bench.facts.wanted = profile;
    bench.profile.fix();
    bench.cycles.running = true;
    bench.cycles.gone = QStringList{"Winch", "Kite"};
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    const auto kite = bench.add("Kite", Answers::Later, "echo");
    bench.joining.begin(*winch);
    bench.joining.begin(*kite);
    QCOMPARE(winch->lastPhase.has_value(), isAsked);
    QCOMPARE(winch->lastPhase.value_or(0), isAsked ? quint64(1000) : quint64(0));
    bench.joining.handleAnswer(*winch, winch->outputs, true);
    bench.joining.handleAnswer(*kite, kite->outputs, false);
    QVERIFY(bench.hasEvent("node Winch goes on where it was"));
    QVERIFY(bench.hasEvent("node Kite begins again at its initial state"));
    QVERIFY(winch->slot()->goesOn && !kite->slot()->goesOn);  // recordings tell it
}

void tst_Sequences::aNodeThatJoinsAgainHasNotFailed()
{
    SequenceBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    winch->setFailed(true);
    bench.joining.begin(*winch);
    QVERIFY(!winch->hasFailed());
}

void tst_Sequences::wrongOutputsOfAJoinerDropIt()
{
    SequenceBench bench;
    bench.cycles.running = true;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    bench.joining.begin(*winch);
    bench.joining.handleAnswer(*winch, bench.bytes("sum", qInf()), false);
    QVERIFY2(bench.log.last().startsWith("Winch drop: the initial value of signal 'sum': "),
             qPrintable(bench.log.last()));
    QCOMPARE(winch->stage(), NodeSession::GivingOutputs);
}

void tst_Sequences::aSilentJoinerIsDropped()
{
    SequenceBench bench;
    bench.cycles.running = true;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    bench.joining.begin(*winch);
    bench.joinTimer.elapse();  // it was asked somewhen during this time
    QCOMPARE(bench.takeLog(), QStringList("Winch askOutputs"));
    bench.joinTimer.elapse();
    QCOMPARE(bench.takeLog(),
             QStringList("Winch drop: no answer to SendYourInitialOutputStates within 2000 ms from node 'Winch'; "
                         "is it busy, or stopped?"));
    QVERIFY(!bench.joinTimer.isRunning());
}

void tst_Sequences::answersOfAJoinerGiveItNewTime()
{
    SequenceBench bench;
    bench.cycles.running = true;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    const auto viewer = bench.add("Viewer", Answers::Later, "", "sum", true);
    bench.joining.begin(*winch);
    bench.joining.begin(*viewer);
    bench.joinTimer.elapse();
    bench.joining.handleAnswer(*winch, bench.bytes("sum", 2.0), false);
    bench.joinTimer.elapse();
    QCOMPARE(bench.log.filter("drop").size(), 1);
    QVERIFY(bench.log.last().startsWith("Viewer drop"));
    bench.joining.handleAnswer(*winch, {}, false);
    bench.joining.handleAnswer(*winch, {}, false);
    QCOMPARE(winch->stage(), NodeSession::Running);
    viewer->setStage(NodeSession::Idle);  // it has left
    bench.joinTimer.elapse();
    QVERIFY(!bench.joinTimer.isRunning());
    QCOMPARE(bench.log.filter("drop").size(), 1);
}

void tst_Sequences::theTimeOfJoinersIsNotThatOfAStart()
{
    SequenceBench bench;
    bench.add("Winch", Answers::Later, "sum");
    bench.add("Viewer", Answers::Later, "", "sum", true);
    bench.initialization.begin();
    bench.joinTimer.elapse();
    bench.joinTimer.elapse();
    QCOMPARE(bench.log.filter("drop").size(), 1);
    QVERIFY(bench.log.filter("drop").first().startsWith("Viewer drop"));
}

void tst_Sequences::cancelledSequenceIsReportedToItsNodes_data()
{
    QTest::addColumn<bool>("isStart");
    QTest::newRow("initialization") << false;
    QTest::newRow("start") << true;
}

void tst_Sequences::cancelledSequenceIsReportedToItsNodes()
{
    QFETCH(bool, isStart);
    SequenceBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    if (isStart) {
        winch->setStage(NodeSession::Initialized);
        bench.starting.begin();
    } else {
        bench.initialization.begin();
    }
    bench.takeLog();
    bench.stopping.cancel("enough");
    QCOMPARE(bench.takeLog(),
             isStart ? QStringList("Winch cancel start: enough")
                     : QStringList({"all: enough", "Winch cancel initialization: enough"}));
    QVERIFY(!bench.step.isUnderWay() && !bench.timer.isRunning());
    QVERIFY(!winch->owes(QPlcMessage::ReceiveMyInitialOutputStates) && !winch->owes(QPlcMessage::RealTimeReady));
}

void tst_Sequences::phaseEndIsReportedToAllNodes()
{
    SequenceBench bench;
    bench.add("Winch", Answers::Later, "sum")->setStage(NodeSession::Running);
    bench.add("Joiner", Answers::Later, "echo")->setStage(NodeSession::Initializing);
    bench.add("Local", Answers::AtOnce, "setpoint")->setStage(NodeSession::Running);
    bench.stopping.makeSafe();
    QCOMPARE(bench.takeLog(), QStringList({"Winch tellSafe", "Joiner tellSafe", "Local tellSafe"}));
    bench.stopping.stop("enough");
    QCOMPARE(bench.takeLog(), QStringList({"Winch stop: enough", "Joiner stop: enough", "Local stop: enough"}));
}

void tst_Sequences::nodesMayLeaveDuringTheEndOfAPhase()
{
    SequenceBench bench;
    auto winch = bench.add("Winch", Answers::AtOnce, "sum");
    auto kite = bench.add("Kite", Answers::AtOnce, "echo");
    winch->heard = [&](const QString &) {
        bench.nodes.remove(*kite);
        kite.reset();
    };
    bench.stopping.stop("enough");
    QCOMPARE(bench.takeLog(), QStringList({"Winch stop: enough", "Kite stop: enough"}));
    QCOMPARE(bench.nodes.all().size(), std::size_t(1));
}

QTEST_GUILESS_MAIN(tst_Sequences)
#include "tst_Sequences.moc"
