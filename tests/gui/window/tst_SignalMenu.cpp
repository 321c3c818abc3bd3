// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "LayoutFixtures.h"
#include "QPlcSignalTree.h"
#include "WindowFixtures.h"
#include "gui/layout/PanelFrame.h"
#include "gui/layout/PanelTitleBar.h"

#include <QtCore/QJsonArray>
#include <QtGui/QContextMenuEvent>
#include <QtWidgets/QMenu>
#include <QtWidgets/QTreeView>

using namespace qplc;

namespace {

/// A window with a plant, whose layout is H[panel1 V[panel2 panel3]], and the tree of its signals.
struct MenuFixture : WindowFixture
{
    MenuFixture()
        : view(part<LayoutView>())
        , editor(view->editor())
        , tree(part<SignalDock>()->tree())
        , rows(tree->findChild<QTreeView *>())
    {
        master.setTimeSignal(QStringLiteral("time"));
        window.connectToMaster(master.address());
        editor->setLayout(threePanels());
        // Rows that move below their writers take no selection along.
        isReady = waitUntil([this] { return find("time").parent().data() == QLatin1String("Master"); })
            && waitUntil([this] { return find("count").parent().data() == QLatin1String("Counter"); })
            && find("setpoint").isValid();
        rows->setFocus();
    }
    QModelIndex find(const char *name) const
    {
        return rows->model()
            ->match(rows->model()->index(0, 0), Qt::DisplayRole, QString::fromLatin1(name), 1,
                    Qt::MatchRecursive | Qt::MatchExactly)
            .value(0);
    }
    static QMenu *menu() { return qobject_cast<QMenu *>(QApplication::activePopupWidget()); }
    /// Presses the right button on a signal.
    QMenu *openByMouse(const char *signal)
    {
        rows->scrollTo(find(signal));
        const QPoint place = rows->visualRect(find(signal)).center();
        QTest::mouseClick(rows->viewport(), Qt::RightButton, {}, place);
        QContextMenuEvent event(QContextMenuEvent::Mouse, place, rows->viewport()->mapToGlobal(place));
        QApplication::sendEvent(rows->viewport(), &event);
        return menu();
    }
    QMenu *openByKeys(const char *signal)
    {
        rows->setCurrentIndex(find(signal));
        press(Qt::Key_F10, Qt::ShiftModifier);
        return menu();
    }
    void closeMenu()
    {
        QTest::keyClick(menu(), Qt::Key_Escape);
        window.activateWindow();  // a platform without a screen leaves that to us
        QVERIFY(QTest::qWaitForWindowActive(&window));
        rows->setFocus();
    }
    static QAction *entry(QMenu *menu, const QString &text)
    {
        for (QAction *action : menu->actions()) {
            if (action->text() == text)
                return action;
        }
        return nullptr;
    }
    /// What is there now and was not before.
    QStringList newPanels() const
    {
        QStringList types;
        for (const LayoutPanel *panel : editor->layout().panels()) {
            if (panel->id != "panel1" && panel->id != "panel2" && panel->id != "panel3")
                types << panel->type;
        }
        return types;
    }

    RunningMaster master;
    LayoutView *view;
    LayoutEditor *editor;
    QPlcSignalTree *tree;
    QTreeView *rows;
    bool isReady = false;
};

}  // namespace

/// The context menu of the tree of signals does all that dragging does.
class tst_SignalMenu : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_settings = std::make_unique<TestSettings>(); }
    void menuListsAllPossibleActions();
    void menuEntriesPlaceTheSignal_data();
    void menuEntriesPlaceTheSignal();
    void menuWorksByKeyboard();
    void menuKeysWorkWithoutOpeningTheMenu_data() { menuEntriesPlaceTheSignal_data(); }
    void menuKeysWorkWithoutOpeningTheMenu();
    void theCurrentPanelIsTheOneThatHadTheKeyboardLast();
    void currentPanelAcceptsTheSignal();
    void signalsOfTheMasterHaveNoSetter();
    void menuDisablesSignalEntriesWithoutASignal();
    void aTreeInAPanelHasTheMenuToo();

private:
    std::unique_ptr<TestSettings> m_settings;
};

void tst_SignalMenu::menuListsAllPossibleActions()
{
    MenuFixture fixture;
    QVERIFY(fixture.isReady);
    QMenu *menu = fixture.openByMouse("setpoint");
    QVERIFY(menu);
    QStringList texts;
    for (const QAction *action : menu->actions()) {
        if (!action->isSeparator())
            texts << action->text();
        QVERIFY2(action->isEnabled(), qPrintable(action->text()));
    }
    const QStringList expected = {
        "Show in a plot",         "Show in an XY plot",   "Show the spectrum", "Show as a gauge",
        "Watch in a value table", "Set by a setter",      "Into 'Time plot'",  "Right axis of 'Time plot'",
        "Left of 'Time plot'",    "Right of 'Time plot'", "Above 'Time plot'", "Below 'Time plot'",
        "Into a new tab",         "Search signals",       "Columns",
    };
    QCOMPARE(texts, expected);
    QTest::keyClick(menu, Qt::Key_Escape);
    QVERIFY(!fixture.menu());
    QVERIFY(fixture.rows->hasFocus());
}

