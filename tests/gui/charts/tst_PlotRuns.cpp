// SPDX-License-Identifier: Apache-2.0
// Runs that lie over each other in a time plot.
#include "FedPlotWindow.h"
#include "gui/charts/PlotSettings.h"
#include "gui/charts/RunBar.h"
#include "gui/charts/StatisticsView.h"
#include "gui/plot/StoreCurve.h"
#include "gui/plot/TableExport.h"

#include <QtWidgets/QLabel>
#include <QtWidgets/QTableWidget>

using namespace qplc;

class tst_PlotRuns : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void piecesThatBeginWithAnEdgeLieOverEachOther();
    void onlyTheLastOnesAreShown();
    void aNewEdgeBeginsANewPieceAndTheViewFollows();
    void anotherPlantLiesOverTheCurvesFromItsBegin();
    void otherPlantsCanBeShownAtTheSameTime();
    void aSignalThatARunLacksIsMissingInTheLegend();
    void withoutEdgesTheBarSaysWhy();
    void eachRunHasItsFigures();
    void figuresAreThoseBetweenTheCursors();
    void aSingleCurveHasAColorForEachRun();
    void ofSeveralCurvesEachKeepsItsColor();
    void tablesHaveAColumnForEachRun();
    void piecesBeginWithAnEvent();
    void anEventThatComesBeginsAPiece();
    void eventsOfThePlantCanBeChosen();
    void piecesBeginAfterPauses();
    void differencesAreDrawnInPlaceOfTheRuns();
    void differencesGoOnWithTheNewestRun();
    void settingsAreReadAsTheyWereWritten();
    void theKeyComparesWithTheOtherPlant();
    void withoutAnotherPlantTheKeyComparesEdges();
    void aTriggerEndsTheComparison();
    void aRunIsHiddenFromTheLegend();
    void theRunBelowIsHiddenAlone();
    void formulasAreComparedOverPlants();
    void aFormulaThatNamesItsPlantIsNotCompared();
};

namespace {

constexpr int period = 10;  // [ms]
const QByteArray speedAtEdges = R"json({"curves":[{"signal":"speed"}],)json"
                                R"json("runs":{"on":true,"align":"edge","signal":"speed","level":100}})json";
const QByteArray speedOverBoat = R"json({"curves":[{"signal":"speed"}],"runs":{"on":true,"plants":["boat"]}})json";

const QByteArray gateOpened
    = R"json({"curves":[{"signal":"speed"}],"runs":{"on":true,"align":"event","event":"Gate opened"}})json";

/// The speed of the kite rises from 0 to 299 in 3 s, three times: the second and third time it is 1
/// and 2 larger.
class ThreeRises : public FedPlotWindow
{
public:
    explicit ThreeRises(const QByteArray &settings = speedAtEdges)
        : FedPlotWindow(settings)
    {
        rise(1);
        rise(2);
    }

