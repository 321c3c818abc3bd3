// SPDX-License-Identifier: Apache-2.0
#include <QtPlcCore>
#include <QtTest/QTest>

#include <cmath>

/// The node that is tested: reels the tether in and out, and brakes in its safe state.
class Winch : public QPlcCompactSlaveNode
{
public:
    Winch()
        : QPlcCompactSlaveNode(QStringLiteral("Winch"))
    {
    }
    bool isBraked = false;

private:
    QPlcInput<double> m_speed{this, "tetherSpeed"};     // [m/s], > 0 reels out
    QPlcOutput<double> m_length{this, "tetherLength"};  // [m]
    void reset() override { m_length = 300.0, isBraked = false; }
    void step(const QPlcCycle &cycle) override
    {
        m_length = m_length + m_speed * cycle.dt();
        if (m_length > 400.0)
            requestSafeStop();
    }
    void safeState(SafeStateReason) override { isBraked = true; }
};

class tst_Winch : public QObject
{
    Q_OBJECT
    const QPlcSignalTable m_table = QPlcSignalTable::fromIni(R"(
[tetherSpeed]
type = Real64
min  = -10
max  = 10
hold = 2
[tetherLength]
type = Real64
)");

private Q_SLOTS:
    void lengthIsTheIntegralOfTheSpeed()
    {
        Winch winch;
        QPlcNodeRunner runner(winch);
        QVERIFY2(runner.bind(m_table) && runner.initialize(), qPrintable(runner.errorString()));
        runner.set("tetherSpeed", 2.0);
        for (int cycle = 0; cycle < 100; ++cycle)  // of 10 ms: 1 s
            QVERIFY(runner.step());
        QCOMPARE(runner.value("tetherLength").toReal(), 302.0);
    }
    void badSpeedIsHeldAndThenSafe()
    {
        Winch winch;
        QPlcNodeRunner runner(winch, std::chrono::seconds(1));
        QVERIFY(runner.bind(m_table) && runner.initialize());
        const QPlcSignalIndex speed = runner.indexOf("tetherSpeed");  // by name once, and then fast
        const QPlcSignalIndex length = runner.indexOf("tetherLength");
        runner.setReal(speed, 5.0);
        runner.step();
        runner.setReal(speed, std::nan(""));
        runner.step(), runner.step();  // `hold` is 2 cycles
        QCOMPARE(runner.real(length), 315.0);
        runner.step();
        QCOMPARE(runner.real(length), 315.0);
        QCOMPARE(runner.quality(speed).toString(), QString("safe"));
    }
    void longTetherStopsThePlant()
    {
        Winch winch;
        QPlcNodeRunner runner(winch, std::chrono::seconds(1));
        QVERIFY(runner.bind(m_table) && runner.initialize());
        runner.set("tetherSpeed", 10.0);
        while (!runner.wantsSafeStop() && runner.nextCycle() < 100)
            runner.step();
        QCOMPARE(runner.value("tetherLength").toReal(), 410.0);
        runner.step();
        QVERIFY(runner.isSafe() && winch.isBraked);
    }
};
QTEST_APPLESS_MAIN(tst_Winch)
#include "tst_Winch.moc"
