// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "ViewFixtures.h"

#include <QtWidgets/QToolButton>

using namespace qplc;

namespace {

/// Fly, Ground station, Real time; \a current is in front.
Layout threeTabs(int current)
{
    Layout layout = threePanels();
    layout.renameTab("tab1", "Fly");
    layout.addTab("Ground station");
    layout.addTab("Real time");
    layout.setCurrentTab(layout.tabs().at(std::size_t(current)).id);
    return layout;
}

/// Names that are cut, and scroll buttons; empty: everything is seen.
QString hiddenIn(const LayoutTabBar *bar)
{
    QStringList hidden;
    for (int index = 0; index < bar->count(); ++index) {
        const int buttonAndMargins = 18 + 12;
        const int wanted = bar->fontMetrics().horizontalAdvance(bar->tabText(index)) + buttonAndMargins;
        if (bar->tabRect(index).width() < wanted || !bar->rect().contains(bar->tabRect(index)))
            hidden << bar->tabText(index);
    }
    for (const QToolButton *button : bar->findChildren<QToolButton *>()) {
        if (button->isVisible() && button->arrowType() != Qt::NoArrow)
            hidden << button->objectName();
    }
    return hidden.join(QStringLiteral(", "));
}

}  // namespace

/// The tabs of a layout, as a person sees and uses them.
class tst_LayoutTabBar : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void tabsAreChosenRenamedMovedAndClosed();
    void tabIsDraggedByMouse();
    void tabsHaveTheirWholeNamesWhereThereIsRoom_data();
    void tabsHaveTheirWholeNamesWhereThereIsRoom();
    void widenedWindowShowsAllTabsAgain();
};

void tst_LayoutTabBar::tabsAreChosenRenamedMovedAndClosed()
{
    Layout layout = threePanels();
    layout.addTab("Fly & land");
    layout.setCurrentTab("tab1");
    ViewFixture window(layout);
    LayoutTabBar *bar = window.view.tabBar();
    QCOMPARE(bar->tabText(1), QStringLiteral("Fly && land"));
    QTest::mouseClick(bar, Qt::LeftButton, {}, bar->tabRect(1).center());
    QCOMPARE(window.editor.layout().currentTab().id, QStringLiteral("tab2"));
    QCOMPARE(window.editor.undoStack()->count(), 0);
    QVERIFY(!window.frame("panel1")->isVisible());
    window.before = layoutToJson(window.editor.layout());

    QTest::mouseDClick(bar, Qt::LeftButton, {}, bar->tabRect(0).center());
    auto *edit = bar->findChild<InlineEdit *>();
    QVERIFY(edit);
    QTest::keyClicks(edit, "Real time");
    QTest::keyClick(edit, Qt::Key_Return);
    QCOMPARE(bar->tabText(0), QStringLiteral("Real time"));
    window.undoAndRedo();
    QCOMPARE(bar->tabText(0), QStringLiteral("Tab 1"));

    bar->QTabBar::moveTab(0, 1);
    QCOMPARE(window.shown(), QStringLiteral("- | H[panel1 V[panel2 panel3]]"));
    window.undoAndRedo();
    QCOMPARE(bar->tabText(0), QStringLiteral("Tab 1"));
    QCOMPARE(bar->currentIndex(), 1);

    QTest::mouseClick(bar->tabButton(0, QTabBar::RightSide), Qt::LeftButton);
    QCOMPARE(bar->count(), 1);
    QVERIFY(!window.frame("panel1"));
    window.undoAndRedo();
    QCOMPARE(bar->count(), 2);
    QVERIFY(window.frame("panel1"));
}

void tst_LayoutTabBar::tabsHaveTheirWholeNamesWhereThereIsRoom_data()
{
    QTest::addColumn<int>("current");
    for (int current = 0; current < 3; ++current)
        QTest::addRow("tab %d", current) << current;
}

void tst_LayoutTabBar::tabsHaveTheirWholeNamesWhereThereIsRoom()
{
    QFETCH(int, current);
    LayoutEditor editor;
    LayoutView view(&editor);
    view.resize(1000, 700);
    view.grab();  // laid out, but never shown
    editor.replace(threeTabs(0), QStringLiteral("other layout"));
    editor.setCurrentTab(editor.layout().tabs().at(std::size_t(current)).id);
    view.show();
    QVERIFY(QTest::qWaitForWindowExposed(&view));
    QCOMPARE(hiddenIn(view.tabBar()), QString());
    editor.renameTab(editor.layout().tabs().at(1).id, QStringLiteral("Ground station of the second winch"));
    QTRY_COMPARE(hiddenIn(view.tabBar()), QString());
    editor.addTab(QStringLiteral("One more"));
    QTRY_COMPARE(hiddenIn(view.tabBar()), QString());
}

void tst_LayoutTabBar::widenedWindowShowsAllTabsAgain()
{
    ViewFixture window(threeTabs(2));
    QCOMPARE(hiddenIn(window.view.tabBar()), QString());
    window.view.resize(150, 700);
    QTRY_VERIFY(!hiddenIn(window.view.tabBar()).isEmpty());
    QVERIFY(window.view.tabBar()->width() <= window.view.width());
    window.view.resize(1000, 700);
    QTRY_COMPARE(hiddenIn(window.view.tabBar()), QString());
}

void tst_LayoutTabBar::tabIsDraggedByMouse()
{
    Layout layout = threePanels();
    layout.addTab("Ground station");
    layout.addTab("Real time");
    layout.setCurrentTab("tab1");
    ViewFixture window(layout);
    LayoutTabBar *bar = window.view.tabBar();
    const QPoint start = bar->tabRect(0).center();
    const QPoint end = bar->tabRect(2).center() + QPoint(20, 0);
    QTest::mousePress(bar, Qt::LeftButton, {}, start);
    for (int x = start.x(); x <= end.x(); x += 5)
        moveTo(bar, bar->mapToGlobal({x, start.y()}));
    release(bar, bar->mapToGlobal(end));
    QCOMPARE(window.shown(), QStringLiteral("- | - | H[panel1 V[panel2 panel3]]"));
    QCOMPARE(window.editor.undoStack()->undoText(), QStringLiteral("move of tab 'Tab 1'"));
    QTRY_COMPARE(bar->tabText(2), QStringLiteral("Tab 1"));
    window.undoAndRedo();
    QCOMPARE(bar->tabText(0), QStringLiteral("Tab 1"));
    QCOMPARE(bar->tabText(2), QStringLiteral("Real time"));
}

QTEST_MAIN(tst_LayoutTabBar)
#include "tst_LayoutTabBar.moc"
