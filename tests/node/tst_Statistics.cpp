// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedNode.h"
#include "node/statistics/StatisticSignals.h"

// The statistics of master and nodes as their users see them: API, control channel, signals.
class tst_Statistics : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void nodesOverTheNetworkAndInTheProcessAreMeasured();
    void slaveMeasuresItself();
    void localSlaveHasNoStatisticsOfItsOwn();
    void everyFaultOfAnAnswerHasItsCounter();
    void aCycleWithoutTwoAnswersIsIncompleteOnce();
    void statisticsOverTheWireAreThoseOfTheApi_data();
    void statisticsOverTheWireAreThoseOfTheApi();
    void statisticsBeforeTheFirstPhaseAreEmpty();
    void lockstepHasNoDurationsAndItsDigestDoesNotDependOnSignals();
    void figuresAreWrittenIntoSignals();
    void signalsAreUpdatedWhileCyclesRun();
    void unfitStatisticSignalsAreRefused();
    void numbersOutOfRangeAreSaturated_data();
    void numbersOutOfRangeAreSaturated();
    void policyStopEndsThePhaseWithAnError();
    void unfitPolicyIsRefused();
    void policyCatchUpComputesEveryCycle();
};

namespace {

QPlcSignalTable statisticsTable()
{
    return QPlcSignalTable::fromIni(testTable().toIni() + R"(
[lateness99]
type = Real64
[overruns]
type = UInt8
[echoSlack]
type = Real32
[echoAnswers]
type = Int64
)");
}

void spin(qint64 nanoseconds)
{
    QElapsedTimer timer;
    timer.start();
    while (timer.nsecsElapsed() < nanoseconds) {}
}

/// Equal up to what a JSON number holds.
bool isEqual(const QJsonObject &fields, const QPlcDistribution &figures)
{
    const QJsonArray bins = fields.value("bins").toArray();
    for (int i = 0; i < bins.size(); ++i) {
        if (bins.at(i).toArray().at(0).toDouble() != double(figures.bins.at(i).upperBorder)
            || bins.at(i).toArray().at(1).toDouble() != double(figures.bins.at(i).count))
            return false;
    }
    return bins.size() == figures.bins.size() && fields.value("count").toDouble(-1) == double(figures.count)
        && fields.value("minimum").toDouble(-1) == double(figures.minimum)
        && fields.value("mean").toDouble(-1) == figures.mean
        && fields.value("p001").toDouble(-1) == double(figures.p001)
        && fields.value("p01").toDouble(-1) == double(figures.p01)
        && fields.value("p50").toDouble(-1) == double(figures.p50)
        && fields.value("p99").toDouble(-1) == double(figures.p99)
        && fields.value("p999").toDouble(-1) == double(figures.p999)
        && fields.value("maximum").toDouble(-1) == double(figures.maximum);
}

bool isEqual(const QJsonValue &fields, const QPlcDurationStatistics &duration)
{
    return fields.toObject().size() == 2 && isEqual(fields["sinceStart"].toObject(), duration.sinceStart)
        && isEqual(fields["last10s"].toObject(), duration.last10s);
}

}  // namespace

