// SPDX-License-Identifier: Apache-2.0
#include "Program.h"

#include <QtPlcCore>
#include <QtTest/QtTest>

#include <QtCore/QRegularExpression>

#include <atomic>
#include <csignal>

namespace {

/// A node that joins a flight, and looks at one value of the model and one of the autopilot.
/// Threads: step() in that of the cycle, all else in that of the test.
class ValueWitness : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    ValueWitness()
        : QPlcCompactSlaveNode(QStringLiteral("ValueWitness"))
    {
        setReceivesQuality(true);
    }
    ~ValueWitness() override { disconnectFromMaster(); }

    int cycles() const { return m_cycles; }
    double shortestTether() const { return m_shortest; }  // [m]
    bool hasSeenSafeValues() const { return m_hasSeenSafe; }
    bool seesGoodValues() const { return m_isGood; }

private:
    void step(const QPlcCycle &) override
    {
        m_shortest = std::min(m_shortest.load(), m_length.value());
        bool isGood = true;
        for (const QPlcPort *port : std::initializer_list<const QPlcPort *>{&m_length, &m_speed}) {
            isGood = isGood && port->quality().kind() == QPlcQuality::Good;
            m_hasSeenSafe = m_hasSeenSafe || port->quality().kind() == QPlcQuality::Safe;
        }
        m_isGood = isGood;
        ++m_cycles;
    }

    std::atomic<int> m_cycles{0};
    std::atomic<double> m_shortest{1e9};
    std::atomic<bool> m_hasSeenSafe{false};
    std::atomic<bool> m_isGood{false};
    QPlcInput<double> m_length{this, "tetherLength"};
    QPlcInput<double> m_speed{this, "tetherSpeed"};
};

}  // namespace

/// awe_sil --processes: however it ends, none of its programs is left behind, and who started it
/// learns what happened.
class tst_SilProcesses : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void programEndsAllItsChildProcesses_data();
    void programEndsAllItsChildProcesses();
    void stoppedNodeDoesNotKeepTheFlightFromEnding();
    void nodePausedInADebuggerDoesNotEndTheFlight_data();
    void nodePausedInADebuggerDoesNotEndTheFlight();

private:
    /// Waits until all three programs run. \return their process ids: master, model, autopilot;
    /// empty when they do not come
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

void tst_SilProcesses::programEndsAllItsChildProcesses_data()
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

void tst_SilProcesses::programEndsAllItsChildProcesses()
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

void tst_SilProcesses::nodePausedInADebuggerDoesNotEndTheFlight_data()
{
    QTest::addColumn<int>("place");  // among the programs
    QTest::newRow("model") << 1;
    QTest::newRow("autopilot") << 2;
}

/// Two seconds at a breakpoint, in real time: all others see the last values, and the node goes on
/// where it was.
void tst_SilProcesses::nodePausedInADebuggerDoesNotEndTheFlight()
{
    QFETCH(int, place);
    Program program(QStringLiteral(AWE_PROGRAMS "/awe_sil"),
                    {QStringLiteral("--processes"), QStringLiteral("--real-time"), QStringLiteral("--duration=0")});
    const QList<qint64> pids = waitForPrograms(program);
    QCOMPARE(pids.size(), 3);
    QVERIFY(program.waitForErrors(QStringLiteral("node Model registered over"))
            && program.waitForErrors(QStringLiteral("node Autopilot registered over")));
    const QRegularExpressionMatch port
        = QRegularExpression(QStringLiteral("listening on 127.0.0.1 port (\\d+)")).match(program.errors());
    QVERIFY2(port.hasMatch(), qPrintable(program.errors()));
    ValueWitness witness;
    QVERIFY(witness.connectToMasterAndWaitForConnected(
        QPlcUnderlyingProtocol::fromString(QStringLiteral("tcp://127.0.0.1:%1").arg(port.captured(1)))));
    const auto seesCycles = [&witness](int count) {
        const int wanted = witness.cycles() + count;
        return QTest::qWaitFor([&] { return witness.cycles() >= wanted; }, Program::patience);
    };
    QVERIFY2(seesCycles(50), qPrintable(program.errors()));
    ::kill(pid_t(pids.at(place)), SIGSTOP);
    const bool goesOn = seesCycles(200);
    const bool sawIt = !witness.seesGoodValues();
    ::kill(pid_t(pids.at(place)), SIGCONT);
    QVERIFY2(goesOn, qPrintable(program.errors()));
    QVERIFY(sawIt);
    QVERIFY2(seesCycles(50), qPrintable(program.errors()));
    QTRY_VERIFY_WITH_TIMEOUT(witness.seesGoodValues(), Program::patience);
    QVERIFY(!witness.hasSeenSafeValues());
    QVERIFY2(witness.shortestTether() > 99.0, qPrintable(QString::number(witness.shortestTether())));
    QCOMPARE(program.errors().count(QStringLiteral("node Model registered over")), 1);
    QCOMPARE(program.errors().count(QStringLiteral("node Autopilot registered over")), 1);
    witness.disconnectFromMaster();
    program.sendSignal(SIGINT);
    QCOMPARE(program.waitForEnd(), 0);
}

QTEST_GUILESS_MAIN(tst_SilProcesses)
#include "tst_SilProcesses.moc"
