// SPDX-License-Identifier: Apache-2.0
// States with names in a time plot.
#include "NodeFixtures.h"
#include "QPlcTimePlot.h"
#include "gui/charts/PlotCanvas.h"
#include "gui/charts/StatisticsView.h"
#include "gui/panel/WindowContext.h"
#include "gui/plant/PlantFeed.h"

#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtWidgets/QAction>
#include <QtWidgets/QMenu>
#include <QtWidgets/QTableWidget>

#include <qwt_plot_item.h>
#include <qwt_scale_draw.h>

using namespace qplc;

namespace {

constexpr PlantValues::Time millisecond = 1'000'000;
constexpr int lines = QwtPlotItem::Rtti_PlotUserItem + 1;
constexpr int bands = QwtPlotItem::Rtti_PlotUserItem + 2;

QPlcSignalTable statesTable()
{
    return QPlcSignalTable::fromIni("[phase]\ntype = Int8\nvalues = 0: Off, 1: ReelOut, 2: ReelInFasterThanEver\n"
                                    "[mode]\ntype = Int8\nvalues = 0: Manual, 1: Automatic\n"
                                    "[speed]\ntype = Real\nunit = m/s\n");
}

/// A plot with a plant whose phase is 0, 1, 2 for a second each.
class StatesWindow
{
public:
    explicit StatesWindow(const QByteArray &settings)
        : plot(new QPlcTimePlot)
    {
        QPlcSignalIndexTable::setCurrent(statesTable());
        plot->resize(640, 360);
        plot->setContext(&context);
        Plant *plant = context.plants()->addFed(QStringLiteral("kite"));
        plant->feed()->connected(statesTable());
        plant->feed()->started();
        PlantValues::Time now = 1'700'000'000'000 * millisecond;
        for (int i = 0; i < 300; ++i) {
            now += 10 * millisecond;
            QPlcSignalList values = valueOf("phase", QPlcValue(qint8(i / 100)));
            values.insert(QStringLiteral("speed"), QPlcValue(float(i)));
            plant->feed()->take({values}, now);
        }
        context.timeView()->setSpan(2900 * millisecond);
        plot->applySettings(QJsonDocument::fromJson(settings).object());
    }
    ~StatesWindow() { delete plot; }

    bool show()
    {
        plot->show();
        return QTest::qWaitForWindowExposed(plot) && QTest::qWaitFor([this] { return plot->drawnPictures() > 0; });
    }
    PlotCanvas *canvas() const { return plot->findChild<PlotCanvas *>(); }
    QAction *action(const char *name) const { return plot->findChild<QAction *>(QLatin1String(name)); }
    int count(int kind) const { return canvas()->itemList(kind).size(); }
    QString label(double value) const { return canvas()->axisScaleDraw(QwtPlot::yLeft)->label(value).text(); }
    bool hasNumbers() const
    {
        return canvas()->axisScaleDraw(QwtPlot::yLeft)->hasComponent(QwtAbstractScaleDraw::Labels);
    }
    /// At a place of the canvas, as shares of its size.
    QColor colorAt(double x, double y) const
    {
        const QImage picture = canvas()->canvas()->grab().toImage();
        return picture.pixelColor(int(x * (picture.width() - 1)), int(y * (picture.height() - 1)));
    }

    WindowContext context;
    QPlcTimePlot *plot;
};

}  // namespace

class tst_StatesInPlots : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void anAxisOfStatesHasTheirNames();
    void anAxisOfDifferentThingsHasNumbers();
    void cursorsSayNames();
    void aCurveBecomesBandsAndALineAgain();
    void bandsAreAtTheBottomBehindOtherCurves();
    void bandsAloneTakeAllOfThePlot();
    void severalBandsAreAboveEachOther();
    void whatIsNoStateHasNoBands();
};

void tst_StatesInPlots::anAxisOfStatesHasTheirNames()
{
    const StatesWindow window(R"({"curves":[{"signal":"phase"}]})");
    QCOMPARE(window.label(1.0), QStringLiteral("ReelOut"));
    QVERIFY2(window.label(2.0).startsWith(QStringLiteral("Reel")) && window.label(2.0).endsWith(QChar(0x2026)),
             qPrintable(window.label(2.0)));
    QCOMPARE(window.label(3.0), QStringLiteral("3"));
    window.plot->applySettings(QJsonDocument::fromJson(R"({"curves":[{"signal":"phase","gain":2}]})").object());
    QCOMPARE(window.label(1.0), QStringLiteral("1"));  // it is no phase any more
}