    void rise(int more)
    {
        for (int i = 0; i < 300; ++i) {
            QPlcSignalList values = valueOf("speed", QPlcValue(float(i + more)));
            values.insert(QStringLiteral("power"), QPlcValue(float(i)));
            take(values);
        }
    }
    /// Curves of the canvas, in the order of the legend.
    QVector<const StoreCurve *> drawn() const
    {
        QVector<const StoreCurve *> found;
        for (const QwtPlotItem *item : canvas()->itemList()) {
            if (const auto *curve = dynamic_cast<const StoreCurve *>(item))
                found.append(curve);
        }
        return found;
    }
    QStringList names() const
    {
        QStringList names;
        for (const PlotLegend::Entry &entry : legend()->entries())
            names << entry.name;
        return names;
    }
    /// What a curve shows at a time of the plot.
    static double valueAt(const StoreCurve &curve, qint64 sinceOrigin)
    {
        const double x = double(sinceOrigin) * 1e-9;
        return double(curve.valueRange(x, x + 1e-3 * 1.5 * period).maximum);
    }
    /// In seconds of the x axis, where the view begins.
    double viewBegin() const { return canvas()->axisScaleDiv(QwtPlot::xBottom).lowerBound(); }
    QString state() const
    {
        for (const QLabel *label : plot->findChild<RunBar *>()->findChildren<QLabel *>()) {
            if (!label->toolTip().isEmpty())
                return label->toolTip();
        }
        return {};
    }
    QTableWidget *figures() const { return plot->findChild<StatisticsView *>()->table(); }
    QString figure(int row, const char *column) const
    {
        for (int i = 0; i < figures()->columnCount(); ++i) {
            if (figures()->horizontalHeaderItem(i)->text() == QLatin1String(column))
                return figures()->item(row, i) ? figures()->item(row, i)->text() : QString();
        }
        return QStringLiteral("no column");
    }
};

/// A second plant, whose speed is 1000 and more, an hour later.
Plant *addBoat(FedPlotWindow *window, const char *table = "[speed]\ntype = Real\nunit = m/s\n")
{
    Plant *boat = window->context.plants()->addFed(QStringLiteral("boat"));
    boat->feed()->connected(QPlcSignalTable::fromIni(table));
    boat->feed()->started();
    for (int i = 0; i < 100; ++i) {
        QPlcSignalList values;
        values.insert(boat->table().at(0).name, QPlcValue(float(1000 + i)));
        boat->feed()->add({values}, window->now + 3'600'000 * millisecond + i * period * millisecond);
    }
    return boat;
}

}  // namespace

void tst_PlotRuns::piecesThatBeginWithAnEdgeLieOverEachOther()
{
    ThreeRises window;
    QVERIFY(window.show());
    QTRY_COMPARE(window.drawn().size(), 3);
    const auto begin = qint64(std::llround(window.viewBegin() * 1e9));
    // The newest piece first; each one has risen to 150 half a second later.
    for (const StoreCurve *curve : window.drawn())
        QVERIFY2(std::abs(window.valueAt(*curve, begin + 500 * millisecond) - 150.0) <= 2.0,
                 qPrintable(QString::number(window.valueAt(*curve, begin + 500 * millisecond))));
}

void tst_PlotRuns::onlyTheLastOnesAreShown()
{
    ThreeRises window;
    window.apply(
        R"json({"curves":[{"signal":"speed"}],"runs":{"on":true,"align":"edge","signal":"speed","level":100,)json"
        R"json("last":2}})json");
    QCOMPARE(window.drawn().size(), 2);
}

void tst_PlotRuns::aNewEdgeBeginsANewPieceAndTheViewFollows()
{
    ThreeRises window;
    QVERIFY(window.show());
    QTRY_COMPARE(window.drawn().size(), 3);
    const double before = window.viewBegin();
    window.rise(3);
    QTRY_COMPARE(window.drawn().size(), 4);
    QTRY_VERIFY(std::abs(window.viewBegin() - before - 3.0) < 0.05);
    QTRY_COMPARE(window.names().size(), 4);
}

void tst_PlotRuns::anotherPlantLiesOverTheCurvesFromItsBegin()
{
    ThreeRises window("{}");
    const Plant *boat = addBoat(&window);
    window.apply(speedOverBoat);
    QVERIFY(window.show());
    QCOMPARE(window.drawn().size(), 2);
    const StoreCurve *over
        = window.drawn().at(0)->store() == boat->store() ? window.drawn().at(0) : window.drawn().at(1);
    const StoreCurve *under = over == window.drawn().at(0) ? window.drawn().at(1) : window.drawn().at(0);
    QCOMPARE(over->store(), boat->store());
    const auto firstTime = [](const StoreCurve *curve) { return curve->store()->time(curve->store()->firstRow()); };
    // What is where the kite began: what the boat began with.
    QCOMPARE(firstTime(over) - over->origin(), firstTime(under) - under->origin());
    QTRY_COMPARE(window.names(), (QStringList{QStringLiteral("speed · kite"), QStringLiteral("speed · boat")}));
}

