// SPDX-License-Identifier: Apache-2.0
// What a time plot shows, with a real plant, and what people do with the mouse.
#include "../../common/Waiting.h"
#include "FedPlotWindow.h"
#include "PlotFixtures.h"

#include <QtCore/QJsonArray>
#include <QtWidgets/QTableWidget>
#include <QtWidgets/QToolButton>

#include <qwt_scale_widget.h>

using namespace qplc;
using Time = QPlcTimeAxis::Time;

namespace {

constexpr Time s = 1'000'000'000;

void wheel(QWidget *widget, QPoint at, int steps, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
{
    QWheelEvent event(at, widget->mapToGlobal(at), {}, QPoint(0, 120 * steps), Qt::NoButton, modifiers,
                      Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(widget, &event);
}

void moveMouse(QWidget *widget, QPoint to)
{
    QMouseEvent event(QEvent::MouseMove, to, widget->mapToGlobal(to), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
    QCoreApplication::sendEvent(widget, &event);
}

void drag(QWidget *widget, QPoint from, QPoint to, Qt::MouseButton button = Qt::LeftButton,
          Qt::KeyboardModifiers modifiers = Qt::NoModifier)
{
    const auto send = [&](QEvent::Type type, QPoint at, Qt::MouseButton which, Qt::MouseButtons held) {
        QMouseEvent event(type, at, widget->mapToGlobal(at), which, held, modifiers);
        QCoreApplication::sendEvent(widget, &event);
    };
    send(QEvent::MouseButtonPress, from, button, button);
    for (int i = 1; i <= 10; ++i)
        send(QEvent::MouseMove, from + (to - from) * i / 10, Qt::NoButton, button);
    send(QEvent::MouseButtonRelease, to, button, Qt::NoButton);
}

/// The newest time between two rows that follow each other: a busy machine leaves cycles out, and
/// there are no values in gaps.
Time timeWithValue(PlotWindow &window)
{
    const SignalStore &store = *window.context.plants()->at(0)->store();
    SignalStore::Row row = *store.newestRow();
    while (row > store.firstRow() + 1 && store.beginsAnew(row))
        --row;
    return (store.time(row - 1) + store.time(row)) / 2;
}

QToolButton *liveButton(const PlotWindow &window)
{
    return window.canvas()->canvas()->findChild<QToolButton *>();
}

}  // namespace

class tst_TimePlot : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void numbersComeWithThePlayhead();
    void plotWithoutContextAcceptsSignalsAndActions();
    void emptyPlotShowsAHint();
    void missingSignalIsReportedAndFoundLater();
    void aLivePlotShowsTheNewestValues();
    void hiddenPlotsNeverDraw();
    void aFrozenPlotIsDrawnOnceAndDataGoOn();
    void theWheelZoomsAtTheMouseAndFreezes();
    void controlAndTheWheelZoomTheValues();
    void theWheelOverAnAxisZoomsItsValues();
    void draggingPansByWhatTheMouseMoves();
    void twoFingersZoomTheTime();
    void aBoxIsZoomedInto();
    void escapeEndsABoxAndADrag();
    void aDoubleClickShowsAll();
    void cursorsAreDragged();
    void theMousePointsInAllPlots();
    void restingMousePointsAtTheNewViewTime();
    void ownTimeAxisIsIndependentOfTheWindow();
    void limitsAndStepsComeFromTheTable();
    void referenceLinesAreIncludedInTheRange();
    void wholeNumbersHaveNoTicksBetweenThem();
};

void tst_TimePlot::plotWithoutContextAcceptsSignalsAndActions()
{
    QPlcTimePlot plot;
    plot.resize(240, 120);
    plot.show();
    QVERIFY(QTest::qWaitForWindowExposed(&plot));
    QVERIFY(plot.addSignals({QStringLiteral("count")}));
    for (QAction *action : plot.actions()) {
        if (!action->objectName().startsWith(QLatin1String("save")))
            action->trigger();
    }
    QTRY_VERIFY(plot.drawnPictures() > 0);
}

void tst_TimePlot::emptyPlotShowsAHint()
{
    PlotWindow window;
    window.plot->show();
    QTRY_COMPARE(window.hint(), QStringLiteral("Drop signals here or press +"));
    window.apply(R"({"curves":[{"signal":"count","visible":false}]})");
    QTRY_VERIFY(window.hint().contains(QStringLiteral("hidden")));
}

void tst_TimePlot::missingSignalIsReportedAndFoundLater()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    window.plot->show();
    QTRY_VERIFY(window.hint().contains(QStringLiteral("Missing: count")));
    QCOMPARE(window.part<PlotLegend>()->entries().value(0).value, QStringLiteral("missing"));
    QVERIFY(!window.part<PlotLegend>()->entries().value(0).isTrusted);
    QVERIFY(window.run(0.1));
    QTRY_COMPARE(window.hint(), QString());
    QTRY_VERIFY(window.part<PlotLegend>()->entries().value(0).value.toDouble() > 0.0);
}

void tst_TimePlot::aLivePlotShowsTheNewestValues()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    QVERIFY(window.run(0.3));
    const int before = window.plot->drawnPictures();
    QTRY_VERIFY(window.plot->drawnPictures() > before + 3);
    QVERIFY(std::abs(window.canvas()->end() - window.time()->newest()) < s);
    QCOMPARE((window.canvas()->end() - window.canvas()->begin() + s / 2) / s, window.time()->span() / s);
    const double top = window.canvas()->valueAt(PlotCurveSettings::Left, 0.0);
    QVERIFY(top > window.part<PlotLegend>()->entries().value(0).value.toDouble() * 0.9);
    QVERIFY(!liveButton(window)->isVisible());
}

