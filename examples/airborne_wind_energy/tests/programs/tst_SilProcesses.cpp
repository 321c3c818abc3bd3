// SPDX-License-Identifier: Apache-2.0
#include "Program.h"

#include <QtTest/QtTest>

#include <csignal>

/// awe_sil --processes: however it ends, none of its programs is left behind, and who started it learns what happened.
class tst_SilProcesses : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void noneIsLeftBehind_data();
    void noneIsLeftBehind();
    void stoppedNodeDoesNotKeepTheFlightFromEnding();

private:
    /// Waits until all three programs run. \return their process ids: master, model, autopilot; empty when they do not come
    static QList<qint64> waitForPrograms(Program &program);
};

QList<qint64> tst_SilProcesses::waitForPrograms(Program &program)
{
    const QByteArray names[] = {"awe_master", "awe_compact_model", "awe_autopilot"};
    QList<qint64> pids;
    const auto allThere = [&] {
        pids.clear();
        const QList<qint64> children = childrenOf(program.processId());
        for (const QByteArray &name : names) {
            for (qint64 pid : children)
                if (nameOf(pid) == name)
                    pids << pid;
        }
        return pids.size() == 3;
    };
    return QTest::qWaitFor(allThere, Program::patience) ? pids : QList<qint64>();
}

void tst_SilProcesses::noneIsLeftBehind_data()
{
    QTest::addColumn<QString>("victim");  // empty: nobody
    QTest::addColumn<int>("signal");
    QTest::addColumn<int>("exitCode");
    QTest::addColumn<QString>("sentence");
    const QString sil = QStringLiteral("awe_sil");
    QTest::newRow("normal end") << QString() << 0 << 0 << QString();
    QTest::newRow("SIGINT") << sil << SIGINT << 0 << QString();
    QTest::newRow("SIGTERM") << sil << SIGTERM << 0 << QString();
    QTest::newRow("parent killed") << sil << SIGKILL << -1 << QString();
    QTest::newRow("master killed") << QStringLiteral("awe_master") << SIGKILL << 1
                                   << QStringLiteral("awe_sil: the master has crashed");
    QTest::newRow("model killed") << QStringLiteral("awe_compact_model") << SIGKILL << 1
                                  << QStringLiteral("node 'Model' is gone");
    QTest::newRow("autopilot killed") << QStringLiteral("awe_autopilot") << SIGKILL << 1
                                      << QStringLiteral("node 'Autopilot' is gone");
    QTest::newRow("model ended") << QStringLiteral("awe_compact_model") << SIGTERM << 1
                                 << QStringLiteral("node 'Model' is gone");
}

void tst_SilProcesses::noneIsLeftBehind()
{
    QFETCH(QString, victim);
    QFETCH(int, signal);
    QFETCH(int, exitCode);
    QFETCH(QString, sentence);
    const bool endsByItself = victim.isEmpty();
    Program program(QStringLiteral(AWE_PROGRAMS "/awe_sil"),
                    {QStringLiteral("--processes"), QStringLiteral("--real-time"),
                     endsByItself ? QStringLiteral("--duration=1") : QStringLiteral("--duration=0")});
    const QList<qint64> pids = waitForPrograms(program);
    QCOMPARE(pids.size(), 3);
    QVERIFY(program.waitForErrors(QStringLiteral("node Model registered over"))
            && program.waitForErrors(QStringLiteral("node Autopilot registered over")));
    if (victim == QLatin1String("awe_sil"))
        program.sendSignal(signal);
    for (qint64 pid : pids) {
        if (nameOf(pid) == victim.toLatin1())
            ::kill(pid_t(pid), signal);
    }
    QCOMPARE(program.waitForEnd(), exitCode);
    QVERIFY2(program.errors().contains(sentence), qPrintable(program.errors()));
    QCOMPARE(stillRunning(pids), QList<qint64>());
}

void tst_SilProcesses::stoppedNodeDoesNotKeepTheFlightFromEnding()
{
    Program program(QStringLiteral(AWE_PROGRAMS "/awe_sil"),
                    {QStringLiteral("--processes"), QStringLiteral("--real-time"), QStringLiteral("--duration=0")});
    const QList<qint64> pids = waitForPrograms(program);
    QCOMPARE(pids.size(), 3);
    QVERIFY(program.waitForErrors(QStringLiteral("node Model registered over"))
            && program.waitForErrors(QStringLiteral("node Autopilot registered over")));
    ::kill(pid_t(pids.at(1)), SIGSTOP);
    program.sendSignal(SIGINT);
    QVERIFY(program.waitForEnd() >= 0);
    QCOMPARE(stillRunning(pids), QList<qint64>());
}

QTEST_GUILESS_MAIN(tst_SilProcesses)
#include "tst_SilProcesses.moc"
