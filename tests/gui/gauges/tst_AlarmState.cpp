// SPDX-License-Identifier: Apache-2.0
#include "gui/gauges/AlarmState.h"

#include <QtTest/QTest>

#include <limits>

using qplc::AlarmLimits;
using qplc::AlarmState;

namespace {

AlarmLimits limitsOfAll()
{
    return {-20.0, -10.0, 10.0, 20.0, 2.0};
}

/// The levels of values one after another: "-" normal, "w" and "W" warning low and high, "a" and
/// "A" alarm.
QString levelsOf(const AlarmLimits &limits, const QVector<double> &values)
{
    AlarmState state;
    state.setLimits(limits);
    QString levels;
    for (const double value : values) {
        state.update(value);
        const char letter = state.level() == AlarmState::Alarm ? 'a' : state.level() == AlarmState::Warning ? 'w' : '-';
        const QLatin1Char sign(letter);
        levels += state.side() == AlarmState::High ? QChar(sign).toUpper() : QChar(sign);
    }
    return levels;
}

}  // namespace

class tst_AlarmState : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void levelsFollowValues_data();
    void levelsFollowValues();
    void newLimitsResetTheLevel();
};

void tst_AlarmState::levelsFollowValues_data()
{
    QTest::addColumn<QString>("expected");
    QTest::addColumn<QVector<double>>("values");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    QTest::newRow("up and down") << "-WAAWW-" << QVector<double>{0, 11, 21, 19, 17, 9, 7};
    QTest::newRow("down and up") << "-waaww-" << QVector<double>{0, -11, -21, -19, -17, -9, -7};
    QTest::newRow("a limit itself is normal") << "--" << QVector<double>{10, -10};
    QTest::newRow("trembles about a limit") << "-WWWWW" << QVector<double>{9.9, 10.1, 9.9, 10.1, 8.1, 10.1};
    QTest::newRow("back by the hysteresis ends it") << "W-" << QVector<double>{10.1, 8.0};
    QTest::newRow("below is not held before it began") << "--W" << QVector<double>{9.5, 9.9, 10.1};
    QTest::newRow("from one side to the other") << "Aa" << QVector<double>{21, -21};
    QTest::newRow("the hysteresis of one side is not that of the other") << "A-" << QVector<double>{21, -9.5};
    QTest::newRow("an alarm ends as a warning") << "AW" << QVector<double>{21, 17.9};
    QTest::newRow("no number") << "A-W" << QVector<double>{21, nan, 19};
    QTest::newRow("infinities") << "Aa" << QVector<double>{infinity, -infinity};
}

void tst_AlarmState::levelsFollowValues()
{
    QFETCH(QString, expected);
    QFETCH(QVector<double>, values);
    QCOMPARE(levelsOf(limitsOfAll(), values), expected);
    QCOMPARE(levelsOf({}, values), QString(values.size(), QLatin1Char('-')));
}

void tst_AlarmState::newLimitsResetTheLevel()
{
    AlarmState state;
    state.setLimits(limitsOfAll());
    state.update(10.1);
    QCOMPARE(state.level(), AlarmState::Warning);
    state.setLimits(limitsOfAll());
    QCOMPARE(state.level(), AlarmState::Normal);
    state.update(9.9);
    QCOMPARE(state.level(), AlarmState::Normal);
}

QTEST_APPLESS_MAIN(tst_AlarmState)
#include "tst_AlarmState.moc"
