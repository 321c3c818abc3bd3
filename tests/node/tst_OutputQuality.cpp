// SPDX-License-Identifier: Apache-2.0
// Nodes that say how far their outputs can be trusted, and nodes that ask for a safe stop.
#include "../common/Waiting.h"
#include "NodeFixtures.h"
#include "ScriptedMaster.h"
#include "ScriptedNode.h"

namespace {

QPlcSignalTable sensorTable()
{
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromIni(
        "[angle]\ntype = Real64\nmin = -100\nmax = 100\nsafe = -5\ninitial = 1\n"
        "[force]\ntype = Real32\nsafe = 9\n[shared]\ntype = Real64\nwriter = Sensor > Spare\n",
        &errors);
    Q_ASSERT_X(errors.isEmpty(), "sensorTable", qPrintable(QPlcParseError::toString(errors)));
    return table;
}

/// Measures "angle", which is the number of the cycle, as well as the test wants; its "force" is
/// always good.
class Sensor : public QPlcCompactSlaveNode
{
public:
    explicit Sensor(const QString &name = QStringLiteral("Sensor"))
        : QPlcCompactSlaveNode(name)
    {
        setSendsQuality(true);
    }
    std::function<QPlcQuality(qint64)> idea;  // of a cycle; -1: at the initialization
    std::function<void(const QPlcCycle &)> onStep;
    QPlcOutput<double> m_angle{this, "angle"};
    QPlcOutput<float> m_force{this, "force"};

private:
    void reset() override
    {
        m_force = 2.0F;
        m_angle = 0.5;
        m_angle.setQuality(idea ? idea(-1) : QPlcQuality::Good);
    }
    void step(const QPlcCycle &cycle) override
    {
        m_angle = double(cycle.number());
        m_angle.setQuality(idea ? idea(qint64(cycle.number())) : QPlcQuality::Good);
        if (onStep)
            onStep(cycle);
    }
};

/// Writes down what it was told in each cycle: "7 good".
class Reader : public QPlcCompactSlaveNode
{
public:
    explicit Reader(QPlcInputTiming::Value timing = QPlcInputTiming::LastCycle)
        : QPlcCompactSlaveNode(QStringLiteral("Reader"))
        , m_angle(this, "angle", timing)
    {
        setReceivesQuality(true);
    }
    QStringList record;
    QStringList forces;
    QStringList ends;

private:
    void reset() override { record.clear(); }
    void step(const QPlcCycle &) override
    {
        record << QStringLiteral("%1 %2").arg(m_angle.value()).arg(m_angle.quality().toString());
        forces << QStringLiteral("%1 %2").arg(double(m_force.value())).arg(m_force.quality().toString());
    }
    void safeState(SafeStateReason) override { ends << QStringLiteral("safe"); }
    QPlcInput<double> m_angle;
    QPlcInput<float> m_force{this, "force"};
};

/// One of two writers of "shared".
class Writer : public QPlcCompactSlaveNode
{
public:
    Writer(const QString &name, double value)
        : QPlcCompactSlaveNode(name)
        , m_value(value)
    {
        setSendsQuality(true);
    }
    std::function<QPlcQuality(qint64)> idea;

private:
    void reset() override { m_shared = m_value; }
    void step(const QPlcCycle &cycle) override
    {
        m_shared = m_value;
        m_shared.setQuality(idea ? idea(qint64(cycle.number())) : QPlcQuality::Good);
    }
    double m_value;
    QPlcOutput<double> m_shared{this, "shared"};
};

void addKinds()
{
    QTest::addColumn<QString>("kind");
    for (const char *kind : {"local", "tcp", "udp"})
        QTest::newRow(kind) << QString(kind);
}

}  // namespace