void tst_Statistics::nodesOverTheNetworkAndInTheProcessAreMeasured()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.002);
    CounterNode counter;
    EchoNode echo;
    echo.onStep = [](const QPlcCycle &) { spin(510'000); };       // an answer tells it in steps of 128 ns
    QVERIFY(echo.activateWatchdog(std::chrono::nanoseconds(0)));  // a node in its safe state computes nothing
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.listen());
    QVERIFY(echo.connectToMasterAndWaitForConnected(master.protocol("udp")));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(100));
    master.stop();
    const QPlcCycleStatistics found = master.cycleStatistics();
    QCOMPARE(found.cycles, master.statistics().cycles);
    for (const QPlcDurationStatistics &duration : {found.lateness, found.execution, found.slack}) {
        QCOMPARE(duration.sinceStart.count, found.cycles);
        QVERIFY(duration.sinceStart.bins.isEmpty());
    }
    QVERIFY(found.execution.sinceStart.minimum > 0);
    QVERIFY(found.roundTrip.sinceStart.count > 0);
    QCOMPARE(found.nodes.size(), 2);
    const QPlcNodeStatistics &local = found.nodes.at(0);
    const QPlcNodeStatistics &remote = found.nodes.at(1);
    QCOMPARE(local.name, QString("Counter"));
    QCOMPARE(local.answers, found.cycles);
    QCOMPARE(local.execution.sinceStart.count, found.cycles);
    QCOMPARE(local.roundTrip.sinceStart.count, quint64(0));
    QCOMPARE(remote.name, QString("Echo"));
    QVERIFY(remote.answers > 0 && remote.answers <= found.cycles);
    QCOMPARE(remote.roundTrip.sinceStart.count, remote.answers);
    QCOMPARE(remote.execution.sinceStart.count, remote.answers);
    QVERIFY(remote.roundTrip.sinceStart.minimum > remote.execution.sinceStart.minimum);
    QVERIFY(remote.execution.sinceStart.minimum >= 500'000);
    QVERIFY(found.execution.sinceStart.p50 < 500'000);  // the master waited for that and computed nothing
    QCOMPARE(found.worst.size(), 16);
    for (const QPlcWorstCycle &worst : found.worst) {
        qint64 whole = 0;
        for (const QPlcWorstCycle::Stage &stage : worst.stages)
            whole += stage.duration;
        QVERIFY(whole >= worst.execution && whole >= worst.roundTrip);
    }
    echo.disconnectFromMaster();
}

void tst_Statistics::slaveMeasuresItself()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.002);
    EchoNode echo;
    QVERIFY(master.listen());
    QVERIFY(echo.connectToMasterAndWaitForConnected(master.protocol("udp")));
    QVERIFY(master.startRealTime());
    QTRY_VERIFY(echo.counters().cycles >= 50);
    master.stop();
    QTRY_COMPARE(echo.state(), QPlcSlaveNode::Off);
    const QPlcSlaveStatistics found = echo.statistics(QPlcDistribution::WithBins);
    const quint64 cycles = echo.counters().cycles;
    QCOMPARE(found.execution.sinceStart.count, cycles);
    QCOMPARE(found.response.sinceStart.count, cycles);
    QCOMPARE(found.slack.sinceStart.count, cycles);
    QCOMPARE(found.interval.sinceStart.count, cycles - 1);
    QVERIFY(found.response.sinceStart.minimum > found.execution.sinceStart.minimum);
    QVERIFY(!found.response.last10s.bins.isEmpty());
    // The intervals add up to the time between the first and the last frame.
    const double total = found.interval.sinceStart.mean * double(cycles - 1);
    QVERIFY(total > double(cycles - 2) * 2e6 * 0.9);
    echo.disconnectFromMaster();
}

void tst_Statistics::localSlaveHasNoStatisticsOfItsOwn()
{
    TestMaster master(QPlcClock::realTime());
    EchoNode echo;
    QVERIFY(master.addLocalNode(&echo));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(3));
    master.stop();
    QCOMPARE(echo.statistics().execution.sinceStart.count, quint64(0));
    QVERIFY(master.cycleStatistics().nodes.at(0).execution.sinceStart.count >= 3);
}

void tst_Statistics::everyFaultOfAnAnswerHasItsCounter()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.01);
    QVERIFY(master.listen());
    ScriptedNode node;
    node.policy = "SilentZeroOrderHold";
    QVERIFY(node.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QVERIFY(node.waitForRequests(6));
    const quint64 newest = node.requests.at(5).cycle;
    node.answer(node.requests.at(1).cycle, 1.0);  // late, but new; the one before is lost
    node.answer(newest, 2.0);                     // those between are lost
    node.answer(newest, 2.0);                     // again
    node.answer(node.requests.at(2).cycle, 3.0);  // after a newer one
    node.sendFrame("garbage that is no frame");
    const auto found = [&] { return master.cycleStatistics().nodes.at(0); };
    QTRY_COMPARE(found().rejected, quint64(1));
    QCOMPARE(found().answers, quint64(2));
    QCOMPARE(found().duplicated, quint64(1));
    QCOMPARE(found().reordered, quint64(1));
    QTRY_COMPARE(found().roundTrip.sinceStart.count, quint64(2));
    QCOMPARE(found().lost, quint64(4));
    QVERIFY(found().late >= 4);
    QVERIFY(found().late >= found().lost);
    QCOMPARE(master.nodes().at(0).duplicates, quint64(2));
    master.stop();
}

