// SPDX-License-Identifier: Apache-2.0
#include "../../common/RuntimeFolder.h"
#include "../../common/Waiting.h"
#include "WindowFixtures.h"
#include "gui/window/FoundMasters.h"

#include <QtWidgets/QLabel>

using namespace qplc;

/// What was found stands on the start page and in the strip, and one click or key leads there.
class tst_FoundMasters : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_settings = std::make_unique<TestSettings>(); }
    void startPageStatesThatNoMasterIsFound();
    void foundMastersAppearAndDisappear();
    void aClickConnects();
    void keysSelectAndConnectFoundMasters();
    void connectStripShowsFoundMasters();
    void focusStaysOnAMasterWhileOthersChange();
    void newMastersDoNotMoveTheButtonsAbove();
    void focusMovesOnWhenItsMasterDisappears();
    void foundNamesGetNoShortcutAndLimitedWidth();
    void onlyTheFirstFiveAreShown();
    void clickOnAConnectedMasterShowsItsPlant();
    void searchRunsOnlyWhileItsResultsAreVisible();

private:
    static FoundMaster master(int port, const char *name = "kite", bool isLocal = true)
    {
        return {QStringLiteral("%1:%2").arg(QLatin1String(isLocal ? "127.0.0.1" : "192.0.2.7")).arg(port),
                QString::fromUtf8(name), isLocal, false, 1};
    }
    static void tell(WindowFixture &fixture, const QVector<FoundMaster> &masters)
    {
        Q_EMIT fixture.part<MasterSearch>()->found(masters);
        QCoreApplication::processEvents();
    }
    template<typename Place>
    static QList<BarButton *> buttons(WindowFixture &fixture)
    {
        QList<BarButton *> found
            = fixture.part<Place>()->template findChild<FoundMasters *>()->template findChildren<BarButton *>();
        std::sort(found.begin(), found.end(), [](const BarButton *a, const BarButton *b) {
            return std::make_pair(a->y(), a->x()) < std::make_pair(b->y(), b->x());
        });
        return found;
    }
    static bool saysNone(WindowFixture &fixture)
    {
        for (const QLabel *label : fixture.part<StartPage>()->findChildren<QLabel *>()) {
            if (label->isVisible() && label->text() == QLatin1String("No running master has been found yet."))
                return true;
        }
        return false;
    }
    std::unique_ptr<TestSettings> m_settings;
};

void tst_FoundMasters::startPageStatesThatNoMasterIsFound()
{
    WindowFixture fixture;
    QVERIFY(saysNone(fixture));
    QVERIFY(buttons<StartPage>(fixture).isEmpty());
    fixture.press(Qt::Key_O, Qt::ControlModifier);
    QVERIFY(buttons<ConnectStrip>(fixture).isEmpty());
    QVERIFY(!fixture.part<ConnectStrip>()->findChild<FoundMasters *>()->isVisible());
}

void tst_FoundMasters::foundMastersAppearAndDisappear()
{
    WindowFixture fixture;
    tell(fixture, {master(50000), master(50001, "winch", false)});
    QVERIFY(!saysNone(fixture));
    QList<BarButton *> shown = buttons<StartPage>(fixture);
    QCOMPARE(shown.size(), 2);
    QVERIFY(shown[0]->isVisible());
    QCOMPARE(shown[0]->text(), QStringLiteral("kite"));
    QCOMPARE(shown[0]->detail(), QStringLiteral("127.0.0.1:50000, this computer"));
    QCOMPARE(shown[1]->detail(), QStringLiteral("192.0.2.7:50001, network, insecure"));
    QCOMPARE(shown[1]->accessibleName(), QStringLiteral("Connect to winch at 192.0.2.7:50001, network, insecure"));
    tell(fixture, {master(50001, "winch", false)});
    QCOMPARE(buttons<StartPage>(fixture).size(), 1);
    tell(fixture, {});
    QVERIFY(buttons<StartPage>(fixture).isEmpty());
    QVERIFY(saysNone(fixture));
}

void tst_FoundMasters::aClickConnects()
{
    RunningMaster running;
    WindowFixture fixture;
    tell(fixture, {master(running.serverPort())});
    QTest::mouseClick(buttons<StartPage>(fixture).constFirst(), Qt::LeftButton);
    QTRY_VERIFY(fixture.window.isConnected(running.address()));
    QVERIFY(!fixture.window.isStartPageShown());
}

void tst_FoundMasters::keysSelectAndConnectFoundMasters()
{
    RunningMaster running;
    WindowFixture fixture;
    tell(fixture, {master(1), master(running.serverPort())});
    const BarButton *wanted = buttons<StartPage>(fixture).constLast();
    QTRY_VERIFY(fixture.part<StartPage>()->isAncestorOf(QApplication::focusWidget()));
    for (int presses = 0; presses < 3 && !wanted->hasFocus(); ++presses)  // Connect..., the first, the second
        fixture.press(Qt::Key_Tab);
    QVERIFY(wanted->hasFocus());
    fixture.press(Qt::Key_Return);
    QTRY_VERIFY(fixture.window.isConnected(running.address()));
}

