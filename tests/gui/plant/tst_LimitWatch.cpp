// SPDX-License-Identifier: Apache-2.0
#include "PlantFixtures.h"
#include "gui/plant/LimitAlarms.h"
#include "gui/plant/PlantFeed.h"

#include <QtTest/QtTest>

#include <limits>

using namespace qplc;

namespace {

constexpr LimitWatch::Time millisecond = 1'000'000;

QPlcSignalTable limitedTable()
{
    return QPlcSignalTable::fromIni("[free]\ntype = Real\n[speed]\ntype = Real\nunit = m/s\nmin = -10\nmax = 10\n"
                                    "[force]\ntype = Real[2]\nmax = 5\n");
}

/// Rows one millisecond apart, and what a watch tells of them: "+speed 12", "-speed 12 after 500".
class Rows
{
public:
    Rows() { m_watch.setTable(m_table, m_channels, &store); }

    void add(int count, float speed, float secondForce = 0.0F, float free = 1e9F)
    {
        const float values[] = {free, speed, 0.0F, secondForce};
        for (int i = 0; i < count; ++i)
            store.append(++m_rows * millisecond, values);
    }
    QStringList told()
    {
        QStringList texts;
        for (const LimitWatch::Change &change : m_watch.check(store)) {
            const QString name = QStringLiteral("%1[%2]").arg(m_table.at(change.signal).name).arg(change.element);
            texts << (change.isOutside ? QStringLiteral("+%1 %2").arg(name).arg(change.farthest)
                                       : QStringLiteral("-%1 %2 after %3")
                                             .arg(name)
                                             .arg(change.farthest)
                                             .arg((change.time - change.since) / millisecond));
        }
        return texts;
    }

    SignalStore store{4, 10'000};

private:
    const QPlcSignalTable m_table = limitedTable();
    const ChannelMap m_channels{m_table};
    LimitWatch m_watch;
    int m_rows = 0;
};

}  // namespace

class tst_LimitWatch : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void valuesWithinLimitsCauseNoAlarm();
    void limitViolationAndReturnAreEachReportedOnce();
    void singleViolatingRowBetweenTwoChecksIsReported();
    void oscillationAboutTheLimitIsOneViolation();
    void everyElementHasAnAlarmOfItsOwn();
    void nanIsNotOutside();
    void earlierRowsCauseNoAlarm();
    void anAlarmOfAPlantIsActiveWhileItLasts();
};

void tst_LimitWatch::valuesWithinLimitsCauseNoAlarm()
{
    Rows rows;
    QCOMPARE(rows.told(), QStringList());
    rows.add(100, 10.0F);
    rows.add(100, -10.0F);
    QCOMPARE(rows.told(), QStringList());
}

void tst_LimitWatch::limitViolationAndReturnAreEachReportedOnce()
{
    Rows rows;
    rows.add(10, 11.0F);
    QCOMPARE(rows.told(), QStringList{"+speed[0] 11"});
    rows.add(90, 12.0F);
    rows.add(100, -3.0F);
    QCOMPARE(rows.told(), QStringList());
    rows.add(899, -3.0F);
    QCOMPARE(rows.told(), QStringList());
    rows.add(1, -3.0F);
    QCOMPARE(rows.told(), QStringList{"-speed[0] 12 after 100"});
    rows.add(1, -20.0F);
    QCOMPARE(rows.told(), QStringList{"+speed[0] -20"});
}

void tst_LimitWatch::singleViolatingRowBetweenTwoChecksIsReported()
{
    Rows rows;
    rows.add(500, 0.0F);
    rows.add(1, 10.5F);
    rows.add(5000, 0.0F);
    QCOMPARE(rows.told(), (QStringList{"+speed[0] 10.5", "-speed[0] 10.5 after 1"}));
}

void tst_LimitWatch::oscillationAboutTheLimitIsOneViolation()
{
    Rows rows;
    QStringList told;
    for (int i = 0; i < 20; ++i) {
        rows.add(50, 10.01F);
        rows.add(50, 9.99F);
        told += rows.told();
    }
    QCOMPARE(told.size(), 1);
    rows.add(1000, 9.0F);
    QCOMPARE(rows.told(), QStringList{"-speed[0] 10.01 after 1950"});
}

void tst_LimitWatch::everyElementHasAnAlarmOfItsOwn()
{
    Rows rows;
    rows.add(10, 11.0F, 6.0F);
    QCOMPARE(rows.told(), (QStringList{"+speed[0] 11", "+force[1] 6"}));
}

void tst_LimitWatch::nanIsNotOutside()
{
    Rows rows;
    rows.add(10, std::numeric_limits<float>::quiet_NaN());
    QCOMPARE(rows.told(), QStringList());
}

void tst_LimitWatch::earlierRowsCauseNoAlarm()
{
    const QPlcSignalTable table = limitedTable();
    const ChannelMap channels(table);
    SignalStore store(4, 100);
    const float outside[] = {0.0F, 99.0F, 0.0F, 0.0F};
    store.append(1, outside);
    LimitWatch watch;
    watch.setTable(table, channels, &store);
    QVERIFY(watch.check(store).empty());
    store.append(2, outside);
    QCOMPARE(int(watch.check(store).size()), 1);
    watch.setTable(table, channels, nullptr);
    QVERIFY(watch.check(SignalStore(4, 100)).empty());
}

void tst_LimitWatch::anAlarmOfAPlantIsActiveWhileItLasts()
{
    const QPlcSignalTable table = limitedTable();
    QPlcSignalIndexTable::setCurrent(table);
    PlantList plants;
    LimitAlarms alarms(&plants);
    QSignalSpy events(&alarms, &LimitAlarms::eventOccurred);
    Plant *plant = plants.addFed(QStringLiteral("kite"));
    plant->feed()->connected(table);
    plant->feed()->started();
    LimitWatch::Time now = 1'700'000'000'000 * millisecond;
    const auto feed = [&](double speed) {
        now += 100 * millisecond;
        plant->feed()->add({valueOf("speed", QPlcValue(float(speed)))}, now);
    };
    feed(1.0);
    QVERIFY(events.isEmpty());
    feed(12.5);
    QCOMPARE(events.size(), 1);
    const auto begin = events.at(0).at(0).value<PlantEvent>();
    QCOMPARE(begin.stage, PlantEvent::Begins);
    QCOMPARE(begin.severity, PlantEvent::Warning);
    QCOMPARE(begin.source, QStringLiteral("kite"));
    QCOMPARE(begin.alarm, QStringLiteral("limits of speed"));
    QCOMPARE(begin.text, QStringLiteral("speed = 12.5 m/s is outside of its limits, -10 ... 10"));
    for (int i = 0; i < 20; ++i)
        feed(2.0);
    QCOMPARE(events.size(), 2);
    const auto end = events.at(1).at(0).value<PlantEvent>();
    QCOMPARE(end.stage, PlantEvent::Ends);
    QCOMPARE(end.severity, PlantEvent::Information);
    QCOMPARE(end.alarm, begin.alarm);
    QVERIFY(end.time > begin.time);
    QVERIFY2(end.text.startsWith(QStringLiteral("speed is within its limits again, after 0."))
                 && end.text.endsWith(QStringLiteral("the farthest value was 12.5 m/s")),
             qPrintable(end.text));
}

QTEST_MAIN(tst_LimitWatch)
#include "tst_LimitWatch.moc"
