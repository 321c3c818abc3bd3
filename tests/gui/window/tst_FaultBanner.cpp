// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "WindowFixtures.h"
#include "gui/window/FaultBanner.h"

using namespace qplc;

/// A plant that meets faults on purpose says so across the window.
class tst_FaultBanner : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_settings = std::make_unique<TestSettings>(); }
    void bannerIsHiddenWithoutInjectedFaults();
    void bannerNamesEveryInjectorAndItsFaults();
    void bannerDisappearsWithItsPlant();

private:
    std::unique_ptr<TestSettings> m_settings;
};

void tst_FaultBanner::bannerIsHiddenWithoutInjectedFaults()
{
    RunningMaster master;
    WindowFixture fixture;
    const auto *banner = fixture.part<FaultBanner>();
    QVERIFY(!banner->isVisible());
    fixture.window.connectToMaster(master.address());
    QTRY_VERIFY(fixture.plant()->status().master.state != messages::MasterState::Unknown);
    QVERIFY(!banner->isVisible());
    QVERIFY(banner->text().isEmpty());
}

void tst_FaultBanner::bannerNamesEveryInjectorAndItsFaults()
{
    TestMaster master(QPlcClock::realTime());
    QVERIFY(master.setFaultPlan(QStringLiteral("delay=1ms,jitter=1ms,seed=7")));
    QVERIFY(master.listen());
    EchoNode echo;
    QVERIFY(echo.setFaultPlan(QStringLiteral("loss=5%")));
    QVERIFY(master.admit(echo, QStringLiteral("udp")));
    QVERIFY(master.startRealTime());
    WindowFixture fixture;
    const auto *banner = fixture.part<FaultBanner>();
    fixture.window.connectToMaster(QStringLiteral("127.0.0.1:%1").arg(master.serverPort()), QStringLiteral("winch"));
    QTRY_VERIFY(banner->isVisible());
    QCOMPARE(banner->text(),
             QStringLiteral("winch: faults are injected on purpose by the master (delay=1ms,jitter=1ms,seed=7), "
                            "Echo (loss=5%)"));
    QCOMPARE(banner->accessibleName(), banner->text());
    QTRY_VERIFY(banner->width() > fixture.window.width() / 2);
    QVERIFY(banner->height() >= 24);
    QTest::qWait(500);  // for the picture
    echo.disconnectFromMaster();
    QTRY_VERIFY(!banner->text().contains(QStringLiteral("Echo")));
    QVERIFY(banner->isVisible());
}

void tst_FaultBanner::bannerDisappearsWithItsPlant()
{
    TestMaster master(QPlcClock::realTime());
    QVERIFY(master.setFaultPlan(QStringLiteral("loss=5%")));
    QVERIFY(master.listen());
    WindowFixture fixture;
    const auto *banner = fixture.part<FaultBanner>();
    fixture.window.connectToMaster(QStringLiteral("127.0.0.1:%1").arg(master.serverPort()), QStringLiteral("winch"));
    QTRY_VERIFY(banner->isVisible());
    fixture.window.disconnectFromMaster(QStringLiteral("winch"));
    QTRY_VERIFY(!banner->isVisible());
}

QTEST_MAIN(tst_FaultBanner)
#include "tst_FaultBanner.moc"
