// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "QPlcXyPlot.h"

#include "PanelFixtures.h"
#include "PlantFixtures.h"
#include "gui/charts/XyCanvas.h"
#include "gui/charts/XyInteraction.h"
#include "gui/panel/WindowContext.h"
#include "gui/plot/PastRows.h"

#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtGui/QClipboard>
#include <QtGui/QGuiApplication>
#include <QtGui/QWheelEvent>
#include <QtWidgets/QAction>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>

#include <cmath>

#include <qwt_scale_draw.h>
#include <qwt_scale_map.h>
#include <qwt_scale_widget.h>

using namespace qplc;

namespace {

QPlcPast pastOf(const std::shared_ptr<SignalStore> &store, int channel)
{
    QPlcPast past = PastRows::past(store, channel);
    past.expression = QString::number(channel);
    past.unit = QStringLiteral("m");
    return past;
}

void wheel(QWidget *widget, QPoint at, int steps, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
{
    QWheelEvent event(at, widget->mapToGlobal(at), {}, QPoint(0, 120 * steps), Qt::NoButton, modifiers,
                      Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(widget, &event);
}

void drag(QWidget *widget, QPoint from, QPoint to, Qt::MouseButton button)
{
    const auto send = [&](QEvent::Type type, QPoint at, Qt::MouseButton which, Qt::MouseButtons held) {
        QMouseEvent event(type, at, widget->mapToGlobal(at), which, held, Qt::NoModifier);
        QCoreApplication::sendEvent(widget, &event);
    };
    send(QEvent::MouseButtonPress, from, button, button);
    for (int i = 1; i <= 10; ++i)
        send(QEvent::MouseMove, from + (to - from) * i / 10, Qt::NoButton, button);
    send(QEvent::MouseButtonRelease, to, button, Qt::NoButton);
}

bool isNear(QPointF a, QPointF b, double distance = 0.02)
{
    return std::hypot(a.x() - b.x(), a.y() - b.y()) < distance;
}

}  // namespace

class tst_QPlcXyPlot : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void settingsAreRestoredUnchanged_data();
    void settingsAreRestoredUnchanged();
    void plotWithoutWindowReportsThatNoPlantIsConnected();
    void twoSignalsAreACurve();
    void missingSignalsAreReported();
    void aCurveAppearsWhenItsSignalsDo();
    void signalsOfTwoPlantsAreRefused();
    void theSettingsAreEdited();
    void equalAspectGivesBothAxesTheSameScale();
    void plotIsDrawnOnlyWhenThePictureChanges();
    void theDotIsAtTheDisplayedTime();
    void pairsAreRowsOfTheSameTime();
    void pathOmitsSubstituteValues();
    void aSettingThatIsMissingIsADefault();
    void theWheelZoomsAboutTheMouse();
    void draggingPansAndABoxIsZoomedInto();
    void twoFingersZoom();
    void axesThatAreZoomedStay();
    void axisNumbersUseTheFormatOfOtherCharts();
    void longAxisTitleKeepsItsUnit();
    void visibleTimeRangeIsExported();

private:
    void fill();
    std::unique_ptr<XyCanvas> canvasOf(int x, int y);

    std::shared_ptr<SignalStore> m_store;
};

void tst_QPlcXyPlot::settingsAreRestoredUnchanged_data()
{
    QTest::addColumn<QByteArray>("json");
    QTest::newRow("none") << QByteArray("{}");
    QTest::newRow("curves") << QByteArray(
        R"({"curves":[{"x":"a","y":"= 2*b"},{"color":"#ff0000","later":7,"x":"c","y":"d"}]})");
    QTest::newRow("aspect") << QByteArray(R"({"curves":[{"x":"a"}],"equalAspect":true,"title":"Path","unknown":[1]})");
    QTest::newRow("default said") << QByteArray(R"({"equalAspect":false})");
}

void tst_QPlcXyPlot::settingsAreRestoredUnchanged()
{
    QFETCH(QByteArray, json);
    QPlcXyPlot plot;
    WindowContext context;
    plot.setContext(&context);
    plot.applySettings(QJsonDocument::fromJson(json).object());
    QCOMPARE(QJsonDocument(plot.settings()).toJson(QJsonDocument::Compact), json);
}

void tst_QPlcXyPlot::plotWithoutWindowReportsThatNoPlantIsConnected()
{
    QPlcXyPlot plot;
    plot.applySettings(objectOf(R"({"curves":[{"x":"a","y":"b"}]})"));
    plot.show();
    QVERIFY(showsText(plot, "No plant is connected."));
    QVERIFY(plot.addSignals({"a"}));
}

void tst_QPlcXyPlot::twoSignalsAreACurve()
{
    WindowContext context;
    QPlcXyPlot plot;
    plot.setContext(&context);
    plot.show();
    QVERIFY(showsText(plot, "Drop two signals here"));
    QSignalSpy edited(&plot, &QPlcXyPlot::settingsEdited);
    QVERIFY(!plot.addSignals({}));
    QVERIFY(plot.addSignals({"a"}));
    QVERIFY(showsText(plot, "drawn over a"));
    QVERIFY(plot.addSignals({"b", "c", "d"}));
    QCOMPARE(plot.settings(), objectOf(R"({"curves":[{"x":"a","y":"b"},{"x":"c","y":"d"}]})"));
    QCOMPARE(edited.size(), 2);
}

void tst_QPlcXyPlot::missingSignalsAreReported()
{
    WindowContext context;
    QPlcXyPlot plot;
    plot.setContext(&context);
    plot.applySettings(objectOf(R"({"curves":[{"x":"nobody","y":"b"},{"x":"= a +","y":"b"}]})"));
    plot.show();
    QVERIFY(showsText(plot, "no signal nobody"));
    plot.applySettings(objectOf(R"({"curves":[{"x":"= a +","y":"b"}]})"));
    QVERIFY(showsText(plot, "a value is missing"));
}

void tst_QPlcXyPlot::aCurveAppearsWhenItsSignalsDo()
{
    RunningMaster master;
    QVERIFY(master.startRealTime());
    WindowContext context;
    QPlcXyPlot plot;
    plot.setContext(&context);
    plot.applySettings(objectOf(R"({"curves":[{"x":"count","y":"= 2*count"}]})"));
    plot.resize(300, 200);
    plot.show();
    auto *canvas = plot.findChild<XyCanvas *>();
    QVERIFY(!canvas->isVisible());
    Plant *plant = context.plants()->add(master.address());
    QTRY_VERIFY(plant->values().rows() > 20);
    QVERIFY(canvas->isVisible());
    QCOMPARE(canvas->curves().size(), std::size_t(1));
    QTRY_VERIFY(canvas->curves().front()->drawnPoints() >= 2);
    const QPointF dot = canvas->curves().front()->dot();
    QVERIFY(dot.x() > 1.0);
    QCOMPARE(dot.y(), 2.0 * dot.x());
    context.plants()->remove(plant);
    QVERIFY(canvas->curves().empty());
    QVERIFY(!canvas->isVisible());
}

void tst_QPlcXyPlot::signalsOfTwoPlantsAreRefused()
{
    RunningMaster east;
    RunningMaster west;
    WindowContext context;
    Plant *first = context.plants()->add(east.address(), "east");
    Plant *second = context.plants()->add(west.address(), "west");
    QTRY_VERIFY(first->store() && second->store());
    QPlcXyPlot plot;
    plot.setContext(&context);
    plot.applySettings(objectOf(R"({"curves":[{"x":"east/count","y":"west/count"}]})"));
    plot.show();
    QVERIFY(showsText(plot, "are of two plants"));
}

void tst_QPlcXyPlot::theSettingsAreEdited()
{
    WindowContext context;
    QPlcXyPlot plot;
    plot.setContext(&context);
    plot.applySettings(objectOf(R"({"curves":[{"x":"a","y":"b","later":1},{"x":"c","y":"d"}]})"));
    QSignalSpy edited(&plot, &QPlcXyPlot::settingsEdited);
    const std::unique_ptr<QWidget> editor(plot.createSettingsEditor());
    editor->show();
    auto *field = editor->findChildren<QLineEdit *>().at(1);
    field->selectAll();
    QTest::keyClicks(field, "= 3*b");
    QTest::keyClick(field, Qt::Key_Return);
    QCOMPARE(edited.size(), 1);
    QCOMPARE(plot.settings().value("curves").toArray().at(0).toObject(),
             objectOf(R"({"x":"a","y":"= 3*b","later":1})"));
    const QList<QAction *> actions = plot.actions();
    actions.first()->trigger();
    QVERIFY(plot.isAspectEqual());
    QCOMPARE(edited.size(), 2);
}

/// A circle of 60 s with radius 2, a row each 10 ms.
void tst_QPlcXyPlot::fill()
{
    m_store = std::make_shared<SignalStore>(3, 10'000);
    for (int i = 0; i < 6000; ++i) {
        const double angle = i * 2.0 * M_PI / 6000.0;
        const float values[] = {float(2.0 * std::cos(angle)), float(2.0 * std::sin(angle)), float(i)};
        m_store->append((i + 1) * SignalStore::Time(10'000'000), values);
    }
}

std::unique_ptr<XyCanvas> tst_QPlcXyPlot::canvasOf(int x, int y)
{
    fill();
    auto canvas = std::make_unique<XyCanvas>();
    std::vector<std::unique_ptr<XyCurve>> curves;
    curves.push_back(std::make_unique<XyCurve>(pastOf(m_store, x), pastOf(m_store, y), "y over x"));
    canvas->setTheme(Theme::byName(Theme::Light));
    canvas->setCurves(std::move(curves), {});
    canvas->resize(500, 250);
    QWidget &widget = *canvas;
    widget.show();
    return canvas;
}

void tst_QPlcXyPlot::equalAspectGivesBothAxesTheSameScale()
{
    const auto canvas = canvasOf(0, 1);
    canvas->setAspect(XyCanvas::Equal);
    canvas->show({0, 60'000'000'000, 0, false});
    const auto pixelsOfUnit = [&](int axis) {
        const QwtScaleMap map = canvas->canvasMap(axis);
        return map.pDist() / map.sDist();
    };
    QVERIFY(std::fabs(pixelsOfUnit(QwtPlot::xBottom) / pixelsOfUnit(QwtPlot::yLeft) - 1.0) < 0.03);
    canvas->setAspect(XyCanvas::Free);
    canvas->show({0, 60'000'000'000, 0, false});
    QVERIFY(pixelsOfUnit(QwtPlot::xBottom) > 1.5 * pixelsOfUnit(QwtPlot::yLeft));
    QCOMPARE(canvas->axisTitle(QwtPlot::xBottom).text(), QStringLiteral("0 [m]"));
}

void tst_QPlcXyPlot::longAxisTitleKeepsItsUnit()
{
    fill();
    QPlcPast past = pastOf(m_store, 1);
    past.expression = QStringLiteral("tetherSpeedOfTheWinchDrumBehindTheSecondGear");
    XyCanvas canvas;
    std::vector<std::unique_ptr<XyCurve>> curves;
    curves.push_back(std::make_unique<XyCurve>(pastOf(m_store, 0), past, "y over x"));
    canvas.setTheme(Theme::byName(Theme::Light));
    canvas.setCurves(std::move(curves), {});
    canvas.resize(500, 250);
    static_cast<QWidget &>(canvas).show();
    const QwtText title = canvas.axisTitle(QwtPlot::yLeft);
    QVERIFY2(title.text().endsWith("[m]") && title.text().contains(QChar(0x2026)), qPrintable(title.text()));
    QVERIFY(QFontMetrics(title.font()).horizontalAdvance(title.text()) < canvas.height());
    canvas.resize(500, 900);
    QVERIFY(!canvas.axisTitle(QwtPlot::yLeft).text().contains(QChar(0x2026)));
}

void tst_QPlcXyPlot::plotIsDrawnOnlyWhenThePictureChanges()
{
    const auto canvas = canvasOf(0, 1);
    const SignalStore::Time s = 1'000'000'000;
    QVERIFY(canvas->show({10 * s, 20 * s, 20 * s, false}));
    QVERIFY(!canvas->show({10 * s, 20 * s, 20 * s, false}));
    const float values[] = {0, 0, 0};
    m_store->append(100 * s, values);  // outside of what is shown
    QVERIFY(!canvas->show({10 * s, 20 * s, 20 * s, false}));
    QVERIFY(canvas->show({10 * s, 20 * s, 19 * s, false}));
    QVERIFY(canvas->show({10 * s, 20 * s, 19 * s, true}));
    QVERIFY(canvas->show({10 * s, 21 * s, 19 * s, true}));
    canvas->setTheme(Theme::byName(Theme::Dark));
    QVERIFY(canvas->show({10 * s, 21 * s, 19 * s, true}));
}

void tst_QPlcXyPlot::theDotIsAtTheDisplayedTime()
{
    const auto canvas = canvasOf(2, 2);
    const XyCurve &curve = *canvas->curves().front();
    const SignalStore::Time s = 1'000'000'000;
    canvas->show({0, 60 * s, 10 * s + 5'000'000, false});
    QCOMPARE(curve.dot(), QPointF(999, 999));
    canvas->show({0, 60 * s, 5, false});
    QVERIFY(std::isnan(curve.dot().x()));
    canvas->show({0, 60 * s, 60 * s + s / 4, false});
    QCOMPARE(curve.dot(), QPointF(5999, 5999));
    canvas->show({0, 60 * s, 1000 * s, false});
    QVERIFY(std::isnan(curve.dot().x()));
    canvas->show({0, 60 * s, std::nullopt, false});
    QCOMPARE(curve.dot(), QPointF(5999, 5999));
}

void tst_QPlcXyPlot::pairsAreRowsOfTheSameTime()
{
    const auto x = std::make_shared<SignalStore>(1, 100);
    const auto y = std::make_shared<SignalStore>(1, 100);
    for (int i = 1; i <= 50; ++i) {
        const auto value = float(i % 2 == 0 ? 10 : 20);
        x->append(i, &value);
        if (i % 2 == 0)
            y->append(i, &value);
    }
    XyCanvas canvas;
    canvas.setTheme(Theme::byName(Theme::Light));
    std::vector<std::unique_ptr<XyCurve>> curves;
    curves.push_back(std::make_unique<XyCurve>(pastOf(x, 0), pastOf(y, 0), "y over x"));
    canvas.setCurves(std::move(curves), {});
    static_cast<QWidget &>(canvas).show();
    canvas.resize(300, 200);
    canvas.show({0, 60, 50, false});
    QVERIFY(canvas.curves().front()->xRange().maximum == 20.0F);
    QCOMPARE(canvas.curves().front()->dot(), QPointF(10, 10));
    canvas.grab();
    QVERIFY(canvas.curves().front()->drawnPoints() > 1);
}

/// Undo brings back the settings of before the first curve.
void tst_QPlcXyPlot::pathOmitsSubstituteValues()
{
    const auto canvas = canvasOf(0, 1);
    const SignalStore::Time s = 1'000'000'000;
    const auto pathOf = [&] {
        canvas->show({0, 100 * s, std::nullopt, false});
        canvas->grab();
        return canvas->curves().front()->drawnPoints();
    };
    const float values[] = {0, 0, 0};
    for (int channel : {0, 1}) {
        const std::size_t points = pathOf();
        m_store->append((61 + channel) * s, values);
        m_store->mark(channel, QPlcQuality::Safe);
        QCOMPARE(pathOf(), points);
        const QPointF dot = canvas->curves().front()->dot();
        QVERIFY(std::isnan(dot.x()) || std::isnan(dot.y()));
    }
    m_store->append(63 * s, values);
    m_store->mark(0, QPlcQuality::Held);
    QCOMPARE(canvas->curves().front()->dot(), QPointF(0, 0));
}

void tst_QPlcXyPlot::aSettingThatIsMissingIsADefault()
{
    WindowContext context;
    QPlcXyPlot plot;
    plot.setContext(&context);
    plot.show();
    plot.applySettings(objectOf(R"({"curves":[{"x":"a","y":"b"}],"equalAspect":true})"));
    plot.applySettings({});
    QCOMPARE(plot.settings(), QJsonObject());
    QVERIFY(!plot.isAspectEqual());
    QVERIFY(showsText(plot, "Drop two signals here"));
}

void tst_QPlcXyPlot::theWheelZoomsAboutTheMouse()
{
    const auto canvas = canvasOf(0, 1);
    canvas->show({0, 60'000'000'000, 0, false});
    XyInteraction interaction(canvas.get(), canvas.get(), nullptr);
    const QPoint at(120, 60);
    const QPointF value = canvas->valueAt(at);
    const double width = canvas->axisInterval(QwtPlot::xBottom).width();
    const double height = canvas->axisInterval(QwtPlot::yLeft).width();
    wheel(canvas->canvas(), at, 1);
    QVERIFY(isNear(canvas->valueAt(at), value));
    QVERIFY(std::fabs(canvas->axisInterval(QwtPlot::xBottom).width() - 0.8 * width) < 1e-6);
    wheel(canvas->canvas(), at, 1, Qt::ControlModifier);
    QVERIFY(std::fabs(canvas->axisInterval(QwtPlot::xBottom).width() - 0.8 * width) < 1e-6);
    QVERIFY(std::fabs(canvas->axisInterval(QwtPlot::yLeft).width() - 0.64 * height) < 1e-6);
    wheel(canvas->axisWidget(QwtPlot::xBottom), QPoint(50, 5), -1);
    QVERIFY(std::fabs(canvas->axisInterval(QwtPlot::xBottom).width() - width) < 1e-6);
    for (int i = 0; i < 1000; ++i)
        wheel(canvas->canvas(), at, 10);
    QVERIFY(canvas->axisInterval(QwtPlot::xBottom).width() > 0.0);
    for (int i = 0; i < 1000; ++i)
        wheel(canvas->canvas(), at, -100);
    QVERIFY(std::isfinite(canvas->axisInterval(QwtPlot::xBottom).width()));
    canvas->release();
    QVERIFY(std::fabs(canvas->axisInterval(QwtPlot::xBottom).width() - width) < 1e-6);
}

void tst_QPlcXyPlot::draggingPansAndABoxIsZoomedInto()
{
    const auto canvas = canvasOf(0, 1);
    canvas->show({0, 60'000'000'000, 0, false});
    XyInteraction interaction(canvas.get(), canvas.get(), nullptr);
    const QPointF value = canvas->valueAt(QPoint(100, 50));
    drag(canvas->canvas(), {100, 50}, {160, 90}, Qt::LeftButton);
    QVERIFY(isNear(canvas->valueAt(QPoint(160, 90)), value));
    QVERIFY(canvas->isHeld());
    const QPointF low = canvas->valueAt(QPoint(100, 130));
    const QPointF high = canvas->valueAt(QPoint(200, 50));
    drag(canvas->canvas(), {100, 50}, {200, 130}, Qt::RightButton);
    QVERIFY(isNear({canvas->axisInterval(QwtPlot::xBottom).minValue(), canvas->axisInterval(QwtPlot::yLeft).minValue()},
                   low, 0.05));
    QVERIFY(isNear({canvas->axisInterval(QwtPlot::xBottom).maxValue(), canvas->axisInterval(QwtPlot::yLeft).maxValue()},
                   high, 0.05));
}

void tst_QPlcXyPlot::twoFingersZoom()
{
    const auto canvas = canvasOf(0, 1);
    canvas->show({0, 60'000'000'000, 0, false});
    XyInteraction interaction(canvas.get(), canvas.get(), nullptr);
    const double width = canvas->axisInterval(QwtPlot::xBottom).width();
    QTouchDevice *screen = QTest::createTouchDevice();
    QWidget *on = canvas->canvas();
    QTest::touchEvent(on, screen).press(0, {150, 80}, on).press(1, {250, 80}, on);
    for (int i = 1; i <= 10; ++i)
        QTest::touchEvent(on, screen).move(0, {150 - 5 * i, 80}, on).move(1, {250 + 5 * i, 80}, on);
    QTest::touchEvent(on, screen).release(0, {100, 80}, on).release(1, {300, 80}, on);
    const double zoomed = canvas->axisInterval(QwtPlot::xBottom).width() / width;
    QVERIFY2(zoomed > 0.4 && zoomed < 0.65, qPrintable(QString::number(zoomed)));
}

void tst_QPlcXyPlot::axesThatAreZoomedStay()
{
    const auto canvas = canvasOf(0, 1);
    canvas->show({0, 60'000'000'000, 0, false});
    canvas->zoom(0.5, 0.5, {100, 50});
    const QwtInterval x = canvas->axisInterval(QwtPlot::xBottom);
    const float values[] = {100, 100, 0};
    m_store->append(61'000'000'000, values);
    canvas->show({0, 61'000'000'000, 0, false});
    QCOMPARE(canvas->axisInterval(QwtPlot::xBottom), x);
    canvas->release();
    QVERIFY(canvas->axisInterval(QwtPlot::xBottom).maxValue() >= 100.0);
}

void tst_QPlcXyPlot::axisNumbersUseTheFormatOfOtherCharts()
{
    const auto canvas = canvasOf(2, 2);
    canvas->show({0, 60'000'000'000, 0, false});
    for (const int axis : {QwtPlot::xBottom, QwtPlot::yLeft})
        QCOMPARE(canvas->axisScaleDraw(axis)->label(4000.0).text(), QStringLiteral("4000"));
}

void tst_QPlcXyPlot::visibleTimeRangeIsExported()
{
    RunningMaster master;
    QVERIFY(master.startRealTime());
    WindowContext context;
    QPlcXyPlot plot;
    plot.setContext(&context);
    plot.applySettings(objectOf(R"({"curves":[{"x":"count","y":"= 2*count"},{"x":"count","y":"sum"}]})"));
    plot.resize(300, 200);
    plot.show();
    Plant *plant = context.plants()->add(master.address());
    QTRY_VERIFY(plant->values().rows() > 20);
    context.timeAxis()->show(context.timeAxis()->newest() - 100'000'000, context.timeAxis()->newest());
    QGuiApplication::clipboard()->clear();
    plot.findChild<QAction *>(QStringLiteral("copyTable"))->trigger();
    QTRY_VERIFY(!QGuiApplication::clipboard()->text().isEmpty());
    const QStringList lines = QGuiApplication::clipboard()->text().split(QLatin1Char('\n'));
    QCOMPARE(lines.first(), QStringLiteral("UTC\ttime [s]\tcount\t2*count\tsum [m]"));
    QVERIFY(lines.size() > 3 && lines.size() < 30);
    const QStringList fields = lines.at(1).split(QLatin1Char('\t'));
    QCOMPARE(fields.size(), 5);
    QCOMPARE(fields.at(3).toDouble(), 2.0 * fields.at(2).toDouble());
    plot.findChild<QAction *>(QStringLiteral("copyPicture"))->trigger();
    QVERIFY(QGuiApplication::clipboard()->image().width() > 400);
}

QTEST_MAIN(tst_QPlcXyPlot)
#include "tst_QPlcXyPlot.moc"
