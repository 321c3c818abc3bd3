// SPDX-License-Identifier: Apache-2.0
#include "LayoutFixtures.h"

#include <QtTest/QtTest>

#include <numeric>

using namespace qplc;

class tst_Layout : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void newLayoutHasOneEmptyTab();
    void panelFillsAnEmptyTab();
    void panelGoesToTheSideThatWasAskedFor_data();
    void panelGoesToTheSideThatWasAskedFor();
    void panelAddedToATabGetsAnEqualShareAtTheRight();
    void closingAPanelMergesTheRemainingSplits();
    void panelMovesToEveryKindOfTarget();
    void panelCannotBeBesideItself();
    void dockedPanelReturnsToItsPlace_data();
    void dockedPanelReturnsToItsPlace();
    void floatingPanelOfAClosedTabDocksIntoTheCurrentTab();
    void copyHasTheSettingsAndAnIdOfItsOwn();
    void sharesAreScaledToTheWhole();
    void grownPanelShrinksTheOthersInProportion();
    void leavingPanelEndsMaximization();
    void tabsAreAddedMovedRenamedAndClosed();
    void lastTabThatIsClosedLeavesAnEmptyOne();
    void titleDefaultsToTheType();
    void editsOfMissingItemsChangeNothing();
    void sharesOfAnyWeightsAddUp_data();
    void sharesOfAnyWeightsAddUp();
};

void tst_Layout::newLayoutHasOneEmptyTab()
{
    const Layout layout;
    QCOMPARE(described(layout), QStringLiteral("-"));
    QCOMPARE(layout.currentTab().name, QStringLiteral("Tab 1"));
    QCOMPARE(layout.invariantError(), QString());
}

void tst_Layout::panelFillsAnEmptyTab()
{
    Layout layout;
    QCOMPARE(layout.addPanel("Gauge", {}, LayoutTarget::inTab(layout.currentTab().id)), QStringLiteral("panel1"));
    QCOMPARE(described(layout), QStringLiteral("panel1"));
    QCOMPARE(layout.panel("panel1")->type, QStringLiteral("Gauge"));
    QCOMPARE(layout.addPanel("Gauge", {}, LayoutTarget::inTab("nowhere")), QString());
    QCOMPARE(layout.addPanel("", {}, LayoutTarget::inTab(layout.currentTab().id)), QString());
}

void tst_Layout::panelGoesToTheSideThatWasAskedFor_data()
{
    QTest::addColumn<QString>("neighbour");
    QTest::addColumn<int>("side");
    QTest::addColumn<QString>("expected");
    QTest::newRow("left") << "panel1" << int(LayoutSide::Left) << "H[panel4 panel1 V[panel2 panel3]]";
    QTest::newRow("right") << "panel1" << int(LayoutSide::Right) << "H[panel1 panel4 V[panel2 panel3]]";
    QTest::newRow("above") << "panel1" << int(LayoutSide::Above) << "H[V[panel4 panel1] V[panel2 panel3]]";
    QTest::newRow("below") << "panel1" << int(LayoutSide::Below) << "H[V[panel1 panel4] V[panel2 panel3]]";
    QTest::newRow("in between") << "panel2" << int(LayoutSide::Below) << "H[panel1 V[panel2 panel4 panel3]]";
    QTest::newRow("deeper") << "panel3" << int(LayoutSide::Left) << "H[panel1 V[panel2 H[panel4 panel3]]]";
}

void tst_Layout::panelGoesToTheSideThatWasAskedFor()
{
    QFETCH(QString, neighbour);
    QFETCH(int, side);
    QFETCH(QString, expected);
    Layout layout = threePanels();
    QCOMPARE(layout.addPanel("Gauge", {}, LayoutTarget::beside(neighbour, LayoutSide(side))), QStringLiteral("panel4"));
    QCOMPARE(described(layout), expected);
    QCOMPARE(layout.invariantError(), QString());
    // Half of what the neighbour had.
    QCOMPARE(layout.currentTab().tree->find("panel4")->share, layout.currentTab().tree->find(neighbour)->share);
}

