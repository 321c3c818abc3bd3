// SPDX-License-Identifier: Apache-2.0
// States with names in a time plot.
#include "../../common/Waiting.h"
#include "FedPlotWindow.h"
#include "gui/charts/StatisticsView.h"

#include <QtCore/QJsonArray>
#include <QtWidgets/QMenu>
#include <QtWidgets/QTableWidget>

#include <qwt_scale_draw.h>

using namespace qplc;

namespace {

constexpr int lines = QwtPlotItem::Rtti_PlotUserItem + 1;
constexpr int bands = QwtPlotItem::Rtti_PlotUserItem + 2;

}  // namespace

class tst_StatesInPlots : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void anAxisOfStatesHasTheirNames();
    void axisOfDifferentStatesShowsNumbers();
    void cursorsShowStateNames();
    void aCurveBecomesBandsAndALineAgain();
    void bandsAreAtTheBottomBehindOtherCurves();
    void bandsAloneTakeAllOfThePlot();
    void severalBandsAreAboveEachOther();
    void aStateThatIsHeldStaysOneBand();
    void theLegendHasTheColourOfTheBand();
    void numericSignalHasNoBands();
};

void tst_StatesInPlots::anAxisOfStatesHasTheirNames()
{
    const FedPlotWindow window(R"({"curves":[{"signal":"phase"}]})");
    QCOMPARE(window.label(1.0), QStringLiteral("ReelOut"));
    QVERIFY2(window.label(2.0).startsWith(QStringLiteral("Reel")) && window.label(2.0).endsWith(QChar(0x2026)),
             qPrintable(window.label(2.0)));
    QCOMPARE(window.label(3.0), QStringLiteral("3"));
    window.plot->applySettings(QJsonDocument::fromJson(R"({"curves":[{"signal":"phase","gain":2}]})").object());
    QCOMPARE(window.label(1.0), QStringLiteral("1"));  // it is no phase any more
}

void tst_StatesInPlots::axisOfDifferentStatesShowsNumbers()
{
    const FedPlotWindow states(R"({"curves":[{"signal":"phase"},{"signal":"mode"}]})");
    QCOMPARE(states.label(1.0), QStringLiteral("1"));
    const FedPlotWindow window(R"({"curves":[{"signal":"phase"},{"signal":"speed"}]})");
    QCOMPARE(window.label(1.0), QStringLiteral("ReelOut"));  // the speed has its own axis
}

void tst_StatesInPlots::cursorsShowStateNames()
{
    FedPlotWindow window(R"({"curves":[{"signal":"phase"}]})");
    QVERIFY(window.show());
    const QPlcTimeAxis::Time newest = window.context.timeAxis()->newest();
    window.context.timeAxis()->setCursor(QPlcTimeAxis::A, newest - 1500 * millisecond);
    window.context.timeAxis()->setCursor(QPlcTimeAxis::B, newest - 2500 * millisecond);
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
    FedPlotWindow window(R"({"curves":[{"signal":"phase"}]})");
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
    FedPlotWindow window(R"({"curves":[{"signal":"speed"},{"bands":true,"signal":"phase"}],"grid":false})");
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
    FedPlotWindow window(R"({"curves":[{"bands":true,"signal":"phase"}]})");
    QVERIFY(window.show());
    QVERIFY(!window.hasNumbers());
    const QColor top = window.colorAt(0.25, 0.02);
    QVERIFY(top != window.context.theme().surface);
    QCOMPARE(window.colorAt(0.25, 0.95), top);
    QVERIFY(window.colorAt(0.97, 0.02) != top);
}

void tst_StatesInPlots::severalBandsAreAboveEachOther()
{
    FedPlotWindow window(R"({"curves":[{"bands":true,"signal":"phase"},{"bands":true,"signal":"mode"}]})");
    QVERIFY(window.show());
    QCOMPARE(window.count(bands), 2);
    QVERIFY(window.colorAt(0.6, 0.05) != window.colorAt(0.6, 0.95));  // ReelOut above Manual
    QCOMPARE(window.colorAt(0.9, 0.95), window.colorAt(0.6, 0.95));   // mode never changes
}

void tst_StatesInPlots::aStateThatIsHeldStaysOneBand()
{
    FedPlotWindow window(R"({"curves":[{"bands":true,"signal":"mode"}],"grid":false})");
    QVERIFY(window.show());
    QPlcSignalList values = valueOf("mode", QPlcValue(qint8(0)));
    const int channel = window.context.curveSources()->find(QStringLiteral("mode")).channel;
    for (int i = 0; i < 100; ++i) {  // about a third of the view, half of it held
        window.take(values);
        if (i < 50)
            window.plant->store()->mark(channel, QPlcQuality::Held);
    }
    window.context.timeAxis()->setSpan(2800 * millisecond);                // draws again
    QTRY_VERIFY(window.colorAt(0.75, 0.98) != window.colorAt(0.75, 0.5));  // a pale edge
    QCOMPARE(window.colorAt(0.75, 0.3), window.colorAt(0.95, 0.3));
    QCOMPARE(window.colorAt(0.95, 0.98), window.colorAt(0.95, 0.3));
}

void tst_StatesInPlots::theLegendHasTheColourOfTheBand()
{
    FedPlotWindow window(R"({"curves":[{"signal":"speed"},{"bands":true,"signal":"phase"}],"grid":false})");
    QVERIFY(window.show());
    const auto swatch = [&] { return window.legend()->entries().value(1).color; };
    QTRY_COMPARE(swatch(), window.colorAt(0.97, 0.98));
    window.context.timeAxis()->setPointer(window.canvas()->timeAt(0.2 * window.canvas()->canvas()->width()));
    QTRY_COMPARE(swatch(), window.colorAt(0.1, 0.98));
}

void tst_StatesInPlots::numericSignalHasNoBands()
{
    const FedPlotWindow window(R"({"curves":[{"bands":true,"signal":"speed"}]})");
    QCOMPARE(window.count(bands), 0);
    QCOMPARE(window.count(lines), 1);
    QVERIFY(!window.action("bands")->isEnabled());
}

QTEST_MAIN(tst_StatesInPlots)
#include "tst_StatesInPlots.moc"
