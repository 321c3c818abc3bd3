// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "ViewFixtures.h"
#include "gui/layout/EmptyPage.h"

#include <QtGui/QScreen>
#include <QtWidgets/QPushButton>

using namespace qplc;

class tst_LayoutView : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void layoutIsOnTheScreen();
    void partsHaveTheirSharesInEverySize();
    void closeButtonClosesThePanel();
    void floatButtonFloatsAndDocksThePanel();
    void maximizeButtonShowsOnePanelAlone();
    void aNarrowTitleKeepsTheButtonsThatMatter();
    void menuEntriesPerformTheirActions_data();
    void menuEntriesPerformTheirActions();
    void menuOffersOnlyWhatIsPossible();
    void menuBeginsWithTheActionsOfTheWidget();
    void manyActionsOfAWidgetHaveAMenuOfTheirOwn();
    void aWidgetFindsTheMenuOfItsPanel();
    void movedSplitterHandleIsAStep();
    void widgetsLiveWhileTheirPanelsMove();
    void typeChangeReplacesTheWidget();
    void viewSignalsAddedAndRemovedWidgets();
    void settingsFollowTheLayoutAndUserEditsBecomeUndoSteps();
    void settingsButtonOpensTheSettings();
    void titleIsRenamedInPlace();
    void movingThePanelCancelsAnOpenRename();
    void unknownTypeIsAPlaceholderUntilItsFactoryComes();
    void addButtonsSignalTheWindow();
    void closingAFocusedPanelIsSafe();
    void keysReachEverything();
    void everythingHasAnAccessibleName();
    void closedWindowClosesItsPanels();
    void windowOfALargerScreenIsSeenWhole();
    void movedWindowCreatesNoUndoStep();
    void unusedSplittersAreDeleted();
};

void tst_LayoutView::layoutIsOnTheScreen()
{
    ViewFixture window;
    QCOMPARE(window.onScreen("panel1"), window.shown());
    QCOMPARE(window.frame("panel1")->titleBar()->title(), QStringLiteral("Time plot"));
    QVERIFY(window.panel("panel1")->isVisible());
    QVERIFY(window.frame("panel1")->geometry().right() < window.frame("panel2")->mapTo(&window.view, QPoint()).x());
}

void tst_LayoutView::partsHaveTheirSharesInEverySize()
{
    ViewFixture window;
    window.editor.setShares({"panel1", "panel3"}, {3, 1});
    for (const QSize &size : {QSize(1366, 768), QSize(800, 600), QSize(2000, 1200), QSize(801, 601)}) {
        window.view.resize(1, 1);  // so small that nothing has its share
        QCoreApplication::processEvents();
        window.view.resize(size);
        QCoreApplication::processEvents();
        const double left = window.frame("panel1")->width();
        QVERIFY2(qAbs(left / (left + window.frame("panel2")->width()) - 0.75) < 0.003,
                 qPrintable(QString::number(left)));
        QVERIFY(qAbs(window.frame("panel2")->height() - window.frame("panel3")->height()) <= 1);
    }
    QCOMPARE(window.editor.undoStack()->count(), 1);
}

void tst_LayoutView::closeButtonClosesThePanel()
{
    ViewFixture window;
    window.click(window.frame("panel2")->closeAction());
    QCOMPARE(window.shown(), QStringLiteral("H[panel1 panel3]"));
    QCOMPARE(window.onScreen("panel1"), window.shown());
    QVERIFY(!window.frame("panel2"));
    window.undoAndRedo();
    QCOMPARE(window.onScreen("panel1"), QStringLiteral("H[panel1 V[panel2 panel3]]"));
}