void tst_Statistics::aCycleWithoutTwoAnswersIsIncompleteOnce()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.005);
    QVERIFY(master.listen());
    ScriptedNode first;  // neither of them ever answers
    ScriptedNode second;
    second.name = "Second";
    second.outputs.clear();
    second.initialValues.clear();
    for (ScriptedNode *node : {&first, &second})
        node->policy = "SilentZeroOrderHold";
    QVERIFY(first.registerAt(master.serverPort()));
    QVERIFY(second.registerAt(master.serverPort()));
    master.setCycleLimit(10);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    const QPlcMasterStatistics found = master.statistics();
    QVERIFY(found.cycles > 0);
    QCOMPARE(found.lateAnswers, 2 * found.cycles);
    QCOMPARE(found.incompleteCycles, found.cycles);
    QCOMPARE(master.cycleStatistics().incompleteCycles, found.cycles);
}

void tst_Statistics::statisticsOverTheWireAreThoseOfTheApi_data()
{
    QTest::addColumn<bool>("histograms");
    QTest::newRow("figures") << false;
    QTest::newRow("with histograms") << true;
}

void tst_Statistics::statisticsOverTheWireAreThoseOfTheApi()
{
    QFETCH(bool, histograms);
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.001);
    CounterNode counter;
    EchoNode echo;
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.listen());
    QVERIFY(echo.connectToMasterAndWaitForConnected(master.protocol("tcp")));
    ScriptedTool tool;
    QVERIFY(tool.greetAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(100));
    master.stop();
    tool.forgetMessages();
    const QPlcMessage message = histograms ? tool.ask(QPlcMessage::GetStatistics, {{"histograms", true}})
                                           : tool.ask(QPlcMessage::GetStatistics);
    QCOMPARE(message.kind(), QPlcMessage::Statistics);
    const QPlcCycleStatistics api
        = master.cycleStatistics(histograms ? QPlcDistribution::WithBins : QPlcDistribution::FiguresOnly);

    const QJsonValue of = message.fields().value("master");
    QVERIFY(isEqual(of["lateness"], api.lateness));
    QVERIFY(isEqual(of["execution"], api.execution));
    QVERIFY(isEqual(of["roundTrip"], api.roundTrip));
    QVERIFY(isEqual(of["slack"], api.slack));
    QCOMPARE(of["counters"].toObject(),
             (QJsonObject{{"cycles", double(api.cycles)},
                          {"overruns", double(api.overruns)},
                          {"skippedCycles", double(api.skippedCycles)},
                          {"caughtUpCycles", double(api.caughtUpCycles)},
                          {"shiftedTime", double(api.shiftedTime)},
                          {"lateAnswers", double(api.lateAnswers)},
                          {"incompleteCycles", double(api.incompleteCycles)},
                          {"strangers", double(api.strangers)},
                          {"floods", double(api.floods)}}));
    const QJsonArray nodes = message.fields().value("nodes").toArray();
    QCOMPARE(nodes.size(), 2);
    for (int i = 0; i < 2; ++i) {
        const QPlcNodeStatistics &node = api.nodes.at(i);
        QCOMPARE(nodes.at(i)["name"].toString(), node.name);
        QVERIFY(isEqual(nodes.at(i)["execution"], node.execution));
        QVERIFY(isEqual(nodes.at(i)["roundTrip"], node.roundTrip));
        QVERIFY(isEqual(nodes.at(i)["slack"], node.slack));
        QCOMPARE(nodes.at(i)["counters"].toObject(),
                 (QJsonObject{{"answers", double(node.answers)},
                              {"late", double(node.late)},
                              {"lost", double(node.lost)},
                              {"duplicated", double(node.duplicated)},
                              {"reordered", double(node.reordered)},
                              {"rejected", double(node.rejected)},
                              {"forged", double(node.forged)},
                              {"resent", double(node.resent)},
                              {"nonFinite", double(node.nonFinite)},
                              {"outOfRange", double(node.outOfRange)}}));
    }
    const QJsonArray worst = message.fields().value("worst").toArray();
    QCOMPARE(worst.size(), api.worst.size());
    QCOMPARE(worst.size(), 16);
    for (int i = 0; i < worst.size(); ++i) {
        const QPlcWorstCycle &cycle = api.worst.at(i);
        QJsonArray stages;
        for (const QPlcWorstCycle::Stage &stage : cycle.stages)
            stages << QJsonObject{{"name", stage.name}, {"duration", double(stage.duration)}};
        QCOMPARE(worst.at(i).toObject(),
                 (QJsonObject{{"cycle", double(cycle.cycle)},
                              {"skipped", double(cycle.skipped)},
                              {"lateness", double(cycle.lateness)},
                              {"roundTrip", double(cycle.roundTrip)},
                              {"execution", double(cycle.execution)},
                              {"slack", double(cycle.slack)},
                              {"stages", stages}}));
    }
    echo.disconnectFromMaster();
}

