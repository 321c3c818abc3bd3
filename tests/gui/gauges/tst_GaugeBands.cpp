// SPDX-License-Identifier: Apache-2.0
// Bands of warning and alarm of a gauge, without a window.
#include "NodeFixtures.h"
#include "gui/gauges/GaugeFeed.h"

#include <QtCore/QJsonObject>

using namespace qplc;

namespace {

QPlcSignalTable levelTable()
{
    return QPlcSignalTable::fromIni("[level]\ntype = Real\nunit = m\nmin = 0\nmax = 100\n");
}

GaugeSettings settingsOf(const QJsonObject &json)
{
    PanelSettings settings = GaugeSettings::emptyJson();
    settings.take(json);
    return GaugeSettings::from(settings);
}

}  // namespace

class tst_GaugeBands : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void bandsReportTheirLevelWithHysteresis();
    void valuesBeyondTheTableLimitsAreAlarms();
};

void tst_GaugeBands::bandsReportTheirLevelWithHysteresis()
{
    QPlcSignalIndexTable::setCurrent(levelTable());
    GaugeFeed feed;
    feed.setSettings(settingsOf({{"signal", "level"}, {"warningHigh", 50}, {"alarmHigh", 80}, {"alarmLow", 10}}));
    feed.setActive(true);
    const QPlcSignalIndex index = QPlcSignalIndexTable::index(QStringLiteral("level"));
    const auto status = [&](float value) {
        QPlcSignalList list;
        list.insert(index, value);
        feed.add({list}, index);
        return feed.picture().status;
    };
    QCOMPARE(feed.picture().bands.size(), 3);
    QCOMPARE(status(49.5f), QString());
    QCOMPARE(status(50.5f), QStringLiteral("▲ high"));
    QCOMPARE(status(49.5f), QStringLiteral("▲ high"));  // 1 % of the scale
    QCOMPARE(status(48.9f), QString());
    QCOMPARE(status(81.0f), QStringLiteral("▲▲ high high"));
    QCOMPARE(status(9.0f), QStringLiteral("▼▼ low low"));
    feed.setSettings(settingsOf({{"signal", "level"}, {"warningHigh", 50}, {"hysteresis", 0}}));
    QCOMPARE(status(50.5f), QStringLiteral("▲ high"));
    QCOMPARE(status(49.9f), QString());
}

void tst_GaugeBands::valuesBeyondTheTableLimitsAreAlarms()
{
    QPlcSignalIndexTable::setCurrent(levelTable());
    GaugeFeed feed;
    feed.setActive(true);
    const auto bands = [&](const QJsonObject &settings) {
        feed.setSettings(settingsOf(settings));
        QStringList texts;
        for (const GaugePicture::Band &band : feed.picture().bands)
            texts << QStringLiteral("%1 ... %2: %3").arg(band.begin).arg(band.end).arg(band.level);
        return texts.join(QStringLiteral(", "));
    };
    QCOMPARE(bands({{"signal", "level"}}), QString());  // the scale is what the table allows
    QCOMPARE(bands({{"signal", "level"}, {"minimum", -50}, {"maximum", 150}}),
             QStringLiteral("-50 ... 0: 2, 100 ... 150: 2"));
    QCOMPARE(bands({{"signal", "level"}, {"maximum", 150}, {"alarmHigh", 120}}), QStringLiteral("120 ... 150: 2"));
}

QTEST_MAIN(tst_GaugeBands)
#include "tst_GaugeBands.moc"