void tst_LayoutView::floatButtonFloatsAndDocksThePanel()
{
    ViewFixture window;
    DummyPanel *widget = window.panel("panel2");
    window.click(window.frame("panel2")->floatAction());
    QCOMPARE(window.shown(), QStringLiteral("H[panel1 panel3] / panel2"));
    QCOMPARE(window.view.floatingWindows().size(), 1);
    QVERIFY(window.frame("panel2")->window() == window.view.floatingWindows().first());
    QVERIFY(widget->isVisible());
    QCOMPARE(window.frame("panel2")->window()->windowTitle(), QStringLiteral("Gauge"));
    QCOMPARE(window.editor.undoStack()->undoText(), QStringLiteral("float of 'Gauge'"));
    QCOMPARE(window.frame("panel2")->floatAction()->text(), QStringLiteral("Dock back"));
    window.undoAndRedo();
    QCOMPARE(window.onScreen("panel1"), QStringLiteral("H[panel1 V[panel2 panel3]]"));
    QVERIFY(window.view.floatingWindows().isEmpty());
    window.click(window.frame("panel2")->floatAction());
    window.click(window.frame("panel2")->floatAction());
    QCOMPARE(window.shown(), QStringLiteral("H[panel1 V[panel2 panel3]]"));
    QCOMPARE(window.panel("panel2"), widget);
}

void tst_LayoutView::maximizeButtonShowsOnePanelAlone()
{
    ViewFixture window;
    const QRect before = window.frame("panel3")->geometry();
    window.click(window.frame("panel3")->maximizeAction());
    QVERIFY(!window.frame("panel1")->isVisible());
    QVERIFY(!window.frame("panel2")->isVisible());
    QCoreApplication::processEvents();
    QVERIFY(window.frame("panel3")->width() > 990);
    QVERIFY(window.frame("panel3")->height() > 600);
    QCOMPARE(window.frame("panel3")->maximizeAction()->text(), QStringLiteral("Restore"));
    window.undoAndRedo();
    QVERIFY(window.frame("panel1")->isVisible());
    QCoreApplication::processEvents();
    QCOMPARE(window.frame("panel3")->geometry(), before);
    QTest::mouseDClick(window.frame("panel3")->titleBar(), Qt::LeftButton, {}, {30, 10});
    QVERIFY(!window.frame("panel1")->isVisible());
}

void tst_LayoutView::aNarrowTitleKeepsTheButtonsThatMatter()
{
    ViewFixture window;
    PanelTitleBar *bar = window.frame("panel1")->titleBar();
    const auto shown = [bar] {
        QStringList texts;
        for (const QToolButton *button : bar->findChildren<QToolButton *>()) {
            if (button->isVisible())
                texts.append(button->defaultAction()->text());
        }
        return texts;
    };
    const QStringList all{QStringLiteral("Settings"), QStringLiteral("Float"), QStringLiteral("Maximize"),
                          QStringLiteral("Close")};
    QCOMPARE(shown(), all);
    bar->resize(199, bar->height());
    QCOMPARE(shown(), (QStringList{all.first(), all.last()}));
    bar->resize(200, bar->height());
    QCOMPARE(shown(), all);
}

void tst_LayoutView::menuEntriesPerformTheirActions_data()
{
    QTest::addColumn<QString>("path");
    QTest::addColumn<QString>("expected");
    QTest::newRow("copy right") << "Split right/Copy of this panel"
                                << "H[panel1 V[H[panel2 panel4] panel3]]";
    QTest::newRow("copy below") << "Split below/Copy of this panel"
                                << "H[panel1 V[panel2 panel4 panel3]]";
    QTest::newRow("gauge right") << "Split right/Gauge"
                                 << "H[panel1 V[H[panel2 panel4] panel3]]";
    QTest::newRow("duplicate") << "Duplicate"
                               << "H[panel1 V[H[panel2 panel4] panel3]]";
    QTest::newRow("move") << "Move to tab/R&D"
                          << "H[panel1 panel3] | panel2";
    QTest::newRow("move to new tab") << "Move to tab/New tab"
                                     << "H[panel1 panel3] | - | panel2";
    QTest::newRow("float") << "Float"
                           << "H[panel1 panel3] | - / panel2";
    QTest::newRow("close") << "Close"
                           << "H[panel1 panel3] | -";
    QTest::newRow("wider") << "Size/Wider"
                           << "H[panel1 V[panel2 panel3]] | -";
    QTest::newRow("lower") << "Size/Lower"
                           << "H[panel1 V[panel2 panel3]] | -";
    QTest::newRow("maximize") << "Maximize"
                              << "H[panel1 V[panel2 panel3]] | -";
}