void tst_Statistics::statisticsBeforeTheFirstPhaseAreEmpty()
{
    QCOMPARE(QPlcMasterNode().cycleStatistics().cycles, quint64(0));
    QCOMPARE(EchoNode().statistics().response.sinceStart.count, quint64(0));
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedTool tool;
    QVERIFY(tool.greetAt(master.serverPort()));
    const QPlcMessage message = tool.ask(QPlcMessage::GetStatistics);
    QCOMPARE(message.kind(), QPlcMessage::Statistics);
    QCOMPARE(message.fields().value("worst").toArray(), QJsonArray());
    QCOMPARE(message.fields().value("nodes").toArray(), QJsonArray());
    QVERIFY(isEqual(message.fields().value("master")["lateness"], QPlcDurationStatistics()));
}

void tst_Statistics::lockstepHasNoDurationsAndItsDigestDoesNotDependOnSignals()
{
    QVector<quint64> digests;
    for (int run = 0; run < 2; ++run) {
        TestMaster master(QPlcClock::lockstep(), statisticsTable());
        EchoNode echo;
        CounterNode counter;
        QVERIFY(master.addLocalNode(&counter));
        QVERIFY(master.listen());
        QVERIFY(echo.connectToMasterAndWaitForConnected(master.protocol("udp")));
        QVERIFY(master.activateStatisticSignal(QPlcStatisticFigure(), "lateness99"));
        QVERIFY(master.activateStatisticSignal(QPlcStatisticFigure::Answers, "echoAnswers", "Echo"));
        if (run == 1) {  // a phase in real time before leaves nothing behind
            master.setClock(QPlcClock::realTime());
            QVERIFY(master.startRealTime());
            QVERIFY(master.waitForCycles(5));
            master.stop();
            QVERIFY(master.signalValue("echoAnswers").toReal() > 0.0);
            master.setClock(QPlcClock::lockstep());
        }
        master.setCycleLimit(500);
        QVERIFY(master.startRealTime());
        QVERIFY(master.waitForState(QPlcMasterNode::Off));
        digests << master.statistics().imageDigest;
        const QPlcCycleStatistics found = master.cycleStatistics();
        QCOMPARE(found.cycles, quint64(500));
        QCOMPARE(found.overruns, quint64(0));
        QCOMPARE(found.lateness.sinceStart.count, quint64(0));
        QCOMPARE(found.roundTrip.last10s.count, quint64(0));
        QCOMPARE(found.nodes.at(0).execution.sinceStart.count, quint64(0));
        QCOMPARE(found.nodes.at(1).roundTrip.sinceStart.count, quint64(0));
        QCOMPARE(found.nodes.at(1).answers, quint64(500));
        QVERIFY(found.worst.isEmpty());
        QCOMPARE(echo.statistics().response.sinceStart.count, quint64(0));
        QCOMPARE(master.signalValue("echoAnswers").toReal(), 0.0);
        echo.disconnectFromMaster();
    }
    QCOMPARE(digests.at(0), digests.at(1));
}

