// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "PlantFixtures.h"
#include "QPlcGauge.h"
#include "QPlcPanelContext.h"
#include "gui/gauges/GaugeFeed.h"
#include "gui/panel/WindowContext.h"

#include <QtCore/QJsonDocument>
#include <QtWidgets/QCheckBox>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QLineEdit>

using namespace qplc;

namespace {

QPlcSignalTable gaugeTable()
{
    return QPlcSignalTable::fromIni(R"(
[level]
type = Real
unit = m
min = 0
max = 100
[turns]
type = Int32
[gate]
type = Bool
[vector]
type = Real64Triple
[matrix]
type = Real[9]
[label]
type = String
)");
}

GaugeSettings settingsOf(const QJsonObject &json)
{
    PanelSettings settings = GaugeSettings::emptyJson();
    settings.take(json);
    return GaugeSettings::from(settings);
}

/// A plant at rest whose master holds values, and a feed that shows one of its signals.
class FeedBench
{
public:
    explicit FeedBench(const QJsonObject &settings)
        : master(gaugeTable())
    {
        plant = context.plants()->add(master.address(), QStringLiteral("kite"));
        panel.setContext(&context);
        feed.setContext(panel.context());
        feed.setSettings(settingsOf(settings));
        feed.setActive(true);
    }
    bool isAtRest()
    {
        return waitUntil([this] { return plant->quality() == Plant::AtRest; });
    }
    void set(const char *signal, const QPlcValue &value)
    {
        plant->setValues({{QString(signal), value}});
        plant->refresh();
    }
    QString text(int element = 0) const
    {
        const QVector<GaugePicture::Value> values = feed.picture().values;
        return element < values.size() ? values.at(element).text : QString();
    }

    RunningMaster master;
    WindowContext context;
    Plant *plant;
    QPlcWidget panel;
    GaugeFeed feed;
};

}  // namespace

class tst_QPlcGauge : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void settingsAreRestoredByteForByte_data();
    void settingsAreRestoredByteForByte();
    void missingSettingsAreDefaults();
    void missingSignalAppearsWhenItsPlantConnects();
    void scaleUsesTheTableLimitsUnlessSet();
    void valueBeyondTheTableLimitsIsMarked();
    void integersBooleansAndTextsAreShownAsSuch();
    void aTripleIsThreeNumbersAndAMatrixAsksForAChoice();
    void aLostMasterLeavesAGreyValueWithItsAge();
    void thePastIsShownWithItsTime();
    void extremesCoverTheTimeSinceReset();
    void aHiddenGaugeDoesNothing();
    void droppedSignalsReplaceTheSignal();
    void gaugeOutsideAWindowReadsValuesOnRealTimeout();
    void editorAppliesChangesImmediately();
    void editorAcceptsFormulas();
    void theNumberOfASmallBarIsLarge();
    void aTitleStandsForTheName();
    void everyStyleIsDrawnAtEverySize();
};

void tst_QPlcGauge::settingsAreRestoredByteForByte_data()
{
    QTest::addColumn<QByteArray>("json");
    QTest::newRow("nothing") << QByteArray("{}");
    QTest::newRow("a default, written out") << QByteArray(R"({"signal":"level","style":"dial"})");
    QTest::newRow("all") << QByteArray(
        R"({"alarmHigh":9,"alarmLow":1,"extremes":true,"hysteresis":0.5,"maximum":10,"minimum":0,)"
        R"("signal":"a/b[2]","style":"led","title":"T","warningHigh":8,"warningLow":2})");
    QTest::newRow("of a later version") << QByteArray(R"({"needle":{"width":3},"signal":"level","style":"wheel"})");
    QTest::newRow("nonsense") << QByteArray(R"({"maximum":"high","signal":7})");
}

void tst_QPlcGauge::settingsAreRestoredByteForByte()
{
    QFETCH(QByteArray, json);
    QPlcGauge gauge;
    gauge.applySettings(QJsonDocument::fromJson(json).object());
    QCOMPARE(QJsonDocument(gauge.settings()).toJson(QJsonDocument::Compact), json);
    QCOMPARE(gauge.kind(), QStringLiteral("Gauge"));
}