void tst_PlotRuns::otherPlantsCanBeShownAtTheSameTime()
{
    ThreeRises window("{}");
    addBoat(&window);
    window.apply(R"json({"curves":[{"signal":"speed"}],"runs":{"on":true,"plants":["boat"],"align":"clock"}})json");
    QCOMPARE(window.drawn().size(), 2);
    QCOMPARE(window.drawn().at(0)->origin(), window.drawn().at(1)->origin());
}

void tst_PlotRuns::aSignalThatARunLacksIsMissingInTheLegend()
{
    ThreeRises window("{}");
    addBoat(&window, "[depth]\ntype = Real\nunit = m\n");
    window.apply(speedOverBoat);
    QVERIFY(window.show());
    QCOMPARE(window.drawn().size(), 1);
    QTRY_COMPARE(window.legend()->entries().size(), 2);
    QCOMPARE(window.legend()->entries().at(1).name, QStringLiteral("speed · boat"));
    QCOMPARE(window.legend()->entries().at(1).value, QStringLiteral("missing"));
}

void tst_PlotRuns::withoutEdgesTheBarSaysWhy()
{
    ThreeRises window;
    QCOMPARE(window.state(), QStringLiteral("3 runs"));
    window.apply(
        R"json({"curves":[{"signal":"speed"}],"runs":{"on":true,"align":"edge","signal":"speed","level":999}})json");
    QCOMPARE(window.state(), QStringLiteral("speed does not rise to 999 in the values that are here."));
    QCOMPARE(window.drawn().size(), 1);
    window.apply(R"json({"curves":[{"signal":"speed"}],"runs":{"on":true}})json");
    QCOMPARE(window.state(), QStringLiteral("Choose a run to lie over this one."));
}

/// All that is seen, from the edge to the next one: 100 to 299, and 0 to 99 of the next rise.
void tst_PlotRuns::eachRunHasItsFigures()
{
    ThreeRises window;
    window.plot->resize(1000, 600);
    QVERIFY(window.show());
    QTRY_COMPARE(window.figures()->rowCount(), 3);
    QTRY_COMPARE(window.figure(2, "max"), QStringLiteral("299"));
    QCOMPARE(window.figure(1, "max"), QStringLiteral("300"));
    QCOMPARE(window.figure(0, "max"), QStringLiteral("301"));
    QCOMPARE(window.figure(0, "min"), QStringLiteral("100"));
    QCOMPARE(window.figure(2, "duration"), QStringLiteral("2.98 s"));
    QVERIFY(window.figures()->isColumnHidden(1));  // there is no cursor A
}

void tst_PlotRuns::figuresAreThoseBetweenTheCursors()
{
    ThreeRises window;
    window.plot->resize(1000, 600);
    QVERIFY(window.show());
    QTRY_COMPARE(window.drawn().size(), 3);
    const QPlcTimeAxis::Time zero = window.canvas()->begin();
    window.context.timeAxis()->setCursor(QPlcTimeAxis::A, zero + 500 * millisecond);
    window.context.timeAxis()->setCursor(QPlcTimeAxis::B, zero + 1005 * millisecond);
    QTRY_VERIFY(!window.figures()->isColumnHidden(1));
    QTRY_VERIFY(window.figure(0, "max").toDouble() > 195.0 && window.figure(0, "max").toDouble() < 205.0);
    for (int run = 0; run < 3; ++run)
        QVERIFY(std::abs(window.figure(run, "min").toDouble() - 150.0) <= 2.0);
}

void tst_PlotRuns::aSingleCurveHasAColorForEachRun()
{
    ThreeRises window;
    QVERIFY(window.show());
    QTRY_COMPARE(window.legend()->entries().size(), 3);
    QVERIFY(window.legend()->entries().at(0).color != window.legend()->entries().at(1).color);
    QVERIFY(window.legend()->entries().at(1).color != window.legend()->entries().at(2).color);
    QCOMPARE(window.legend()->entries().at(1).penStyle, Qt::SolidLine);
}

