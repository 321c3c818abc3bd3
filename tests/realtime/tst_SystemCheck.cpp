// SPDX-License-Identifier: Apache-2.0
#include "realtime/SystemCheck.h"

#include <QtTest/QtTest>

#include <initializer_list>

using qplc::Finding;
using qplc::Histogram;
using qplc::SystemFacts;
using qplc::WakeUps;

Q_DECLARE_METATYPE(qplc::SystemFacts)

// Judgements on facts and effects that the test makes up.
class tst_SystemCheck : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void suitableComputerNeedsNoRemedy();
    void unknownFactsNeedNoRemedy();
    void findingsNameTheActualSetting_data();
    void findingsNameTheActualSetting();
    void deepestEnabledIdleStateCounts();
    void refusedSchedulingNeedsARemedyAndIsNotMeasured();
    void refusedMemoryLockNeedsARemedy();
    void swapMattersWhereMemoryCannotBeLocked();
    void wakeUpsAreJudgedByTheir99thPercentile_data();
    void wakeUpsAreJudgedByTheir99thPercentile();
    void loopbackIsJudgedByItsRoundTrips();
    void versionsAreNamed();

private:
    static SystemFacts fitFacts()
    {
        SystemFacts facts;
        facts.kernel = "6.1.0-18-rt-amd64";
        facts.preemption = "PREEMPT_RT";
        facts.processors = "0-3";
        facts.isolated = "3";
        facts.governors = QStringList{"performance"};
        facts.clockSource = "tsc";
        facts.swapSpace = 0;
        facts.realTimeShare = 95;
        facts.idleStates = {{"C1", 2, true}};
        facts.priorityLimit = "99";
        facts.memoryLimit = "unlimited";
        return facts;
    }
    /// \param lateness  of all wake-ups [ns] \param lastOnes  of the last 2 of 100
    static WakeUps wakeUps(qint64 lateness, qint64 lastOnes = 0)
    {
        WakeUps wakeUps;
        wakeUps.settings = {{"scheduling", "SCHED_FIFO 49", "SCHED_FIFO 49", true, {}},
                            {"locked memory", "all", "all (1234 KiB)", true, {}}};
        wakeUps.lateness = std::make_unique<Histogram>();
        for (int i = 0; i < 98; ++i)
            wakeUps.lateness->record(lateness);
        for (int i = 0; i < 2; ++i)
            wakeUps.lateness->record(qMax(lateness, lastOnes));
        return wakeUps;
    }
    static WakeUps refused()
    {
        WakeUps wakeUps;
        wakeUps.settings = {{"scheduling", "SCHED_FIFO 49", "SCHED_OTHER 0", false, "some cure"},
                            {"locked memory", "all", "0 KiB", false, "some cure"}};
        return wakeUps;
    }
    static Finding find(const QVector<Finding> &findings, const QString &subject)
    {
        for (const Finding &finding : findings) {
            if (finding.subject == subject)
                return finding;
        }
        return {"not found", Finding::Unknown, {}, {}};
    }
};

void tst_SystemCheck::suitableComputerNeedsNoRemedy()
{
    const SystemFacts facts = fitFacts();
    const QVector<Finding> findings
        = qplc::judgeFacts(facts) + qplc::judgeEffects(facts, wakeUps(60'000), wakeUps(5'000));
    QCOMPARE(findings.size(), 11);
    for (const Finding &finding : findings) {
        QVERIFY2(finding.verdict == Finding::Ok, qPrintable(finding.subject));
        QVERIFY(!finding.found.isEmpty());
        QCOMPARE(finding.remedy, QString());
    }
}

void tst_SystemCheck::unknownFactsNeedNoRemedy()
{
    for (const Finding &finding : qplc::judgeFacts(SystemFacts())) {
        QVERIFY2(finding.verdict == Finding::Unknown, qPrintable(finding.subject));
        QVERIFY(!finding.found.isEmpty());
    }
}