void tst_QPlcGauge::missingSettingsAreDefaults()
{
    QPlcGauge gauge;
    gauge.applySettings({{"signal", "level"}, {"style", "bar"}});
    gauge.applySettings({{"signal", "level"}});
    QVERIFY(!gauge.settings().contains(QStringLiteral("style")));
}

void tst_QPlcGauge::missingSignalAppearsWhenItsPlantConnects()
{
    WindowContext context;
    QPlcWidget panel;
    panel.setContext(&context);
    GaugeFeed feed;
    feed.setContext(panel.context());
    feed.setActive(true);
    QVERIFY(feed.picture().message.contains(QStringLiteral("Drop one here")));
    feed.setSettings(settingsOf({{"signal", "level"}}));
    QVERIFY(feed.picture().message.contains(QStringLiteral("not there")));
    feed.setSettings(settingsOf({{"signal", "level[["}}));
    QVERIFY(!feed.picture().message.isEmpty());
    feed.setSettings(settingsOf({{"signal", "level"}}));
    RunningMaster master(gaugeTable());
    Plant *plant = context.plants()->add(master.address());
    QTRY_COMPARE(feed.picture().message, QString());
    QCOMPARE(feed.picture().prefix.unit(), QStringLiteral("m"));
    context.plants()->remove(plant);
    QVERIFY(feed.picture().message.contains(QStringLiteral("not there")));
}

void tst_QPlcGauge::scaleUsesTheTableLimitsUnlessSet()
{
    FeedBench bench({{"signal", "level"}});
    QVERIFY(bench.isAtRest());
    QTRY_COMPARE(bench.feed.picture().scale, (GaugeScale{0.0, 100.0}));
    QCOMPARE(bench.feed.picture().decimals, 1);
    bench.feed.setSettings(settingsOf({{"signal", "level"}, {"maximum", 50}}));
    QCOMPARE(bench.feed.picture().scale, (GaugeScale{0.0, 50.0}));
    bench.set("level", 60.0f);
    QTRY_VERIFY(bench.feed.picture().status.contains(QStringLiteral("off scale")));
    QCOMPARE(bench.feed.picture().level, AlarmState::Normal);
    bench.feed.setSettings(settingsOf({{"signal", "level"}, {"minimum", 7}, {"maximum", 3}}));
    QCOMPARE(bench.feed.picture().scale, (GaugeScale{7.0, 8.0}));
    bench.feed.setSettings(settingsOf({{"signal", "turns"}}));
    bench.set("turns", -30);
    QTRY_COMPARE(bench.feed.picture().scale, (GaugeScale{-50.0, 50.0}));
}

void tst_QPlcGauge::valueBeyondTheTableLimitsIsMarked()
{
    FeedBench bench({{"signal", "level"}});
    QVERIFY(bench.isAtRest());
    // A master refuses what is out of range; a node may write it.
    bench.set("level", 100.0f);
    QTRY_COMPARE(bench.text(), QStringLiteral("100.0"));
    QCOMPARE(bench.feed.picture().level, AlarmState::Normal);
    GaugeFeed feed;
    QPlcSignalIndexTable::setCurrent(gaugeTable());
    feed.setSettings(settingsOf({{"signal", "level"}}));
    feed.setActive(true);
    const QPlcSignalIndex index = QPlcSignalIndexTable::index(QStringLiteral("level"));
    const auto take = [&](float value) {
        QPlcSignalList list;
        list.insert(index, value);
        feed.add({list}, index);
    };
    take(100.5f);
    QCOMPARE(feed.picture().level, AlarmState::Alarm);
    QCOMPARE(feed.picture().status, QStringLiteral("▲ over range"));
    take(-0.5f);
    QCOMPARE(feed.picture().status, QStringLiteral("▼ under range"));
    take(std::numeric_limits<float>::quiet_NaN());
    QCOMPARE(feed.picture().status, QStringLiteral("not a number"));
    QCOMPARE(feed.picture().level, AlarmState::Warning);
    take(5.0f);
    QCOMPARE(feed.picture().status, QString());
    QCOMPARE(feed.picture().level, AlarmState::Normal);
}

