// SPDX-License-Identifier: Apache-2.0
#include "Scenario.h"

#include <QtCore/QFile>
#include <QtCore/QLoggingCategory>
#include <QtCore/QProcess>
#include <QtCore/QTemporaryDir>
#include <QtTest/QTest>

#include <algorithm>

using namespace soak;

namespace {

constexpr int Seconds = 10;

const Scenario &scenarioNamed(const char *name)
{
    return *Scenario::named(QString::fromLatin1(name));
}

SimulatedRun runOf(const char *scenario, quint64 seed, int seconds = Seconds)
{
    return run(planOf(scenarioNamed(scenario), seconds, seed));
}

QString simulateProgram()
{
    return QCoreApplication::applicationDirPath() + QStringLiteral("/qtplc_simulate");
}

struct Outcome
{
    int code = -1;
    QByteArray output;  // of both channels
};

Outcome simulated(const QStringList &arguments)
{
    QProcess simulate;
    simulate.setProcessChannelMode(QProcess::MergedChannels);
    simulate.start(simulateProgram(), arguments);
    if (!simulate.waitForFinished(120'000))
        return {};
    return {simulate.exitCode(), simulate.readAllStandardOutput()};
}

QString writtenTo(const QTemporaryDir &folder, const QString &text)
{
    QFile file(folder.filePath(QStringLiteral("plan")));
    if (!file.open(QIODevice::WriteOnly) || file.write(text.toUtf8()) < 0)
        qFatal("cannot write %s", qPrintable(file.fileName()));
    return file.fileName();
}

}  // namespace

class tst_SimulatedSoak : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { QLoggingCategory::setFilterRules(QStringLiteral("qtplc.*=false")); }  // faults are to happen
    void allGatesPass_data();
    void allGatesPass();
    void sameSeedGivesSameTrafficInOtherProcess();
    void otherSeedGivesOtherPlan();
    void everyKindOfFaultHappensInSomeScenario();
    void gatesDetectLateReactionsOfThePlant();
    void faultsBeginWhenAllNodesCompute_data();
    void faultsBeginWhenAllNodesCompute();
    void processGatesAreNotJudged();
    void shrinkingKeepsTheFaultsThatMatter();
    void shrinkingGoesOnUntilNoFaultCanBeLeftOut();
    void shrinkingShortensTimes();
    void planIsReadAsItWasWritten_data();
    void planIsReadAsItWasWritten();
    void commentsAndEmptyLinesOfAPlanSayNothing();
    void aWrongPlanIsRefusedWithItsLine_data();
    void aWrongPlanIsRefusedWithItsLine();
    void aPlanFromAFileRunsAsItsSeed();
    void typingErrorsAreRefused_data();
    void typingErrorsAreRefused();
};

void tst_SimulatedSoak::allGatesPass_data()
{
    QTest::addColumn<QString>("name");
    for (const Scenario &scenario : Scenario::all())
        QTest::newRow(qPrintable(scenario.profile.name)) << scenario.profile.name;
}

void tst_SimulatedSoak::allGatesPass()
{
    QFETCH(QString, name);
    const SimulatedRun result = runOf(qPrintable(name), 3, 2 * Seconds);  // an eviction lasts 6 s
    QVERIFY2(result.violation().isEmpty(), qPrintable(result.report.toText()));
    QVERIFY(result.report.evidence.faults.size() >= 5);
}

void tst_SimulatedSoak::sameSeedGivesSameTrafficInOtherProcess()
{
    QSet<QByteArray> digests;
    for (const char *hashSeed : {"4711", "815"}) {
        QProcess other;
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert(QStringLiteral("QT_HASH_SEED"), QString::fromLatin1(hashSeed));
        environment.insert(QStringLiteral("MALLOC_MMAP_THRESHOLD_"), QString::fromLatin1(hashSeed));  // other addresses
        other.setProcessEnvironment(environment);
        other.start(simulateProgram(),
                    {QStringLiteral("--scenario"), QStringLiteral("storm"), QStringLiteral("--seed"),
                     QStringLiteral("7"), QStringLiteral("--seconds"), QStringLiteral("20"),
                     QStringLiteral("--report")});
        QVERIFY(other.waitForFinished(120'000));
        const QByteArray output = other.readAllStandardOutput();
        const int place = output.indexOf("digest ");
        QVERIFY2(place >= 0, output.constData());
        digests.insert(output.mid(place, 23));
    }
    QCOMPARE(digests.size(), 1);
}

void tst_SimulatedSoak::otherSeedGivesOtherPlan()
{
    const auto textOf = [](quint64 seed) {
        return planOf(scenarioNamed("all"), Seconds, seed).toText().section(QLatin1Char('\n'), 3);
    };
    QCOMPARE(textOf(1), textOf(1));
    QVERIFY(textOf(1) != textOf(2));
}

void tst_SimulatedSoak::everyKindOfFaultHappensInSomeScenario()
{
    std::array<bool, FaultKinds> happens{};
    for (const Scenario &scenario : Scenario::all()) {
        for (const Fault &fault : planOf(scenario, 600, 1).faults)
            happens[std::size_t(fault.kind)] = true;
    }
    for (std::size_t kind = 0; kind < happens.size(); ++kind)
        QVERIFY2(happens[kind], FaultNames[kind]);
}

/// The same histories, judged as those of a plant that may hold a value for one cycle only.
void tst_SimulatedSoak::gatesDetectLateReactionsOfThePlant()
{
    SimulatedRun result = runOf("programs", 3);
    result.report.evidence.shape.hold = 1;
    QVERIFY(silentWritersBecomeSafe(result.report.evidence).failed > 0);
    QVERIFY(nodesAloneBecomeSafe(result.report.evidence).failed > 0);
}

void tst_SimulatedSoak::faultsBeginWhenAllNodesCompute_data()
{
    QTest::addColumn<int>("seed");
    for (const int seed : {3, 20, 22})
        QTest::addRow("%d", seed) << seed;
}

/// Losses can delay the control messages of a node that joins for seconds. It has registered then,
/// but a fault of it has no effect.
void tst_SimulatedSoak::faultsBeginWhenAllNodesCompute()
{
    QFETCH(int, seed);
    Fault losses;
    losses.kind = FaultKind::LoseOnRoads;
    losses.amount = 900;
    const std::vector<Fault> plan(20, losses);
    const Evidence evidence = run({&scenarioNamed("all"), quint64(seed), 60, plan}).report.evidence;
    QCOMPARE(evidence.faults.size(), plan.size());
    for (const DoneFault &fault : evidence.faults) {
        std::vector<bool> computes(std::size_t(evidence.shape.nodes));
        for (const History &life : evidence.nodes) {
            if (!recordsOf(life, Record::Step, life.node, fault.begin - 2 * evidence.period, fault.begin).empty())
                computes[std::size_t(life.node)] = true;
        }
        QVERIFY2(std::all_of(computes.begin(), computes.end(), [](bool does) { return does; }),
                 qPrintable(QStringLiteral("fault at %1 s").arg(double(fault.begin) * 1e-9)));
    }
}

void tst_SimulatedSoak::processGatesAreNotJudged()
{
    const SimulatedRun result = runOf("soak", 3);
    int found = 0;
    for (const Gate &gate : result.report.gates) {
        const bool isOfProcesses
            = gate.name == QLatin1String("nothing leaks") || gate.name == QLatin1String("memory stays");
        found += isOfProcesses && !gate.isAsked ? 1 : 0;
    }
    QCOMPARE(found, 2);
}

void tst_SimulatedSoak::shrinkingKeepsTheFaultsThatMatter()
{
    SimulatedPlan plan = planOf(scenarioNamed("all"), Seconds, 1);
    plan.faults.front().seed = plan.faults.back().seed = 815;
    const SimulatedPlan shortest = shrunk(plan, [](const SimulatedPlan &shorter) {
        return std::count_if(shorter.faults.begin(), shorter.faults.end(),
                             [](const Fault &fault) { return fault.seed == 815; })
            == 2;
    });
    QCOMPARE(shortest.faults.size(), std::size_t(2));
}

/// The last fault is needed while the one in front of it is there, which one look at each of them,
/// from the last to the first, does not see.
void tst_SimulatedSoak::shrinkingGoesOnUntilNoFaultCanBeLeftOut()
{
    const Scenario &scenario = scenarioNamed("all");
    const auto fault = [](FaultKind kind) {
        Fault made;
        made.kind = kind;
        return made;
    };
    const SimulatedPlan plan{
        &scenario, 1, 1, {fault(FaultKind::KillMaster), fault(FaultKind::KillNode), fault(FaultKind::StopNode)}};
    const SimulatedPlan shortest = shrunk(plan, [](const SimulatedPlan &shorter) {
        const auto has = [&](FaultKind kind) {
            return std::any_of(shorter.faults.begin(), shorter.faults.end(),
                               [kind](const Fault &one) { return one.kind == kind; });
        };
        return has(FaultKind::KillMaster) && (!has(FaultKind::KillNode) || has(FaultKind::StopNode));
    });
    QCOMPARE(shortest.faults.size(), std::size_t(1));
    QCOMPARE(shortest.faults.front().kind, FaultKind::KillMaster);
}

void tst_SimulatedSoak::shrinkingShortensTimes()
{
    Fault stop;
    stop.kind = FaultKind::StopNode;
    stop.node = 3;
    stop.amount = 800;
    stop.pause = 100;
    const SimulatedPlan plan{&scenarioNamed("storm"), 1, 60, {stop}};
    const SimulatedPlan shortest = shrunk(plan, [](const SimulatedPlan &shorter) {
        return !shorter.faults.empty() && shorter.faults.front().amount >= 190 && shorter.faults.front().pause >= 0
            && shorter.seconds >= 2;
    });
    QCOMPARE(shortest.faults.front().amount, 200);
    QCOMPARE(shortest.faults.front().pause, 0);
    QCOMPARE(shortest.seconds, 3);
}

void tst_SimulatedSoak::planIsReadAsItWasWritten_data()
{
    allGatesPass_data();
}

void tst_SimulatedSoak::planIsReadAsItWasWritten()
{
    QFETCH(QString, name);
    const SimulatedPlan plan = planOf(*Scenario::named(name), 300, 5);
    QString error;
    const auto read = SimulatedPlan::fromText(plan.toText(), &error);
    QVERIFY2(read, qPrintable(error));
    QCOMPARE(read->toText(), plan.toText());
    QCOMPARE(read->scenario, plan.scenario);
    QCOMPARE(read->seed, plan.seed);
    QCOMPARE(read->seconds, plan.seconds);
    QVERIFY(std::equal(read->faults.begin(), read->faults.end(), plan.faults.begin(), plan.faults.end(),
                       [](const Fault &a, const Fault &b) {
                           return a.kind == b.kind && a.node == b.node && a.amount == b.amount && a.seed == b.seed
                               && a.pause == b.pause;
                       }));
}

void tst_SimulatedSoak::commentsAndEmptyLinesOfAPlanSayNothing()
{
    QString error;
    const auto plan = SimulatedPlan::fromText("# why\n\nscenario all\r\n seed 3\n\n#\nseconds 4\n", &error);
    QVERIFY2(plan, qPrintable(error));
    QVERIFY(plan->faults.empty());
    QCOMPARE(plan->seconds, 4);
}

void tst_SimulatedSoak::aWrongPlanIsRefusedWithItsLine_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("error");
    const QString head = QStringLiteral("scenario all\nseed 1\nseconds 4\n");
    const auto row = [](const char *name, const QString &text, const char *error) {
        QTest::newRow(name) << text << QString::fromLatin1(error);
    };
    row("empty", "", "1: the plan has no line 'scenario NAME'");
    row("scenario missing", "seed 1\nseconds 4", "2: the plan has no line 'scenario NAME'");
    row("seed missing", "scenario all\nseconds 4", "2: the plan has no line 'seed N'");
    row("seconds missing", "scenario all\nseed 4", "2: the plan has no line 'seconds S'");
    row("unknown scenario", "scenario alle", "1: unknown scenario 'alle'; use soak, programs, ");
    row("two scenarios", "scenario all\nscenario storm", "2: a second scenario; a plan has one");
    row("two seeds", "seed 1\nseed 2", "2: a second line 'seed'; a plan has one");
    row("negative seed", "seed -1", "1: 'seed -1': use a whole number from 0 to ");
    row("no seconds", "seconds 0", "1: 'seconds 0': use a whole number from 1 to ");
    row("fault too early", "scenario all\nkill the master, 1, seed 2",
        "2: 'kill the master, 1, seed 2' before the scenario, the seed and the seconds");
    row("no fault", head + "kill", "4: 'kill' is not a fault; write it as \"stop a node (Node3), 300, seed 815\"");
    row("without seed", head + "kill the master, 1", "4: 'kill the master, 1' is not a fault");
    row("more behind it", head + "kill the master, 1, seed 2 and",
        "4: 'kill the master, 1, seed 2 and' is not a fault");
    row("unknown fault", head + "kill the cat, 1, seed 2", "4: unknown fault 'kill the cat'; use kill a node, stop a");
    row("node missing", head + "kill a node, 1, seed 2", "4: 'kill a node' needs a node from (Node0) to (Node11)");
    row("unknown node", head + "kill a node (Node12), 1, seed 2", "4: 'kill a node' needs a node from (Node0) to");
    row("node too much", head + "kill the master (Node1), 1, seed 2",
        "4: 'kill the master' is not of a single node; leave (Node1) out");
}

void tst_SimulatedSoak::aWrongPlanIsRefusedWithItsLine()
{
    QFETCH(QString, text);
    QFETCH(QString, error);
    QString found;
    QVERIFY(!SimulatedPlan::fromText(text, &found));
    QVERIFY2(found.startsWith(error), qPrintable(found));
    const QTemporaryDir folder;
    const QString file = writtenTo(folder, text);
    const auto [code, output] = simulated({QStringLiteral("--plan"), file});
    QCOMPARE(code, 2);
    QVERIFY2(output.contains((file + QLatin1Char(':') + error).toUtf8()), output.constData());
}

void tst_SimulatedSoak::aPlanFromAFileRunsAsItsSeed()
{
    const SimulatedPlan plan = planOf(scenarioNamed("storm"), Seconds, 7);
    const QTemporaryDir folder;
    const auto [code, output]
        = simulated({QStringLiteral("--plan"), writtenTo(folder, plan.toText()), QStringLiteral("--report")});
    QCOMPARE(code, 0);
    const QString digest = QString::number(run(plan).digest, 16).rightJustified(16, QLatin1Char('0'));
    QVERIFY2(output.contains("digest " + digest.toLatin1() + '\n'), output.constData());
    QVERIFY2(output.contains("the plan violates no gate"), output.constData());
}

/// They must not look like a run without violations.
void tst_SimulatedSoak::typingErrorsAreRefused_data()
{
    QTest::addColumn<QStringList>("arguments");
    for (const char *arguments : {"--seeds 0", "--seeds -1", "--seed abc", "--seconds 1.5", "--scenario nobody", "7",
                                  "--nonsense", "--seed", "--plan /nowhere/plan", "--plan /dev/null --seed 1"})
        QTest::newRow(arguments) << QString::fromLatin1(arguments).split(QLatin1Char(' '));
}

void tst_SimulatedSoak::typingErrorsAreRefused()
{
    QFETCH(QStringList, arguments);
    const auto [code, output] = simulated(arguments);
    QCOMPARE(code, 2);
    QVERIFY(!output.isEmpty());
}

QTEST_GUILESS_MAIN(tst_SimulatedSoak)
#include "tst_SimulatedSoak.moc"
