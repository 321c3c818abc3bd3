// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "PlantFixtures.h"
#include "QPlcGauge.h"
#include "QPlcPanelContext.h"
#include "gui/gauges/GaugeFeed.h"
#include "gui/panel/WindowContext.h"

using namespace qplc;

namespace {

GaugeSettings settingsOf(const QJsonObject &json)
{
    PanelSettings settings = GaugeSettings::emptyJson();
    settings.take(json);
    return GaugeSettings::from(settings);
}

/// A running plant, and a feed that shows something calculated.
class FormulaBench
{
public:
    explicit FormulaBench(const QString &formula, const QJsonObject &more = {})
    {
        plant = context.plants()->add(master.address());
        panel.setContext(&context);
        feed.setContext(panel.context());
        QJsonObject json = more;
        json.insert(QStringLiteral("signal"), formula);
        feed.setSettings(settingsOf(json));
        feed.setActive(true);
    }
    bool runs()
    {
        return master.startRealTime() && waitUntil([this] { return rows() > 20; });
    }
    int rows() const { return plant->store() ? int(plant->store()->endRow() - plant->store()->firstRow()) : 0; }
    int channel() const { return plant->values().channels().channel(plant->table().indexOf(QStringLiteral("count"))); }
    double count(SignalStore::Row row) const { return double(plant->store()->value(channel(), row)); }
    double shown() const { return feed.picture().values.isEmpty() ? -1.0 : feed.picture().values.first().number; }

    RunningMaster master;
    WindowContext context;
    Plant *plant;
    QPlcWidget panel;
    GaugeFeed feed;
};

}  // namespace

class tst_GaugeFormula : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aFormulaIsCalculatedOfSignals();
    void formulaIsEvaluatedWhenItsPlantConnects();
    void aFormulaShowsThePast();
    void valuesAtRestLookTheSameAsSignalAndAsFormula();
    void formulaWithHistoryShowsTheLastCycleAtRest();
    void aFormulaNeedsAWindow();
    void newFormulaResetsTheExtremes();
};

void tst_GaugeFormula::aFormulaIsCalculatedOfSignals()
{
    FormulaBench bench(QStringLiteral("= 1000 + 2*count"));
    QVERIFY(bench.runs());
    QTRY_VERIFY(bench.shown() > 1040.0);
    QCOMPARE(bench.shown(), 1000.0 + 2.0 * bench.count(bench.plant->store()->endRow() - 1));
    QVERIFY(bench.feed.picture().isTrusted);
    QCOMPARE(bench.feed.picture().status, QString());
    QCOMPARE(bench.feed.picture().style, GaugeStyle::Dial);
    QCOMPARE(bench.feed.definition().name, QStringLiteral("= 1000 + 2*count"));
    const double before = bench.shown();
    QTRY_VERIFY(bench.shown() > before + 10.0);
    QVERIFY(bench.feed.picture().scale.maximum >= 2000.0);
    QVERIFY(bench.master.setSignalValue(QStringLiteral("vector"), QPlcValue(std::array<double, 3>{0.0, 3.0, 4.0})));
    bench.feed.setSettings(settingsOf({{"signal", "= norm(vector)"}, {"style", "bar"}}));
    QTRY_COMPARE(bench.shown(), 5.0);
    QCOMPARE(bench.feed.picture().style, GaugeStyle::Bar);
    bench.plant->close();
    QTRY_VERIFY(bench.feed.picture().status.startsWith(QStringLiteral("stale, ")));
    QVERIFY(!bench.feed.picture().isTrusted);
    QCOMPARE(bench.shown(), 5.0);
}

void tst_GaugeFormula::formulaIsEvaluatedWhenItsPlantConnects()
{
    WindowContext context;
    QPlcWidget panel;
    panel.setContext(&context);
    GaugeFeed feed;
    feed.setContext(panel.context());
    feed.setActive(true);
    feed.setSettings(settingsOf({{"signal", "= 2*count"}}));
    QVERIFY(feed.picture().message.contains(QStringLiteral("count")));
    RunningMaster master;
    Plant *plant = context.plants()->add(master.address());
    QTRY_COMPARE(feed.picture().message, QString());
    feed.setSettings(settingsOf({{"signal", "= 2*("}}));
    QVERIFY(!feed.picture().message.isEmpty());
    feed.setSettings(settingsOf({{"signal", "= 2*count"}}));
    QCOMPARE(feed.picture().message, QString());
    context.plants()->remove(plant);
    QVERIFY(feed.picture().message.contains(QStringLiteral("count")));
}

