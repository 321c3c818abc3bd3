// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "ProgramFixtures.h"
#include "WindowFixtures.h"

#include <algorithm>
#include <csignal>

using namespace qplc;

class tst_ControlCenterPrograms : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_settings = std::make_unique<TestSettings>(); }
    void killedMasterIsReportedAndFoundAgain();

private:
    std::unique_ptr<TestSettings> m_settings;
};

void tst_ControlCenterPrograms::killedMasterIsReportedAndFoundAgain()
{
    std::unique_ptr<Program> master = startMaster(QStringLiteral("0"));
    QVERIFY(master);
    const QString port = portOf(*master);
    WindowFixture fixture;
    fixture.connectTo(QStringLiteral("127.0.0.1:") + port);
    QTRY_VERIFY(fixture.topBar()->nextButton()->isVisible());
    QTest::mouseClick(fixture.topBar()->nextButton(), Qt::LeftButton);
    PlantSelector *selector = fixture.topBar()->selector();
    QTRY_COMPARE(selector->headline(), QStringLiteral("live"));

    const Heartbeat heartbeat;
    master->sendSignal(SIGKILL);
    QTRY_VERIFY2(selector->headline().startsWith(QLatin1String("lost")), qPrintable(selector->headline()));
    QCOMPARE(fixture.plant()->quality(), Plant::Stale);
    QCOMPARE(fixture.topBar()->stepper()->step(), StateStep::None);
    QVERIFY(fixture.topBar()->stopButton()->isEnabled());
    QTRY_VERIFY(selector->headline().contains(QLatin1String("next attempt in")));
    QTest::mouseClick(fixture.topBar()->stopButton(), Qt::LeftButton);  // waits for nobody, and says so
    QTRY_VERIFY(fixture.hint().contains(QLatin1String("no connection")));
    QVERIFY(fixture.part<EventLine>("EventLine")->text().contains(QLatin1String("Error")));

    master = startMaster(port);
    QVERIFY(master);
    QTRY_VERIFY(fixture.topBar()->nextButton()->isVisible());
    fixture.press(Qt::Key_F5);
    QTRY_COMPARE(selector->headline(), QStringLiteral("live"));
    QVERIFY2(heartbeat.longest() < 1000, qPrintable(QString::number(heartbeat.longest())));
}

QTEST_MAIN(tst_ControlCenterPrograms)
#include "tst_ControlCenterPrograms.moc"