void tst_LayoutView::menuEntriesPerformTheirActions()
{
    QFETCH(QString, path);
    QFETCH(QString, expected);
    Layout layout = threePanels();
    layout.addTab("R&D");
    layout.setCurrentTab("tab1");
    ViewFixture window(layout);
    const std::unique_ptr<QMenu> menu(window.frame("panel2")->createMenu());
    QAction *action = entry(menu.get(), path);
    QVERIFY(action && action->isEnabled());
    action->trigger();
    QVERIFY2(window.shown().startsWith(expected), qPrintable(window.shown()));
    window.undoAndRedo();
    QCOMPARE(window.onScreen("panel1"), QStringLiteral("H[panel1 V[panel2 panel3]]"));
}

void tst_LayoutView::menuOffersOnlyWhatIsPossible()
{
    Layout layout;
    layout.addPanel("Gauge", {}, LayoutTarget::inTab("tab1"));
    ViewFixture window(layout);
    const std::unique_ptr<QMenu> menu(window.frame("panel1")->createMenu());
    for (const char *path : {"Size/Wider", "Size/Taller", "Move to tab/Tab 1", "Maximize"})
        QVERIFY2(!entry(menu.get(), path)->isEnabled(), path);
    for (const char *path : {"Duplicate", "Close", "Settings", "Rename", "Move to tab/New tab"})
        QVERIFY2(entry(menu.get(), path)->isEnabled(), path);
}

void tst_LayoutView::menuBeginsWithTheActionsOfTheWidget()
{
    ViewFixture window;
    auto *own = new QAction(QStringLiteral("Reset the maximum"), window.panel("panel2"));
    own->setShortcut(Qt::Key_R);
    window.panel("panel2")->addAction(own);
    const std::unique_ptr<QMenu> menu(window.frame("panel2")->createMenu());
    QCOMPARE(menu->actions().at(0), own);
    QVERIFY(own->isShortcutVisibleInContextMenu());
    QVERIFY(menu->actions().at(1)->isSeparator());
    const std::unique_ptr<QMenu> other(window.frame("panel1")->createMenu());  // its widget can nothing
    QCOMPARE(other->actions().at(0)->text(), QStringLiteral("Split right"));
}

void tst_LayoutView::manyActionsOfAWidgetHaveAMenuOfTheirOwn()
{
    ViewFixture window;
    for (int i = 0; i < 9; ++i)
        window.panel("panel2")->addAction(new QAction(QString::number(i), window.panel("panel2")));
    const std::unique_ptr<QMenu> menu(window.frame("panel2")->createMenu());
    QCOMPARE(menu->actions().at(0)->text(), QStringLiteral("Gauge"));
    QCOMPARE(menu->actions().at(0)->menu()->actions(), window.panel("panel2")->actions());
}

void tst_LayoutView::aWidgetFindsTheMenuOfItsPanel()
{
    ViewFixture window;
    const auto *offered = window.panel("panel2")->findChild<QAction *>("panelMenu", Qt::FindDirectChildrenOnly);
    QVERIFY(offered && offered->menu());
    for (int opened = 0; opened < 2; ++opened) {
        Q_EMIT offered->menu()->aboutToShow();
        QCOMPARE(offered->menu()->actions().first()->text(), QStringLiteral("Split right"));
        QCOMPARE(offered->menu()->actions().last(), window.frame("panel2")->closeAction());
    }
    entry(offered->menu(), QStringLiteral("Move to tab/New tab"))->trigger();
    QCOMPARE(window.shown(), QStringLiteral("H[panel1 panel3] | panel2"));
}

