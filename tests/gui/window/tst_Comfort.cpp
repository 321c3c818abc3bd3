// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "WindowFixtures.h"
#include "gui/layout/LayoutTabBar.h"
#include "gui/layout/PanelTitleBar.h"
#include "gui/layout/TitleButton.h"
#include "gui/window/DesktopTheme.h"
#include "gui/window/LongPress.h"
#include "gui/window/TouchStyle.h"

#include <QtGui/QTouchDevice>
#include <QtWidgets/QMenu>
#include <QtWidgets/QPushButton>

using namespace qplc;

namespace {

PlantEvent eventOf(PlantEvent::Severity severity, int age = 0)
{
    return {QDateTime::currentDateTime().addSecs(-age), severity, QStringLiteral("kite"), QStringLiteral("text"),
            false};
}

QPalette paletteOf(const QColor &window)
{
    return QPalette(window, window);
}

}  // namespace

/// Themes that follow the desktop, fingers, and ears.
class tst_Comfort : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase() { m_finger = QTest::createTouchDevice(); }
    void init() { m_settings = std::make_unique<TestSettings>(); }
    void theSystemThemeFollowsTheDesktop();
    void aChosenThemeStaysWhenTheDesktopChanges();
    void targetsForFingersAreLarge();
    void touchAndSoundSettingsAreRestored();
    void longTouchOpensTheContextMenu();
    void movedOrShortTouchOpensNoContextMenu();
    void longMousePressOpensNoContextMenu();
    void alarmSoundRateIsLimited();
    void oldEventsAndWarningsPlayNoSound();

private:
    QTouchDevice *m_finger = nullptr;
    std::unique_ptr<TestSettings> m_settings;
};

void tst_Comfort::theSystemThemeFollowsTheDesktop()
{
    WindowFixture fixture;
    fixture.window.setTheme(QPlcControlCenter::SystemTheme);
    const auto isDark = [&] { return fixture.window.context()->theme().isDark; };
    QApplication::setPalette(paletteOf(Qt::black));
    QTRY_VERIFY(isDark());
    QCOMPARE(QApplication::palette().color(QPalette::Window), Theme::byName(Theme::Dark).window);
    QApplication::setPalette(paletteOf(Qt::white));
    QTRY_VERIFY(!isDark());
    QCOMPARE(QApplication::palette().color(QPalette::Window), Theme::byName(Theme::Light).window);

    // The platform tells of a change: its palette is the one behind that of the window.
    QApplication::setPalette(paletteOf(Qt::black));
    QTRY_VERIFY(isDark());
    QEvent change(QEvent::ThemeChange);
    QCoreApplication::sendEvent(&fixture.window, &change);
    QTRY_VERIFY(!isDark());  // offscreen, it is light
    QCOMPARE(QApplication::palette().color(QPalette::Window), Theme::byName(Theme::Light).window);
}

void tst_Comfort::aChosenThemeStaysWhenTheDesktopChanges()
{
    WindowFixture fixture;
    fixture.window.setTheme(QPlcControlCenter::SunlightTheme);
    QApplication::setPalette(paletteOf(Qt::black));
    QCoreApplication::processEvents();
    QVERIFY(!fixture.window.context()->theme().isDark);
    fixture.window.setTheme(QPlcControlCenter::SystemTheme);
    QVERIFY(fixture.window.context()->theme().isDark);
    QApplication::setPalette(paletteOf(Qt::white));
    QTRY_VERIFY(!fixture.window.context()->theme().isDark);
}

void tst_Comfort::targetsForFingersAreLarge()
{
    WindowFixture fixture;
    QAction *touch = fixture.action("Large targets for touch");
    QVERIFY(touch->isChecked());  // there is a touch screen
    touch->trigger();
    QPushButton button(QStringLiteral("Press"));
    QMenu menu;
    QAction *entry = menu.addAction(QStringLiteral("Entry"));
    QAction *line = menu.addSeparator();
    PanelTitleBar title;
    QAction close(QStringLiteral("Close"), this);
    QToolButton *closeButton = title.addButton(&close);
    QCOMPARE(closeButton->size(), QSize(20, 20));
    const QSize before = button.sizeHint();
    touch->trigger();
    fixture.window.connectToMaster(QStringLiteral("127.0.0.1:%1").arg(freePort()));  // shows dock and tabs
    for (QWidget *place : {static_cast<QWidget *>(fixture.part<SignalDock>()->titleBarWidget()),
                           static_cast<QWidget *>(fixture.part<LayoutTabBar>())}) {
        const QList<TitleButton *> closing = place->findChildren<TitleButton *>();
        QVERIFY(!closing.isEmpty());
        for (const TitleButton *each : closing)
            QCOMPARE(each->size(), QSize(40, 40));
        QVERIFY(place->height() >= TouchStyle::Target);
    }
    QVERIFY(button.sizeHint().height() >= TouchStyle::Target);
    QVERIFY(menu.actionGeometry(entry).height() >= TouchStyle::Target);
    QVERIFY(menu.actionGeometry(line).height() < TouchStyle::Target);
    QCOMPARE(closeButton->size(), QSize(40, 40));
    QVERIFY(title.sizeHint().height() >= TouchStyle::Target);
    for (const BarButton *each : fixture.window.findChildren<BarButton *>())
        QVERIFY2(each->sizeHint().height() >= TouchStyle::Target, qPrintable(each->text()));
    touch->trigger();
    QCOMPARE(button.sizeHint(), before);
    QCOMPARE(closeButton->size(), QSize(20, 20));
}