void tst_TimePlot::hiddenPlotsNeverDraw()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    QVERIFY(window.run(0.2));
    window.plot->hide();
    const int before = window.plot->drawnPictures();
    const double past = window.past();
    QTRY_VERIFY(window.past() > past + 0.3);
    window.time()->pan(-s);
    QCOMPARE(window.plot->drawnPictures(), before);
    window.plot->show();
    QTRY_VERIFY(window.plot->drawnPictures() > before);
}

void tst_TimePlot::aFrozenPlotIsDrawnOnceAndDataGoOn()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}],"left":{"minimum":0,"maximum":1000}})");
    QVERIFY(window.run(0.5));
    QVERIFY(window.show(window.time()->newest() - s / 2, window.time()->newest() - s / 10));
    QTRY_VERIFY(liveButton(window)->isVisible());
    const int before = window.plot->drawnPictures();
    const double past = window.past();
    QTRY_VERIFY(window.past() > past + 1.2);
    QVERIFY(window.plot->drawnPictures() <= before + 1);
    QTRY_VERIFY2(liveButton(window)->text().contains(QStringLiteral("s behind")),
                 qPrintable(liveButton(window)->text()));
    QTest::mouseClick(liveButton(window), Qt::LeftButton);
    QVERIFY(window.time()->isLive());
    QTRY_VERIFY(!liveButton(window)->isVisible());
}

void tst_TimePlot::theWheelZoomsAtTheMouseAndFreezes()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    QVERIFY(window.run(0.2));
    QWidget *canvas = window.canvas()->canvas();
    const QPoint at(canvas->width() / 4, canvas->height() / 2);
    const Time below = window.canvas()->timeAt(at.x());
    const Time span = window.time()->span();
    wheel(canvas, at, 2);
    QVERIFY(!window.time()->isLive());
    QVERIFY(window.time()->span() < span);
    QTRY_VERIFY(std::abs(window.canvas()->timeAt(at.x()) - below) < span / 100);
    wheel(canvas, at, -2);
    QTRY_VERIFY(std::abs(window.time()->span() - span) < span / 1000);
}

void tst_TimePlot::controlAndTheWheelZoomTheValues()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}],"left":{"minimum":0,"maximum":100}})");
    QVERIFY(window.run(0.1));
    QWidget *canvas = window.canvas()->canvas();
    const auto top = [&] { return window.canvas()->valueAt(PlotCurveSettings::Left, 0.0); };
    QTRY_COMPARE(qRound(top()), 100);
    wheel(canvas, {20, canvas->height()}, 1, Qt::ControlModifier);
    QTRY_COMPARE(qRound(top()), 80);
    QVERIFY(window.time()->isLive());
    window.trigger("all");
    QTRY_COMPARE(qRound(top()), 100);
}