void tst_SystemCheck::findingsNameTheActualSetting_data()
{
    QTest::addColumn<SystemFacts>("facts");
    QTest::addColumn<QString>("subject");
    QTest::addColumn<QString>("found");
    QTest::addColumn<QString>("remedy");
    const auto with = [](auto change) {
        SystemFacts facts = fitFacts();
        change(facts);
        return facts;
    };
    QTest::newRow("kernel") << with([](SystemFacts &facts) { facts.preemption = "PREEMPT_DYNAMIC"; }) << "kernel"
                            << "PREEMPT_DYNAMIC"
                            << "sudo apt install linux-image-rt-";
    QTest::newRow("governor") << with([](SystemFacts &facts) { facts.governors = QStringList{"powersave"}; })
                              << "governor"
                              << "powersave"
                              << "echo performance | sudo tee ";
    QTest::newRow("one processor of many") << with([](SystemFacts &facts) {
        facts.governors = QStringList{"performance", "ondemand"};
    }) << "governor"
                                           << "performance, ondemand"
                                           << "echo performance | sudo tee ";
    QTest::newRow("clock source with a better one") << with([](SystemFacts &facts) {
        facts.clockSource = "hpet";
        facts.clockSources = QStringList{"tsc", "hpet"};
    }) << "clock source"
                                                    << "hpet"
                                                    << "echo tsc | sudo tee ";
    QTest::newRow("clock source without a better one") << with([](SystemFacts &facts) {
        facts.clockSource = "acpi_pm";
        facts.clockSources = QStringList{"acpi_pm"};
    }) << "clock source"
                                                       << "acpi_pm"
                                                       << "dmesg";
    QTest::newRow("real-time share") << with([](SystemFacts &facts) { facts.realTimeShare = 50; }) << "real-time share"
                                     << "50 %"
                                     << "sudo sysctl kernel.sched_rt_runtime_us=950000";
    QTest::newRow("idle state") << with([](SystemFacts &facts) {
        facts.idleStates.append({"C6", 133, true});
    }) << "idle states"
                                << "C6, 133 µs"
                                << "sudo cpupower idle-set";
}

void tst_SystemCheck::findingsNameTheActualSetting()
{
    QFETCH(SystemFacts, facts);
    QFETCH(QString, subject);
    QFETCH(QString, found);
    QFETCH(QString, remedy);
    const Finding finding = find(qplc::judgeFacts(facts), subject);
    QCOMPARE(finding.verdict, Finding::ToCure);
    QVERIFY2(finding.found.contains(found), qPrintable(finding.found));
    QVERIFY2(finding.remedy.contains(remedy), qPrintable(finding.remedy));
}

void tst_SystemCheck::deepestEnabledIdleStateCounts()
{
    SystemFacts facts = fitFacts();
    facts.idleStates = {{"C1", 2, true}, {"C6", 500, false}};
    QCOMPARE(find(qplc::judgeFacts(facts), "idle states").verdict, Finding::Ok);
    facts.idleStates = {{"C6", 500, false}};
    QCOMPARE(find(qplc::judgeFacts(facts), "idle states").found, QString("all disabled"));
}

void tst_SystemCheck::refusedSchedulingNeedsARemedyAndIsNotMeasured()
{
    SystemFacts facts = fitFacts();
    facts.priorityLimit = "0";
    const QVector<Finding> findings = qplc::judgeEffects(facts, wakeUps(1), refused());
    const Finding scheduling = find(findings, "scheduling");
    QCOMPARE(scheduling.verdict, Finding::ToCure);
    QCOMPARE(scheduling.found, QString("wanted SCHED_FIFO 49, obtained SCHED_OTHER 0 (limit rtprio: 0)"));
    QVERIFY(!scheduling.remedy.isEmpty()
            && !scheduling.remedy.contains("tst_SystemCheck"));  // not for this program only
    QCOMPARE(find(findings, "wake-up FIFO").verdict, Finding::Unknown);
    QCOMPARE(find(findings, "wake-up").verdict, Finding::Ok);
}