void tst_Comfort::touchAndSoundSettingsAreRestored()
{
    {
        WindowFixture fixture;
        fixture.window.restoreView();
        fixture.action("Large targets for touch")->trigger();
        fixture.action("Alarm sound")->trigger();
        fixture.window.close();
    }
    WindowFixture fixture;
    QVERIFY(fixture.action("Large targets for touch")->isChecked());
    QVERIFY(fixture.action("Alarm sound")->isChecked());
    fixture.window.restoreView();
    QVERIFY(!fixture.action("Large targets for touch")->isChecked());
    QVERIFY(!fixture.action("Alarm sound")->isChecked());
    QVERIFY(!qobject_cast<TouchStyle *>(QApplication::style()));
}

namespace {

/// A button that counts.
struct Pressed
{
    Pressed()
    {
        LongPress::watch();
        LongPress::watch();
        button.setContextMenuPolicy(Qt::CustomContextMenu);
        QObject::connect(&button, &QWidget::customContextMenuRequested, &button, [this] { ++menus; });
        QObject::connect(&button, &QPushButton::clicked, &button, [this] { ++clicks; });
        button.resize(200, 100);
        button.show();
        QVERIFY(QTest::qWaitForWindowExposed(&button));
    }

    QPushButton button;
    int menus = 0;
    int clicks = 0;
};

}  // namespace

void tst_Comfort::longTouchOpensTheContextMenu()
{
    Pressed pressed;
    QTest::touchEvent(&pressed.button, m_finger).press(0, QPoint(50, 50), &pressed.button);
    QTRY_COMPARE(pressed.menus, 1);
    QVERIFY(!pressed.button.isDown());
    QTest::touchEvent(&pressed.button, m_finger).release(0, QPoint(50, 50), &pressed.button);
    QTest::qWait(20);
    QCOMPARE(pressed.clicks, 0);
    QCOMPARE(pressed.menus, 1);
}

void tst_Comfort::movedOrShortTouchOpensNoContextMenu()
{
    Pressed pressed;
    QTest::touchEvent(&pressed.button, m_finger).press(0, QPoint(50, 50), &pressed.button);
    QTest::touchEvent(&pressed.button, m_finger).move(0, QPoint(90, 50), &pressed.button);
    QTest::qWait(LongPress::Delay + 100);
    QTest::touchEvent(&pressed.button, m_finger).release(0, QPoint(90, 50), &pressed.button);
    QTest::touchEvent(&pressed.button, m_finger).press(0, QPoint(20, 50), &pressed.button);
    QTest::touchEvent(&pressed.button, m_finger).release(0, QPoint(20, 50), &pressed.button);
    QTest::qWait(LongPress::Delay + 100);
    QCOMPARE(pressed.menus, 0);
    QCOMPARE(pressed.clicks, 2);
}

void tst_Comfort::longMousePressOpensNoContextMenu()
{
    Pressed pressed;
    QTest::mousePress(&pressed.button, Qt::LeftButton);
    QTest::qWait(LongPress::Delay + 100);
    QTest::mouseRelease(&pressed.button, Qt::LeftButton);
    QCOMPARE(pressed.menus, 0);
    QCOMPARE(pressed.clicks, 1);
}

void tst_Comfort::alarmSoundRateIsLimited()
{
    EventLogModel events;
    int played = 0;
    AlarmSound sound(&events, [&played] { ++played; });
    events.append(eventOf(PlantEvent::Error));
    QCOMPARE(played, 1);
    events.append(eventOf(PlantEvent::Error));
    QCOMPARE(played, 1);
}

void tst_Comfort::oldEventsAndWarningsPlayNoSound()
{
    EventLogModel events;
    int played = 0;
    AlarmSound sound(&events, [&played] { ++played; });
    events.append(eventOf(PlantEvent::Warning));
    events.append(eventOf(PlantEvent::Information));
    events.append(eventOf(PlantEvent::Error, 60));
    sound.setOn(false);
    events.append(eventOf(PlantEvent::Error));
    QCOMPARE(played, 0);
    sound.setOn(true);
    events.append(eventOf(PlantEvent::Error));
    QCOMPARE(played, 1);
}

QTEST_MAIN(tst_Comfort)
#include "tst_Comfort.moc"