void tst_StatesInPlots::anAxisOfDifferentThingsHasNumbers()
{
    for (const char *other : {"speed", "mode"}) {
        const StatesWindow window(QByteArray(R"({"curves":[{"signal":"phase"},{"signal":")") + other + R"("}]})");
        QCOMPARE(window.label(1.0), QStringLiteral("1"));
    }
    const StatesWindow window(R"({"curves":[{"signal":"phase"},{"axis":"right","signal":"speed"}]})");
    QCOMPARE(window.label(1.0), QStringLiteral("ReelOut"));
}

void tst_StatesInPlots::cursorsSayNames()
{
    StatesWindow window(R"({"curves":[{"signal":"phase"}]})");
    QVERIFY(window.show());
    const TimeView::Time newest = window.context.timeView()->newest();
    window.context.timeView()->setCursor(TimeView::A, newest - 1500 * millisecond);
    window.context.timeView()->setCursor(TimeView::B, newest - 2500 * millisecond);
    const auto *table = window.plot->findChild<StatisticsView *>()->findChild<QTableWidget *>();
    const auto text = [table](int column) {
        return table->rowCount() > 0 && table->item(0, column) ? table->item(0, column)->text() : QString();
    };
    QTRY_COMPARE(text(1), QStringLiteral("ReelOut"));
    QCOMPARE(text(2), QStringLiteral("Off"));
    QCOMPARE(text(3), QStringLiteral("-1"));
}

void tst_StatesInPlots::aCurveBecomesBandsAndALineAgain()
{
    StatesWindow window(R"({"curves":[{"signal":"phase"}]})");
    QVERIFY(window.show());
    QSignalSpy edited(window.plot, &QPlcWidget::settingsEdited);
    QCOMPARE(window.count(lines), 1);
    QVERIFY(window.action("bands")->isEnabled() && !window.action("bands")->isChecked());
    window.action("bands")->trigger();
    QCOMPARE(window.plot->settings()["curves"].toArray().at(0).toObject(),
             (QJsonObject{{"signal", "phase"}, {"bands", true}}));
    QCOMPARE(window.count(lines), 0);
    QCOMPARE(window.count(bands), 1);
    QVERIFY(window.action("bands")->isChecked());
    window.action("bands")->trigger();
    QCOMPARE(window.count(lines), 1);
    QCOMPARE(window.count(bands), 0);
    QCOMPARE(edited.size(), 2);
}

void tst_StatesInPlots::bandsAreAtTheBottomBehindOtherCurves()
{
    StatesWindow window(R"({"curves":[{"signal":"speed"},{"bands":true,"signal":"phase"}],"grid":false})");
    QVERIFY(window.show());
    QVERIFY(window.hasNumbers());
    const QColor surface = window.context.theme().surface;
    const QColor off = window.colorAt(0.25, 0.98);
    const QColor reelIn = window.colorAt(0.97, 0.98);
    QVERIFY(off != surface && reelIn != surface);
    QVERIFY(off != reelIn);
    QCOMPARE(window.colorAt(0.25, 0.2), surface);
    QCOMPARE(window.label(100.0), QStringLiteral("100"));  // the axis is that of the speed
    const auto *canvas = window.plot->findChild<PlotCanvas *>();
    const int strip = QFontMetrics(canvas->axisFont(QwtPlot::xBottom)).height();
    QVERIFY(canvas->yOf(PlotCurveSettings::Left, 0.0) < canvas->canvas()->height() - strip);  // no line is below it
}

void tst_StatesInPlots::bandsAloneTakeAllOfThePlot()
{
    StatesWindow window(R"({"curves":[{"bands":true,"signal":"phase"}]})");
    QVERIFY(window.show());
    QVERIFY(!window.hasNumbers());
    const QColor top = window.colorAt(0.25, 0.02);
    QVERIFY(top != window.context.theme().surface);
    QCOMPARE(window.colorAt(0.25, 0.95), top);
    QVERIFY(window.colorAt(0.97, 0.02) != top);
}

void tst_StatesInPlots::severalBandsAreAboveEachOther()
{
    StatesWindow window(R"({"curves":[{"bands":true,"signal":"phase"},{"bands":true,"signal":"mode"}]})");
    QVERIFY(window.show());
    QCOMPARE(window.count(bands), 2);
    QVERIFY(window.colorAt(0.6, 0.05) != window.colorAt(0.6, 0.95));  // ReelOut above Manual
    QCOMPARE(window.colorAt(0.9, 0.95), window.colorAt(0.6, 0.95));   // mode never changes
}

void tst_StatesInPlots::whatIsNoStateHasNoBands()
{
    const StatesWindow window(R"({"curves":[{"bands":true,"signal":"speed"}]})");
    QCOMPARE(window.count(bands), 0);
    QCOMPARE(window.count(lines), 1);
    QVERIFY(!window.action("bands")->isEnabled());
}

QTEST_MAIN(tst_StatesInPlots)
#include "tst_StatesInPlots.moc"
