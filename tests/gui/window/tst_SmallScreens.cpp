// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "WindowFixtures.h"

using namespace qplc;

namespace {

constexpr QSize smallest(1024, 640);  // [px] on which everything is reached

/// The place of \a widget in its window.
QRect placeOf(const QWidget *widget)
{
    return {widget->mapTo(widget->window(), QPoint()), widget->size()};
}

}  // namespace

/// On small screens, and on large ones with a large scale, nothing is cut off: least of all STOP.
class tst_SmallScreens : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_settings = std::make_unique<TestSettings>(); }
    void theFirstWindowFitsTheScreen();
    void everythingIsReachedOnASmallScreen_data();
    void everythingIsReachedOnASmallScreen();
    void theBarHasRoomForLongNamesAndForControl();
    void controlNoticeIsReadableOnASmallScreen();

private:
    std::unique_ptr<TestSettings> m_settings;
};

void tst_SmallScreens::theFirstWindowFitsTheScreen()
{
    QPlcControlCenter window;
    window.show();
    QVERIFY(QTest::qWaitForWindowExposed(&window));
    const QSize room = window.screen()->availableSize().expandedTo(smallest);
    QVERIFY2(window.width() <= room.width() && window.frameGeometry().height() <= room.height(),
             qPrintable(QStringLiteral("%1 x %2 on %3 x %4")
                            .arg(window.frameGeometry().width())
                            .arg(window.frameGeometry().height())
                            .arg(room.width())
                            .arg(room.height())));
    const QRect stop = placeOf(window.findChild<TopBar *>()->stopButton());
    QVERIFY(window.findChild<TopBar *>()->stopButton()->isVisible());
    QVERIFY(window.rect().contains(stop));
}

void tst_SmallScreens::everythingIsReachedOnASmallScreen_data()
{
    QTest::addColumn<bool>("isConnected");
    QTest::newRow("start page") << false;
    QTest::newRow("panels") << true;
}

void tst_SmallScreens::everythingIsReachedOnASmallScreen()
{
    QFETCH(bool, isConnected);
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    WindowFixture fixture;
    if (isConnected) {
        fixture.window.connectToMaster(master.address());
        QTRY_VERIFY(fixture.plant()->status().isRunning());
    }
    fixture.action("Connect...")->trigger();  // the strip needs room, too
    fixture.window.resize(smallest);
    QTest::qWait(50);
    QCOMPARE(fixture.window.size(), smallest);
    QTRY_COMPARE(fixture.structure().cutButtons<BarButton>(), QStringList());
    QVERIFY(fixture.window.rect().contains(placeOf(fixture.part<EventLine>())));
}

void tst_SmallScreens::theBarHasRoomForLongNamesAndForControl()
{
    FlyingMaster first;
    FlyingMaster second;
    WindowFixture fixture;
    fixture.window.connectToMaster(first.address(), QStringLiteral("Kite of the northern field"));
    fixture.window.connectToMaster(second.address(), QStringLiteral("Kite of the southern field"));
    for (int place : {0, 1}) {
        QTRY_VERIFY(fixture.plant(place)->hasLeases());
        fixture.plant(place)->takeLease({QStringLiteral("echo")});
    }
    TopBar *bar = fixture.topBar();
    QTRY_VERIFY(bar->controlNotice()->giveBackButton()->isVisible() && bar->nextButton()->isVisible());
    fixture.window.resize(smallest);
    QTest::qWait(50);
    QCOMPARE(fixture.window.size(), smallest);
    QTRY_COMPARE(fixture.structure().cutButtons<BarButton>(), QStringList());
    QVERIFY(bar->stopButton()->width() >= bar->stopButton()->sizeHint().width());
    const QVector<QWidget *> parts{bar->selector(), bar->stepper(), bar->nextButton(), bar->controlNotice(),
                                   bar->stopButton()};
    for (int i = 0; i + 1 < parts.size(); ++i)
        QVERIFY2(placeOf(parts[i]).right() < placeOf(parts[i + 1]).left(), qPrintable(parts[i]->objectName()));
}

void tst_SmallScreens::controlNoticeIsReadableOnASmallScreen()
{
    FlyingMaster master;
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address(), QStringLiteral("north"));
    QTRY_VERIFY(fixture.plant()->hasLeases());
    fixture.plant()->takeLease({QStringLiteral("echo")});
    const ControlNotice *notice = fixture.topBar()->controlNotice();
    QTRY_VERIFY(notice->giveBackButton()->isVisible());
    QCOMPARE(notice->lines(), (QStringList{QStringLiteral("You control"), QStringLiteral("echo")}));
    fixture.window.resize(smallest);
    QTest::qWait(50);
    QFont bold = notice->font();
    bold.setBold(true);
    const int room = notice->textRect().width();
    QVERIFY2(QFontMetrics(bold).elidedText(notice->lines().constFirst(), Qt::ElideRight, room)
                 == QLatin1String("You control"),
             qPrintable(QString::number(room)));
}

QTEST_MAIN(tst_SmallScreens)
#include "tst_SmallScreens.moc"