void tst_QPlcGauge::integersBooleansAndTextsAreShownAsSuch()
{
    FeedBench bench({{"signal", "turns"}});
    QVERIFY(bench.isAtRest());
    bench.set("turns", 7);
    QTRY_COMPARE(bench.text(), QStringLiteral("7"));
    bench.feed.setSettings(settingsOf({{"signal", "gate"}, {"style", "led"}}));
    QCOMPARE(bench.text(), QStringLiteral("Off"));
    QVERIFY(bench.feed.picture().isBoolean);
    bench.set("gate", true);
    QTRY_COMPARE(bench.text(), QStringLiteral("On"));
    bench.feed.setSettings(settingsOf({{"signal", "label"}}));
    bench.set("label", QStringLiteral("reel out"));
    QTRY_COMPARE(bench.text(), QStringLiteral("reel out"));
    QCOMPARE(bench.feed.picture().style, GaugeStyle::Number);
}

void tst_QPlcGauge::aTripleIsThreeNumbersAndAMatrixAsksForAChoice()
{
    FeedBench bench({{"signal", "vector"}});
    QVERIFY(bench.isAtRest());
    bench.set("vector", QPlcValue({1.0, 2.0, 3.0}));
    QTRY_COMPARE(bench.text(2).left(1), QStringLiteral("3"));
    QCOMPARE(bench.feed.picture().style, GaugeStyle::Number);
    QCOMPARE(bench.feed.picture().values.size(), 3);
    bench.feed.setSettings(settingsOf({{"signal", "vector[1]"}}));
    QCOMPARE(bench.feed.picture().values.size(), 1);
    QCOMPARE(bench.feed.picture().style, GaugeStyle::Dial);
    QCOMPARE(bench.text().left(1), QStringLiteral("2"));
    bench.feed.setSettings(settingsOf({{"signal", "matrix"}}));
    QVERIFY(bench.feed.picture().message.contains(QStringLiteral("matrix[0]")));
}

void tst_QPlcGauge::aLostMasterLeavesAGreyValueWithItsAge()
{
    FeedBench bench({{"signal", "level"}});
    QVERIFY(bench.isAtRest());
    QTRY_COMPARE(bench.feed.picture().status, QStringLiteral("at rest"));
    QVERIFY(bench.feed.picture().isTrusted);
    bench.plant->close();
    QTRY_VERIFY(bench.feed.picture().status.startsWith(QStringLiteral("stale, ")));
    QVERIFY(!bench.feed.picture().isTrusted);
    QCOMPARE(bench.text(), QStringLiteral("0.0"));
}

