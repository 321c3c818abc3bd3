// SPDX-License-Identifier: Apache-2.0
#include "Scenario.h"

#include <QtCore/QLoggingCategory>
#include <QtCore/QProcess>
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
    return run(scenarioNamed(scenario), seconds, seed, planOf(scenarioNamed(scenario), seconds, seed));
}

QString simulateProgram()
{
    return QCoreApplication::applicationDirPath() + QStringLiteral("/qtplc_simulate");
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
        QStringList lines;
        for (const Fault &fault : planOf(scenarioNamed("all"), Seconds, seed))
            lines << fault.toString();
        return lines;
    };
    QCOMPARE(textOf(1), textOf(1));
    QVERIFY(textOf(1) != textOf(2));
}

void tst_SimulatedSoak::everyKindOfFaultHappensInSomeScenario()
{
    std::array<bool, FaultKinds> happens{};
    for (const Scenario &scenario : Scenario::all()) {
        for (const Fault &fault : planOf(scenario, 600, 1))
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
    const Evidence evidence = run(scenarioNamed("all"), 60, quint64(seed), plan).report.evidence;
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
    std::vector<Fault> plan = planOf(scenarioNamed("all"), Seconds, 1);
    plan.front().amount = plan.back().amount = -1;
    const std::vector<Fault> shortest = shrunk(plan, [](const std::vector<Fault> &shorter) {
        return std::count_if(shorter.begin(), shorter.end(), [](const Fault &fault) { return fault.amount < 0; }) == 2;
    });
    QCOMPARE(shortest.size(), std::size_t(2));
}

/// They must not look like a run without violations.
void tst_SimulatedSoak::typingErrorsAreRefused_data()
{
    QTest::addColumn<QStringList>("arguments");
    for (const char *arguments : {"--seeds 0", "--seeds -1", "--seed abc", "--seconds 1.5", "--scenario nobody", "7"})
        QTest::newRow(arguments) << QString::fromLatin1(arguments).split(QLatin1Char(' '));
}

void tst_SimulatedSoak::typingErrorsAreRefused()
{
    QFETCH(QStringList, arguments);
    QProcess simulate;
    simulate.start(simulateProgram(), arguments);
    QVERIFY(simulate.waitForFinished(60'000));
    QCOMPARE(simulate.exitCode(), 2);
    QVERIFY(!simulate.readAllStandardError().isEmpty());
}

QTEST_GUILESS_MAIN(tst_SimulatedSoak)
#include "tst_SimulatedSoak.moc"