void tst_PlotRuns::ofSeveralCurvesEachKeepsItsColor()
{
    ThreeRises window(R"json({"curves":[{"signal":"speed"},{"signal":"power"}],)json"
                      R"json("runs":{"on":true,"align":"edge","signal":"speed","level":100}})json");
    QVERIFY(window.show());
    QTRY_COMPARE(window.legend()->entries().size(), 6);
    const QVector<PlotLegend::Entry> &entries = window.legend()->entries();
    for (int i = 2; i < 6; ++i) {
        QCOMPARE(entries.at(i).color.rgb(), entries.at(i % 2).color.rgb());
        QCOMPARE(entries.at(i).penStyle, i < 4 ? Qt::DashLine : Qt::DotLine);
    }
    QVERIFY(entries.at(4).color.alpha() < entries.at(2).color.alpha());
}

void tst_PlotRuns::tablesHaveAColumnForEachRun()
{
    ThreeRises window;
    QVERIFY(window.show());
    QTRY_COMPARE(window.drawn().size(), 3);
    const SignalStore *store = window.plant->store();
    std::vector<TableExport::Column> columns;
    for (int run = 0; run < 2; ++run) {
        TableExport::Column column{store, window.drawn().at(0)->channel(), 1.0, 0.0, QStringLiteral("run"), QString()};
        column.shift = run * 3000 * millisecond;
        columns.push_back(column);
    }
    // Where the second rise begins, the first one lies over it.
    const SignalStore::Time begin = store->time(store->firstRow() + 300);
    TableExport table(TableExport::Csv, columns, begin, begin);
    const QList<QByteArray> fields = table.next(2).trimmed().split(',');
    QCOMPARE(table.rows(), 1);
    QCOMPARE(fields.mid(2), (QList<QByteArray>{"1", "0"}));
}

void tst_PlotRuns::piecesBeginWithAnEvent()
{
    ThreeRises window("{}");
    for (const int row : {50, 350, 650})
        window.tell(row, QStringLiteral("Gate opened"));
    window.tell(400, QStringLiteral("Gate closed"));
    window.tell(500, QStringLiteral("Gate opened"), QStringLiteral("boat"));
    window.apply(gateOpened);
    QCOMPARE(window.state(), QStringLiteral("3 runs"));
    QVERIFY(window.show());
    QTRY_COMPARE(window.drawn().size(), 3);
    const auto begin = qint64(std::llround(window.viewBegin() * 1e9));
    for (const StoreCurve *curve : window.drawn())
        QVERIFY(std::abs(window.valueAt(*curve, begin + 500 * millisecond) - 100.0) <= 4.0);
    window.apply(R"json({"curves":[{"signal":"speed"}],"runs":{"on":true,"align":"event","event":"Nothing"}})json");
    QCOMPARE(window.state(), QStringLiteral("There is no such event in the values that are here."));
}

void tst_PlotRuns::anEventThatComesBeginsAPiece()
{
    ThreeRises window("{}");
    window.tell(350, QStringLiteral("Gate opened"));
    window.apply(gateOpened);
    QVERIFY(window.show());
    QCOMPARE(window.drawn().size(), 1);
    window.tell(650, QStringLiteral("Gate opened"));
    window.rise(3);
    QTRY_COMPARE(window.drawn().size(), 2);
}

void tst_PlotRuns::eventsOfThePlantCanBeChosen()
{
    ThreeRises window("{}");
    for (const int row : {50, 350})
        window.tell(row, QStringLiteral("Gate opened"));
    window.tell(400, QStringLiteral("Gate closed"), QStringLiteral("kite/Gate"));
    window.tell(500, QStringLiteral("Anchor lost"), QStringLiteral("boat"));
    const QStringList texts = PlotRuns::eventTexts(*window.plot->context(), QStringLiteral("kite"));
    QVERIFY(texts.contains(QStringLiteral("Gate closed")));
    QCOMPARE(texts.count(QStringLiteral("Gate opened")), 1);
    QVERIFY(texts.indexOf(QStringLiteral("Gate closed")) < texts.indexOf(QStringLiteral("Gate opened")));
    QVERIFY(!texts.contains(QStringLiteral("Anchor lost")));
}