void tst_Layout::panelAddedToATabGetsAnEqualShareAtTheRight()
{
    Layout layout = threePanels();
    layout.addPanel("Gauge", {}, LayoutTarget::inTab(layout.currentTab().id));
    QCOMPARE(described(layout), QStringLiteral("H[panel1 V[panel2 panel3] panel4]"));
    QCOMPARE(layout.currentTab().tree->shares(), (QVector<int>{3334, 3333, 3333}));
}

void tst_Layout::closingAPanelMergesTheRemainingSplits()
{
    Layout layout = threePanels();
    layout.addPanel("Gauge", {}, LayoutTarget::beside("panel3", LayoutSide::Left));
    QCOMPARE(described(layout), QStringLiteral("H[panel1 V[panel2 H[panel4 panel3]]]"));
    QVERIFY(layout.closePanel("panel2"));
    QCOMPARE(described(layout), QStringLiteral("H[panel1 panel4 panel3]"));
    QCOMPARE(layout.currentTab().tree->shares(), (QVector<int>{5000, 2500, 2500}));
    QVERIFY(layout.closePanel("panel1"));
    QVERIFY(layout.closePanel("panel3"));
    QCOMPARE(described(layout), QStringLiteral("panel4"));
    QVERIFY(layout.closePanel("panel4"));
    QCOMPARE(described(layout), QStringLiteral("-"));
    QVERIFY(!layout.closePanel("panel4"));
}

void tst_Layout::panelMovesToEveryKindOfTarget()
{
    Layout layout = threePanels();
    QVERIFY(layout.movePanel("panel1", LayoutTarget::beside("panel3", LayoutSide::Below)));
    QCOMPARE(described(layout), QStringLiteral("V[panel2 panel3 panel1]"));
    QVERIFY(layout.movePanel("panel1", LayoutTarget::inNewTab("Fly")));
    QCOMPARE(described(layout), QStringLiteral("V[panel2 panel3] | panel1"));
    QCOMPARE(layout.currentTab().name, QStringLiteral("Fly"));
    QVERIFY(layout.movePanel("panel2", LayoutTarget::inTab(layout.currentTab().id)));
    QCOMPARE(described(layout), QStringLiteral("panel3 | H[panel1 panel2]"));
    QVERIFY(layout.movePanel("panel3", LayoutTarget::inNewWindow({10, 20, 300, 200})));
    QCOMPARE(described(layout), QStringLiteral("- | H[panel1 panel2] / panel3"));
    QVERIFY(layout.isFloating("panel3"));
    QVERIFY(layout.movePanel("panel1", LayoutTarget::beside("panel3", LayoutSide::Left)));
    QCOMPARE(described(layout), QStringLiteral("- | panel2 / H[panel1 panel3]"));
    QCOMPARE(layout.invariantError(), QString());
}

void tst_Layout::panelCannotBeBesideItself()
{
    Layout layout = threePanels();
    const Layout before = layout;
    QVERIFY(!layout.movePanel("panel1", LayoutTarget::beside("panel1", LayoutSide::Left)));
    QVERIFY(layout == before);
}

void tst_Layout::dockedPanelReturnsToItsPlace_data()
{
    QTest::addColumn<QString>("panel");
    for (const char *panel : {"panel1", "panel2", "panel3", "panel4", "panel5"})
        QTest::newRow(panel) << panel;
}

void tst_Layout::dockedPanelReturnsToItsPlace()
{
    QFETCH(QString, panel);
    Layout layout = threePanels();
    layout.addPanel("Gauge", {}, LayoutTarget::beside("panel2", LayoutSide::Above));
    layout.addPanel("Gauge", {}, LayoutTarget::beside("panel1", LayoutSide::Left));
    layout.setShares({"panel1", "panel3"}, {2, 3, 5});
    const Layout before = layout;
    QVERIFY(layout.floatPanel(panel, {10, 20, 300, 200}));
    QVERIFY(layout.isFloating(panel));
    QVERIFY(described(layout).endsWith(" / " + panel));
    QVERIFY(layout.dockPanel(panel));
    QCOMPARE(described(layout), described(before));
    QVERIFY(layout.windows().empty());
    const LayoutNode *now = layout.currentTab().tree->find(panel);
    QVERIFY(std::abs(now->share - before.currentTab().tree->find(panel)->share) <= 1);
    QVERIFY(!layout.dockPanel(panel));
}