void tst_SystemCheck::refusedMemoryLockNeedsARemedy()
{
    SystemFacts facts = fitFacts();
    facts.memoryLimit = "8388608";
    const Finding memory = find(qplc::judgeEffects(facts, wakeUps(1), refused()), "locked memory");
    QCOMPARE(memory.verdict, Finding::ToCure);
    QCOMPARE(memory.found, QString("wanted all, obtained 0 KiB (limit memlock: 8192 KiB)"));
    QVERIFY2(memory.remedy.contains("memlock unlimited"), qPrintable(memory.remedy));
}

void tst_SystemCheck::swapMattersWhereMemoryCannotBeLocked()
{
    SystemFacts facts = fitFacts();
    facts.swapSpace = 2048 * 1024;
    QCOMPARE(find(qplc::judgeEffects(facts, wakeUps(1), wakeUps(1)), "swap").verdict, Finding::Ok);
    const Finding swap = find(qplc::judgeEffects(facts, wakeUps(1), refused()), "swap");
    QCOMPARE(swap.verdict, Finding::ToCure);
    QCOMPARE(swap.found, QString("2048 MiB"));
    QVERIFY(swap.remedy.contains("swapoff"));
    facts.swapSpace.reset();
    QCOMPARE(find(qplc::judgeEffects(facts, wakeUps(1), refused()), "swap").verdict, Finding::Unknown);
}

void tst_SystemCheck::wakeUpsAreJudgedByTheir99thPercentile_data()
{
    QTest::addColumn<qint64>("ordinary");
    QTest::addColumn<qint64>("realTime");
    QTest::addColumn<bool>("ordinaryIsOk");
    QTest::addColumn<bool>("realTimeIsOk");
    QTest::newRow("early") << qint64(50'000) << qint64(10'000) << true << true;
    QTest::newRow("at the limit") << qint64(1'000'000) << qint64(100'000) << true << true;
    QTest::newRow("ordinary is late") << qint64(1'100'000) << qint64(10'000) << false << true;
    QTest::newRow("real time is late") << qint64(50'000) << qint64(110'000) << true << false;
}

void tst_SystemCheck::wakeUpsAreJudgedByTheir99thPercentile()
{
    QFETCH(qint64, ordinary);
    QFETCH(qint64, realTime);
    QFETCH(bool, ordinaryIsOk);
    QFETCH(bool, realTimeIsOk);
    const QVector<Finding> findings = qplc::judgeEffects(fitFacts(), wakeUps(1000, ordinary), wakeUps(1000, realTime));
    QCOMPARE(find(findings, "wake-up").verdict == Finding::Ok, ordinaryIsOk);
    QCOMPARE(find(findings, "wake-up FIFO").verdict == Finding::Ok, realTimeIsOk);
    QVERIFY(find(findings, "wake-up").found.contains("p50 1 µs"));
}

void tst_SystemCheck::loopbackIsJudgedByItsRoundTrips()
{
    Histogram roundTrips;
    QCOMPARE(qplc::judgeLoopback(roundTrips).verdict, Finding::ToCure);
    QVERIFY(qplc::judgeLoopback(roundTrips).remedy.contains("ip link set lo up"));
    roundTrips.record(30'000);
    QCOMPARE(qplc::judgeLoopback(roundTrips).verdict, Finding::Ok);
    roundTrips.record(3'000'000);
    QCOMPARE(qplc::judgeLoopback(roundTrips).verdict, Finding::ToCure);
}

void tst_SystemCheck::versionsAreNamed()
{
    const Finding versions = qplc::judgeVersions(fitFacts());
    for (const QString &part :
         {QString("QtPLC "), QString("Qt ") + qVersion(), QString("6.1.0-18-rt-amd64"), QString("glibc ")})
        QVERIFY2(versions.found.contains(part), qPrintable(versions.found));
}

QTEST_APPLESS_MAIN(tst_SystemCheck)
#include "tst_SystemCheck.moc"
