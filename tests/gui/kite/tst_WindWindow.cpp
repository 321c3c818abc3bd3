// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "KiteFixtures.h"
#include "QPlcWidgetFactoryOf.h"
#include "kite/WindWindow.h"
#include "kite/WindWindowDrawing.h"

#include <QtWidgets/QDoubleSpinBox>

using namespace awe;
using qplc::SignalStore;
using qplc::Theme;
using qplc::WindowContext;

class tst_WindWindow : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void initTestCase();
    void viewWithoutPlantIsDrawnAtAnySize();
    void aMissingSignalIsNamed();
    void kiteOfALostNodeHasNoPosition();
    void kiteIsDrawnAtItsPosition_data();
    void kiteIsDrawnAtItsPosition();
    void aFlownPathIsColored();
    void nothingIsDrawnWhileHidden();
    void thePastIsShownWhenTheWindowShowsThePast();
    void settingsAreRestoredByteForByte();
    void editorAppliesChangesImmediatelyAsUndoSteps();
    void droppedSignalsColorThePath();

private:
    QImage picture(WindWindow *view, const QSize &size);
    Theme m_theme = Theme::byName(Theme::Light);
};

void tst_WindWindow::initTestCase()
{
    QPlcWidget::registerFactory(new QPlcWidgetFactoryOf<WindWindow>);
    QVERIFY(QPlcWidget::factory(QStringLiteral("Wind window")));
}

QImage tst_WindWindow::picture(WindWindow *view, const QSize &size)
{
    view->resize(size);
    return view->grab().toImage();
}

void tst_WindWindow::viewWithoutPlantIsDrawnAtAnySize()
{
    WindWindow view;
    QVERIFY(!picture(&view, {240, 160}).isNull());
    WindowContext context;
    view.setContext(&context);
    QVERIFY(!picture(&view, {240, 160}).isNull());
    QVERIFY(!picture(&view, {1, 1}).isNull());
    QCOMPARE(view.settings(), QJsonObject());
}

void tst_WindWindow::aMissingSignalIsNamed()
{
    FlyingPlant plant;
    QVERIFY(plant.fly());
    QPlcWidget panel;
    panel.setContext(&plant.context);
    KiteSignals kite;
    kite.setContext(panel.context());
    QCOMPARE(kite.problem(), QString());
    KiteSettings settings;
    settings.position = QStringLiteral("nowhere");
    kite.setSettings(settings);
    QVERIFY(kite.problem().contains(QStringLiteral("nowhere")));
    settings.position = QStringLiteral("power");
    kite.setSettings(settings);
    QVERIFY(kite.problem().contains(QStringLiteral("three elements")));
    QVERIFY(!kite.state().position);
    FlightTrail trail;
    QVERIFY(!kite.readTrail(&trail));
}

void tst_WindWindow::kiteOfALostNodeHasNoPosition()
{
    FlyingPlant plant(false, QStringLiteral("tcp"));
    QVERIFY(plant.fly());
    QPlcWidget panel;
    panel.setContext(&plant.context);
    KiteSignals kite;
    kite.setContext(panel.context());
    QVERIFY(kite.state().position);
    plant.kite.disconnectFromMaster();
    QTRY_VERIFY(!kite.state().position);
    QCOMPARE(kite.problem(), QString());  // its path is still to be seen
    FlightTrail trail;
    QVERIFY(kite.readTrail(&trail));
    QVERIFY(trail.points().size() > 10);
    for (const FlightTrail::Point &point : trail.points())
        QVERIFY(!point.position.isNull());
}

void tst_WindWindow::kiteIsDrawnAtItsPosition_data()
{
    QTest::addColumn<QSize>("size");
    for (const QSize &size : {QSize(240, 160), QSize(640, 400)})
        QTest::addRow("%d x %d", size.width(), size.height()) << size;
}

void tst_WindWindow::kiteIsDrawnAtItsPosition()
{
    QFETCH(QSize, size);
    FlyingPlant plant(true);
    plant.context.setTheme(m_theme);
    QVERIFY(plant.fly());
    WindWindow view;
    view.applySettings({{"trail", 0}});
    view.setContext(&plant.context);
    const QImage image = picture(&view, size);

    const WindWindowFrame frame(size, QFontMetricsF(view.context()->theme().labelFont).height());
    const QPoint place = frame.toPixels(QPointF(0, 35)).toPoint();
    const auto isKite = [this](const QColor &color) { return color.lightness() < m_theme.text.lightness() + 50; };
    QVERIFY(countPixels(image, QRect(place - QPoint(20, 20), place + QPoint(20, 20)), isKite) > 20);
    const QRect aside(frame.toPixels(QPointF(70, 60)).toPoint(), frame.toPixels(QPointF(80, 10)).toPoint());
    QCOMPARE(countPixels(image, aside, isKite), 0);
}