void tst_SignalMenu::menuEntriesPlaceTheSignal_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("layout");
    QTest::addColumn<QStringList>("types");
    QTest::addColumn<QKeySequence>("keys");
    const auto row = [](const char *text, const char *layout, const char *type, const char *keys) {
        QTest::newRow(keys) << QString::fromLatin1(text) << QString::fromLatin1(layout)
                            << (*type ? QStringList{QString::fromLatin1(type)} : QStringList())
                            << QKeySequence(QString::fromLatin1(keys));
    };
    row("Show in an XY plot", "H[V[panel1 panel4] V[panel2 panel3]]", "XY plot", "X");
    row("Set by a setter", "H[V[panel1 panel4] V[panel2 panel3]]", "Setter", "S");
    row("Into 'Time plot'", "H[panel1 V[panel2 panel3]]", "", "Alt+Return");
    row("Right axis of 'Time plot'", "H[panel1 V[panel2 panel3]]", "", "Alt+Shift+Return");
    row("Left of 'Time plot'", "H[panel4 panel1 V[panel2 panel3]]", "Time plot", "Alt+Left");
    row("Right of 'Time plot'", "H[panel1 panel4 V[panel2 panel3]]", "Time plot", "Alt+Right");
    row("Above 'Time plot'", "H[V[panel4 panel1] V[panel2 panel3]]", "Time plot", "Alt+Up");
    row("Below 'Time plot'", "H[V[panel1 panel4] V[panel2 panel3]]", "Time plot", "Alt+Down");
    row("Into a new tab", "H[panel1 V[panel2 panel3]] | panel4", "Time plot", "T");
}

void tst_SignalMenu::menuEntriesPlaceTheSignal()
{
    QFETCH(QString, text);
    QFETCH(QString, layout);
    QFETCH(QStringList, types);
    MenuFixture fixture;
    QVERIFY(fixture.isReady);
    QMenu *menu = fixture.openByMouse("setpoint");
    QVERIFY(menu && fixture.entry(menu, text));
    QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(fixture.entry(menu, text)).center());
    QCOMPARE(described(fixture.editor->layout()), layout);
    QCOMPARE(fixture.newPanels(), types);
    QVERIFY(fixture.window.layoutJson().contains("\"setpoint\""));
    QCOMPARE(fixture.editor->undoStack()->count(), 1);
    fixture.editor->undoStack()->undo();
    QVERIFY(fixture.editor->layout() == threePanels());
}

void tst_SignalMenu::menuWorksByKeyboard()
{
    MenuFixture fixture;
    QVERIFY(fixture.isReady);
    QMenu *menu = fixture.openByKeys("setpoint");
    QVERIFY(menu);
    for (int step = 0; step < 20 && (!menu->activeAction() || menu->activeAction()->text() != "Below 'Time plot'");
         ++step)
        QTest::keyClick(menu, Qt::Key_Down);
    QTest::keyClick(menu, Qt::Key_Return);
    QCOMPARE(described(fixture.editor->layout()), QStringLiteral("H[V[panel1 panel4] V[panel2 panel3]]"));
    // The key for menus, as platforms tell of it.
    QContextMenuEvent event(QContextMenuEvent::Keyboard, {5, 5}, fixture.rows->viewport()->mapToGlobal({5, 5}));
    QApplication::sendEvent(fixture.rows, &event);
    QVERIFY(fixture.menu());
    fixture.closeMenu();
}

void tst_SignalMenu::menuKeysWorkWithoutOpeningTheMenu()
{
    QFETCH(QString, layout);
    QFETCH(QStringList, types);
    QFETCH(QKeySequence, keys);
    MenuFixture fixture;
    QVERIFY(fixture.isReady);
    fixture.rows->setCurrentIndex(fixture.find("setpoint"));
    fixture.press(Qt::Key(keys[0] & ~int(Qt::KeyboardModifierMask)),
                  Qt::KeyboardModifiers(keys[0] & int(Qt::KeyboardModifierMask)));
    QCOMPARE(described(fixture.editor->layout()), layout);
    QCOMPARE(fixture.newPanels(), types);
}

