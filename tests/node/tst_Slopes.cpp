// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "NodeFixtures.h"
#include "ScriptedNode.h"
#include "VirtualTime.h"
#include "node/cycle/SlopeLimits.h"

#include <cmath>
#include <mutex>
#include <vector>

using namespace std::chrono_literals;

namespace {

constexpr double period = 0.002;  // [s]
constexpr double slope = 5.0;     // [m/s per second]
constexpr double step = slope * period;

QPlcSignalTable slopeTable()
{
    return QPlcSignalTable::fromIni(R"(
[speed]
type = Real64
slope = 5 per second
hold = 1000
[drive]
type = Real64
slope = 5 per second
safe = -0.5
hold = 1000
[vector]
type = Real32[3]
slope = 5 per second
[free]
type = Real64
[far]
type = Real64
slope = 5 per second
)");
}

/// Writes "drive", and keeps what it reads in each cycle.
class Recorder : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    Recorder()
        : QPlcCompactSlaveNode(QStringLiteral("Recorder"))
    {
    }
    std::vector<double> take()
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        return std::exchange(m_values, {});
    }

protected:
    void reset() override { m_drive = 2.0; }
    void step(const QPlcCycle &) override
    {
        m_drive = 2.0;
        const std::lock_guard<std::mutex> lock(m_mutex);
        m_values.push_back(m_speed);
    }

private:
    std::mutex m_mutex;
    std::vector<double> m_values;
    QPlcInput<double> m_speed{this, "speed"};
    QPlcOutput<double> m_drive{this, "drive"};
};

}  // namespace

/// Values that people and programs set move signals no faster than the table allows.
class tst_Slopes : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    /// Before the node that runs in its cycles is destroyed.
    void cleanup() { m_master->stop(); }
    void aSignalMovesBySlopeTimesPeriodInEachCycle();
    void eachElementOfAnArrayMovesOnItsOwn();
    void newTargetStartsFromThePresentValue();
    void aLostLeaseMovesToTheNeutralValue();
    void newHolderKeepsThePresentValue();
    void aSignalMovesToTheValueWithWhichItIsTaken();
    void renewedLeaseKeepsTheTarget();
    void releasedSignalFollowsItsWriterWithoutSlope();
    void aWriterThatJoinsEndsTheWayOfItsSignal_data();
    void aWriterThatJoinsEndsTheWayOfItsSignal();
    void safeStopIgnoresTheSlope();
    void slopeIsIgnoredWithoutCycles();
    void aWayEndsWithItsPhase();
    void aSettingForAWhileComesBackToWhereTheWayEnded();
    void thereIsNoWayFromInfinity();
    void theNeighbourOfAMovingSignalStays();
    void onlySignalsThatAreLeftStop();

private:
    bool set(const QString &name, const QString &value)
    {
        return m_tool->ask(QPlcMessage::SetSignals, {{"values", QJsonObject{{name, value}}}}).kind()
            == QPlcMessage::Done;
    }
    bool take(const QString &name)
    {
        return m_tool->ask(QPlcMessage::TakeLease, {{"signals", QJsonArray{name}}, {"timeout", 3.6e12}}).kind()
            == QPlcMessage::Done;
    }
    double number(const QString &name) const { return m_master->signalValue(name).toReal(); }
    bool stays(const QString &name, double value)
    {
        bool stayed = true;
        for (int look = 0; stayed && look < 30; ++look)
            stayed = m_master->waitForCycles(m_master->statistics().cycles + 1) && number(name) == value;
        return stayed;
    }
    /// Reads \a name until it is \a last. \return the largest change between two cycles that follow
    /// each other
    double largestChange(const QString &name, double last);

    QScopedPointer<TestMaster> m_master;
    QScopedPointer<Recorder> m_recorder;
    QScopedPointer<ScriptedTool> m_tool;
};