void tst_LayoutView::movedSplitterHandleIsAStep()
{
    ViewFixture window;
    auto *splitter = qobject_cast<ShareSplitter *>(window.frame("panel1")->parentWidget());
    QVERIFY(splitter);
    QWidget *handle = splitter->handle(1);
    const QPoint middle = handle->rect().center();
    QTest::mousePress(handle, Qt::LeftButton, {}, middle);
    const QPoint start = handle->mapToGlobal(middle);
    for (int x = 10; x <= 200; x += 10)
        moveTo(handle, start + QPoint(x, 0));
    release(handle, start + QPoint(200, 0));
    const QVector<int> shares = window.editor.layout().currentTab().tree->shares();
    QVERIFY2(shares.first() > 6500 && shares.first() < 7500, qPrintable(QString::number(shares.first())));
    const int width = window.frame("panel1")->width();
    QVERIFY(width > 650);
    window.undoAndRedo();
    QCoreApplication::processEvents();
    QVERIFY(qAbs(window.frame("panel1")->width() - window.frame("panel2")->width()) <= 1);
    window.editor.undoStack()->redo();
    QVERIFY(qAbs(window.frame("panel1")->width() - width) <= 1);
}

void tst_LayoutView::widgetsLiveWhileTheirPanelsMove()
{
    ViewFixture window;
    const DummyPanel *first = window.panel("panel1");
    const DummyPanel *second = window.panel("panel2");
    window.editor.movePanel("panel1", LayoutTarget::beside("panel3", LayoutSide::Below));
    window.editor.movePanel("panel2", LayoutTarget::inNewTab());
    window.editor.floatPanel("panel1", {0, 0, 300, 200});
    window.editor.setLayout(threePanels());
    QCOMPARE(window.panel("panel1"), first);
    QCOMPARE(window.panel("panel2"), second);
    QCOMPARE(window.onScreen("panel1"), QStringLiteral("H[panel1 V[panel2 panel3]]"));
}

void tst_LayoutView::typeChangeReplacesTheWidget()
{
    ViewFixture window;
    const QPointer<DummyPanel> before = window.panel("panel1");
    const DummyPanel *second = window.panel("panel2");
    Layout other;
    other.addPanel("Value table", {}, LayoutTarget::inTab("tab1"));
    other.addPanel("Gauge", {}, LayoutTarget::beside("panel1", LayoutSide::Right));
    window.editor.setLayout(other);
    QCOMPARE(window.panel("panel1")->type(), int(QPlcWidget::UserType) + 2);
    QCOMPARE(window.panel("panel2"), second);
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    QVERIFY(!before);
}

void tst_LayoutView::viewSignalsAddedAndRemovedWidgets()
{
    ViewFixture window;
    QStringList told;
    connect(&window.view, &LayoutView::widgetAdded, this, [&](const QString &id) { told.append("+" + id); });
    connect(&window.view, &LayoutView::widgetRemoved, this, [&](const QString &id) { told.append("-" + id); });
    window.editor.duplicatePanel("panel1", LayoutSide::Below);
    window.editor.closePanel("panel2");
    window.editor.floatPanel("panel1", {0, 0, 300, 200});
    QCOMPARE(told, (QStringList{"+panel4", "-panel2"}));
}

void tst_LayoutView::settingsFollowTheLayoutAndUserEditsBecomeUndoSteps()
{
    ViewFixture window;
    QCOMPARE(window.panel("panel1")->waves(), 2);
    window.panel("panel1")->editWaves(5);
    window.panel("panel1")->editWaves(6);
    QCOMPARE(window.editor.layout().panel("panel1")->settings, (QJsonObject{{"waves", 6}}));
    QCOMPARE(window.editor.undoStack()->undoText(), QStringLiteral("settings of 'Time plot'"));
    window.undoAndRedo();
    QCOMPARE(window.panel("panel1")->waves(), 2);  // a missing key is that of a new widget
    window.editor.setPanelSettings("panel2", {{"limit", 3}, {"waves", 9}});
    QCOMPARE(window.panel("panel2")->waves(), 9);
    QCOMPARE(window.panel("panel2")->settings().value("limit").toInt(), 3);
}

void tst_LayoutView::settingsButtonOpensTheSettings()
{
    ViewFixture window;
    window.click(window.frame("panel1")->settingsAction());
    QWidget *popup = QApplication::activePopupWidget();
    QVERIFY(popup);
    popup->findChild<QSpinBox *>()->setValue(7);
    QCOMPARE(window.panel("panel1")->waves(), 7);
    QCOMPARE(window.editor.undoStack()->count(), 1);
    popup->close();
    window.undoAndRedo();
    QCOMPARE(window.panel("panel1")->waves(), 2);
}

