// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "WindowFixtures.h"
#include "gui/window/MissingNotice.h"

using namespace qplc;

// A safe stop as the window shows it, and the way back: reset, initialize, arm, start.
class tst_LatchBanner : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aSafeStopIsShownWithItsReasonUntilItIsReset_data();
    void aSafeStopIsShownWithItsReasonUntilItIsReset();
    void bannerNamesPendingConditionsAndDisablesReset();
    void missingNodeIsNamedUntilItIsBack();
    void nextButtonStepsThroughInitializeArmAndStart();
    void safeStopOfAnUnselectedPlantIsShown();

private:
    TestSettings m_settings;
};

void tst_LatchBanner::aSafeStopIsShownWithItsReasonUntilItIsReset_data()
{
    QTest::addColumn<int>("theme");
    QTest::newRow("light") << int(QPlcControlCenter::LightTheme);
    QTest::newRow("dark") << int(QPlcControlCenter::DarkTheme);
}

void tst_LatchBanner::aSafeStopIsShownWithItsReasonUntilItIsReset()
{
    QFETCH(int, theme);
    RunningMaster master;
    WindowFixture fixture;
    fixture.window.setTheme(QPlcControlCenter::Theme(theme));
    fixture.window.connectToMaster(master.address(), QStringLiteral("kite"));
    auto *banner = fixture.part<LatchBanner>();
    QVERIFY(!banner->isVisible());
    QTRY_COMPARE(fixture.plant()->nextAction(), Plant::Start);
    fixture.press(Qt::Key_F5);
    QTRY_COMPARE(master.state(), QPlcMasterNode::RealTime);
    master.safeStop(QStringLiteral("smoke at the winch"));
    QTRY_VERIFY(banner->isVisible());
    QCOMPARE(banner->text(),
             QStringLiteral("kite has stopped safely: smoke at the winch. Reset it, then initialize and start."));
    QCOMPARE(banner->accessibleName(), banner->text());
    QCOMPARE(fixture.topBar()->selector()->headline(), QStringLiteral("stopped safely"));
    QCOMPARE(PlantSummary::of(*fixture.plant()).tone, Tone::Alarm);
    QCOMPARE(fixture.topBar()->nextButton()->text(), QStringLiteral("Reset"));
    QTRY_VERIFY(fixture.topBar()->stepper()->toolTip().contains(QLatin1String("Safe stop")));
    QTest::qWait(100);  // a picture with values
    const QString folder = qEnvironmentVariable("QTPLC_SCREENSHOTS");
    if (!folder.isEmpty())
        fixture.window.screen()->grabWindow(0).save(
            QStringLiteral("%1/safe_stop_%2.png").arg(folder, QLatin1String(QTest::currentDataTag())));
    QTest::mouseClick(banner->resetButton(), Qt::LeftButton);
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QTRY_VERIFY(!banner->isVisible());
    QTRY_COMPARE(fixture.plant()->nextAction(), Plant::Start);
}

void tst_LatchBanner::bannerNamesPendingConditionsAndDisablesReset()
{
    RunningMaster master;
    master.setInterval(std::chrono::milliseconds(100));  // a busy computer is not to be the reason
    EchoNode critical;
    critical.setCritical(true);
    QVERIFY(critical.connectToMasterAndWaitForConnected(master.protocol(QStringLiteral("udp"))));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address(), QStringLiteral("kite"));
    critical.disconnectFromMaster();
    auto *banner = fixture.part<LatchBanner>();
    QTRY_VERIFY(banner->text().contains(QLatin1String("critical node 'Echo' has left")));
    QVERIFY2(banner->text().contains(QLatin1String("Before a reset: node 'Echo' is not back")),
             qPrintable(banner->text()));
    QVERIFY(!banner->resetButton()->isEnabled());
    QVERIFY(critical.connectToMasterAndWaitForConnected(master.protocol(QStringLiteral("udp"))));
    QTRY_VERIFY(banner->resetButton()->isEnabled());
    fixture.press(Qt::Key_F7);
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    critical.disconnectFromMaster();
}

void tst_LatchBanner::missingNodeIsNamedUntilItIsBack()
{
    RunningMaster master;
    EchoNode critical;
    critical.setCritical(true);
    QVERIFY(critical.connectToMasterAndWaitForConnected(master.protocol(QStringLiteral("udp"))));
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address(), QStringLiteral("kite"));
    QTRY_VERIFY(fixture.window.isConnected(QStringLiteral("kite")));
    auto *notice = fixture.part<MissingNotice>();
    QCOMPARE(notice->text(), QString());
    critical.disconnectFromMaster();
    QTRY_VERIFY(notice->text().startsWith(QLatin1String("kite: critical node 'Echo' (has left: ")));
    QVERIFY(notice->isVisible());
    QVERIFY(critical.connectToMasterAndWaitForConnected(master.protocol(QStringLiteral("udp"))));
    QTRY_COMPARE(notice->text(), QString());
    critical.disconnectFromMaster();
}

void tst_LatchBanner::nextButtonStepsThroughInitializeArmAndStart()
{
    RunningMaster master;
    master.setArmingRequired(true);
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address(), QStringLiteral("kite"));
    BarButton *next = fixture.topBar()->nextButton();
    for (const auto &[action, word] :
         {std::pair(Plant::Initialize, "Initialize"), std::pair(Plant::Arm, "Arm"), std::pair(Plant::Start, "Start")}) {
        QTRY_COMPARE(fixture.plant()->nextAction(), action);
        QTRY_COMPARE(next->text(), QString::fromLatin1(word));
        QTest::mouseClick(next, Qt::LeftButton);
    }
    QTRY_COMPARE(master.state(), QPlcMasterNode::RealTime);
}

void tst_LatchBanner::safeStopOfAnUnselectedPlantIsShown()
{
    RunningMaster chosen;
    RunningMaster other;
    WindowFixture fixture;
    fixture.window.connectToMaster(chosen.address(), QStringLiteral("kite"));
    fixture.window.connectToMaster(other.address(), QStringLiteral("tower"));
    QVERIFY(other.startRealTime());
    QVERIFY(other.waitForState(QPlcMasterNode::RealTime));
    other.safeStop(QStringLiteral("smoke"));
    auto *banner = fixture.part<LatchBanner>();
    QTRY_VERIFY(banner->text().startsWith(QLatin1String("tower has stopped safely: smoke")));
    QTest::mouseClick(banner->resetButton(), Qt::LeftButton);
    QVERIFY(other.waitForState(QPlcMasterNode::Off));
    QTRY_VERIFY(banner->isHidden());
}

QTEST_MAIN(tst_LatchBanner)
#include "tst_LatchBanner.moc"