/// A fed plant that starts again begins a new phase.
void tst_PlotRuns::piecesBeginAfterPauses()
{
    ThreeRises window("{}");
    window.plant->feed()->stopped();
    window.now += 5000 * millisecond;
    window.plant->feed()->started();
    window.rise(3);
    window.apply(R"json({"curves":[{"signal":"speed"}],"runs":{"on":true,"align":"pause"}})json");
    QCOMPARE(window.state(), QStringLiteral("2 runs"));
    QCOMPARE(window.drawn().size(), 2);
}

void tst_PlotRuns::differencesAreDrawnInPlaceOfTheRuns()
{
    ThreeRises window("{}");
    window.apply(
        R"json({"curves":[{"signal":"power","offset":7}],"runs":{"on":true,"align":"edge","signal":"power",)json"
        R"json("level":100,"differences":true}})json");
    QVERIFY(window.show());
    QCOMPARE(window.drawn().size(), 1);  // the first rise was another one, from 709 kW on
    QTRY_COMPARE(window.legend()->entries().size(), 2);
    QCOMPARE(window.legend()->entries().at(0).isVisible, false);
    QVERIFY(window.legend()->entries().at(1).name.startsWith(QStringLiteral("Δ power · ")));
    const SignalStore &store = *window.drawn().at(0)->store();
    QCOMPARE(store.channels(), 1);
    QVERIFY(store.endRow() > 190);
    QCOMPARE(store.range(0, 0, store.endRow()).minimum, 0.0F);  // the same rise: exactly nothing
    QCOMPARE(store.range(0, 0, store.endRow()).maximum, 0.0F);
}

void tst_PlotRuns::differencesGoOnWithTheNewestRun()
{
    ThreeRises window;
    window.apply(
        R"json({"curves":[{"signal":"speed"}],"runs":{"on":true,"align":"edge","signal":"speed","level":100,)json"
        R"json("last":2,"differences":true}})json");
    QVERIFY(window.show());
    QCOMPARE(window.drawn().size(), 1);
    const SignalStore::Row before = window.drawn().at(0)->store()->endRow();
    QPlcSignalList values = valueOf("speed", QPlcValue(500.0F));
    window.take(values);
    window.take(values);
    QTRY_VERIFY(window.drawn().at(0)->store()->endRow() > before);
    QTRY_VERIFY(window.figure(0, "min").toDouble() < -150.0);
}

void tst_PlotRuns::settingsAreReadAsTheyWereWritten()
{
    const QByteArray written
        = R"json({"curves":[{"signal":"speed"}],"runs":{"align":"edge","apart":2.5,"differences":true,)json"
          R"json("event":"Started","last":3,)json"
          R"json("level":100,"on":true,"others":1,"plants":["boat"],"signal":"speed"}})json";
    const FedPlotWindow window(written);
    QCOMPARE(window.settings(), written);
    const QJsonObject extreme{{QStringLiteral("last"), 1'000'000}, {QStringLiteral("apart"), -1.0}};
    QCOMPARE(RunSettings::fromJson(extreme).last, RunSettings::MostLast);
    QCOMPARE(RunSettings::fromJson(extreme).apart, 0.0);
    QCOMPARE(RunSettings::fromJson({}).toJson(), QJsonObject());
}

void tst_PlotRuns::theKeyComparesWithTheOtherPlant()
{
    ThreeRises window(R"json({"curves":[{"signal":"speed"}]})json");
    addBoat(&window);
    window.action("runs")->trigger();
    QVERIFY(window.plot->findChild<RunBar *>()->isVisibleTo(window.plot));
    QCOMPARE(window.drawn().size(), 2);
    QVERIFY(window.settings().contains(R"json("runs":{"on":true,"plants":["boat"]})json"));
    window.action("runs")->trigger();
    QCOMPARE(window.drawn().size(), 1);
    QVERIFY(!window.plot->findChild<RunBar *>()->isVisibleTo(window.plot));
}