void tst_GaugeFormula::aFormulaShowsThePast()
{
    FormulaBench bench(QStringLiteral("= 3*count"));
    QVERIFY(bench.runs());
    QTRY_VERIFY(bench.shown() > 60.0);
    const SignalStore::Row row = bench.plant->store()->firstRow() + 10;
    const SignalStore::Time time = bench.plant->store()->time(row);
    bench.context.timeAxis()->show(time - 1'000'000'000, time);
    QTRY_COMPARE(bench.shown(), 3.0 * bench.count(row));
    QVERIFY(bench.feed.picture().status.startsWith(QStringLiteral("at ")));
    QVERIFY(bench.feed.picture().isTrusted);
    bench.context.timeAxis()->show(1'000'000'000, 2'000'000'000);
    QTRY_VERIFY(bench.feed.picture().status.startsWith(QStringLiteral("no value at ")));
    QVERIFY(!bench.feed.picture().isTrusted);
    // What is new gets its past also while time stands still.
    bench.context.timeAxis()->show(time - 1'000'000'000, time);
    bench.feed.setSettings(settingsOf({{"signal", "= 5*count"}}));
    QTRY_COMPARE(bench.shown(), 5.0 * bench.count(row));
}

void tst_GaugeFormula::valuesAtRestLookTheSameAsSignalAndAsFormula()
{
    FormulaBench bench(QStringLiteral("= norm(vector)"));
    GaugeFeed signal;
    signal.setContext(bench.panel.context());
    signal.setSettings(settingsOf({{"signal", "vector[0]"}}));
    signal.setActive(true);
    const auto looks = [](const GaugeFeed &feed, double number) {
        const GaugePicture &picture = feed.picture();
        return picture.isTrusted && picture.status == QLatin1String("at rest") && picture.values.size() == 1
            && picture.values.first().number == number;
    };
    // Before the first start, with initial values.
    QTRY_VERIFY(looks(signal, 0.0));
    QTRY_VERIFY(looks(bench.feed, 0.0));
    QVERIFY(bench.runs());
    QVERIFY(bench.master.setSignalValue(QStringLiteral("vector"), QPlcValue(std::array<double, 3>{3.0, 4.0, 0.0})));
    QTRY_COMPARE(bench.shown(), 5.0);
    bench.plant->stop();
    QTRY_VERIFY(looks(signal, 3.0));
    QTRY_VERIFY(looks(bench.feed, 5.0));
    // What the master holds changes at rest, too.
    bench.plant->setValues({{QStringLiteral("vector"), QPlcValue(std::array<double, 3>{6.0, 8.0, 0.0})}});
    QTRY_VERIFY(looks(signal, 6.0));
    QTRY_VERIFY(looks(bench.feed, 10.0));
}

void tst_GaugeFormula::formulaWithHistoryShowsTheLastCycleAtRest()
{
    FormulaBench bench(QStringLiteral("= 2*mean(count, 0.001)"));
    QTRY_COMPARE(bench.plant->quality(), Plant::AtRest);
    QTRY_COMPARE(bench.feed.picture().status, QStringLiteral("no value yet"));
    QVERIFY(!bench.feed.picture().isTrusted);
    QVERIFY(bench.runs());
    bench.plant->stop();
    QTRY_COMPARE(bench.feed.picture().status, QStringLiteral("at rest, last cycle"));
    QVERIFY(bench.feed.picture().isTrusted);
    QCOMPARE(bench.shown(), 2.0 * bench.count(bench.plant->store()->endRow() - 1));
}

void tst_GaugeFormula::aFormulaNeedsAWindow()
{
    QPlcSignalIndexTable::setCurrent(testTable());
    QPlcGauge gauge;
    gauge.applySettings({{"signal", "= 2*count"}});
    gauge.show();
    QCOMPARE(gauge.inputSignalIndices().size(), 0);
    QVERIFY(gauge.accessibleName().contains(QStringLiteral("Formulas need a Control Center window")));
}

void tst_GaugeFormula::newFormulaResetsTheExtremes()
{
    FormulaBench bench(QStringLiteral("= 2*count"), {{"extremes", true}});
    QVERIFY(bench.runs());
    const double begin = bench.count(bench.plant->store()->endRow() - 1);
    bench.feed.setSettings(settingsOf({{"signal", "= 3*count"}, {"extremes", true}}));
    QTRY_VERIFY(bench.shown() > 3.0 * begin + 30.0);
    const GaugePicture::Value value = bench.feed.picture().values.first();
    QCOMPARE(*value.minimum, 3.0 * begin);
    QCOMPARE(*value.maximum, value.number);
    bench.feed.reset();
    QVERIFY(*bench.feed.picture().values.first().minimum > 3.0 * begin);
}

QTEST_MAIN(tst_GaugeFormula)
#include "tst_GaugeFormula.moc"