void tst_Slopes::init()
{
    m_tool.reset();
    m_recorder.reset(new Recorder);
    m_master.reset(new TestMaster(QPlcClock::realTime(), slopeTable()));
    m_master->setInterval(period);
    QVERIFY(m_master->listen());
    m_tool.reset(new ScriptedTool("Anna"));
    QVERIFY(m_tool->greetAt(m_master->serverPort()));
    QVERIFY(m_master->addLocalNode(m_recorder.data()));
    QVERIFY(m_master->startRealTime());
    QVERIFY(m_tool->waitForMessage(QPlcMessage::StatesInitialized));
    QVERIFY(m_master->waitForCycles(3));
    m_tool->forgetMessages();
}

double tst_Slopes::largestChange(const QString &name, double last)
{
    double largest = 0.0;
    double before = number(name);
    quint64 cycle = m_master->cycle();
    while (before != last) {
        const quint64 nextCycle = m_master->cycle();
        const double now = number(name);  // of that cycle, or of a later one
        if (now != before && nextCycle >= cycle) {
            const double cycles = double(m_master->cycle() - cycle) + 1.0;
            largest = std::max(largest, std::abs(now - before) / cycles);
        }
        before = now;
        cycle = nextCycle;
        pass(1ms);
    }
    return largest;
}

void tst_Slopes::aSignalMovesBySlopeTimesPeriodInEachCycle()
{
    m_recorder->take();
    QVERIFY(set("speed", "1"));
    QTRY_COMPARE(number("speed"), 1.0);
    QVERIFY(m_master->waitForCycles(m_master->statistics().cycles + 5));
    std::vector<double> values = m_recorder->take();
    values.insert(values.begin(), 0.0);  // before the first cycle that is kept
    int moves = 0;
    for (std::size_t i = 1; i < values.size(); ++i) {
        if (values[i] == values[i - 1])
            continue;
        ++moves;
        QVERIFY2(std::abs(values[i] - std::min(1.0, values[i - 1] + step)) < 1e-12,
                 qPrintable(QStringLiteral("%1 after %2").arg(values[i]).arg(values[i - 1])));
    }
    QCOMPARE(moves, 100);
    QCOMPARE(values.back(), 1.0);
    QVERIFY(set("free", "1"));  // another signal has no slope
    QTRY_COMPARE(number("free"), 1.0);
}

void tst_Slopes::eachElementOfAnArrayMovesOnItsOwn()
{
    QVERIFY(set("vector", "0.1, -0.2, 0"));
    for (QString text; (text = m_master->signalValue("vector").toString()) != QLatin1String("0.1, -0.2, 0");) {
        const QPlcValue value = m_master->signalValue("vector");
        QVERIFY2(value.toReal(0) <= 0.1f && value.toReal(1) >= -0.2f && value.toReal(2) == 0.0, qPrintable(text));
        // Both elements have come as far, until the first one is there.
        QVERIFY2(value.toReal(0) >= 0.0999 || std::abs(value.toReal(0) + value.toReal(1)) < 1e-6, qPrintable(text));
        pass(1ms);
    }
}

void tst_Slopes::newTargetStartsFromThePresentValue()
{
    QVERIFY(set("speed", "10"));
    QTRY_VERIFY(number("speed") > 0.2);
    m_recorder->take();
    QVERIFY(set("speed", "0"));
    QTRY_COMPARE(number("speed"), 0.0);
    const std::vector<double> values = m_recorder->take();
    for (std::size_t i = 1; i < values.size(); ++i)
        QVERIFY(std::abs(values[i] - values[i - 1]) < step + 1e-12);
    QVERIFY(*std::max_element(values.begin(), values.end()) < 9.0);
}

void tst_Slopes::aLostLeaseMovesToTheNeutralValue()
{
    QTRY_COMPARE(number("drive"), 2.0);
    QVERIFY(take("drive"));
    QVERIFY(m_master->waitForCycles(m_master->statistics().cycles + 5));
    QCOMPARE(number("drive"), 2.0);  // what was taken over stays
    m_tool.reset();                  // and the connection is lost
    QVERIFY(largestChange("drive", -0.5) <= step * 1.001);
}