void tst_PlotRuns::withoutAnotherPlantTheKeyComparesEdges()
{
    ThreeRises window(R"json({"curves":[{"signal":"speed"}]})json");
    window.action("runs")->trigger();
    QVERIFY2(window.settings().contains(R"json("align":"edge","level":151,"on":true,"signal":"speed")json"),
             window.settings().constData());
    QCOMPARE(window.drawn().size(), 3);
}

void tst_PlotRuns::aTriggerEndsTheComparison()
{
    ThreeRises window;
    window.action("trigger")->trigger();
    QCOMPARE(window.drawn().size(), 1);
    window.action("runs")->trigger();
    QCOMPARE(window.drawn().size(), 3);
    QVERIFY(!window.action("trigger")->isChecked());
}

void tst_PlotRuns::aRunIsHiddenFromTheLegend()
{
    ThreeRises window("{}");
    addBoat(&window);
    window.apply(speedOverBoat);
    QVERIFY(window.show());
    QTRY_COMPARE(window.names().size(), 2);
    QTest::mouseClick(window.legend(), Qt::LeftButton, {}, window.legend()->entryRect(1).center());
    QTRY_COMPARE(window.drawn().size(), 1);
    QVERIFY(window.settings().contains(R"("hidden":["boat"])"));
    QCOMPARE(window.names().size(), 2);  // it can be shown again
    QVERIFY(!window.legend()->entries().at(1).isVisible);
    QTest::mouseClick(window.legend(), Qt::LeftButton, {}, window.legend()->entryRect(1).center());
    QTRY_COMPARE(window.drawn().size(), 2);
    QCOMPARE(window.settings(), speedOverBoat);
}

void tst_PlotRuns::theRunBelowIsHiddenAlone()
{
    ThreeRises window("{}");
    const Plant *boat = addBoat(&window);
    window.apply(speedOverBoat);
    QVERIFY(window.show());
    QTRY_COMPARE(window.names().size(), 2);
    QTest::mouseClick(window.legend(), Qt::LeftButton, {}, window.legend()->entryRect(0).center());
    QTRY_COMPARE(window.drawn().size(), 1);
    QCOMPARE(window.drawn().first()->store(), boat->store());
}

void tst_PlotRuns::formulasAreComparedOverPlants()
{
    ThreeRises window("{}");
    Plant *boat = window.context.plants()->addFed(QStringLiteral("boat"));
    boat->feed()->connected(fedTable());
    boat->feed()->started();
    for (int i = 0; i < 100; ++i)
        boat->feed()->add({valueOf("speed", QPlcValue(float(1000 + i)))}, window.now + i * period * millisecond);
    window.apply(R"json({"curves":[{"signal":"= 2*speed"}],"runs":{"on":true,"plants":["boat"]}})json");
    QVERIFY(window.show());
    QTRY_COMPARE(window.drawn().size(), 2);
    const auto largest = [](const StoreCurve *curve) {
        const SignalStore *store = curve->store();
        return double(store->range(curve->channel(), store->firstRow(), store->endRow()).maximum);
    };
    QTRY_COMPARE(std::max(largest(window.drawn().at(0)), largest(window.drawn().at(1))), 2.0 * 1099.0);
    QTRY_COMPARE(std::min(largest(window.drawn().at(0)), largest(window.drawn().at(1))), 2.0 * 301.0);
}

void tst_PlotRuns::aFormulaThatNamesItsPlantIsNotCompared()
{
    ThreeRises window("{}");
    addBoat(&window);
    window.apply(R"json({"curves":[{"signal":"= 2*kite/speed"}],"runs":{"on":true,"plants":["boat"]}})json");
    QVERIFY(window.show());
    QCOMPARE(window.drawn().size(), 1);
    QTRY_COMPARE(window.names().size(), 2);
    QVERIFY2(window.legend()->entries().at(1).hint.contains(QLatin1String("names its plant")),
             qPrintable(window.legend()->entries().at(1).hint));
}

QTEST_MAIN(tst_PlotRuns)
#include "tst_PlotRuns.moc"