void tst_TimePlot::theWheelOverAnAxisZoomsItsValues()
{
    PlotWindow window(R"({"curves":[{"signal":"count"},{"signal":"count","axis":"right"}],"left":{"minimum":0,)"
                      R"("maximum":100},"right":{"minimum":0,"maximum":10}})");
    QVERIFY(window.run(0.1));
    QWidget *axis = window.canvas()->axisWidget(QwtPlot::yRight);
    const auto high = [&](PlotCanvas::Axis which) { return window.canvas()->valueAt(which, 0.0); };
    QTRY_COMPARE(qRound(high(PlotCurveSettings::Right)), 10);
    wheel(axis, {5, axis->height() / 2}, -1);
    QTRY_VERIFY(high(PlotCurveSettings::Right) > 10.5);
    QCOMPARE(qRound(high(PlotCurveSettings::Left)), 100);
}

void tst_TimePlot::draggingPansByWhatTheMouseMoves()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    QVERIFY(window.run(0.2));
    window.time()->freeze();
    QVERIFY(window.isDrawn());
    QWidget *canvas = window.canvas()->canvas();
    const Time before = window.time()->end();
    drag(canvas, {100, 50}, {100 + canvas->width() / 2, 60});
    const Time half = window.time()->span() / 2;
    QVERIFY(std::abs(before - window.time()->end() - half) < half / 20);
}

void tst_TimePlot::twoFingersZoomTheTime()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    QVERIFY(window.run(0.3));
    const Time newest = window.time()->newest();
    QVERIFY(window.show(newest - 10 * s, newest));
    QTouchDevice *screen = QTest::createTouchDevice();
    QWidget *canvas = window.canvas()->canvas();
    const Time about = window.canvas()->timeAt(200.0);
    QTest::touchEvent(canvas, screen).press(0, {150, 80}, canvas).press(1, {250, 80}, canvas);
    for (int i = 1; i <= 10; ++i)
        QTest::touchEvent(canvas, screen).move(0, {150 - 5 * i, 80}, canvas).move(1, {250 + 5 * i, 80}, canvas);
    QTest::touchEvent(canvas, screen).release(0, {100, 80}, canvas).release(1, {300, 80}, canvas);
    const double zoomed = double(window.time()->span()) / double(10 * s);
    QVERIFY2(zoomed > 0.4 && zoomed < 0.65, qPrintable(QString::number(zoomed)));
    QTRY_VERIFY(std::abs(window.canvas()->xOf(about) - 200.0) < 15.0);
}

void tst_TimePlot::aBoxIsZoomedInto()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}],"left":{"minimum":0,"maximum":100}})");
    QVERIFY(window.run(0.2));
    window.time()->freeze();
    QVERIFY(window.isDrawn());
    for (const bool isByKey : {true, false}) {
        window.trigger("all");
        QTRY_COMPARE(qRound(window.canvas()->valueAt(PlotCurveSettings::Left, 0.0)), 100);
        QWidget *canvas = window.canvas()->canvas();
        const QRect box(canvas->width() / 4, canvas->height() / 4, canvas->width() / 2, canvas->height() / 2);
        const Time left = window.canvas()->timeAt(box.left());
        const Time span = window.canvas()->end() - window.canvas()->begin();
        drag(canvas, box.bottomRight(), box.topLeft(), isByKey ? Qt::LeftButton : Qt::RightButton,
             isByKey ? Qt::ShiftModifier : Qt::NoModifier);
        QCOMPARE(window.time()->begin(), left);
        QVERIFY(std::abs(window.time()->span() - span / 2) < span / 50);
        QTRY_COMPARE(qRound(window.canvas()->valueAt(PlotCurveSettings::Left, 0.0)), 75);
        QCOMPARE(qRound(window.canvas()->valueAt(PlotCurveSettings::Left, canvas->height())), 25);
    }
}

void tst_TimePlot::escapeEndsABoxAndADrag()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    QVERIFY(window.run(0.2));
    window.time()->freeze();
    QVERIFY(window.isDrawn());
    QWidget *canvas = window.canvas()->canvas();
    for (const Qt::MouseButton button : {Qt::RightButton, Qt::LeftButton}) {
        const QPoint center = canvas->rect().center();
        QTest::mousePress(canvas, button, {}, center);
        for (int step = 1; step < 4; ++step) {
            QMouseEvent move(QEvent::MouseMove, center + 8 * step * QPoint(1, 1), Qt::NoButton, button, {});
            QCoreApplication::sendEvent(canvas, &move);
        }
        const Time begin = window.time()->begin();
        const Time span = window.time()->span();
        QTest::keyClick(window.plot, Qt::Key_Escape);
        QMouseEvent move(QEvent::MouseMove, center + QPoint(-40, 50), Qt::NoButton, button, {});
        QCoreApplication::sendEvent(canvas, &move);
        QTest::mouseRelease(canvas, button, {}, center + QPoint(-40, 50));
        QCOMPARE(window.time()->begin(), begin);
        QCOMPARE(window.time()->span(), span);
    }
}