/// On its way to the neutral value.
void tst_Slopes::newHolderKeepsThePresentValue()
{
    QVERIFY(take("drive"));
    QVERIFY(set("drive", "9"));
    QTRY_VERIFY(number("drive") > 4.0);
    m_tool.reset(new ScriptedTool("Bert"));  // Anna is lost
    QVERIFY(m_tool->greetAt(m_master->serverPort()));
    QTRY_VERIFY(number("drive") < 3.9);
    QVERIFY(take("drive"));
    QVERIFY(m_master->waitForCycles(m_master->statistics().cycles + 3));
    const double kept = number("drive");
    QVERIFY2(kept > -0.5, qPrintable(QString::number(kept)));
    QVERIFY(stays("drive", kept));
    QVERIFY(set("drive", "0.5"));  // and from there it goes where he wants it
    QTRY_COMPARE(number("drive"), 0.5);
}

void tst_Slopes::aSignalMovesToTheValueWithWhichItIsTaken()
{
    QTRY_COMPARE(number("drive"), 2.0);
    QCOMPARE(
        m_tool
            ->ask(QPlcMessage::TakeLease,
                  {{"signals", QJsonArray{"drive"}}, {"values", QJsonObject{{"drive", "2.5"}}}, {"timeout", 3.6e12}})
            .kind(),
        QPlcMessage::Done);
    QTRY_COMPARE(number("drive"), 2.5);
}

void tst_Slopes::renewedLeaseKeepsTheTarget()
{
    QVERIFY(take("drive"));
    QVERIFY(set("drive", "3"));
    QVERIFY(take("drive"));
    QTRY_COMPARE(number("drive"), 3.0);
}

void tst_Slopes::releasedSignalFollowsItsWriterWithoutSlope()
{
    QVERIFY(take("drive"));
    QVERIFY(set("drive", "-8"));
    QTRY_VERIFY(number("drive") < 1.5);
    QCOMPARE(m_tool->ask(QPlcMessage::ReleaseLease, {{"signals", QJsonArray{"drive"}}}).kind(), QPlcMessage::Done);
    QTRY_COMPARE(number("drive"), 2.0);
    QVERIFY(stays("drive", 2.0));  // and nothing pulls it away
}

void tst_Slopes::aWriterThatJoinsEndsTheWayOfItsSignal_data()
{
    QTest::addColumn<int>("cycles");
    QTest::newRow("that has begun") << 10;
    QTest::newRow("that would begin in the same cycle") << 0;
}

void tst_Slopes::aWriterThatJoinsEndsTheWayOfItsSignal()
{
    QFETCH(int, cycles);
    QVERIFY(set("speed", "1000"));
    QVERIFY(m_master->waitForCycles(m_master->statistics().cycles + quint64(cycles)));
    ScriptedNode writer("Writer");
    writer.table = slopeTable();
    writer.inputs.clear();
    writer.outputs = QStringList{"speed"};
    writer.initialValues = QPlcValue(-7.0).toBytes();
    writer.answerAll();
    QVERIFY(writer.registerAt(m_master->serverPort()));
    QTRY_COMPARE(number("speed"), -7.0);
    QVERIFY(m_master->waitForCycles(m_master->statistics().cycles + 5));
    m_recorder->take();
    QVERIFY(m_master->waitForCycles(m_master->statistics().cycles + 20));
    for (const double value : m_recorder->take())
        QCOMPARE(value, -7.0);  // no cycle reads what the way would have been
}

void tst_Slopes::safeStopIgnoresTheSlope()
{
    QVERIFY(take("drive"));
    QVERIFY(set("drive", "9"));
    QVERIFY(set("speed", "9"));  // without a holder: no one lets go of it
    QTRY_VERIFY(number("drive") > 2.3 && number("speed") > 0.3);
    m_master->safeStop();
    double before = number("drive");
    for (double now = before; now != -0.5; before = now) {
        now = number("drive");
        QVERIFY2(now == -0.5 || now >= before, qPrintable(QString::number(now)));  // no way down, but one jump
        pass(1ms);
    }
    QVERIFY(m_master->waitForCycles(m_master->statistics().cycles + 5));
    const double halted = number("speed");  // it has no safe value
    QVERIFY(halted < 9.0);
    for (int look = 0; look < 30; ++look) {  // and nothing goes on with its way
        QVERIFY(m_master->waitForCycles(m_master->statistics().cycles + 1));
        QCOMPARE(number("drive"), -0.5);
        QCOMPARE(number("speed"), halted);
    }
    m_master->stop();
    QCOMPARE(number("speed"), halted);
}