void tst_WindWindow::aFlownPathIsColored()
{
    FlyingPlant plant;
    plant.context.setTheme(m_theme);
    QVERIFY(plant.fly());
    QTRY_VERIFY_WITH_TIMEOUT(plant.context.plants()->at(0)->store()->endRow() > 150, 10'000);
    WindWindow view;
    view.setContext(&plant.context);
    const auto isColored = [](const QColor &color) { return color.hsvSaturation() > 90; };
    const WindWindowFrame frame({420, 260}, QFontMetricsF(view.context()->theme().labelFont).height());
    const QPoint middle = frame.toPixels(QPointF(0, 35)).toPoint();
    const int reach = int(20 * frame.scale());
    const QRect about(middle - QPoint(reach, reach), middle + QPoint(reach, reach));
    const QImage image = picture(&view, {420, 260});
    QVERIFY(countPixels(image, about, isColored) > 40);
    view.applySettings({{"trail", 0}});
    QVERIFY(countPixels(picture(&view, {420, 260}), about, isColored) < 10);
}

void tst_WindWindow::nothingIsDrawnWhileHidden()
{
    class Counter : public WindWindow
    {
    public:
        int paints = 0;

    protected:
        void paintEvent(QPaintEvent *event) override
        {
            ++paints;
            WindWindow::paintEvent(event);
        }
    };
    FlyingPlant plant;
    QVERIFY(plant.fly());
    Counter view;
    view.setContext(&plant.context);
    QTest::qWait(200);
    QCOMPARE(view.paints, 0);
    view.show();
    QTRY_VERIFY_WITH_TIMEOUT(view.paints > 5, 10'000);
    view.hide();
    QCoreApplication::processEvents();
    const int before = view.paints;
    QTest::qWait(200);
    QCOMPARE(view.paints, before);
}

void tst_WindWindow::thePastIsShownWhenTheWindowShowsThePast()
{
    FlyingPlant plant;
    QVERIFY(plant.fly());
    const SignalStore *store = plant.context.plants()->at(0)->store();
    QTRY_VERIFY_WITH_TIMEOUT(store->endRow() > 150, 10'000);
    QPlcWidget panel;
    panel.setContext(&plant.context);
    KiteSignals kite;
    kite.setContext(panel.context());
    const SignalStore::Row row = store->firstRow() + 50;
    plant.context.timeAxis()->setNewest(store->time(store->endRow() - 1));
    plant.context.timeAxis()->show(store->time(row) - 1'000'000'000, store->time(row));
    const int channel = plant.context.plants()->at(0)->values().channels().channel(0, 0);
    QCOMPARE(kite.state().position->x(), store->value(channel, row));
    QVERIFY(kite.state().pastTime.has_value());
    QVERIFY(stateText(kite.state()).startsWith(QStringLiteral("at ")));
    FlightTrail trail;
    QVERIFY(kite.readTrail(&trail));
    QCOMPARE(trail.points().back().position.x(), store->value(channel, row));
    // Before all values nothing is known.
    plant.context.timeAxis()->show(0, 1'000'000'000);
    QVERIFY(!kite.state().position);
}

void tst_WindWindow::settingsAreRestoredByteForByte()
{
    WindWindow view;
    const QJsonObject json{{"color", "tetherLength"}, {"minimum", 0}, {"maximum", 200}, {"trail", 60},
                           {"title", "Sky"},          {"later", 3}};
    view.applySettings(json);
    QCOMPARE(QJsonDocument(view.settings()).toJson(), QJsonDocument(json).toJson());
    view.applySettings({{"title", ""}});
    QVERIFY(!view.settings().contains(QStringLiteral("trail")));
}

void tst_WindWindow::editorAppliesChangesImmediatelyAsUndoSteps()
{
    WindWindow view;
    QSignalSpy edits(&view, &QPlcWidget::settingsEdited);
    const std::unique_ptr<QWidget> editor(view.createSettingsEditor());
    auto *trail = editor->findChild<QDoubleSpinBox *>();
    QVERIFY(trail);
    trail->setValue(120);
    QCOMPARE(edits.count(), 1);
    QCOMPARE(view.settings().value(QStringLiteral("trail")).toDouble(), 120.0);
}

void tst_WindWindow::droppedSignalsColorThePath()
{
    WindWindow view;
    QVERIFY(!view.addSignals({}));
    QVERIFY(view.addSignals({QStringLiteral("tetherLength")}));
    QCOMPARE(view.settings().value(QStringLiteral("color")).toString(), QStringLiteral("tetherLength"));
}

QTEST_MAIN(tst_WindWindow)
#include "tst_WindWindow.moc"