void tst_TimePlot::aDoubleClickShowsAll()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    QVERIFY(window.run(0.4));
    window.time()->show(window.time()->newest() - s / 10, window.time()->newest());
    QTest::mouseDClick(window.canvas()->canvas(), Qt::LeftButton, {}, {50, 50});
    QVERIFY(std::abs(double(window.time()->span()) * 1e-9 - window.past()) < 0.2);
}

void tst_TimePlot::cursorsAreDragged()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    QVERIFY(window.run(2.5));
    QVERIFY(window.show(window.time()->newest() - 2 * s, window.time()->newest()));
    window.trigger("cursorA");
    window.trigger("cursorB");
    const auto &picture = window.part<PlotOverlay>()->picture();
    QTRY_VERIFY(picture.cursorA && picture.cursorB);
    const int from = *picture.cursorB;
    QVERIFY(*picture.cursorA < from);
    drag(window.canvas()->canvas(), {from + 2, 40}, {from + 50, 40});
    QTRY_VERIFY(std::abs(*picture.cursorB - from - 50) <= 4);
    const SignalStore &store = *window.context.plants()->at(0)->store();
    const Time b = *window.time()->cursor(QPlcTimeAxis::B);
    QCOMPARE(store.time(store.rowAt(b)), b);  // it has gone to a row
    QVERIFY(!window.time()->isLive());
    QTRY_VERIFY(window.part<StatisticsView>()->isVisible());
    QTRY_VERIFY(window.part<StatisticsView>()->timesText().contains(QStringLiteral("1/Δt")));
    const QString mean = window.part<StatisticsView>()->table()->item(0, 6)->text();
    QVERIFY2(mean.toDouble() > 0.0, qPrintable(mean));
    window.trigger("removeCursors");
    QTRY_VERIFY(!window.part<StatisticsView>()->isVisible());
}

void tst_TimePlot::theMousePointsInAllPlots()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    QVERIFY(window.run(0.4));
    const Time middle = timeWithValue(window);
    QVERIFY(window.show(middle - s / 8, middle + s / 8));
    QWidget *canvas = window.canvas()->canvas();
    moveMouse(canvas, {canvas->width() / 2, 30});
    QVERIFY(window.time()->pointer());
    QCOMPARE(*window.time()->pointer(), window.canvas()->timeAt(canvas->width() / 2));
    const auto &picture = window.part<PlotOverlay>()->picture();
    QTRY_COMPARE(picture.dots.size(), 1);
    QEvent leave(QEvent::Leave);
    QCoreApplication::sendEvent(canvas, &leave);
    QVERIFY(!window.time()->pointer());
}

void tst_TimePlot::restingMousePointsAtTheNewViewTime()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    QVERIFY(window.run(0.4));
    QWidget *canvas = window.canvas()->canvas();
    moveMouse(canvas, {canvas->width() / 2, 30});  // in the middle of 30 s, where there are no values
    const Time middle = timeWithValue(window);
    QVERIFY(window.show(middle - s / 8, middle + s / 8));
    QTRY_COMPARE(*window.time()->pointer(), window.canvas()->timeAt(canvas->width() / 2));
    QTRY_COMPARE(window.part<PlotOverlay>()->picture().dots.size(), 1);
}

void tst_TimePlot::ownTimeAxisIsIndependentOfTheWindow()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}],"time":"own","span":5})");
    QVERIFY(window.run(0.2));
    const auto span = [&] { return (window.canvas()->end() - window.canvas()->begin() + s / 2) / s; };
    QTRY_COMPARE(span(), 5);
    window.time()->setSpan(100 * s);
    window.trigger("freeze");
    QVERIFY(window.time()->isLive());
    QTRY_VERIFY(liveButton(window)->isVisible());
    QCOMPARE(span(), 5);
}

