// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "QPlcSignalTree.h"
#include "WindowFixtures.h"
#include "gui/window/RecorderNotice.h"

#include <QtCore/QJsonArray>

using namespace qplc;

/// The window as a person uses it, with masters in this process.
class tst_ControlCenter : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_settings = std::make_unique<TestSettings>(); }
    void windowWithoutPlantShowsTheStartPage();
    void aTypedAddressConnectsAndTheNextActionStarts();
    void stopWorksByButtonAndByKeys();
    void stopNamesItsPlantAndTheOthersContinue();
    void invalidAddressIsReportedWithoutConnecting();
    void barsCannotBeMovedHiddenOrCut_data();
    void barsCannotBeMovedHiddenOrCut();
    void frozenTimeBarShowsTheDelayAndTheLKeyGoesLive();
    void timeBarShowsLiveOnlyWhileNewValuesArrive();
    void theBottomLineKeepsItsPlaceWhileNumbersCount();
    void rateAppliesToAllPlantsAndIsRestored();
    void closedWindowIsRestored();
    void signalTreeIsRestored();
    void windowSavesNothingWithoutRestoreView();
    void themesReachPanelsAndPalette();
    void eventsAreOnTheLineUntilAcknowledged();
    void aWindowEndsInEveryState();

private:
    std::unique_ptr<TestSettings> m_settings;
};

void tst_ControlCenter::windowWithoutPlantShowsTheStartPage()
{
    WindowFixture fixture;
    QAction demo(QStringLiteral("Fly the demo kite"));
    demo.setToolTip(QStringLiteral("Here, without rights"));
    QSignalSpy flown(&demo, &QAction::triggered);
    fixture.window.addStartAction(&demo);
    QVERIFY(fixture.window.isStartPageShown());
    QVERIFY(fixture.part<SignalDock>()->isHidden());
    QTRY_VERIFY(fixture.structure().shows(QStringLiteral("Fly the demo kite")));
    const QList<QWidget *> buttons = fixture.part<StartPage>()->buttons();
    QCOMPARE(buttons.size(), 3);
    fixture.press(Qt::Key_Return);  // the first button has the focus
    QCOMPARE(flown.count(), 1);
    const QString name = fixture.window.connectToMaster(QStringLiteral("127.0.0.1:%1").arg(freePort()));
    QVERIFY(!fixture.window.isStartPageShown());
    QVERIFY(fixture.part<SignalDock>()->isVisible());
    fixture.window.showStartPage();
    QVERIFY(fixture.window.isStartPageShown());
    QTRY_VERIFY(fixture.structure().shows(QStringLiteral("Back to %1").arg(name)));
    fixture.press(Qt::Key_Home, Qt::ControlModifier);
    QVERIFY(!fixture.window.isStartPageShown());
    fixture.press(Qt::Key_Home, Qt::ControlModifier);
    QVERIFY(fixture.window.isStartPageShown());
    fixture.window.disconnectFromMaster(name);
    QVERIFY(!fixture.structure().shows(QStringLiteral("Back to %1").arg(name)));
    QVERIFY(fixture.window.isStartPageShown());
    fixture.window.disconnectFromMaster(QStringLiteral("nobody"));
}

void tst_ControlCenter::aTypedAddressConnectsAndTheNextActionStarts()
{
    RunningMaster master;
    WindowFixture fixture;
    fixture.connectTo(master.address());
    QVERIFY(fixture.part<ConnectStrip>()->isHidden());
    QTRY_VERIFY(fixture.window.isConnected(master.address()));
    QTRY_VERIFY(fixture.topBar()->nextButton()->isVisible());
    QCOMPARE(fixture.topBar()->nextButton()->text(), QStringLiteral("Start"));
    QTest::mouseClick(fixture.topBar()->nextButton(), Qt::LeftButton);
    QTRY_COMPARE(master.state(), QPlcMasterNode::RealTime);
    QTRY_COMPARE(fixture.topBar()->stepper()->step(), StateStep::RealTime);
    QVERIFY(!fixture.topBar()->nextButton()->isVisible());  // STOP is the next one
    QTRY_COMPARE(fixture.topBar()->selector()->headline(), QStringLiteral("live"));
    QTRY_COMPARE(fixture.part<RecorderNotice>()->summary().text, QString("not recording"));
    // Connect..., Open a recording..., Back, and the address for the next time
    QCOMPARE(fixture.part<StartPage>()->buttons().size(), 4);
}