void tst_QPlcGauge::thePastIsShownWithItsTime()
{
    RunningMaster master;
    WindowContext context;
    Plant *plant = context.plants()->add(master.address());
    QPlcWidget panel;
    panel.setContext(&context);
    GaugeFeed feed;
    feed.setContext(panel.context());
    feed.setSettings(settingsOf({{"signal", "count"}}));
    feed.setActive(true);
    QVERIFY(master.startRealTime());
    QTRY_VERIFY(plant->store() && plant->store()->endRow() > plant->store()->firstRow() + 20);
    const SignalStore::Row row = plant->store()->firstRow() + 10;
    const int channel = plant->values().channels().channel(plant->table().indexOf(QStringLiteral("count")));
    const auto expected = qint64(plant->store()->value(channel, row));
    context.timeAxis()->show(plant->store()->time(row) - 1'000'000'000, plant->store()->time(row));
    QTRY_COMPARE(feed.picture().values.first().text, QString::number(expected));
    QVERIFY(feed.picture().status.startsWith(QStringLiteral("at ")));
    QVERIFY(feed.picture().isTrusted);
    context.timeAxis()->show(1'000'000'000, 2'000'000'000);
    QTRY_COMPARE(feed.picture().values.first().text, QStringLiteral("–"));
    QVERIFY(feed.picture().status.startsWith(QStringLiteral("no value at ")));
    QVERIFY(!feed.picture().isTrusted);
    context.timeAxis()->goLive();
    QTRY_VERIFY(feed.picture().status.isEmpty());
}

void tst_QPlcGauge::extremesCoverTheTimeSinceReset()
{
    QPlcSignalIndexTable::setCurrent(gaugeTable());
    GaugeFeed feed;
    feed.setSettings(settingsOf({{"signal", "level"}, {"extremes", true}}));
    feed.setActive(true);
    const QPlcSignalIndex index = QPlcSignalIndexTable::index(QStringLiteral("level"));
    QList<QPlcSignalList> batch;
    for (const float value : {30.0f, 10.0f, 70.0f, 50.0f}) {
        batch << QPlcSignalList();
        batch.last().insert(index, value);
    }
    feed.add(batch, index);
    QCOMPARE(feed.picture().values.first().minimum, std::optional<double>(10.0));
    QCOMPARE(feed.picture().values.first().maximum, std::optional<double>(70.0));
    feed.reset();
    QVERIFY(!feed.picture().values.first().minimum);
    feed.add({batch.first()}, index);
    QCOMPARE(feed.picture().values.first().maximum, std::optional<double>(30.0));
}

void tst_QPlcGauge::aHiddenGaugeDoesNothing()
{
    FeedBench bench({{"signal", "level"}});
    QVERIFY(bench.isAtRest());
    bench.feed.setActive(false);
    QSignalSpy changes(&bench.feed, &GaugeFeed::changed);
    bench.set("level", 42.0f);
    QTRY_COMPARE(bench.plant->value(bench.plant->table().indexOf(QStringLiteral("level"))).toReal(), 42.0);
    QCOMPARE(changes.size(), 0);
    bench.feed.setActive(true);
    QCOMPARE(bench.text(), QStringLiteral("42.0"));
    QVERIFY(changes.size() > 0);
}

void tst_QPlcGauge::droppedSignalsReplaceTheSignal()
{
    QPlcGauge gauge;
    QSignalSpy edits(&gauge, &QPlcWidget::settingsEdited);
    QVERIFY(!gauge.addSignals({}));
    QVERIFY(gauge.addSignals({"level", "count"}));
    QVERIFY(gauge.addSignals({"count"}));
    QVERIFY(gauge.addSignals({"count"}));
    QCOMPARE(gauge.settings(), (QJsonObject{{"signal", "count"}}));
    QCOMPARE(edits.size(), 2);
}

void tst_QPlcGauge::gaugeOutsideAWindowReadsValuesOnRealTimeout()
{
    QPlcSignalIndexTable::setCurrent(gaugeTable());
    QPlcGauge gauge;
    gauge.applySettings({{"signal", "level"}, {"style", "number"}});
    QCOMPARE(gauge.inputSignalIndices().size(), 1);
    gauge.resize(200, 100);
    gauge.show();
    QVERIFY(gauge.accessibleName().contains(QStringLiteral("no value yet")));
    QPlcSignalList list;
    list.insert(QStringLiteral("level"), 12.5f);
    gauge.realTimeout({list});
    QTRY_COMPARE(gauge.accessibleName(), QStringLiteral("level 12.5 m"));
}

void tst_QPlcGauge::editorAppliesChangesImmediately()
{
    RunningMaster master(gaugeTable());
    WindowContext context;
    context.plants()->add(master.address());
    QPlcGauge gauge;
    gauge.setContext(&context);
    gauge.show();
    QTRY_VERIFY(!context.plants()->at(0)->table().isEmpty());
    const std::unique_ptr<QWidget> editor(gauge.createSettingsEditor());
    QSignalSpy edits(&gauge, &QPlcWidget::settingsEdited);
    editor->show();
    auto *signal = qobject_cast<QLineEdit *>(editor->focusProxy());
    QVERIFY(signal);
    QTest::keyClicks(signal, QStringLiteral("level"));
    QCOMPARE(edits.size(), 0);
    QTest::keyClick(signal, Qt::Key_Return);
    QCOMPARE(gauge.settings().value(QStringLiteral("signal")).toString(), QStringLiteral("level"));
    editor->findChild<QComboBox *>()->setCurrentIndex(1);
    auto *maximum = editor->findChild<QLineEdit *>(QStringLiteral("maximum"));
    QTest::keyClicks(maximum, QStringLiteral("2x5"));
    QTest::keyClick(maximum, Qt::Key_Return);
    editor->findChild<QCheckBox *>()->setChecked(true);
    QCOMPARE(gauge.settings(),
             (QJsonObject{{"signal", "level"}, {"style", "bar"}, {"maximum", 25}, {"extremes", true}}));
    QCOMPARE(edits.size(), 4);
    maximum->selectAll();
    QTest::keyClick(maximum, Qt::Key_Delete);
    editor->findChild<QComboBox *>()->setCurrentIndex(0);
    editor->findChild<QCheckBox *>()->setChecked(false);
    QCOMPARE(gauge.settings(), (QJsonObject{{"signal", "level"}}));
}

void tst_QPlcGauge::editorAcceptsFormulas()
{
    RunningMaster master(gaugeTable());
    WindowContext context;
    context.plants()->add(master.address());
    QPlcGauge gauge;
    gauge.setContext(&context);
    QTRY_VERIFY(!context.plants()->at(0)->table().isEmpty());
    const std::unique_ptr<QWidget> editor(gauge.createSettingsEditor());
    editor->show();
    auto *signal = qobject_cast<QLineEdit *>(editor->focusProxy());
    QTest::keyClicks(signal, QStringLiteral("= 2*level"));
    QTest::keyClick(signal, Qt::Key_Return);
    QCOMPARE(gauge.settings(), (QJsonObject{{"signal", "= 2*level"}}));
    signal->clear();
    QTest::keyClicks(signal, QStringLiteral("vector"));
    QTest::keyClick(signal, Qt::Key_Return);
    QCOMPARE(gauge.settings(), (QJsonObject{{"signal", "vector"}}));
}

/// Height of what has the colour of texts, above the bar.
int figureHeight(QPlcGauge *gauge, const QColor &color)
{
    const QImage image = gauge->grab().toImage();
    int first = image.height();
    int last = -1;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            if (image.pixelColor(x, y) != color)
                continue;
            first = std::min(first, y);
            last = y;
        }
    }
    return last - first + 1;
}