void tst_Slopes::slopeIsIgnoredWithoutCycles()
{
    QVERIFY(set("speed", "9"));
    QTRY_VERIFY(number("speed") > 0.0);
    m_master->stop();
    QCOMPARE(number("speed"), 9.0);  // as if no cycle had run
    QVERIFY(set("speed", "-3"));
    QCOMPARE(number("speed"), -3.0);
}

void tst_Slopes::aWayEndsWithItsPhase()
{
    QVERIFY(set("speed", "9"));
    QTRY_VERIFY(number("speed") > 0.0);
    m_master->stop();
    QVERIFY(set("speed", "-3"));
    QVERIFY(m_master->startRealTime());
    QVERIFY(m_master->waitForCycles(5));
    QCOMPARE(number("speed"), -3.0);  // and not where the way of before led
}

void tst_Slopes::aSettingForAWhileComesBackToWhereTheWayEnded()
{
    QVERIFY(set("speed", "10"));
    QTRY_VERIFY(number("speed") > 0.2);
    QVERIFY(take("speed"));  // ends the way
    QVERIFY(m_master->waitForCycles(m_master->statistics().cycles + 3));
    const double kept = number("speed");
    QCOMPARE(m_tool->ask(QPlcMessage::SetSignals, {{"values", QJsonObject{{"speed", "0"}}}, {"duration", 20e6}}).kind(),
             QPlcMessage::Done);
    QTRY_VERIFY(number("speed") < kept);
    QTRY_COMPARE(number("speed"), kept);
    QVERIFY(stays("speed", kept));
}

void tst_Slopes::thereIsNoWayFromInfinity()
{
    const QPlcSignalTable table = slopeTable();
    qplc::ProcessImage image(table);
    qplc::SlopeLimits slopes(image);
    const QPlcSignalIndex far = table.indexOf(QString("far"));
    image.setValue(far, QPlcValue(std::numeric_limits<double>::infinity()));
    slopes.aim(far, QPlcValue(2.0).toBytes().constData());
    slopes.advance(0.001);
    QCOMPARE(image.value(far).toReal(), 2.0);
    QVERIFY(!slopes.isMoving());
}

void tst_Slopes::theNeighbourOfAMovingSignalStays()
{
    const QPlcSignalTable table = slopeTable();
    qplc::ProcessImage image(table);
    qplc::SlopeLimits slopes(image);
    const QPlcSignalIndex speed = table.indexOf(QString("speed"));
    const QPlcSignalIndex drive = table.indexOf(QString("drive"));
    QCOMPARE(image.offset(drive), quint32(image.offset(speed) + sizeof(double)));
    image.setValue(drive, QPlcValue(7.0));
    slopes.aim(speed, QPlcValue(1.0).toBytes().constData());
    slopes.advance(0.1);
    QCOMPARE(image.value(speed).toReal(), 0.5);
    QCOMPARE(image.value(drive).toReal(), 7.0);
}

void tst_Slopes::onlySignalsThatAreLeftStop()
{
    const QPlcSignalTable table = slopeTable();
    qplc::ProcessImage image(table);
    qplc::SlopeLimits slopes(image);
    const QPlcSignalIndex speed = table.indexOf(QString("speed"));
    const QPlcSignalIndex far = table.indexOf(QString("far"));
    for (const QPlcSignalIndex signal : {speed, far})
        slopes.aim(signal, QPlcValue(1.0).toBytes().constData());
    std::vector<bool> written(std::size_t(std::min(speed, far)) + 1, true);  // the other one is beyond its end
    slopes.leaveAll(written);
    QVERIFY(slopes.isMoving());
    slopes.advance(0.001);
    QCOMPARE(image.value(std::min(speed, far)).toReal(), 0.0);
    QVERIFY(image.value(std::max(speed, far)).toReal() > 0.0);
    written.assign(std::size_t(table.size()), true);
    slopes.leaveAll(written);
    QVERIFY(!slopes.isMoving());
}

QTPLC_VIRTUAL_TIME_MAIN(tst_Slopes)
#include "tst_Slopes.moc"
