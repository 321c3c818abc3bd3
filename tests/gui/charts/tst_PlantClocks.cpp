// SPDX-License-Identifier: Apache-2.0
// Plants of one window whose clocks differ: in lockstep, rows run far ahead of those of a plant in
// real time.
#include "../../common/Waiting.h"
#include "NodeFixtures.h"
#include "QPlcTimePlot.h"
#include "QPlcXyPlot.h"
#include "gui/charts/PlotCanvas.h"
#include "gui/charts/PlotLegend.h"
#include "gui/charts/PlotOverlay.h"
#include "gui/charts/XyCanvas.h"
#include "gui/panel/WindowContext.h"
#include "gui/plant/PlantFeed.h"

#include <QtCore/QJsonDocument>
#include <QtGui/QClipboard>
#include <QtGui/QGuiApplication>
#include <QtWidgets/QAction>

#include <cstdlib>

using namespace qplc;
using Time = QPlcTimeAxis::Time;

namespace {

constexpr Time s = 1'000'000'000;
constexpr Time now = 1'700'000'000 * s;
constexpr Time ahead = 3600 * s;

/// The plants "kite" of now and "simulation" of an hour later; values have only just come from the
/// kite.
class TwoClocks
{
public:
    TwoClocks()
        : simulation(add(QStringLiteral("simulation"), now + ahead))
        , kite(add(QStringLiteral("kite"), now))
    {
    }

    QPlcTimeAxis *time() { return context.timeAxis(); }
    template<typename Panel>
    bool show(Panel *panel, const char *settings)
    {
        panel->setContext(&context);
        panel->applySettings(QJsonDocument::fromJson(settings).object());
        panel->resize(640, 360);
        panel->show();
        return QTest::qWaitForWindowExposed(panel);
    }
    /// Two seconds of values up to a time.
    static void take(Plant *plant, Time last)
    {
        for (int i = 0; i < 200; ++i)
            plant->feed()->add({valueOf("count", QPlcValue(i))}, last - (199 - i) * s / 100);
    }

    WindowContext context;
    Plant *simulation;
    Plant *kite;

private:
    Plant *add(const QString &name, Time last)
    {
        QPlcSignalIndexTable::setCurrent(testTable());
        Plant *plant = context.plants()->addFed(name);
        plant->feed()->connected(testTable());
        plant->feed()->started();
        take(plant, last);
        return plant;
    }
};

bool isNear(Time a, Time b)
{
    return std::abs(a - b) < s;
}

}  // namespace

class tst_PlantClocks : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void aLivePlotEndsWithTheNewestValuesOfItsPlant_data();
    void aLivePlotEndsWithTheNewestValuesOfItsPlant();
    void plotOfAPlantWithASlowerClockStaysLive();
    void freezingActionFreezesTheShownTimeOfThePlot_data();
    void freezingActionFreezesTheShownTimeOfThePlot();
    void zoomingAtTheLiveEdgeStaysLive();
    void aLiveXyPlotShowsTheNewestValuesOfItsPlant();
    void plotReportsMissingValuesAtTheFrozenTime();
    void livePlotLegendUsesTheTimeOfItsPlant();
    void newestTimeIgnoresRemovedPlants();
    void newTableResetsTheNewestTimeOfItsPlant();
};

void tst_PlantClocks::aLivePlotEndsWithTheNewestValuesOfItsPlant_data()
{
    QTest::addColumn<QByteArray>("settings");
    QTest::newRow("time of the window") << QByteArray(R"({"curves":[{"signal":"kite/count"}]})");
    QTest::newRow("own time") << QByteArray(R"({"curves":[{"signal":"kite/count"}],"time":"own"})");
    QTest::newRow("formula") << QByteArray(R"({"curves":[{"signal":"= 2*kite/count"}]})");
}

void tst_PlantClocks::aLivePlotEndsWithTheNewestValuesOfItsPlant()
{
    QFETCH(QByteArray, settings);
    TwoClocks window;
    QPlcTimePlot plot;
    QVERIFY(window.show(&plot, settings.constData()));
    const auto *canvas = plot.findChild<PlotCanvas *>();
    QTRY_VERIFY(isNear(canvas->end(), now));
    plot.applySettings(QJsonDocument::fromJson(R"({"curves":[{"signal":"simulation/count"}]})").object());
    QTRY_VERIFY(isNear(canvas->end(), now + ahead));
}

