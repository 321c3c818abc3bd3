// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "SetterFixtures.h"
#include "WindowFixtures.h"

using namespace qplc;

namespace {

const QString echo = QStringLiteral("echo");
const QString setpoint = QStringLiteral("setpoint");

/// Somebody else: a connection with leases of its own.
std::unique_ptr<Plant> otherWindow(const RunningMaster &master)
{
    auto other = std::make_unique<Plant>(master.address(), QString(), QStringLiteral("Other"));
    other->open();
    return other;
}

bool isReady(const Plant &plant)
{
    return waitUntil([&] { return plant.hasLeases() && plant.table().size() > 0; });
}

}  // namespace

/// What the bar says of signals that persons have taken over, and how they are given back.
class tst_ControlByHand : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_settings = std::make_unique<TestSettings>(); }
    void noticeIsEmptyWithoutManualControl();
    void noticeShowsHeldSignalsAndAClickReleasesThem();
    void keysReleaseAllSignals();
    void noticeNamesOtherHoldersWithoutReleasingTheirSignals();
    void noticeReportsLostControlWithTheRemedy();
    void noticeShowsTwoLinesAndTheRestInTheToolTip();
    void noticeNamesThePlantsAmongSeveral();
    void acquiringControlDoesNotMoveTheLayout();
    void aSetterOutlivesItsPlant();

private:
    std::unique_ptr<TestSettings> m_settings;
};

void tst_ControlByHand::noticeIsEmptyWithoutManualControl()
{
    FlyingMaster master;
    WindowFixture fixture;
    const ControlNotice *notice = fixture.topBar()->controlNotice();
    const auto isSilent = [&] {
        return notice->lines().isEmpty() && notice->toolTip().isEmpty() && !notice->giveBackButton()->isVisible()
            && !fixture.action("Give back control")->isEnabled();
    };
    QVERIFY(isSilent());
    fixture.window.connectToMaster(master.address());
    QVERIFY(isReady(*fixture.plant()));
    QVERIFY(isSilent());
}

void tst_ControlByHand::noticeShowsHeldSignalsAndAClickReleasesThem()
{
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    WindowFixture fixture;
    const ControlNotice *notice = fixture.topBar()->controlNotice();
    fixture.window.connectToMaster(master.address());
    QVERIFY(isReady(*fixture.plant()));
    fixture.plant()->takeLease({echo, setpoint});
    QTRY_VERIFY(!notice->lines().isEmpty());
    QCOMPARE(notice->lines().at(0), QStringLiteral("You control"));
    QStringList names = notice->lines().at(1).split(QStringLiteral(", "));
    names.sort();
    QCOMPARE(names, (QStringList{echo, setpoint}));
    QVERIFY(notice->giveBackButton()->isVisible());
    QVERIFY(notice->giveBackButton()->accessibleName().contains(echo));
    QTest::mouseClick(notice->giveBackButton(), Qt::LeftButton);
    QTRY_VERIFY(master.leases().isEmpty());
    QTRY_VERIFY(notice->lines().isEmpty());
    QVERIFY(!notice->giveBackButton()->isVisible());
}

void tst_ControlByHand::keysReleaseAllSignals()
{
    FlyingMaster master;
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address());
    QVERIFY(isReady(*fixture.plant()));
    fixture.plant()->takeLease({echo});
    QTRY_VERIFY(fixture.action("Give back control")->isEnabled());
    fixture.press(Qt::Key_G, Qt::ControlModifier);
    QTRY_VERIFY(master.leases().isEmpty());
    QTRY_VERIFY(!fixture.action("Give back control")->isEnabled());
}

void tst_ControlByHand::noticeNamesOtherHoldersWithoutReleasingTheirSignals()
{
    FlyingMaster master;
    WindowFixture fixture;
    const ControlNotice *notice = fixture.topBar()->controlNotice();
    fixture.window.connectToMaster(master.address());
    const std::unique_ptr<Plant> other = otherWindow(master);
    QVERIFY(isReady(*other) && isReady(*fixture.plant()));
    other->takeLease({echo});
    QTRY_COMPARE(notice->lines(), (QStringList{PlantLeases::whoever() + QStringLiteral(" controls"), echo}));
    QVERIFY(!notice->giveBackButton()->isVisible());
    QVERIFY(notice->toolTip().contains(QLatin1String("A setter can take control")));
    giveBackControl(*fixture.window.context()->plants());
    QTest::qWait(100);
    QCOMPARE(master.leases().size(), 1);
}