void tst_ControlCenter::stopWorksByButtonAndByKeys()
{
    RunningMaster master;
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address());
    const auto run = [&] {
        QTRY_COMPARE(fixture.plant()->nextAction(), Plant::Start);
        fixture.press(Qt::Key_F5);
        QTRY_COMPARE(master.state(), QPlcMasterNode::RealTime);
    };
    run();
    QTest::mouseClick(fixture.topBar()->stopButton(), Qt::LeftButton);
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    run();
    fixture.press(Qt::Key_Period, Qt::ControlModifier);
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    run();
    fixture.press(Qt::Key_Escape);
    QTest::qWait(50);
    fixture.press(Qt::Key_Escape);
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
}

void tst_ControlCenter::stopNamesItsPlantAndTheOthersContinue()
{
    RunningMaster first;
    RunningMaster second;
    QVERIFY(first.startRealTime() && second.startRealTime());
    WindowFixture fixture;
    fixture.window.connectToMaster(first.address(), QStringLiteral("kite"));
    QCOMPARE(fixture.topBar()->stopButton()->detail(), QString());
    fixture.window.connectToMaster(second.address(), QStringLiteral("winch"));
    QCOMPARE(fixture.window.plants(), (QStringList{QStringLiteral("kite"), QStringLiteral("winch")}));
    QCOMPARE(fixture.topBar()->stopButton()->detail(), QStringLiteral("kite"));
    fixture.press(Qt::Key_P, Qt::ControlModifier);
    QCOMPARE(fixture.topBar()->stopButton()->detail(), QStringLiteral("winch"));
    QTRY_VERIFY(fixture.window.isConnected(QStringLiteral("winch")));
    QTest::mouseClick(fixture.topBar()->stopButton(), Qt::LeftButton);
    QVERIFY(second.waitForState(QPlcMasterNode::Off));
    QCOMPARE(first.state(), QPlcMasterNode::RealTime);
    fixture.press(Qt::Key_D, Qt::ControlModifier);
    QCOMPARE(fixture.window.plants(), QStringList{QStringLiteral("kite")});
}

void tst_ControlCenter::invalidAddressIsReportedWithoutConnecting()
{
    WindowFixture fixture;
    fixture.connectTo(QStringLiteral("127.0.0.1:kite"));
    QVERIFY(fixture.part<ConnectStrip>()->isVisible());
    QVERIFY2(fixture.part<ConnectStrip>()->error().contains(QLatin1String("kite")),
             qPrintable(fixture.part<ConnectStrip>()->error()));
    QVERIFY(fixture.window.plants().isEmpty());
    fixture.press(Qt::Key_Escape);
    QVERIFY(fixture.part<ConnectStrip>()->isHidden());
    QTest::mouseClick(fixture.topBar()->stopButton(), Qt::LeftButton);
    QVERIFY(fixture.hint().contains(QLatin1String("no plant")));
}

void tst_ControlCenter::barsCannotBeMovedHiddenOrCut_data()
{
    QTest::addColumn<QSize>("size");
    QTest::newRow("laptop") << QSize(1366, 768);
    QTest::newRow("half a laptop") << QSize(1000, 500);
    QTest::newRow("screen") << QSize(2560, 1400);
}

void tst_ControlCenter::barsCannotBeMovedHiddenOrCut()
{
    QFETCH(QSize, size);
    RunningMaster first;
    RunningMaster second;
    WindowFixture fixture;
    fixture.window.resize(size);
    fixture.window.connectToMaster(first.address(), QStringLiteral("a plant with a name that goes on and on and on"));
    fixture.window.connectToMaster(second.address());
    QTRY_VERIFY(fixture.topBar()->nextButton()->isVisible());
    for (const QToolBar *bar : fixture.window.findChildren<QToolBar *>()) {
        QVERIFY(!bar->isMovable());
        QVERIFY(!bar->isFloatable());
        QVERIFY(!bar->toggleViewAction()->isEnabled());
    }
    const auto cut = [&] {
        return (fixture.structure().cutButtons<BarButton>() + fixture.structure().cutButtons<PlantSelector>())
            .join(QStringLiteral(", "));
    };
    QTRY_COMPARE(cut(), QString());
    QVERIFY(fixture.topBar()->stopButton()->height() >= 44);
    QVERIFY(fixture.topBar()->stopButton()->width() >= 120);
}