void tst_Statistics::figuresAreWrittenIntoSignals()
{
    TestMaster master(QPlcClock::realTime(), statisticsTable());
    master.setInterval(0.001);
    EchoNode echo;
    QVERIFY(master.addLocalNode(&echo));
    QVERIFY(master.activateStatisticSignal(
        {QPlcStatisticFigure::Lateness, QPlcStatisticFigure::P99, QPlcStatisticFigure::SinceStart}, "lateness99"));
    QVERIFY(master.activateStatisticSignal(QPlcStatisticFigure::Overruns, "overruns"));
    QVERIFY(master.activateStatisticSignal(
        {QPlcStatisticFigure::Slack, QPlcStatisticFigure::Minimum, QPlcStatisticFigure::SinceStart}, "echoSlack",
        "Echo"));
    QVERIFY(master.activateStatisticSignal(QPlcStatisticFigure::Answers, "echoAnswers", "Echo"));
    QCOMPARE(master.writer("lateness99"), QString("Master"));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(20));
    master.stop();
    const QPlcCycleStatistics found = master.cycleStatistics();
    QCOMPARE(master.signalValue("lateness99").toReal(), double(found.lateness.sinceStart.p99) * 1e-9);
    QCOMPARE(master.signalValue("overruns").toReal(), double(std::min<quint64>(found.overruns, 255)));
    QCOMPARE(float(master.signalValue("echoSlack").toReal()),
             float(double(found.nodes.at(0).slack.sinceStart.minimum) * 1e-9));
    QCOMPARE(master.signalValue("echoAnswers").toReal(), double(found.cycles));
}

void tst_Statistics::signalsAreUpdatedWhileCyclesRun()
{
    TestMaster master(QPlcClock::realTime(), statisticsTable());
    EchoNode echo;
    QVERIFY(master.addLocalNode(&echo));
    QVERIFY(master.activateStatisticSignal(QPlcStatisticFigure::Answers, "echoAnswers", "Echo"));
    QVERIFY(master.activateStatisticSignal(QPlcStatisticFigure::Lost, "overruns", "Nobody"));
    QVERIFY(master.startRealTime());
    QTRY_VERIFY(master.signalValue("echoAnswers").toReal() > 0.0);
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    QCOMPARE(master.signalValue("overruns").toReal(), 0.0);
    master.stop();
}

void tst_Statistics::unfitStatisticSignalsAreRefused()
{
    TestMaster master(QPlcClock::realTime(), statisticsTable());
    const auto refusal = [&](QPlcStatisticFigure figure, const char *signal, const char *node = "") {
        return master.activateStatisticSignal(figure, signal, node) ? QString() : master.errorString();
    };
    QVERIFY(refusal(QPlcStatisticFigure::Lateness, "latness99").contains("'lateness99'"));
    QVERIFY(refusal(QPlcStatisticFigure::Lateness, "echoAnswers").contains("'echoAnswers' is Int64; give it the type"));
    QVERIFY(refusal(QPlcStatisticFigure::Overruns, "vector").contains("'vector'"));
    QVERIFY(refusal(QPlcStatisticFigure::Overruns, "time").contains("'time'"));
    QVERIFY(refusal(QPlcStatisticFigure::Lateness, "lateness99", "Echo").contains("leave out 'Echo'"));
    QVERIFY(refusal(QPlcStatisticFigure::Lost, "overruns").contains("give its name"));
    QCOMPARE(refusal(QPlcStatisticFigure::Overruns, "overruns"), QString());
    QVERIFY(refusal(QPlcStatisticFigure::Cycles, "overruns").contains("'Master' already"));
    QCOMPARE(master.error(), QPlcMasterNode::SignalError);
}