void tst_LayoutView::titleIsRenamedInPlace()
{
    ViewFixture window;
    window.frame("panel1")->renameAction()->trigger();
    auto *edit = window.frame("panel1")->findChild<InlineEdit *>();
    QVERIFY(edit);
    QTest::keyClicks(edit, "Power");
    QTest::keyClick(edit, Qt::Key_Return);
    QCOMPARE(window.frame("panel1")->titleBar()->title(), QStringLiteral("Power"));
    window.undoAndRedo();
    QCOMPARE(window.frame("panel1")->titleBar()->title(), QStringLiteral("Time plot"));
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    window.frame("panel1")->renameAction()->trigger();
    edit = window.frame("panel1")->findChild<InlineEdit *>();
    QTest::keyClicks(edit, "Forgotten");
    QTest::keyClick(edit, Qt::Key_Escape);
    QCOMPARE(window.frame("panel1")->titleBar()->title(), QStringLiteral("Time plot"));
}

void tst_LayoutView::movingThePanelCancelsAnOpenRename()
{
    ViewFixture window;
    window.frame("panel1")->renameAction()->trigger();
    QTest::keyClicks(window.frame("panel1")->findChild<InlineEdit *>(), "Forgotten");
    window.editor.movePanel("panel1", LayoutTarget::beside("panel3", LayoutSide::Below));
    QCOMPARE(window.frame("panel1")->titleBar()->title(), QStringLiteral("Time plot"));
    window.undoAndRedo();
}

void tst_LayoutView::unknownTypeIsAPlaceholderUntilItsFactoryComes()
{
    Layout layout = threePanels();
    layout.addPanel("Wind rose", {{"waves", 8}}, LayoutTarget::beside("panel1", LayoutSide::Below));
    ViewFixture window(layout);
    QVERIFY(!window.view.widget("panel4"));
    QVERIFY(!window.frame("panel4")->settingsAction()->isEnabled());
    const auto *placeholder = window.frame("panel4")->findChild<PanelPlaceholder *>();
    QVERIFY(placeholder->isVisible());
    QVERIFY(placeholder->text().contains("Wind rose"));
    QCOMPARE(layoutToJson(window.editor.layout()), window.before);
    const DummyPanel *first = window.panel("panel1");
    DummyFactory rose(QPlcWidget::UserType + 9, "Wind rose");
    window.view.setFactories(window.factories.all() << &rose);
    QVERIFY(window.panel("panel4"));
    QCOMPARE(window.panel("panel4")->waves(), 8);
    QCOMPARE(window.panel("panel1"), first);
    QCOMPARE(layoutToJson(window.editor.layout()), window.before);
}

void tst_LayoutView::addButtonsSignalTheWindow()
{
    ViewFixture window{Layout()};
    QSignalSpy asked(&window.view, &LayoutView::addRequested);
    auto *page = window.view.findChild<EmptyPage *>();
    QVERIFY(page && page->isVisible());
    QTest::mouseClick(page->addButton(), Qt::LeftButton);
    QCOMPARE(asked.size(), 1);
    QTest::mouseClick(window.view.findChild<QToolButton *>(QStringLiteral("addPanel")), Qt::LeftButton);
    QCOMPARE(asked.size(), 2);
    window.view.addPanel(QStringLiteral("Gauge"));
    QCOMPARE(window.shown(), QStringLiteral("panel1"));
    QVERIFY(!page->isVisible());
    window.undoAndRedo();
    QVERIFY(page->isVisible());
}

void tst_LayoutView::closingAFocusedPanelIsSafe()
{
    ViewFixture window;
    window.panel("panel2")->setFocus();
    QVERIFY(window.panel("panel2")->hasFocus());
    window.editor.closePanel("panel2");
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    QVERIFY(!window.view.findChild<QWidget *>("panel2"));
    window.panel("panel1")->setFocus();  // and the whole window goes
}