void tst_ControlCenter::frozenTimeBarShowsTheDelayAndTheLKeyGoesLive()
{
    WindowFixture fixture;
    QPlcTimeAxis *view = fixture.window.context()->timeAxis();
    auto *bar = fixture.part<TimeBar>();
    view->setNewest(100'000'000'000);
    fixture.press(Qt::Key_L, Qt::ControlModifier | Qt::ShiftModifier);
    view->setNewest(112'300'000'000);
    QTRY_VERIFY2(bar->stateText().contains(QLatin1String("12.3 s behind")), qPrintable(bar->stateText()));
    fixture.press(Qt::Key_L);
    QVERIFY(view->isLive());
    fixture.press(Qt::Key_BracketRight, Qt::ControlModifier);
    QCOMPARE(view->span(), QPlcTimeAxis::Time(60'000'000'000));
    fixture.press(Qt::Key_BracketLeft, Qt::ControlModifier);
    fixture.press(Qt::Key_BracketLeft, Qt::ControlModifier);
    QCOMPARE(view->span(), QPlcTimeAxis::Time(20'000'000'000));
    QTest::mouseClick(bar->stateButton(), Qt::LeftButton);
    QVERIFY(!view->isLive());
}

void tst_ControlCenter::timeBarShowsLiveOnlyWhileNewValuesArrive()
{
    WindowFixture fixture;
    auto *bar = fixture.part<TimeBar>();
    const auto says = [&](const char *text) { return bar->stateText().endsWith(QLatin1String(text)); };
    QTRY_VERIFY2(says("No values"), qPrintable(bar->stateText()));
    auto master = std::make_unique<RunningMaster>();
    auto other = std::make_unique<RunningMaster>();
    fixture.window.connectToMaster(master->address(), QStringLiteral("north"));
    QTRY_VERIFY(says("At rest"));
    QVERIFY(master->startRealTime());
    QTRY_VERIFY(says("Live"));
    master.reset();
    QTRY_VERIFY(bar->stateText().contains(QLatin1String("No new values for ")));
    QVERIFY(fixture.window.context()->timeAxis()->isLive());
    fixture.window.connectToMaster(other->address(), QStringLiteral("south"));
    QVERIFY(other->startRealTime());
    QTRY_VERIFY(bar->stateText().contains(QLatin1String("No new values of north for ")));
    fixture.window.disconnectFromMaster(QStringLiteral("north"));
    QTRY_VERIFY(says("Live"));
}

void tst_ControlCenter::theBottomLineKeepsItsPlaceWhileNumbersCount()
{
    WindowFixture fixture;
    QPlcTimeAxis *view = fixture.window.context()->timeAxis();
    auto *bar = fixture.part<TimeBar>();
    view->setNewest(100'000'000'000);
    view->freeze();
    view->setNewest(200'300'000'000);
    QTRY_VERIFY2(bar->stateText().contains(QLatin1String("100.3 s behind")), qPrintable(bar->stateText()));
    int place = -1;
    for (int looks = 0; looks < 50 && place != fixture.part<EventLine>()->x(); ++looks) {  // until it is laid out
        place = fixture.part<EventLine>()->x();
        QTest::qWait(20);
    }
    view->setNewest(101'100'000'000);
    QTRY_VERIFY2(bar->stateText().contains(QLatin1String("1.1 s behind")), qPrintable(bar->stateText()));
    QTRY_COMPARE(fixture.part<EventLine>()->x(), place);
}

void tst_ControlCenter::closedWindowIsRestored()
{
    RunningMaster master;
    QByteArray layout;
    {
        WindowFixture fixture;
        fixture.window.restoreView();  // the first time
        fixture.window.connectToMaster(master.address(), QStringLiteral("kite"));
        fixture.window.setTheme(QPlcControlCenter::SunlightTheme);
        fixture.press(Qt::Key_T, Qt::ControlModifier);
        fixture.part<SignalDock>()->hide();
        layout = fixture.window.layoutJson();
        fixture.window.close();
    }
    QPlcControlCenter again;
    again.restoreView();
    again.show();
    QCOMPARE(again.layoutJson(), layout);
    QCOMPARE(again.theme(), QPlcControlCenter::SunlightTheme);
    QCOMPARE(again.plants(), QStringList{QStringLiteral("kite")});
    QVERIFY(again.findChild<SignalDock *>()->isHidden());
    QTRY_VERIFY(again.isConnected(QStringLiteral("kite")));
    again.setTheme(QPlcControlCenter::SystemTheme);
}

void tst_ControlCenter::rateAppliesToAllPlantsAndIsRestored()
{
    RunningMaster master;
    QVERIFY(master.startRealTime());
    {
        WindowFixture fixture;
        fixture.window.restoreView();
        QVERIFY(fixture.action("Rate: every cycle")->isChecked());
        fixture.connectTo(master.address());
        const auto figures = [&] { return fixture.topBar()->selector()->toolTip(); };
        QTRY_VERIFY(figures().contains(QStringLiteral("100 Hz ·")));
        fixture.action("Rate: 10 per second")->trigger();
        QVERIFY(!fixture.action("Rate: every cycle")->isChecked());
        QTRY_COMPARE(fixture.plant()->every(), 10);
        QTRY_VERIFY(figures().contains(QStringLiteral("100 Hz, 10 shown")));
        fixture.window.close();
    }
    WindowFixture fixture;
    fixture.window.restoreView();
    QVERIFY(fixture.action("Rate: 10 per second")->isChecked());
    QTRY_COMPARE(fixture.plant()->every(), 10);
    QTRY_VERIFY(fixture.plant()->values().rows() > 3);
}

void tst_ControlCenter::signalTreeIsRestored()
{
    const QString address = QStringLiteral("127.0.0.1:%1").arg(freePort());
    const QJsonObject settings{{QStringLiteral("search"), QStringLiteral("tether")},
                               {QStringLiteral("columns"), QJsonArray{QStringLiteral("name"), QStringLiteral("age")}}};
    {
        WindowFixture fixture;
        fixture.window.restoreView();
        fixture.window.connectToMaster(address);
        auto *dock = fixture.part<SignalDock>();
        QCOMPARE(dock->width(), 330);
        fixture.window.resizeDocks({dock}, {410}, Qt::Horizontal);
        dock->tree()->applySettings(settings);
        QTRY_COMPARE(dock->width(), 410);
        fixture.window.close();
    }
    WindowFixture again;
    again.window.restoreView();
    auto *dock = again.part<SignalDock>();
    QTRY_COMPARE(dock->width(), 410);
    QCOMPARE(dock->tree()->settings(), settings);
    QCOMPARE(dock->tree()->findChild<QLineEdit *>()->text(), QStringLiteral("tether"));
}

void tst_ControlCenter::windowSavesNothingWithoutRestoreView()
{
    {
        WindowFixture fixture;
        fixture.window.close();
    }
    QVERIFY(QSettings().allKeys().isEmpty());
    QSettings().setValue(QStringLiteral("ControlCenter/layout"), QByteArray("nonsense"));
    WindowFixture fixture;
    fixture.window.restoreView();
    QVERIFY(!fixture.hint().isEmpty());
    QVERIFY(fixture.window.layoutJson().contains("Value table"));
}

void tst_ControlCenter::themesReachPanelsAndPalette()
{
    WindowFixture fixture;
    QSignalSpy changed(fixture.window.context(), &WindowContext::themeChanged);
    for (const auto theme :
         {QPlcControlCenter::DarkTheme, QPlcControlCenter::SunlightTheme, QPlcControlCenter::LightTheme}) {
        fixture.window.setTheme(theme);
        const qplc::Theme expected = qplc::Theme::byName(qplc::Theme::Name(int(theme)));
        QCOMPARE(fixture.window.context()->theme().window, expected.window);
        QCOMPARE(QApplication::palette().color(QPalette::Window), expected.window);
        QCOMPARE(fixture.topBar()->palette().color(QPalette::WindowText), expected.text);
    }
    QCOMPARE(changed.count(), 3);
    fixture.window.setTheme(QPlcControlCenter::SystemTheme);
}

void tst_ControlCenter::eventsAreOnTheLineUntilAcknowledged()
{
    WindowFixture fixture;
    fixture.window.connectToMaster(QStringLiteral("127.0.0.1:%1").arg(freePort()));
    auto *line = fixture.part<EventLine>("EventLine");
    EventLogModel *events = fixture.window.context()->events();
    const auto tell = [&](PlantEvent::Severity severity, const char *text) {
        events->append(
            {QDateTime::currentDateTime(), severity, QStringLiteral("kite"), QString::fromLatin1(text), false});
    };
    QVERIFY(line->text().startsWith(QLatin1String("No events")));
    tell(PlantEvent::Error, "tether broken");
    tell(PlantEvent::Warning, "late");
    tell(PlantEvent::Information, "fine");
    QVERIFY2(line->text().contains(QLatin1String("late")) && line->text().contains(QLatin1String("1 more")),
             qPrintable(line->text()));
    QTest::mouseClick(line, Qt::LeftButton);
    auto *view = fixture.part<LayoutView>();
    QCOMPARE(view->editor()->layout().currentTab().name, QStringLiteral("Real time"));  // where the log is
    QCOMPARE(view->editor()->undoStack()->count(), 0);
    fixture.press(Qt::Key_A, Qt::ControlModifier | Qt::ShiftModifier);
    QVERIFY(line->text().startsWith(QLatin1String("No events")));
}

void tst_ControlCenter::aWindowEndsInEveryState()
{
    RunningMaster master;
    QVERIFY(master.startRealTime());
    {
        QPlcControlCenter neverShown;
        neverShown.connectToMaster(master.address());
    }
    auto fixture = std::make_unique<WindowFixture>();
    fixture->window.connectToMaster(master.address());
    fixture->window.connectToMaster(QStringLiteral("127.0.0.1:%1").arg(freePort()));
    QTRY_VERIFY(fixture->plant()->values().rows() > 5);
    fixture->press(Qt::Key_K, Qt::ControlModifier);
    fixture->window.close();
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);  // the plant goes on
    fixture.reset();
    master.stop();
}

QTEST_MAIN(tst_ControlCenter)
#include "tst_ControlCenter.moc"
