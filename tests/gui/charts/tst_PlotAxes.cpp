// SPDX-License-Identifier: Apache-2.0
// Curves of different units in a time plot.
#include "../../common/Waiting.h"
#include "FedPlotWindow.h"
#include "gui/panel/SignalDropArea.h"

#include <QtCore/QJsonArray>
#include <QtGui/QWheelEvent>
#include <QtWidgets/QMenu>

#include <qwt_scale_widget.h>

using namespace qplc;

namespace {

constexpr PlotCurveSettings::Axis atLeft = PlotCurveSettings::Left;
constexpr PlotCurveSettings::Axis atRight = PlotCurveSettings::Right;

QColor colorOf(const FedPlotWindow &window, int axis)
{
    return window.canvas()->scaleWidget(axis)->palette().color(QPalette::Text);
}

QString titleOf(const FedPlotWindow &window, int axis)
{
    return window.canvas()->scaleWidget(axis)->title().text();
}

double topOf(const FedPlotWindow &window, int axis)
{
    return window.canvas()->valueAt(axis, 0.0);
}

}  // namespace

class tst_PlotAxes : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void eachUnitHasAnAxis();
    void curvesWithoutUnitShareAnAxis();
    void aPersonChoosesTheSide();
    void aCurveOfAnotherUnitHasAnAxisInItsColour();
    void anAxisOfSeveralCurvesHasTheirColours();
    void aThirdUnitHasAThirdAxis();
    void theMouseZoomsAFurtherAxis();
    void theRightAxisIsChosenInTheMenuOfTheCurve();
    void aSignalIsDroppedOnTheRightAxis();
    void aRangeOfAFurtherAxisIsKept();
    void furtherAxesLeaveTheCurvesRoom();
    void axesAndLegendHaveThePrefixThatFits();
};

void tst_PlotAxes::eachUnitHasAnAxis()
{
    PlotAxes axes;
    QCOMPARE(axes.add({}, QStringLiteral("m")), 0);
    QCOMPARE(axes.add({}, QStringLiteral("N")), 1);
    QCOMPARE(axes.add({}, QStringLiteral("m")), 0);
    QCOMPARE(axes.add({}, QStringLiteral("W")), 2);
    QCOMPARE(axes.add({}, QStringLiteral("W")), 2);
    QCOMPARE(axes.add({}, QString()), 3);
    QCOMPARE(axes.count(), 4);
}

void tst_PlotAxes::curvesWithoutUnitShareAnAxis()
{
    PlotAxes axes;
    const QString one = QStringLiteral("1");  // as tables write that there is no unit
    QCOMPARE(axes.add({}, QString()), 0);
    QCOMPARE(axes.add({}, one), 0);
    QCOMPARE(axes.add({}, QString()), 0);
    QCOMPARE(axes.add({}, QStringLiteral("m")), 1);
    QCOMPARE(axes.add({}, one), 0);
    PlotAxes others;
    QCOMPARE(others.add({}, QStringLiteral("m")), 0);
    QCOMPARE(others.add({}, one), 1);
    QCOMPARE(others.add({}, QString()), 1);
    QCOMPARE(others.add(atRight, one), 1);
    QCOMPARE(others.count(), 2);
}

void tst_PlotAxes::aPersonChoosesTheSide()
{
    PlotAxes axes;
    QCOMPARE(axes.add({}, QStringLiteral("m")), 0);
    QCOMPARE(axes.add(atRight, QStringLiteral("m")), 1);  // as layouts had it before units had axes
    QCOMPARE(axes.add({}, QStringLiteral("m")), 0);
    const int second = axes.add(atLeft, QStringLiteral("N"));
    QCOMPARE(second, 2);
    QCOMPARE(axes.at(second).side, atLeft);
}

void tst_PlotAxes::aCurveOfAnotherUnitHasAnAxisInItsColour()
{
    FedPlotWindow window(R"({"curves":[{"signal":"speed"},{"signal":"force"}]})");
    QVERIFY(window.show());
    QCOMPARE(titleOf(window, 0), QStringLiteral("m/s"));
    QCOMPARE(titleOf(window, 1), QStringLiteral("N"));
    QVERIFY(window.canvas()->isAxisVisible(1));
    QTRY_COMPARE(colorOf(window, 0), window.legend()->entries().value(0).color);
    QCOMPARE(colorOf(window, 1), window.legend()->entries().value(1).color);
    QVERIFY(topOf(window, 0) < 1000.0);
    QVERIFY(topOf(window, 1) > 4000.0);
}

