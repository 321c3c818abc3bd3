// SPDX-License-Identifier: Apache-2.0
#include "realtime/SystemFacts.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

using qplc::SystemFacts;

// What is read from a tree of proc and sys that the test has written.
class tst_SystemFacts : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void emptyRootGivesNoFacts();
    void preemptionIsReadFromTheVersion_data();
    void preemptionIsReadFromTheVersion();
    void oldRealTimeKernelsAreDetectedByTheirFile();
    void noIsolatedProcessorsDiffersFromUnknown();
    void governorsAreNamedOnce();
    void swapSpacesAddUp();
    void realTimeShareIsRuntimeOfPeriod();
    void idleStatesTellTheirLatency();
    void softLimitsAreRead();
    void clockSourcesAreListed();
    void thisMachineCanBeRead();

private:
    void write(const QString &path, const QByteArray &text)
    {
        const QString full = m_root->filePath(path);
        QDir().mkpath(QFileInfo(full).path());
        QFile file(full);
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write(text);
    }
    SystemFacts read() const { return SystemFacts::read(m_root->path()); }
    QScopedPointer<QTemporaryDir> m_root;
};

void tst_SystemFacts::init()
{
    m_root.reset(new QTemporaryDir);
    QVERIFY(m_root->isValid());
}

void tst_SystemFacts::emptyRootGivesNoFacts()
{
    const SystemFacts facts = read();
    QVERIFY(facts.kernel.isEmpty() && facts.preemption.isEmpty() && facts.processors.isEmpty());
    QVERIFY(!facts.isolated && !facts.swapSpace && !facts.realTimeShare);
    QVERIFY(facts.governors.isEmpty() && facts.clockSource.isEmpty() && facts.clockSources.isEmpty());
    QVERIFY(facts.idleStates.isEmpty() && facts.priorityLimit.isEmpty() && facts.memoryLimit.isEmpty());
    QVERIFY(facts.model.isEmpty() && facts.memory.isEmpty() && !facts.isVirtual);
    QVERIFY(facts.load.isEmpty() && facts.kernelParameters.isEmpty());
}

void tst_SystemFacts::preemptionIsReadFromTheVersion_data()
{
    QTest::addColumn<QByteArray>("version");
    QTest::addColumn<QString>("kernel");
    QTest::addColumn<QString>("preemption");
    QTest::newRow("real time") << QByteArray("Linux version 6.1.0-18-rt-amd64 (debian-kernel@lists.debian.org) (gcc-12 "
                                             "(Debian 12.2.0-14) 12.2.0) #1 SMP PREEMPT_RT Debian 6.1.76-1\n")
                               << "6.1.0-18-rt-amd64"
                               << "PREEMPT_RT";
    QTest::newRow("dynamic") << QByteArray("Linux version 6.1.0-18-amd64 (x@y) #1 SMP PREEMPT_DYNAMIC Debian 6.1.76\n")
                             << "6.1.0-18-amd64"
                             << "PREEMPT_DYNAMIC";
    QTest::newRow("desktop") << QByteArray("Linux version 5.15.84-v8+ (dom@buildbot) #1613 SMP PREEMPT Thu Jan 5\n")
                             << "5.15.84-v8+"
                             << "PREEMPT";
    QTest::newRow("none") << QByteArray("Linux version 4.19.0-5-amd64 (x@y) #1 SMP Debian 4.19.37-5\n")
                          << "4.19.0-5-amd64"
                          << "no PREEMPT";
}

void tst_SystemFacts::preemptionIsReadFromTheVersion()
{
    QFETCH(QByteArray, version);
    write("proc/version", version);
    QTEST(read().kernel, "kernel");
    QTEST(read().preemption, "preemption");
}

void tst_SystemFacts::oldRealTimeKernelsAreDetectedByTheirFile()
{
    write("proc/version", "Linux version 4.19.0-5-rt-amd64 (x@y) #1 SMP PREEMPT RT Debian 4.19.37-5\n");
    write("sys/kernel/realtime", "1\n");
    QCOMPARE(read().preemption, QString("PREEMPT_RT"));
    write("sys/kernel/realtime", "0\n");
    QCOMPARE(read().preemption, QString("PREEMPT"));
}

