// SPDX-License-Identifier: Apache-2.0
#include "HandMade.h"
#include "SoakReport.h"

#include <QtCore/QJsonArray>
#include <QtTest/QtTest>

using soak::Record;

// What the soak is made of: histories, groups of values, plans, reports.
class tst_SoakParts : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aHistoryReadsAsItWasWritten();
    void aRecordThatWasCutOffIsLeftOut();
    void aRecordThatWasChangedIsRefused();
    void aHistoryIsNeverWrittenOver();
    void theTableHasAllGroups();
    void groupChecksumCoversEveryValue();
    void emptyChecksumMatchesUnsetPorts();
    void theSameSeedGivesTheSamePlan();
    void anotherSeedGivesAnotherOrderOfTheSameFaults();
    void everyKindOfFaultIsInTheShortPlan();
    void stallsThatOverlapCountOnce();
    void endlessFaultExplainsAllLaterAlarms();
    void aReportNamesSeedAndCommandOfAFailure();
    void stalledMachineExcusesTimeGatesOnly();
};

namespace {

class GroupNode : public QPlcCompactSlaveNode
{
public:
    explicit GroupNode(const soak::PlantShape &shape)
        : QPlcCompactSlaveNode(QStringLiteral("GroupNode"))
        , written(this, shape, 1)
        , seen(this, shape, 1)
    {
    }
    soak::Group<QPlcOutput> written;
    soak::Group<QPlcInput> seen;
};

QByteArray contents(const QString &fileName)
{
    QFile file(fileName);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

bool setContents(const QString &fileName, const QByteArray &bytes)
{
    QFile file(fileName);
    return file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size();
}

/// A file with three records.
QString historyFile(const QTemporaryDir &folder)
{
    const QString name = folder.filePath("Node3-life2.history");
    QString error;
    soak::HistoryFile writer;
    if (!writer.open(name, &error))
        return error;
    for (quint64 cycle = 0; cycle < 3; ++cycle)
        writer.append(Record::Step, 3, {cycle, soak::bitsOf(0.5)}, cycle);
    return name;
}

QList<int> kindsOf(const std::vector<soak::Fault> &plan)
{
    QList<int> kinds;
    for (const soak::Fault &fault : plan)
        kinds << int(fault.kind);
    return kinds;
}

}  // namespace

void tst_SoakParts::aHistoryReadsAsItWasWritten()
{
    QTemporaryDir folder;
    soak::Evidence evidence;
    QString error;
    historyFile(folder);
    QVERIFY2(soak::Evidence::read(folder.path(), *soak::Profile::named("short"), &evidence, &error), qPrintable(error));
    QCOMPARE(evidence.nodes.size(), std::size_t(1));
    const soak::History &history = evidence.nodes.front();
    QCOMPARE(history.node, 3);
    QCOMPARE(history.life, quint32(2));
    QCOMPARE(history.records.size(), std::size_t(3));
    QVERIFY(!history.isTorn);
    const Record &last = history.records.back();
    QCOMPARE(int(last.kind), int(Record::Step));
    QCOMPARE(last.cycle, quint64(2));
    QCOMPARE(last.numbers[0], quint64(2));
    QCOMPARE(soak::fromBits(last.numbers[1]), 0.5);
    QVERIFY(last.time >= history.records.front().time && last.time > 0);
}

void tst_SoakParts::aRecordThatWasCutOffIsLeftOut()
{
    QTemporaryDir folder;
    const QString name = historyFile(folder);
    QVERIFY(setContents(name, contents(name).chopped(1)));
    soak::History history;
    QString error;
    QVERIFY(soak::History::read(name, &history, &error));
    QVERIFY(history.isTorn);
    QCOMPARE(history.records.size(), std::size_t(2));
}

void tst_SoakParts::aRecordThatWasChangedIsRefused()
{
    QTemporaryDir folder;
    const QString name = historyFile(folder);
    QByteArray bytes = contents(name);
    bytes[int(sizeof(Record)) + 40] = char(bytes.at(int(sizeof(Record)) + 40) ^ 1);
    QVERIFY(setContents(name, bytes));
    soak::History history;
    QString error;
    QVERIFY(!soak::History::read(name, &history, &error));
    QVERIFY2(error.contains("record 1"), qPrintable(error));
}

void tst_SoakParts::aHistoryIsNeverWrittenOver()
{
    QTemporaryDir folder;
    const QString name = historyFile(folder);
    soak::HistoryFile writer;
    QString error;
    QVERIFY(!writer.open(name, &error));
    QVERIFY2(error.contains(name), qPrintable(error));
}

void tst_SoakParts::theTableHasAllGroups()
{
    const QPlcSignalTable table = soak::table({3, 100, 5});
    QCOMPARE(table.size(), 301);
    QVERIFY(table.contains("n2.drive") && table.contains("n0.v95"));
    QCOMPARE(table.at(table.indexOf("n2.drive")).safe.toReal(), soak::SafeDrive);
}

void tst_SoakParts::groupChecksumCoversEveryValue()
{
    GroupNode node({3, 12, 3});
    soak::write(node.written, 4, 7);
    const quint64 check = node.written.check;
    QCOMPARE(node.written.computedCheck(), check);
    QCOMPARE(node.written.stamp(), (soak::Stamp{4, 7, check}));
    const auto isKnown = [&](auto &port, auto other) {
        const auto value = port.value();
        port = other;
        const bool differs = node.written.computedCheck() != check;
        port = value;
        return differs;
    };
    QVERIFY(isKnown(node.written.life, quint32(5)));
    QVERIFY(isKnown(node.written.counter, quint32(8)));
    QVERIFY(isKnown(node.written.drive, 2.0));
    for (auto &port : node.written.reals)
        QVERIFY(isKnown(port, port + 1.0));
    for (auto &port : node.written.shortReals)
        QVERIFY(isKnown(port, port + 1.0F));
    for (auto &port : node.written.integers)
        QVERIFY(isKnown(port, port ^ 1));
    for (auto &port : node.written.triples) {
        std::array<float, 3> other = port.value();
        std::swap(other[0], other[2]);
        QVERIFY(isKnown(port, other));
    }
    QCOMPARE(node.written.computedCheck(), check);
    soak::write(node.written, 4, 8);
    QVERIFY(node.written.check != check);
}

void tst_SoakParts::emptyChecksumMatchesUnsetPorts()
{
    const soak::PlantShape shape{3, 12, 3};
    GroupNode node(shape);
    QCOMPARE(node.seen.computedCheck(), soak::checkOfNothing(shape, 1, 0.0));
    QVERIFY(soak::checkOfNothing(shape, 1, 0.0) != soak::checkOfNothing(shape, 1, soak::SafeDrive));
    QVERIFY(soak::checkOfNothing(shape, 1, 0.0) != soak::checkOfNothing(shape, 2, 0.0));
}

void tst_SoakParts::theSameSeedGivesTheSamePlan()
{
    const soak::Profile profile = *soak::Profile::named("short");
    const std::vector<soak::Fault> one = soak::planOf(profile, 60, 7);
    const std::vector<soak::Fault> other = soak::planOf(profile, 60, 7);
    QCOMPARE(one.size(), std::size_t(60));
    for (std::size_t i = 0; i < one.size(); ++i) {
        QCOMPARE(int(one[i].kind), int(other[i].kind));
        QCOMPARE(one[i].node, other[i].node);
        QCOMPARE(one[i].seed, other[i].seed);
        QVERIFY(soak::hasNode(one[i].kind) ? one[i].node >= 0 && one[i].node < 12 : one[i].node == -1);
    }
}

void tst_SoakParts::anotherSeedGivesAnotherOrderOfTheSameFaults()
{
    const soak::Profile profile = *soak::Profile::named("short");
    QList<int> one = kindsOf(soak::planOf(profile, 60, 7));
    QList<int> other = kindsOf(soak::planOf(profile, 60, 8));
    QVERIFY(one != other);
    std::sort(one.begin(), one.end());
    std::sort(other.begin(), other.end());
    QCOMPARE(one, other);
}

void tst_SoakParts::everyKindOfFaultIsInTheShortPlan()
{
    const soak::Profile profile = *soak::Profile::named("short");
    const QList<int> kinds = kindsOf(soak::planOf(profile, profile.faultCount, 1));
    QCOMPARE(kinds.size(), 60);
    for (int kind = 0; kind < soak::FaultKinds; ++kind)
        QCOMPARE(int(kinds.count(kind)), profile.weights[std::size_t(kind)]);
}

void tst_SoakParts::stallsThatOverlapCountOnce()
{
    soak::History runner;
    HandMade::add(runner, Record::Stall, -1, 30, {20});
    HandMade::add(runner, Record::Stall, -1, 25, {10});
    HandMade::add(runner, Record::Stall, -1, 60, {50});
    const soak::Stalls stalls(runner);
    QCOMPARE(stalls.count(), std::size_t(2));
    QCOMPARE(stalls.within(0, 100), qint64(30));
    QCOMPARE(stalls.within(15, 55), qint64(20));
    QCOMPARE(stalls.within(31, 49), qint64(0));
}

void tst_SoakParts::endlessFaultExplainsAllLaterAlarms()
{
    soak::Evidence evidence;
    HandMade::add(evidence.runner, Record::FaultBegins, 2, 10, {quint64(soak::FaultKind::StopNode), 300});
    evidence.complete();
    QCOMPARE(evidence.faults.size(), std::size_t(1));
    QCOMPARE(evidence.faults.front().node, 2);
    QVERIFY(evidence.isExplained(1000, 2) && !evidence.isExplained(9, 2) && !evidence.isExplained(1000, 1));
}

void tst_SoakParts::aReportNamesSeedAndCommandOfAFailure()
{
    soak::SoakReport report;
    report.profile = "short";
    report.seed = 77;
    report.seconds = 60;
    HandMade plant;
    report.gates = {plant.judge(&soak::valuesAreWhole)};
    report.evidence = plant.evidence;
    QVERIFY(report.passed());
    QVERIFY(!report.toText().contains("FAIL"));
    plant.step(1, 50).numbers[Record::ComputedCheck] ^= 1;
    report.gates = {plant.judge(&soak::valuesAreWhole)};
    QVERIFY(!report.passed());
    QVERIFY2(report.toText().contains("qtplc_soak --profile short --seed 77 --duration 60"),
             qPrintable(report.toText()));
    QVERIFY(report.toText().contains("Node1-life1, cycle 50"));
    QVERIFY(!report.toJson()["passed"].toBool());
    QCOMPARE(report.toJson()["gates"].toArray().at(0).toObject()["failed"].toDouble(), 1.0);
    report.gates.clear();
    QVERIFY2(!report.passed(), "nothing was judged");
}

void tst_SoakParts::stalledMachineExcusesTimeGatesOnly()
{
    using soak::SoakReport;
    soak::Gate values("values are whole"), time("cycles add up");
    time.isOfTime = true;
    values.looked = time.looked = 10;
    time.fail(QStringLiteral("35 cycles in the time of 47"));
    for (const int percent : {4, 6}) {
        SoakReport report;
        HandMade::add(report.evidence.runner, Record::Born, -1, 0);
        HandMade::add(report.evidence.runner, Record::Stall, -1, 500 + 10 * percent, {500});
        HandMade::add(report.evidence.runner, Record::Command, -1, 1000);
        report.evidence.complete();
        report.gates = {values, time};
        QCOMPARE(report.verdict(), percent > 5 ? SoakReport::Unjudged : SoakReport::Failed);
        QVERIFY(!report.passed());
        QCOMPARE(report.toText().contains("NOT JUDGED"), percent > 5);
        report.gates[0].fail(QStringLiteral("a value of two cycles"));
        QCOMPARE(report.verdict(), SoakReport::Failed);
        report.gates = {values};
        QCOMPARE(report.verdict(), SoakReport::Passed);
    }
}

QTEST_APPLESS_MAIN(tst_SoakParts)
#include "tst_SoakParts.moc"