void tst_Layout::floatingPanelOfAClosedTabDocksIntoTheCurrentTab()
{
    Layout layout = threePanels();
    layout.floatPanel("panel1", {0, 0, 300, 200});
    const QString other = layout.addTab("Other");
    layout.closeTab("tab1");
    QVERIFY(layout.dockPanel("panel1"));
    QCOMPARE(described(layout), QStringLiteral("panel1"));
    QCOMPARE(layout.currentTab().id, other);
}

void tst_Layout::copyHasTheSettingsAndAnIdOfItsOwn()
{
    Layout layout = threePanels();
    QCOMPARE(layout.duplicatePanel("panel2", LayoutSide::Right), QStringLiteral("panel4"));
    QCOMPARE(described(layout), QStringLiteral("H[panel1 V[H[panel2 panel4] panel3]]"));
    QCOMPARE(layout.panel("panel4")->type, QStringLiteral("Gauge"));
    QCOMPARE(layout.panel("panel4")->settings, (QJsonObject{{"limit", 3}}));
    QCOMPARE(layout.duplicatePanel("panel9", LayoutSide::Right), QString());
}

void tst_Layout::sharesAreScaledToTheWhole()
{
    Layout layout = threePanels();
    QVERIFY(layout.setShares({"panel1", "panel3"}, {1, 3}));
    QCOMPARE(layout.currentTab().tree->shares(), (QVector<int>{2500, 7500}));
    QVERIFY(!layout.setShares({"panel1", "panel3"}, {1, 0}));
    QVERIFY(!layout.setShares({"panel1", "panel3"}, {1, 1, 1}));
    QVERIFY(!layout.setShares({"panel1", "panel1"}, {1}));
    QCOMPARE(layout.currentTab().tree->shares(), (QVector<int>{2500, 7500}));
}

void tst_Layout::grownPanelShrinksTheOthersInProportion()
{
    Layout layout = threePanels();
    layout.addPanel("Gauge", {}, LayoutTarget::inTab("tab1"));
    layout.setShares({"panel1", "panel4"}, {4000, 4000, 2000});
    QVERIFY(layout.growPanel("panel1", Qt::Horizontal, 1000));
    QCOMPARE(layout.currentTab().tree->shares(), (QVector<int>{5000, 3333, 1667}));
    QVERIFY(layout.growPanel("panel1", Qt::Horizontal, -100000));
    QCOMPARE(layout.currentTab().tree->shares().first(), 500);
    QVERIFY(!layout.growPanel("panel1", Qt::Horizontal, -1));
    QVERIFY(!layout.growPanel("panel1", Qt::Vertical, 100));
    QVERIFY(layout.growPanel("panel3", Qt::Vertical, 100));
    QCOMPARE(layout.currentTab().tree->find("panel3")->share, 5100);
    QCOMPARE(layout.invariantError(), QString());
}

void tst_Layout::leavingPanelEndsMaximization()
{
    Layout layout = threePanels();
    QVERIFY(layout.setMaximized("panel2", true));
    QCOMPARE(layout.currentTab().maximized, QStringLiteral("panel2"));
    QVERIFY(layout.movePanel("panel2", LayoutTarget::inNewTab()));
    QCOMPARE(layout.tabs().front().maximized, QString());
    layout.setMaximized("panel1", true);
    layout.addPanel("Gauge", {}, LayoutTarget::beside("panel3", LayoutSide::Left));
    QCOMPARE(layout.tabs().front().maximized, QString());
    layout.setMaximized("panel1", true);
    layout.setMaximized("panel1", false);
    QCOMPARE(layout.tabs().front().maximized, QString());
}