void tst_SystemFacts::noIsolatedProcessorsDiffersFromUnknown()
{
    write("sys/devices/system/cpu/online", "0-3\n");
    QVERIFY(!read().isolated);
    write("sys/devices/system/cpu/isolated", "\n");
    QCOMPARE(read().isolated.value(), QString());
    write("sys/devices/system/cpu/isolated", "2-3\n");
    QCOMPARE(read().isolated.value(), QString("2-3"));
    QCOMPARE(read().processors, QString("0-3"));
}

void tst_SystemFacts::governorsAreNamedOnce()
{
    for (int i = 0; i < 12; ++i)
        write(QString("sys/devices/system/cpu/cpu%1/cpufreq/scaling_governor").arg(i), "powersave\n");
    write("sys/devices/system/cpu/cpuidle/cpufreq/scaling_governor", "no processor\n");
    QCOMPARE(read().governors, QStringList{"powersave"});
    write("sys/devices/system/cpu/cpu7/cpufreq/scaling_governor", "performance\n");
    QCOMPARE(read().governors.size(), 2);
}

void tst_SystemFacts::swapSpacesAddUp()
{
    write("proc/swaps", "Filename\t\t\t\tType\t\tSize\t\tUsed\t\tPriority\n");
    QCOMPARE(read().swapSpace.value(), 0);
    write("proc/swaps",
          "Filename\t\t\t\tType\t\tSize\t\tUsed\t\tPriority\n"
          "/dev/sda5                               partition\t999420\t\t0\t\t-2\n"
          "/swapfile                               file\t\t1024\t\t0\t\t-3\n");
    QCOMPARE(read().swapSpace.value(), 999420 + 1024);
}

void tst_SystemFacts::realTimeShareIsRuntimeOfPeriod()
{
    write("proc/sys/kernel/sched_rt_period_us", "1000000\n");
    QVERIFY(!read().realTimeShare);
    write("proc/sys/kernel/sched_rt_runtime_us", "950000\n");
    QCOMPARE(read().realTimeShare.value(), 95);
    write("proc/sys/kernel/sched_rt_runtime_us", "-1\n");
    QCOMPARE(read().realTimeShare.value(), 100);
    write("proc/sys/kernel/sched_rt_period_us", "0\n");
    QVERIFY(!read().realTimeShare);
}

void tst_SystemFacts::idleStatesTellTheirLatency()
{
    const QString folder = "sys/devices/system/cpu/cpu0/cpuidle/state%1/%2";
    write(folder.arg(0).arg("name"), "POLL\n");
    write(folder.arg(0).arg("latency"), "0\n");
    write(folder.arg(1).arg("name"), "C6\n");
    write(folder.arg(1).arg("latency"), "133\n");
    write(folder.arg(1).arg("disable"), "1\n");
    const SystemFacts facts = read();
    QCOMPARE(facts.idleStates.size(), 2);
    QCOMPARE(facts.idleStates.at(1).name, QString("C6"));
    QCOMPARE(facts.idleStates.at(1).exitLatency, 133);
    QVERIFY(facts.idleStates.at(0).isEnabled && !facts.idleStates.at(1).isEnabled);
}

void tst_SystemFacts::softLimitsAreRead()
{
    write("proc/self/limits",
          "Limit                     Soft Limit           Hard Limit           Units     \n"
          "Max locked memory         8388608              unlimited            bytes     \n"
          "Max realtime priority     20                   99                             \n");
    QCOMPARE(read().priorityLimit, QString("20"));
    QCOMPARE(read().memoryLimit, QString("8388608"));
}

void tst_SystemFacts::clockSourcesAreListed()
{
    const QString folder = "sys/devices/system/clocksource/clocksource0/";
    write(folder + "current_clocksource", "hpet\n");
    write(folder + "available_clocksource", "tsc hpet acpi_pm \n");
    QCOMPARE(read().clockSource, QString("hpet"));
    QCOMPARE(read().clockSources, (QStringList{"tsc", "hpet", "acpi_pm"}));
}

void tst_SystemFacts::thisMachineCanBeRead()
{
    const SystemFacts facts = SystemFacts::read();
    QVERIFY(!facts.kernel.isEmpty() && !facts.preemption.isEmpty());
    QVERIFY(!facts.priorityLimit.isEmpty() && !facts.memoryLimit.isEmpty());
}

QTEST_APPLESS_MAIN(tst_SystemFacts)
#include "tst_SystemFacts.moc"
