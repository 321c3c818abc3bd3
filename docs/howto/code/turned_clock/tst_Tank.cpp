// SPDX-License-Identifier: Apache-2.0
#include <QtPlcCore>
#include <QtTest/QTest>
using StepResult = QPlcMasterNode::StepResult;

/// The node that is tested.
class Tank : public QPlcCompactSlaveNode
{
public:
    Tank()
        : QPlcCompactSlaveNode(QStringLiteral("Tank"))
    {
    }

private:
    QPlcInput<double> m_inflow{this, "inflow", QPlcInputTiming::SameCycle};  // [l/s]
    QPlcOutput<double> m_level{this, "level"};                               // [l]
    void reset() override { m_level = 5.0; }
    void step(const QPlcCycle &cycle) override { m_level = m_level + m_inflow * cycle.dt(); }
};

/// Gives the plant what the test writes into its port.
class Given : public QPlcCompactSlaveNode
{
public:
    Given()
        : QPlcCompactSlaveNode(QStringLiteral("Given"))
    {
    }
    QPlcOutput<double> inflow{this, "inflow"};  // [l/s]
private:
    void step(const QPlcCycle &) override {}
};

/// Takes from the plant what the test reads.
class Seen : public QPlcCompactSlaveNode
{
public:
    Seen()
        : QPlcCompactSlaveNode(QStringLiteral("Seen"))
    {
    }
    QPlcInput<double> level{this, "level", QPlcInputTiming::SameCycle};  // [l]
private:
    void step(const QPlcCycle &) override {}
};

class tst_Tank : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void levelRisesByTheInflow()
    {
        QPlcMasterNode master;
        master.setSignalTable(QPlcSignalTable::fromIni("[inflow]\ntype = Real64\n[level]\ntype = Real64\n"));
        master.setInterval(0.25);
        master.setClock(QPlcClock::external());
        Given given;
        Tank tank;
        Seen seen;
        QVERIFY(master.addLocalNode(&given) && master.addLocalNode(&tank) && master.addLocalNode(&seen));
        QVERIFY2(master.startRealTime(), qPrintable(master.errorString()));
        given.inflow = 2.0;
        QCOMPARE(master.step(), StepResult::Complete);
        QCOMPARE(double(seen.level), 5.5);
        given.inflow = 0.0;
        QCOMPARE(master.step(), StepResult::Complete);
        QCOMPARE(double(seen.level), 5.5);
        master.stop();
    }
};
QTEST_GUILESS_MAIN(tst_Tank)
#include "tst_Tank.moc"