void tst_PlotAxes::anAxisOfSeveralCurvesHasTheirColours()
{
    FedPlotWindow window(R"({"curves":[{"signal":"speed"},{"signal":"windSpeed"},{"signal":"force"}]})");
    QVERIFY(window.show());
    for (int curve : {0, 1})
        QVERIFY(titleOf(window, 0).contains(window.context.theme().curve(curve).name()));
    QVERIFY(titleOf(window, 0).contains(QStringLiteral("m/s")));
    window.apply(R"({"curves":[{"signal":"speed"},{"signal":"windSpeed"}]})");
    QCOMPARE(titleOf(window, 0), QStringLiteral("m/s"));  // the only axis needs no colours
    QCOMPARE(colorOf(window, 0), window.context.theme().mutedText);
}

void tst_PlotAxes::aThirdUnitHasAThirdAxis()
{
    FedPlotWindow window(R"({"curves":[{"signal":"speed"},{"signal":"force"},{"signal":"power"}]})");
    window.plot->resize(900, 400);
    QVERIFY(window.show());
    PlotCanvas *canvas = window.canvas();
    QCOMPARE(canvas->axisCount(), 3);
    QTRY_VERIFY(canvas->isAxisVisible(2));
    QCOMPARE(titleOf(window, 2).contains(QLatin1Char('W')), true);
    QCOMPARE(colorOf(window, 2), window.context.theme().curve(2));
    // It is beside the right one, over all the height, and has the values of its curve.
    const QRect second = canvas->scaleWidget(1)->geometry();
    const QRect third = canvas->scaleWidget(2)->geometry();
    QVERIFY(third.left() > second.right() && third.right() <= canvas->rect().right());
    QVERIFY(std::abs(third.height() - second.height()) < 20);
    QVERIFY(topOf(window, 2) > 1e6 && canvas->valueAt(2, canvas->canvas()->height()) > 1e5);
    const QImage picture = canvas->grab().toImage();
    int colored = 0;
    for (int y = third.top(); y < third.bottom(); ++y) {
        for (int x = third.left(); x < third.right(); ++x)
            colored += picture.pixelColor(x, y) == window.context.theme().curve(2) ? 1 : 0;
    }
    QVERIFY(colored > 20);
    // Its curve is where its scale says.
    window.apply(R"({"curves":[{"signal":"speed","visible":false},{"signal":"force","visible":false},)"
                 R"({"signal":"power"}],"grid":false})");
    const auto isCurveAt = [&](double value) {
        const double y = canvas->yOf(2, value);
        for (int row = -5; row <= 5; ++row) {
            if (window.colorAt(0.98, (y + row) / canvas->canvas()->height()) != window.context.theme().surface)
                return true;
        }
        return false;
    };
    QTRY_VERIFY(isCurveAt(1.002e6));  // the newest values
    QVERIFY(!isCurveAt(0.9e6));
    window.apply(R"({"curves":[{"signal":"speed"}]})");
    QCOMPARE(canvas->axisCount(), 2);
    QVERIFY(!canvas->isAxisVisible(1));
}