void tst_Statistics::numbersOutOfRangeAreSaturated_data()
{
    QTest::addColumn<QString>("type");
    QTest::addColumn<double>("number");
    QTest::addColumn<QString>("value");
    QTest::newRow("fits") << "UInt8" << 255.0 << "255";
    QTest::newRow("too large for a byte") << "UInt8" << 256.0 << "255";
    QTest::newRow("too large, signed") << "Int8" << 128.0 << "127";
    QTest::newRow("32 bits") << "Int32" << 1e12 << "2147483647";
    QTest::newRow("64 bits") << "UInt64" << 1e30 << "18446744073709551615";
    QTest::newRow("64 bits, signed") << "Int64" << 1e30 << "9223372036854775807";
    QTest::newRow("negative") << "Int16" << -5.0 << "0";
    QTest::newRow("real") << "Real64" << 0.25 << "0.25";
}

void tst_Statistics::numbersOutOfRangeAreSaturated()
{
    QFETCH(QString, type);
    QFETCH(double, number);
    const QPlcValue value = qplc::nearestValue(QPlcSignalType::fromName(type), number);
    QCOMPARE(value.type().name(), type);
    QTEST(value.toString(), "value");
}

void tst_Statistics::policyStopEndsThePhaseWithAnError()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.001);
    QVERIFY(master.setOverrunPolicy(QPlcOverrunPolicy::stop()));
    QCOMPARE(master.overrunPolicy(), QPlcOverrunPolicy::stop());
    CounterNode counter;
    counter.onStep = [](const QPlcCycle &cycle) { spin(cycle.number() == 7 ? 20'000'000 : 0); };
    QVERIFY(master.addLocalNode(&counter));
    LogCapture log;
    QSignalSpy errors(&master, &QPlcMasterNode::errorOccurred);
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(errors.size(), 1);
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    QCOMPARE(master.error(), QPlcMasterNode::RealTimeError);
    QVERIFY2(
        QRegularExpression("^cycle \\d+ could begin only \\d+\\.\\d{3} ms after its time, and a period is 1.000 ms")
            .match(master.errorString())
            .hasMatch(),
        qPrintable(master.errorString()));
    QVERIFY(counter.lastCycle <= 7);  // or the machine itself was late before
    QCOMPARE(log.matching("overrun policy 'stop'").size(), 1);
    QVERIFY(master.startRealTime());  // again, by a person
    master.stop();
}

void tst_Statistics::unfitPolicyIsRefused()
{
    TestMaster master;
    QVERIFY(!master.setOverrunPolicy(QPlcOverrunPolicy::catchUp(0)));
    QVERIFY2(master.errorString().contains("use 1 ... 1000000"), qPrintable(master.errorString()));
    QCOMPARE(master.overrunPolicy(), QPlcOverrunPolicy::skipToGrid());
}

void tst_Statistics::policyCatchUpComputesEveryCycle()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.001);
    QVERIFY(master.setOverrunPolicy(QPlcOverrunPolicy::catchUp(100'000)));
    CounterNode counter;
    EchoNode echo;  // over the network: has to get the time for its answers also while cycles are caught up
    counter.onStep = [](const QPlcCycle &cycle) { spin(cycle.number() == 7 ? 20'000'000 : 0); };
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.listen());
    QVERIFY(echo.connectToMasterAndWaitForConnected(master.protocol("tcp")));
    LogCapture log;
    master.setCycleLimit(200);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    const QPlcCycleStatistics found = master.cycleStatistics();
    QCOMPARE(found.cycles, quint64(200));
    QCOMPARE(found.skippedCycles, quint64(0));
    QVERIFY(found.caughtUpCycles >= 18);
    QVERIFY(found.overruns >= 1);
    QVERIFY(found.nodes.at(1).answers > 100);
    QVERIFY(found.lateness.sinceStart.maximum >= 18'000'000);
    echo.disconnectFromMaster();
}

QTEST_GUILESS_MAIN(tst_Statistics)
#include "tst_Statistics.moc"