class tst_OutputQuality : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void anOutputWithoutAValueIsHeldAndThenSafe_data() { addKinds(); }
    void anOutputWithoutAValueIsHeldAndThenSafe();
    void heldOutputHasTheAgeOfItsWriter();
    void sameCycleReaderGetsQualityInTheSameCycle();
    void aSensorThatNeverMeasuredLeavesItsSignalInvalid();
    void contentOfAnInvalidOutputIsNotChecked();
    void otherWriterReplacesAWriterWithoutAValue();
    void outputsWithoutQualityAreGood();
    void nodeWithOutputQualityRefusesAnOlderMaster();
    void aNodeMayAskForASafeStop_data() { addKinds(); }
    void aNodeMayAskForASafeStop();
    void safeStopRequestEndsWithItsPhase();
};

void tst_OutputQuality::anOutputWithoutAValueIsHeldAndThenSafe()
{
    QFETCH(QString, kind);
    TestMaster master(QPlcClock::lockstep(), sensorTable());
    QVERIFY(master.listen());
    Sensor sensor;
    sensor.idea = [](qint64 cycle) { return cycle >= 3 && cycle < 9 ? QPlcQuality::Invalid : QPlcQuality::Good; };
    Reader reader;
    QVERIFY(master.admit(sensor, kind) && master.admit(reader, kind));
    master.setCycleLimit(12);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(reader.record,
             (QStringList{"0.5 good", "0 good", "1 good", "2 good", "2 held 1", "2 held 2", "2 held 3", "-5 safe",
                          "-5 safe", "-5 safe", "9 good", "10 good"}));
    QCOMPARE(reader.forces.filter("2 good").size(), 12);  // the others of the same node go on
    QCOMPARE(sensor.m_angle.quality().kind(), QPlcQuality::Good);
    sensor.disconnectFromMaster();
    reader.disconnectFromMaster();
}

void tst_OutputQuality::heldOutputHasTheAgeOfItsWriter()
{
    TestMaster master(QPlcClock::lockstep(), sensorTable());
    Sensor sensor;
    sensor.idea = [](qint64 cycle) { return QPlcQuality::held(cycle < 2 ? 0 : cycle - 1); };  // 1, 2, 3, 4, ...
    Reader reader;
    QVERIFY(master.addLocalNode(&sensor) && master.addLocalNode(&reader));
    master.setCycleLimit(8);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(reader.record,
             (QStringList{"0.5 good", "0 good", "1 good", "2 held 1", "3 held 2", "4 held 3", "-5 safe", "-5 safe"}));
}

void tst_OutputQuality::sameCycleReaderGetsQualityInTheSameCycle()
{
    TestMaster master(QPlcClock::lockstep(), sensorTable());
    Sensor sensor;
    sensor.idea = [](qint64 cycle) { return cycle == 2 ? QPlcQuality::Invalid : QPlcQuality::Good; };
    Reader reader(QPlcInputTiming::SameCycle);
    QVERIFY(master.addLocalNode(&sensor) && master.addLocalNode(&reader));
    master.setCycleLimit(5);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(reader.record, (QStringList{"0 good", "1 good", "1 held 1", "3 good", "4 good"}));
}

void tst_OutputQuality::aSensorThatNeverMeasuredLeavesItsSignalInvalid()
{
    TestMaster master(QPlcClock::lockstep(), sensorTable());
    Sensor sensor;
    sensor.idea = [](qint64 cycle) { return cycle < 4 ? QPlcQuality::Invalid : QPlcQuality::Good; };
    Reader reader;
    QVERIFY(master.addLocalNode(&sensor) && master.addLocalNode(&reader));
    master.setCycleLimit(7);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(reader.record,
             (QStringList{"1 invalid", "1 invalid", "1 invalid", "1 invalid", "1 invalid", "4 good", "5 good"}));
}

void tst_OutputQuality::contentOfAnInvalidOutputIsNotChecked()
{
    TestMaster master(QPlcClock::lockstep(), sensorTable());
    Sensor sensor;
    sensor.idea = [](qint64) { return QPlcQuality::Invalid; };
    sensor.onStep = [&](const QPlcCycle &) { sensor.m_angle = qQNaN(); };
    LogCapture log;
    QVERIFY(master.addLocalNode(&sensor));
    master.setCycleLimit(5);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(master.error(), QPlcMasterNode::NoError);
    QVERIFY2(log.matching("angle").isEmpty(), qPrintable(log.all().join('\n')));  // no alarm
}