void tst_QPlcGauge::theNumberOfASmallBarIsLarge()
{
    QPlcSignalIndexTable::setCurrent(gaugeTable());
    const Theme theme = Theme::byName(Theme::System);
    for (const QSize size : {QSize(198, 66), QSize(186, 120)}) {
        QPlcGauge gauge;
        gauge.applySettings({{"signal", "level"}, {"style", "bar"}, {"title", "Altitude"}});
        gauge.resize(size);
        gauge.show();
        QPlcSignalList list;
        list.insert(QStringLiteral("level"), 60.0f);
        gauge.realTimeout({list});
        QTRY_VERIFY(gauge.accessibleName().contains(QStringLiteral("60.0")));
        const int height = figureHeight(&gauge, theme.text);
        QVERIFY2(height >= 12, qPrintable(QString::number(height)));  // of digits: letters of 16 pixels and more
    }
}

void tst_QPlcGauge::aTitleStandsForTheName()
{
    QPlcSignalIndexTable::setCurrent(gaugeTable());
    for (const char *style : {"dial", "bar", "number", "led"}) {
        QPlcGauge gauge;
        gauge.resize(200, 90);
        gauge.applySettings({{"signal", "level"}, {"style", style}});
        gauge.show();
        const QImage named = gauge.grab().toImage();
        gauge.setTitle(QStringLiteral("Altitude"));
        const QImage titled = gauge.grab().toImage();
        QVERIFY2(titled != named, style);
        QVERIFY(gauge.accessibleName().startsWith(QStringLiteral("level")));
        gauge.setTitle(QString());
        QCOMPARE(gauge.grab().toImage(), named);
    }
}

void tst_QPlcGauge::everyStyleIsDrawnAtEverySize()
{
    QPlcSignalIndexTable::setCurrent(gaugeTable());
    for (const char *style : {"dial", "bar", "number", "led"}) {
        QPlcGauge gauge;
        gauge.applySettings({{"signal", "level"}, {"style", style}, {"warningHigh", 50}, {"extremes", true}});
        for (const QSize size : {QSize(72, 56), QSize(120, 120), QSize(240, 120), QSize(60, 400), QSize(1000, 700)}) {
            gauge.resize(size);
            gauge.show();
            QPlcSignalList list;
            list.insert(QStringLiteral("level"), 60.0f);
            gauge.realTimeout({list});
            const QImage image = gauge.grab().toImage();
            const QColor background = image.pixelColor(image.width() - 2, 1);
            int drawn = 0;
            for (int y = 0; y < image.height(); ++y) {
                for (int x = 0; x < image.width(); ++x)
                    drawn += image.pixelColor(x, y) != background ? 1 : 0;
            }
            QVERIFY2(drawn > 100, style);
        }
    }
}

QTEST_MAIN(tst_QPlcGauge)
#include "tst_QPlcGauge.moc"