void tst_SignalMenu::theCurrentPanelIsTheOneThatHadTheKeyboardLast()
{
    MenuFixture fixture;
    QVERIFY(fixture.isReady);
    fixture.view->frame("panel3")->titleBar()->setFocus();
    fixture.editor->setPanelTitle("panel3", "Power");
    fixture.rows->setFocus();
    QMenu *menu = fixture.openByKeys("setpoint");
    QVERIFY(menu && fixture.entry(menu, "Above 'Power'"));
    fixture.closeMenu();
    fixture.press(Qt::Key_Up, Qt::AltModifier);
    QCOMPARE(described(fixture.editor->layout()), QStringLiteral("H[panel1 V[panel2 panel4 panel3]]"));
    // A panel that is gone, or on another tab, is not the current one any more.
    fixture.editor->closePanel("panel3");
    QVERIFY(fixture.entry(fixture.openByKeys("setpoint"), "Above 'Time plot'"));
    fixture.closeMenu();
    fixture.editor->addTab();
    fixture.rows->setFocus();
    menu = fixture.openByKeys("setpoint");
    QVERIFY(fixture.entry(menu, "Into a new tab")->isEnabled());
    QVERIFY(!fixture.entry(menu, "Left of the panel")->isEnabled());
    QVERIFY(fixture.entry(menu, "Into this tab")->isEnabled());
    fixture.closeMenu();
    fixture.press(Qt::Key_Return, Qt::AltModifier);
    QCOMPARE(described(fixture.editor->layout()), QStringLiteral("H[panel1 V[panel2 panel4]] | panel5"));
}

void tst_SignalMenu::currentPanelAcceptsTheSignal()
{
    MenuFixture fixture;
    QVERIFY(fixture.isReady);
    fixture.view->frame("panel2")->titleBar()->setFocus();
    fixture.rows->setFocus();
    QMenu *menu = fixture.openByMouse("setpoint");
    QVERIFY(menu && fixture.entry(menu, "Into 'Gauge'"));
    fixture.entry(menu, "Into 'Gauge'")->trigger();
    menu->close();
    QCOMPARE(fixture.editor->layout().panel("panel2")->settings.value("signal").toString(), QStringLiteral("setpoint"));
    QCOMPARE(fixture.newPanels(), QStringList());
}

void tst_SignalMenu::signalsOfTheMasterHaveNoSetter()
{
    MenuFixture fixture;
    QVERIFY(fixture.isReady);
    fixture.rows->setCurrentIndex(fixture.find("time"));
    fixture.press(Qt::Key_S);
    QCOMPARE(fixture.newPanels(), QStringList());
    QMenu *menu = fixture.openByMouse("time");
    QVERIFY(menu && fixture.entry(menu, "Set by a setter"));
    QVERIFY(!fixture.entry(menu, "Set by a setter")->isEnabled());
    QVERIFY(fixture.entry(menu, "Show as a gauge")->isEnabled());
}

void tst_SignalMenu::menuDisablesSignalEntriesWithoutASignal()
{
    MenuFixture fixture;
    QVERIFY(fixture.isReady);
    fixture.rows->clearSelection();
    QTest::keyClicks(fixture.tree->findChild<QLineEdit *>(), QStringLiteral("nosuchsignal"));
    fixture.rows->setFocus();
    fixture.press(Qt::Key_F10, Qt::ShiftModifier);
    QVERIFY(fixture.menu());
    for (const char *text : {"Show in a plot", "Set by a setter", "Into 'Time plot'", "Into a new tab"})
        QVERIFY2(!fixture.entry(fixture.menu(), text)->isEnabled(), text);
    QVERIFY(fixture.entry(fixture.menu(), "Search signals")->isEnabled());
    fixture.closeMenu();
}

void tst_SignalMenu::aTreeInAPanelHasTheMenuToo()
{
    MenuFixture fixture;
    QVERIFY(fixture.isReady);
    const QString id = fixture.editor->addPanel(QPlcSignalTree::typeName(), {},
                                                LayoutTarget::inTab(fixture.editor->layout().currentTab().id));
    fixture.tree = qobject_cast<QPlcSignalTree *>(fixture.view->widget(id));
    fixture.rows = fixture.tree->findChild<QTreeView *>();
    QTRY_VERIFY(fixture.find("setpoint").isValid());
    fixture.view->frame("panel3")->titleBar()->setFocus();
    fixture.rows->setFocus();
    QMenu *menu = fixture.openByKeys("setpoint");
    QVERIFY(menu);
    QVERIFY(fixture.entry(menu, "Panel"));
    QVERIFY(fixture.entry(menu, "Into 'Value table'"));
    fixture.closeMenu();
}

QTEST_MAIN(tst_SignalMenu)
#include "tst_SignalMenu.moc"