void tst_OutputQuality::otherWriterReplacesAWriterWithoutAValue()
{
    TestMaster master(QPlcClock::lockstep(), sensorTable());
    Writer first("Sensor", 1.0);
    Writer second("Spare", 2.0);
    first.idea = [](qint64 cycle) { return cycle < 10 ? QPlcQuality::Good : QPlcQuality::Invalid; };
    QVERIFY(master.addLocalNode(&first) && master.addLocalNode(&second));
    master.setCycleLimit(10);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(master.signalValue("shared").toReal(), 1.0);
    master.setCycleLimit(11);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(master.signalValue("shared").toReal(), 2.0);
    QCOMPARE(master.signalQuality("shared").kind(), QPlcQuality::Good);
}

void tst_OutputQuality::outputsWithoutQualityAreGood()
{
    TestMaster master(QPlcClock::lockstep(), sensorTable());
    Sensor sensor;
    sensor.setSendsQuality(false);
    sensor.idea = [](qint64) { return QPlcQuality::Invalid; };
    Reader reader;
    QVERIFY(master.addLocalNode(&sensor) && master.addLocalNode(&reader));
    master.setCycleLimit(3);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(reader.record, (QStringList{"0.5 good", "0 good", "1 good"}));
}

void tst_OutputQuality::nodeWithOutputQualityRefusesAnOlderMaster()
{
    ScriptedMaster master;
    Sensor sensor;
    QSignalSpy failed(&sensor, &QPlcSlaveNode::errorOccurred);
    sensor.connectToMaster(master.udp());
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);
    master.send(QPlcMessage::Hello, master.helloFields());
    QTRY_COMPARE(failed.size(), 1);
    QCOMPARE(sensor.error(), QPlcSlaveNode::RegistrationError);
    QVERIFY2(sensor.errorString().contains(
                 "does not know qualities of outputs, which node 'Sensor' needs; update the master"),
             qPrintable(sensor.errorString()));
    QCOMPARE(sensor.state(), QPlcSlaveNode::Rejected);
}

void tst_OutputQuality::aNodeMayAskForASafeStop()
{
    QFETCH(QString, kind);
    TestMaster master(QPlcClock::lockstep(), sensorTable());
    QVERIFY(master.listen());
    Sensor sensor;
    sensor.onStep = [&](const QPlcCycle &cycle) {
        if (cycle.number() == 20)
            sensor.requestSafeStop();
    };
    Reader reader;
    QVERIFY(master.admit(sensor, kind) && master.admit(reader, kind));
    LogCapture log;
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::SafeStop));
    QVERIFY2(master.stateReason().contains("node 'Sensor' asked for it in cycle 20"), qPrintable(master.stateReason()));
    QTRY_COMPARE(reader.ends, QStringList{"safe"});
    QCOMPARE(reader.record.size(), 21);  // computed in cycles 0 ... 20; told to be safe in the next one
    sensor.disconnectFromMaster();
    reader.disconnectFromMaster();
}

void tst_OutputQuality::safeStopRequestEndsWithItsPhase()
{
    TestMaster master(QPlcClock::lockstep(), sensorTable());
    Sensor sensor;
    bool isPressed = true;
    sensor.onStep = [&](const QPlcCycle &) {
        if (isPressed)
            sensor.requestSafeStop();
    };
    QVERIFY(master.addLocalNode(&sensor));
    LogCapture log;
    sensor.requestSafeStop();  // before the phase: without effect
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::SafeStop));
    isPressed = false;
    QVERIFY(master.reset());
    master.setCycleLimit(5);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(master.statistics().cycles, quint64(5));
}

QTEST_GUILESS_MAIN(tst_OutputQuality)
#include "tst_OutputQuality.moc"