void tst_LayoutView::keysReachEverything()
{
    ViewFixture window;
    QTest::keyClick(&window.view, Qt::Key_F6);
    QCOMPARE(QApplication::focusWidget(), static_cast<QWidget *>(window.frame("panel1")->titleBar()));
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_F6);
    QCOMPARE(QApplication::focusWidget(), static_cast<QWidget *>(window.frame("panel2")->titleBar()));
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_F6, Qt::ShiftModifier);
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_F6, Qt::ShiftModifier);
    QCOMPARE(QApplication::focusWidget(), static_cast<QWidget *>(window.frame("panel3")->titleBar()));
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_W, Qt::ControlModifier);
    QCOMPARE(window.shown(), QStringLiteral("H[panel1 panel2]"));
    window.undoAndRedo();
    QTest::keyClick(&window.view, Qt::Key_T, Qt::ControlModifier);
    QCOMPARE(window.shown(), QStringLiteral("H[panel1 V[panel2 panel3]] | -"));
    QTest::keyClick(&window.view, Qt::Key_PageUp, Qt::ControlModifier);
    QCOMPARE(window.editor.layout().currentTab().id, QStringLiteral("tab1"));
    window.frame("panel2")->titleBar()->setFocus();
    QContextMenuEvent menuKey(QContextMenuEvent::Keyboard, {10, 10},
                              window.frame("panel2")->titleBar()->mapToGlobal({10, 10}));
    QApplication::sendEvent(window.frame("panel2")->titleBar(), &menuKey);
    QVERIFY(qobject_cast<QMenu *>(QApplication::activePopupWidget()));
    QApplication::activePopupWidget()->close();
}

void tst_LayoutView::everythingHasAnAccessibleName()
{
    Layout layout = threePanels();
    layout.addTab();
    ViewFixture window(layout);
    for (const QWidget *each : window.view.findChildren<QWidget *>()) {
        const bool isOurs = !each->objectName().startsWith("Scroll");
        if (isOurs && (each->focusPolicy() & Qt::TabFocus) && !each->inherits("DummyPanel"))
            QVERIFY2(!each->accessibleName().isEmpty(), each->metaObject()->className());
    }
}

void tst_LayoutView::closedWindowClosesItsPanels()
{
    Layout layout = threePanels();
    layout.floatPanel("panel2", {30, 40, 400, 300});
    ViewFixture window(layout);
    QCOMPARE(window.view.floatingWindows().first()->geometry(), QRect(30, 40, 400, 300));
    window.view.floatingWindows().first()->close();
    QCOMPARE(window.shown(), QStringLiteral("H[panel1 panel3]"));
    window.undoAndRedo();
    QCOMPARE(window.view.floatingWindows().size(), 1);
    QVERIFY(window.panel("panel2")->isVisible());
}

void tst_LayoutView::windowOfALargerScreenIsSeenWhole()
{
    Layout layout = threePanels();
    layout.floatPanel("panel2", {3000, 2000, 400, 300});
    ViewFixture window(layout);
    const QRect room = window.view.screen()->availableGeometry();
    const QRect seen = window.view.floatingWindows().first()->geometry();
    QVERIFY(room.contains(seen));
    QCOMPARE(seen.size(), QSize(400, 300));
    QCOMPARE(window.editor.layout().windows().front().geometry, QRect(3000, 2000, 400, 300));  // for that screen
}

void tst_LayoutView::movedWindowCreatesNoUndoStep()
{
    Layout layout = threePanels();
    layout.floatPanel("panel2", {30, 40, 400, 300});
    ViewFixture window(layout);
    window.view.floatingWindows().first()->setGeometry(60, 70, 500, 320);
    QTRY_COMPARE(window.editor.layout().windows().front().geometry, QRect(60, 70, 500, 320));
    QCOMPARE(window.editor.undoStack()->count(), 0);
}

void tst_LayoutView::unusedSplittersAreDeleted()
{
    ViewFixture window;
    const int before = window.view.findChildren<QWidget *>().size();
    for (int i = 0; i < 50; ++i) {
        window.editor.duplicatePanel("panel1", LayoutSide::Below);
        window.editor.undoStack()->undo();
    }
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    QCOMPARE(window.view.findChildren<QWidget *>().size(), before);
}

QTEST_MAIN(tst_LayoutView)
#include "tst_LayoutView.moc"