void tst_ControlByHand::noticeReportsLostControlWithTheRemedy()
{
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    WindowFixture fixture;
    const ControlNotice *notice = fixture.topBar()->controlNotice();
    fixture.window.connectToMaster(master.address());
    std::unique_ptr<Plant> other = otherWindow(master);
    QVERIFY(isReady(*other) && isReady(*fixture.plant()));
    other->takeLease({echo});
    QTRY_VERIFY(!notice->lines().isEmpty());
    other.reset();
    QTRY_COMPARE(notice->lines(), (QStringList{QStringLiteral("Control is lost: neutral"), echo}));
    QVERIFY2(notice->toolTip().startsWith(QLatin1String("Control of echo is lost: neutral. "))
                 && notice->toolTip().contains(QLatin1String("give back")),
             qPrintable(notice->toolTip()));
    QTest::mouseClick(notice->giveBackButton(), Qt::LeftButton);
    QTRY_VERIFY(notice->lines().isEmpty());
}

void tst_ControlByHand::noticeShowsTwoLinesAndTheRestInTheToolTip()
{
    FlyingMaster master;
    WindowFixture fixture;
    const ControlNotice *notice = fixture.topBar()->controlNotice();
    fixture.window.connectToMaster(master.address());
    const std::unique_ptr<Plant> other = otherWindow(master);
    QVERIFY(isReady(*other) && isReady(*fixture.plant()));
    other->takeLease({setpoint});
    fixture.plant()->takeLease({echo});
    const QString theirs = PlantLeases::whoever() + QStringLiteral(" controls setpoint");
    QTRY_COMPARE(notice->lines(), (QStringList{QStringLiteral("You control echo"), theirs}));
    QCOMPARE(notice->toolTip().split(QLatin1Char('\n')).size(), 2);
    QTest::mouseClick(notice->giveBackButton(), Qt::LeftButton);
    QTRY_COMPARE(notice->lines().value(1), setpoint);  // theirs is left
}

void tst_ControlByHand::noticeNamesThePlantsAmongSeveral()
{
    FlyingMaster first;
    FlyingMaster second;
    WindowFixture fixture;
    fixture.window.connectToMaster(first.address(), QStringLiteral("kite"));
    fixture.window.connectToMaster(second.address(), QStringLiteral("winch"));
    QVERIFY(isReady(*fixture.plant(0)) && isReady(*fixture.plant(1)));
    fixture.plant(0)->takeLease({echo});
    fixture.plant(1)->takeLease({echo});
    const ControlNotice *notice = fixture.topBar()->controlNotice();
    QTRY_COMPARE(notice->lines().value(1), QStringLiteral("kite/echo, winch/echo"));
    fixture.press(Qt::Key_G, Qt::ControlModifier);
    QTRY_VERIFY(first.leases().isEmpty() && second.leases().isEmpty());
    fixture.plant(1)->takeLease({echo});
    QTRY_COMPARE(notice->lines().value(1), QStringLiteral("winch/echo"));
    fixture.window.disconnectFromMaster(QStringLiteral("winch"));
    QVERIFY(notice->lines().isEmpty());
}

void tst_ControlByHand::acquiringControlDoesNotMoveTheLayout()
{
    FlyingMaster master;
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address());
    QVERIFY(isReady(*fixture.plant()));
    const auto places = [&] {
        QVector<QRect> all{fixture.part<LayoutView>()->geometry(), fixture.topBar()->geometry()};
        for (const QWidget *part : QVector<QWidget *>{fixture.topBar()->selector(), fixture.topBar()->stepper(),
                                                      fixture.topBar()->nextButton(), fixture.topBar()->stopButton()})
            all << QRect(part->mapTo(&fixture.window, QPoint()), part->size());
        return all;
    };
    QTRY_VERIFY(fixture.topBar()->nextButton()->isVisible());
    QTest::qWait(50);  // until the button has its width
    const QVector<QRect> before = places();
    fixture.plant()->takeLease({echo});
    QTRY_VERIFY(fixture.topBar()->controlNotice()->giveBackButton()->isVisible());
    QTest::qWait(50);
    QCOMPARE(places(), before);
    QCOMPARE(fixture.structure().cutButtons<BarButton>(), QStringList());
}

void tst_ControlByHand::aSetterOutlivesItsPlant()
{
    FlyingMaster master;
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address(), QStringLiteral("kite"));
    auto *view = fixture.part<LayoutView>();
    const LayoutTarget here = LayoutTarget::inTab(view->editor()->layout().currentTab().id);
    view->editor()->addPanel(QStringLiteral("Setter"), {{QStringLiteral("signal"), echo}}, here);
    QTRY_VERIFY(fixture.structure().shows(QStringLiteral("^Take control$")));
    fixture.window.disconnectFromMaster(QStringLiteral("kite"));
    QVERIFY(fixture.window.plants().isEmpty());
}

QTEST_MAIN(tst_ControlByHand)
#include "tst_ControlByHand.moc"