void tst_PlantClocks::plotOfAPlantWithASlowerClockStaysLive()
{
    TwoClocks window;
    QPlcTimePlot plot;
    QVERIFY(window.show(&plot, R"({"curves":[{"signal":"kite/count"}]})"));
    const auto *canvas = plot.findChild<PlotCanvas *>();
    QTRY_VERIFY(isNear(canvas->end(), now));
    window.take(window.kite, now + 10 * s);
    QTRY_VERIFY(isNear(canvas->end(), now + 10 * s));
}

void tst_PlantClocks::freezingActionFreezesTheShownTimeOfThePlot_data()
{
    QTest::addColumn<QByteArray>("action");
    for (const char *action : {"freeze", "earlier", "later"})
        QTest::newRow(action) << QByteArray(action);
}

void tst_PlantClocks::freezingActionFreezesTheShownTimeOfThePlot()
{
    QFETCH(QByteArray, action);
    TwoClocks window;
    QPlcTimePlot plot;
    QVERIFY(window.show(&plot, R"({"curves":[{"signal":"kite/count"}]})"));
    window.time()->setSpan(s);
    plot.findChild<QAction *>(QLatin1String(action))->trigger();
    QVERIFY(!window.time()->isLive());
    QVERIFY(isNear(window.time()->end(), now));
    QCOMPARE(window.time()->span(), s);
}

void tst_PlantClocks::zoomingAtTheLiveEdgeStaysLive()
{
    TwoClocks window;
    QPlcTimePlot plot;
    QVERIFY(window.show(&plot, R"({"curves":[{"signal":"kite/count"}]})"));
    const Time before = window.time()->span();
    plot.findChild<QAction *>(QStringLiteral("zoomIn"))->trigger();
    QVERIFY(window.time()->isLive());
    QVERIFY(window.time()->span() < before);
}

void tst_PlantClocks::aLiveXyPlotShowsTheNewestValuesOfItsPlant()
{
    TwoClocks window;
    QPlcXyPlot plot;
    QVERIFY(window.show(&plot, R"({"curves":[{"x":"kite/count","y":"kite/count"}]})"));
    const auto seen = [&plot] { return plot.findChild<XyCanvas *>()->curves().front()->xRange(); };
    QTRY_COMPARE(seen().maximum, 199.0F);
    plot.findChild<QAction *>(QStringLiteral("copyTable"))->trigger();
    QTRY_VERIFY(QGuiApplication::clipboard()->text().count(QLatin1Char('\n')) >= 200);
}

void tst_PlantClocks::plotReportsMissingValuesAtTheFrozenTime()
{
    TwoClocks window;
    QPlcTimePlot plot;
    QVERIFY(window.show(&plot, R"({"curves":[{"signal":"kite/count"}]})"));
    const auto hint = [&plot] { return plot.findChild<PlotOverlay *>()->picture().hint; };
    QTRY_COMPARE(hint(), QString());
    window.time()->freeze();
    QTRY_VERIFY2(hint().contains(QStringLiteral("No values at this time")), qPrintable(hint()));
    QTRY_COMPARE(plot.findChild<PlotLegend *>()->entries().value(0).value, QStringLiteral("–"));
    window.time()->jumpTo(now);
    QTRY_COMPARE(hint(), QString());
}

/// Wherever a mouse points in a plot of another plant.
void tst_PlantClocks::livePlotLegendUsesTheTimeOfItsPlant()
{
    TwoClocks window;
    QPlcTimePlot plot;
    QVERIFY(window.show(&plot, R"({"curves":[{"signal":"kite/count"}]})"));
    const auto value = [&plot] { return plot.findChild<PlotLegend *>()->entries().value(0).value; };
    QTRY_COMPARE(value(), QStringLiteral("199"));
    window.time()->setPointer(now - s);
    QTRY_COMPARE(value(), QStringLiteral("99"));
    window.time()->setPointer(now + ahead);
    QTRY_COMPARE(value(), QStringLiteral("199"));
}

void tst_PlantClocks::newestTimeIgnoresRemovedPlants()
{
    TwoClocks window;
    QVERIFY(isNear(window.time()->newest(), now + ahead));
    window.context.plants()->remove(window.simulation);
    QVERIFY(isNear(window.time()->newest(), now));
    window.context.plants()->remove(window.kite);
    QCOMPARE(window.time()->newest(), Time(0));
}

void tst_PlantClocks::newTableResetsTheNewestTimeOfItsPlant()
{
    TwoClocks window;
    window.simulation->feed()->connected(QPlcSignalTable::fromIni("[other]\ntype = Real\n"));
    QVERIFY(isNear(window.time()->newest(), now));
}

QTEST_MAIN(tst_PlantClocks)
#include "tst_PlantClocks.moc"