void tst_Layout::tabsAreAddedMovedRenamedAndClosed()
{
    Layout layout = threePanels();
    QCOMPARE(layout.addTab("Fly"), QStringLiteral("tab2"));
    QCOMPARE(layout.addTab(), QStringLiteral("tab3"));
    QCOMPARE(layout.currentTab().name, QStringLiteral("Tab 2"));
    QVERIFY(layout.moveTab("tab3", 0));
    QVERIFY(layout.moveTab("tab1", 2));
    QVERIFY(layout.renameTab("tab2", "Real time"));
    QVERIFY(!layout.renameTab("tab2", ""));
    QStringList names;
    for (const LayoutTab &tab : layout.tabs())
        names.append(tab.name);
    QCOMPARE(names, (QStringList{"Tab 2", "Real time", "Tab 1"}));
    QVERIFY(!layout.moveTab("tab1", 3));
    QVERIFY(!layout.moveTab("tab1", -1));
    QVERIFY(layout.closeTab("tab3"));
    QCOMPARE(layout.currentTab().id, QStringLiteral("tab2"));
    QVERIFY(layout.setCurrentTab("tab1"));
    QVERIFY(layout.closeTab("tab1"));
    QCOMPARE(layout.currentTab().id, QStringLiteral("tab2"));
    QVERIFY(!layout.panel("panel1"));
}

void tst_Layout::lastTabThatIsClosedLeavesAnEmptyOne()
{
    Layout layout = threePanels();
    QVERIFY(layout.closeTab("tab1"));
    QCOMPARE(described(layout), QStringLiteral("-"));
    QCOMPARE(layout.invariantError(), QString());
}

void tst_Layout::titleDefaultsToTheType()
{
    Layout layout = threePanels();
    QCOMPARE(layout.panel("panel2")->title(), QStringLiteral("Gauge"));
    QVERIFY(layout.setPanelTitle("panel2", QStringLiteral("Force")));
    QCOMPARE(layout.panel("panel2")->title(), QStringLiteral("Force"));
    QCOMPARE(layout.panel("panel2")->settings, (QJsonObject{{"limit", 3}, {"title", "Force"}}));
    QVERIFY(layout.setPanelTitle("panel2", QString()));
    QCOMPARE(layout.panel("panel2")->settings, (QJsonObject{{"limit", 3}}));
}

void tst_Layout::editsOfMissingItemsChangeNothing()
{
    Layout layout = threePanels();
    const Layout before = layout;
    QVERIFY(!layout.movePanel("panel1", LayoutTarget::beside("panel9", LayoutSide::Left)));
    QVERIFY(!layout.movePanel("panel1", LayoutTarget::inTab("tab9")));
    QVERIFY(!layout.movePanel("panel1", LayoutTarget::inNewWindow({})));
    QVERIFY(!layout.floatPanel("panel9", {0, 0, 10, 10}));
    QVERIFY(!layout.floatPanel("panel1", {}));
    QVERIFY(!layout.setMaximized("panel9", true));
    QVERIFY(!layout.setPanelSettings("panel9", {}));
    QVERIFY(!layout.growPanel("panel9", Qt::Horizontal, 1));
    QVERIFY(!layout.closeTab("tab9"));
    QVERIFY(!layout.closeWindow("window9"));
    QVERIFY(!layout.setWindowGeometry("window9", {0, 0, 10, 10}));
    QVERIFY(!layout.setCurrentTab("tab9"));
    QVERIFY(layout == before);
}

void tst_Layout::sharesOfAnyWeightsAddUp_data()
{
    QTest::addColumn<QVector<double>>("weights");
    QTest::newRow("one") << QVector<double>{3};
    QTest::newRow("thirds") << QVector<double>{1, 1, 1};
    QTest::newRow("tiny and huge") << QVector<double>{1e-9, 1e6, 1e-9};
    QTest::newRow("many") << QVector<double>(1000, 0.1);
    QTest::newRow("one huge of many") << (QVector<double>(999, 1e-6) << 1e6);
}

void tst_Layout::sharesOfAnyWeightsAddUp()
{
    QFETCH(QVector<double>, weights);
    const QVector<int> shares = layoutShares(weights);
    QCOMPARE(std::accumulate(shares.begin(), shares.end(), 0), LayoutNode::WholeShare);
    QVERIFY(*std::min_element(shares.begin(), shares.end()) >= 1);
    // What is whole stays.
    QCOMPARE(layoutShares(QVector<double>(shares.begin(), shares.end())), shares);
}

QTEST_GUILESS_MAIN(tst_Layout)
#include "tst_Layout.moc"