void tst_TimePlot::limitsAndStepsComeFromTheTable()
{
    PlotWindow window(R"({"curves":[{"signal":"count"},{"signal":"setpoint","gain":2}],"limits":true})");
    QVERIFY(window.run(0.1));
    const QwtPlotItemList items = window.canvas()->itemList(QwtPlotItem::Rtti_PlotUserItem + 1);
    QCOMPARE(items.size(), 2);
    QCOMPARE(static_cast<StoreCurve *>(items.first())->style(), StoreCurve::Steps);
    QCOMPARE(static_cast<StoreCurve *>(items.last())->style(), StoreCurve::Line);
    QCOMPARE(window.canvas()->itemList(QwtPlotItem::Rtti_PlotMarker).size(), 2);
    QCOMPARE(window.canvas()->axisTitle(QwtPlot::yLeft).text(), QString());  // two units
    window.apply(R"({"curves":[{"signal":"count"},{"signal":"setpoint"}]})");
    QCOMPARE(window.canvas()->itemList(QwtPlotItem::Rtti_PlotMarker).size(), 0);
    window.apply(R"({"curves":[{"signal":"setpoint","gain":2}]})");
    QCOMPARE(window.canvas()->itemList(QwtPlotItem::Rtti_PlotMarker).size(), 2);  // nobody takes them for others
    window.trigger("limits");
    QCOMPARE(window.canvas()->itemList(QwtPlotItem::Rtti_PlotMarker).size(), 0);
    QCOMPARE(window.settings(), QByteArray(R"({"curves":[{"gain":2,"signal":"setpoint"}],"limits":false})"));
    QCOMPARE(window.canvas()->axisTitle(QwtPlot::yLeft).text(), QStringLiteral("m/s"));
}

void tst_TimePlot::referenceLinesAreIncludedInTheRange()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}],"left":{"lines":[1000000]}})");
    QVERIFY(window.run(0.2));
    QTRY_VERIFY(window.canvas()->valueAt(PlotCurveSettings::Left, 0.0) >= 1e6);
    QCOMPARE(window.canvas()->itemList(QwtPlotItem::Rtti_PlotMarker).size(), 1);
    window.trigger("removeLines");
    QCOMPARE(window.settings(), QByteArray(R"({"curves":[{"signal":"count"}]})"));
    QCOMPARE(window.canvas()->itemList(QwtPlotItem::Rtti_PlotMarker).size(), 0);
    QTRY_VERIFY(window.canvas()->valueAt(PlotCurveSettings::Left, 0.0) < 1e6);
    const double middle = window.canvas()->valueAt(PlotCurveSettings::Left, 0.5 * window.canvas()->canvas()->height());
    window.trigger("addLine");
    const double line = window.plot->settings()["left"].toObject()["lines"].toArray().at(0).toDouble();
    QVERIFY2(std::abs(line - middle) <= 0.1 * middle, qPrintable(QString::number(line)));
    QCOMPARE(QString::number(line, 'g', 6).toDouble(), line);
}

void tst_TimePlot::wholeNumbersHaveNoTicksBetweenThem()
{
    PlotCanvas canvas;
    canvas.resize(600, 500);
    canvas.show();
    QVERIFY(QTest::qWaitForWindowExposed(&canvas));
    const auto ticks = [&] { return canvas.axisScaleDiv(QwtPlot::yLeft).ticks(QwtScaleDiv::MajorTick); };
    canvas.setRange(PlotCurveSettings::Left, 0.0, 2.0);
    QVERIFY(ticks().size() > 3);
    canvas.setRange(PlotCurveSettings::Left, 0.0, 2.0, PlotCanvas::WholeTicks);
    QCOMPARE(ticks(), (QList<double>{0.0, 1.0, 2.0}));
    canvas.setRange(PlotCurveSettings::Left, 0.0, 1000.0, PlotCanvas::WholeTicks);
    QVERIFY(ticks().size() > 3 && ticks().size() < 30);
}

void tst_TimePlot::numbersComeWithThePlayhead()
{
    FedPlotWindow window(R"({"curves":[{"signal":"speed"}]})");
    QVERIFY(window.show());
    const SignalStore *store = window.plant->store();
    window.context.timeAxis()->setPlayhead(store->time(store->firstRow() + 150));
    const auto *overlay = window.plot->findChild<PlotOverlay *>();
    QVERIFY(waitUntil([overlay] { return overlay->picture().playhead.has_value(); }));
    const QString value = window.legend()->entries().first().value;
    QVERIFY2(value.startsWith(QLatin1String("150")), qPrintable(value));
}

QTEST_MAIN(tst_TimePlot)
#include "tst_TimePlot.moc"