void tst_PlotAxes::theMouseZoomsAFurtherAxis()
{
    FedPlotWindow window(R"({"axes":{"W":{"maximum":100,"minimum":0}},"curves":[{"signal":"speed"},{"signal":"force"},)"
                         R"({"signal":"power"}],"left":{"maximum":10,"minimum":0}})");
    window.plot->resize(900, 400);
    QVERIFY(window.show());
    QTRY_COMPARE(qRound(topOf(window, 2)), 100);
    QWidget *scale = window.canvas()->scaleWidget(2);
    QWheelEvent wheel(QPointF(5, 50), scale->mapToGlobal(QPoint(5, 50)), {}, QPoint(0, -120), Qt::NoButton,
                      Qt::NoModifier, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(scale, &wheel);
    QTRY_VERIFY(topOf(window, 2) > 101.0);
    QCOMPARE(qRound(topOf(window, 0)), 10);
}

void tst_PlotAxes::theRightAxisIsChosenInTheMenuOfTheCurve()
{
    FedPlotWindow window(R"({"curves":[{"signal":"speed"},{"signal":"windSpeed"}]})");
    QVERIFY(window.show());
    QCOMPARE(window.canvas()->axisCount(), 2);
    window.action("next")->trigger();
    window.action("next")->trigger();  // windSpeed
    QContextMenuEvent event(QContextMenuEvent::Keyboard, {});
    QCoreApplication::sendEvent(window.plot, &event);
    const auto *menu = window.plot->findChild<QMenu *>();
    QVERIFY(menu && menu->actions().contains(window.action("rightAxis")));
    QVERIFY(!window.action("rightAxis")->isChecked());
    window.action("rightAxis")->trigger();
    QCOMPARE(window.settings(), QByteArray(R"({"curves":[{"signal":"speed"},{"axis":"right","signal":"windSpeed"}]})"));
    QVERIFY(window.canvas()->isAxisVisible(1));
    QVERIFY(window.action("rightAxis")->isChecked());
    window.action("rightAxis")->trigger();
    QVERIFY(!window.canvas()->isAxisVisible(1));
}

void tst_PlotAxes::aSignalIsDroppedOnTheRightAxis()
{
    FedPlotWindow window("{}");
    const auto *area = window.plot->findChild<SignalDropArea *>();
    QVERIFY(area && area->area().isNull());  // an empty plot has one place for signals
    window.apply(R"({"curves":[{"signal":"speed"}]})");
    QVERIFY(window.show());
    const QRect canvas(window.canvas()->canvas()->mapTo(window.plot, QPoint()), window.canvas()->canvas()->size());
    QVERIFY(canvas.contains(area->area()));
    QVERIFY(area->area().center().x() > canvas.center().x());
    QVERIFY(area->add({QStringLiteral("windSpeed")}));
    QCOMPARE(window.settings(), QByteArray(R"({"curves":[{"signal":"speed"},{"axis":"right","signal":"windSpeed"}]})"));
    QVERIFY(window.canvas()->isAxisVisible(1));
}

void tst_PlotAxes::aRangeOfAFurtherAxisIsKept()
{
    const QByteArray text(R"({"axes":{"W":{"lines":[5],"maximum":10,"minimum":0}},)"
                          R"("curves":[{"signal":"speed"},{"signal":"force"},{"signal":"power"}]})");
    FedPlotWindow window(text);
    QCOMPARE(window.settings(), text);
    QVERIFY(window.show());
    QTRY_COMPARE(qRound(topOf(window, 2)), 10);
    window.action("removeLines")->trigger();
    QVERIFY(!window.settings().contains("lines"));
}

void tst_PlotAxes::furtherAxesLeaveTheCurvesRoom()
{
    FedPlotWindow window(R"({"curves":[{"signal":"speed"},{"signal":"force"},{"signal":"power"},)"
                         R"({"signal":"angle"},{"signal":"mode"}]})");
    QVERIFY(window.show());
    for (const int width : {1200, 600, 400, 250}) {
        window.plot->resize(width, 300);
        QCoreApplication::processEvents();
        int further = 0;
        for (int axis = 2; axis < window.canvas()->axisCount(); ++axis)
            further += window.canvas()->isAxisVisible(axis) ? window.canvas()->scaleWidget(axis)->width() : 0;
        QVERIFY2(further <= 0.4 * width, qPrintable(QString::number(further)));
    }
    window.plot->resize(1200, 300);
    QTRY_VERIFY(window.canvas()->isAxisVisible(4));
}

void tst_PlotAxes::axesAndLegendHaveThePrefixThatFits()
{
    FedPlotWindow window(R"({"curves":[{"signal":"power"},{"signal":"angle"}]})");
    QVERIFY(window.show());
    QTRY_COMPARE(titleOf(window, 0), QStringLiteral("MW"));
    QCOMPARE(window.canvas()->scaleWidget(0)->scaleDraw()->label(1e6).text().toDouble(), 1.0);
    QCOMPARE(titleOf(window, 1), QStringLiteral("deg"));
    QTRY_COMPARE(window.legend()->entries().value(0).unit, QStringLiteral("MW"));
    QCOMPARE(window.legend()->entries().value(0).value, QStringLiteral("1.0080"));
    QCOMPARE(window.legend()->entries().value(1).unit, QStringLiteral("deg"));
    QCOMPARE(window.legend()->entries().value(1).value, QStringLiteral("74.750"));
}

QTEST_MAIN(tst_PlotAxes)
#include "tst_PlotAxes.moc"