void tst_FoundMasters::connectStripShowsFoundMasters()
{
    RunningMaster running;
    WindowFixture fixture;
    fixture.press(Qt::Key_O, Qt::ControlModifier);
    tell(fixture, {master(running.serverPort()), master(1)});
    QCOMPARE(buttons<ConnectStrip>(fixture).size(), 2);
    QVERIFY(buttons<ConnectStrip>(fixture).constFirst()->isVisible());
    QTest::mouseClick(buttons<ConnectStrip>(fixture).constFirst(), Qt::LeftButton);
    QVERIFY(fixture.part<ConnectStrip>()->isHidden());
    QTRY_VERIFY(fixture.window.isConnected(running.address()));
}

void tst_FoundMasters::focusStaysOnAMasterWhileOthersChange()
{
    WindowFixture fixture;
    tell(fixture, {master(50000, "b")});
    BarButton *button = buttons<StartPage>(fixture).constFirst();
    button->setFocus();
    tell(fixture, {master(50001, "a"), master(50000, "b"), master(50002, "c")});
    QVERIFY(button->hasFocus());
    QCOMPARE(buttons<StartPage>(fixture)[1], button);
    tell(fixture, {master(50000, "another name")});
    QVERIFY(button->hasFocus());
    QCOMPARE(button->text(), QStringLiteral("another name"));
}

void tst_FoundMasters::newMastersDoNotMoveTheButtonsAbove()
{
    WindowFixture fixture;
    const QWidget *connectButton = fixture.part<StartPage>()->buttons().constFirst();
    const QPoint before = connectButton->mapToGlobal(QPoint());
    tell(fixture, {master(1), master(2), master(3), master(4), master(5)});
    QCOMPARE(connectButton->mapToGlobal(QPoint()), before);
    QVERIFY(buttons<StartPage>(fixture).constFirst()->mapToGlobal(QPoint()).y() > before.y());
}

void tst_FoundMasters::focusMovesOnWhenItsMasterDisappears()
{
    WindowFixture fixture;
    tell(fixture, {master(50000), master(50001)});
    buttons<StartPage>(fixture).constFirst()->setFocus();
    tell(fixture, {});
    QTRY_VERIFY(QApplication::focusWidget() && fixture.part<StartPage>()->isAncestorOf(QApplication::focusWidget()));
    fixture.press(Qt::Key_O, Qt::ControlModifier);
    tell(fixture, {master(50000)});
    buttons<ConnectStrip>(fixture).constFirst()->setFocus();
    tell(fixture, {});
    QVERIFY(fixture.part<ConnectStrip>()->line()->hasFocus());
}

void tst_FoundMasters::foundNamesGetNoShortcutAndLimitedWidth()
{
    WindowFixture fixture;
    tell(fixture, {master(50000, "<b>&Stop</b> WWWWWWWWWWWWWWWWWWWWWWWWWWWW")});
    const BarButton *button = buttons<StartPage>(fixture).constFirst();
    QVERIFY(button->shortcut().isEmpty());
    QVERIFY(button->width() < 520);
    QVERIFY(button->text().contains(QChar(0x2026)));
}

void tst_FoundMasters::onlyTheFirstFiveAreShown()
{
    WindowFixture fixture;
    QVector<FoundMaster> many;
    for (int port = 1; port <= 70; ++port)
        many.append(master(port));
    tell(fixture, many);
    QCOMPARE(buttons<StartPage>(fixture).size(), 5);
    QCOMPARE(buttons<ConnectStrip>(fixture).size(), 3);
    fixture.press(Qt::Key_O, Qt::ControlModifier);
    tell(fixture, {master(1, "WWWWWWWWWWWWWWWWWWWWWW"), master(2, "WWWWWWWWWWWWWWWWWWWWWW"), master(3)});
    QVERIFY(fixture.part<ConnectStrip>()->minimumSizeHint().width() < 1000);
}

void tst_FoundMasters::clickOnAConnectedMasterShowsItsPlant()
{
    RunningMaster running;
    WindowFixture fixture;
    fixture.window.connectToMaster(running.address(), QStringLiteral("mine"));
    fixture.window.showStartPage();
    tell(fixture, {master(running.serverPort())});
    QTest::mouseClick(buttons<StartPage>(fixture).constFirst(), Qt::LeftButton);
    QCOMPARE(fixture.window.plants(), QStringList{QStringLiteral("mine")});
    QVERIFY(!fixture.window.isStartPageShown());
}

void tst_FoundMasters::searchRunsOnlyWhileItsResultsAreVisible()
{
    const RuntimeFolder folder;
    RunningMaster running;
    MasterSearch search;
    QVector<FoundMaster> found;
    connect(&search, &MasterSearch::found, this, [&](const QVector<FoundMaster> &masters) { found = masters; });
    const auto isFound = [&] {
        return std::any_of(found.begin(), found.end(),
                           [&](const FoundMaster &each) { return each.address == running.address(); });
    };
    QWidget page;
    search.watch(&page);
    QVERIFY(!isFound());
    page.show();
    QVERIFY(isFound());
    page.hide();
    found.clear();
    QTest::qWait(600);
    QVERIFY(found.isEmpty());
    page.show();
    QVERIFY(isFound());
}

QTEST_MAIN(tst_FoundMasters)
#include "tst_FoundMasters.moc"
