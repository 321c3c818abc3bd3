// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "QPlcSignalTree.h"
#include "WindowFixtures.h"
#include "gui/layout/PanelFrame.h"
#include "gui/layout/PanelTitleBar.h"
#include "gui/window/StandardWidgets.h"

#include <QtWidgets/QListWidget>
#include <QtWidgets/QMenu>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QTreeView>

#include <numeric>

using namespace qplc;

namespace {

QString textOf(const QAction *action)
{
    return action->text().remove(QLatin1Char('&'));
}

/// Those of a menu instead of the menu.
QList<QAction *> withoutMenus(const QList<QAction *> &actions)
{
    QList<QAction *> all;
    for (QAction *action : actions) {
        if (action->menu())
            all += withoutMenus(action->menu()->actions());
        else if (!action->isSeparator())
            all += action;
    }
    return all;
}

/// A window with a plant, and with one panel in a tab of its own.
struct PanelFixture : WindowFixture
{
    explicit PanelFixture(const QString &type)
        : view(part<LayoutView>())
    {
        window.connectToMaster(master.address());
        LayoutEditor *editor = view->editor();
        editor->addTab();
        const QJsonObject settings{{QStringLiteral("signal"), QStringLiteral("setpoint")}};
        const QString id = editor->addPanel(type, settings, LayoutTarget::inTab(editor->layout().currentTab().id));
        frame = view->frame(id);
        panel = view->widget(id);
        isReady = waitUntil([this] { return plant()->hasLeases() && plant()->table().size() > 0; });
    }
    /// Gives the keyboard to the panel as a person without a mouse does: its title, and what can be
    /// done there. \return whether it came further than to the title
    bool enterPanel()
    {
        enterTitle();
        for (int step = 0; step < 20 && !isInPanel(); ++step)
            press(Qt::Key_Tab);
        if (!isInPanel())
            enterTitle();
        return isInPanel();
    }
    void enterTitle()
    {
        press(Qt::Key_F, Qt::ControlModifier);
        press(Qt::Key_F6);
    }
    /// Beyond lines into which people type.
    bool isInPanel() const
    {
        const QWidget *focus = QApplication::focusWidget();
        const bool isWithin = focus && (focus == panel || panel->isAncestorOf(focus));
        return isWithin && !(qobject_cast<const QLineEdit *>(focus) && panel->findChild<QAbstractItemView *>());
    }
    QStringList paletteTexts(const QList<QAction *> &actions)
    {
        press(Qt::Key_K, Qt::ControlModifier);
        auto *palette = part<CommandPalette>();
        QStringList texts;
        for (const QAction *action : actions) {
            palette->line()->setText(textOf(action));
            for (int row = 0; row < palette->list()->count(); ++row)
                texts << palette->list()->item(row)->text();
        }
        press(Qt::Key_Escape);
        return texts;
    }
    /// How many actions the keys run, none of which does anything any more.
    int runsByKeys(const QKeySequence &keys)
    {
        std::vector<std::unique_ptr<QSignalSpy>> spies;
        for (QAction *action : window.findChildren<QAction *>()) {
            if (!action->shortcuts().contains(keys))
                continue;
            action->disconnect();
            spies.push_back(std::make_unique<QSignalSpy>(action, &QAction::triggered));
        }
        press(Qt::Key(keys[0] & ~int(Qt::KeyboardModifierMask)),
              Qt::KeyboardModifiers(keys[0] & int(Qt::KeyboardModifierMask)));
        return std::accumulate(spies.begin(), spies.end(), 0,
                               [](int sum, const auto &spy) { return sum + spy->count(); });
    }

    RunningMaster master;
    LayoutView *view;
    PanelFrame *frame = nullptr;
    QPlcWidget *panel = nullptr;
    bool isReady = false;
};

/// What is wrong with the keys of an action; empty: they run one action.
QString keyError(PanelFixture &fixture, QAction *action)
{
    action->setVisible(true);
    action->setEnabled(true);
    for (const QKeySequence &keys : action->shortcuts()) {
        const int runs = fixture.runsByKeys(keys);
        if (runs != 1)
            return QStringLiteral("%1 (%2) runs %3 actions with the focus in %4")
                .arg(textOf(action), keys.toString(), QString::number(runs),
                     QLatin1String(QApplication::focusWidget()->metaObject()->className()));
    }
    return {};
}

/// A button that only a mouse reaches: neither Tab nor keys, which its tool tip tells at the end,
/// nor an action of the same text.
bool isForTheMouseOnly(const QAbstractButton *button, const QSet<QString> &actions)
{
    const auto *tool = qobject_cast<const QToolButton *>(button);
    const QAction *action = tool ? tool->defaultAction() : nullptr;
    const bool hasKeys = (action && !action->shortcuts().isEmpty()) || button->toolTip().endsWith(QLatin1Char(')'));
    return !(button->focusPolicy() & Qt::TabFocus) && !hasKeys && !actions.contains(button->accessibleName())
        && !actions.contains(button->toolTip()) && !actions.contains(button->text());
}

}  // namespace

/// Every action of the window and of all panels is reached without a mouse.
class tst_EverythingByKeys : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_settings = std::make_unique<TestSettings>(); }
    void actionsOfAPanelRunByTheirKeysOrAreInThePalette_data();
    void actionsOfAPanelRunByTheirKeysOrAreInThePalette();
    void actionsOfTheWindowRunByTheirKeysWhereverTheFocusIs();
    void actionsOfTheWindowRunByTheirKeysInAFloatingPanel();
    void keysOfPlantCommandsAreUnique();
    void keysOfAPanelTakePrecedenceOverThoseOfTheTabs();
    void noButtonIsForTheMouseOnly_data();
    void noButtonIsForTheMouseOnly();
    void keyboardOpensThePanelMenu();

private:
    static void addTypes();

    std::unique_ptr<TestSettings> m_settings;
};

void tst_EverythingByKeys::addTypes()
{
    QTest::addColumn<QString>("type");
    for (const QPlcWidgetFactory *factory : standardWidgets())
        QTest::newRow(qPrintable(factory->name())) << factory->name();
}

void tst_EverythingByKeys::actionsOfAPanelRunByTheirKeysOrAreInThePalette_data()
{
    addTypes();
}

void tst_EverythingByKeys::actionsOfAPanelRunByTheirKeysOrAreInThePalette()
{
    QFETCH(QString, type);
    PanelFixture fixture(type);
    QVERIFY(fixture.panel && fixture.isReady);
    const QList<QAction *> all = withoutMenus(fixture.panel->actions() + fixture.frame->actions());
    QVERIFY2(fixture.enterPanel() || fixture.panel->actions().isEmpty(), "no key leads into the panel");
    const QStringList palette = fixture.paletteTexts(all);
    for (QAction *action : all) {
        QVERIFY(!action->text().isEmpty());
        QVERIFY2(!action->shortcuts().isEmpty() || palette.contains(textOf(action)), qPrintable(textOf(action)));
        QCOMPARE(keyError(fixture, action), QString());
    }
}

void tst_EverythingByKeys::actionsOfTheWindowRunByTheirKeysWhereverTheFocusIs()
{
    PanelFixture fixture(QStringLiteral("Gauge"));  // lines of text have keys of their own
    QVERIFY(fixture.isReady && fixture.enterPanel());
    QWidget *const places[] = {QApplication::focusWidget(), fixture.frame->titleBar(),
                               fixture.part<SignalDock>()->tree()->findChild<QTreeView *>()};
    for (QWidget *place : places) {
        place->setFocus();
        QCOMPARE(QApplication::focusWidget(), place);
        for (QAction *action : fixture.window.actions() + fixture.view->actions())
            QCOMPARE(keyError(fixture, action), QString());
    }
}

void tst_EverythingByKeys::actionsOfTheWindowRunByTheirKeysInAFloatingPanel()
{
    PanelFixture fixture(QStringLiteral("Gauge"));
    QVERIFY(fixture.isReady);
    fixture.view->editor()->floatPanel(fixture.frame->panelId(), QRect(40, 40, 400, 300));
    QWidget *const floating = fixture.panel->window();
    QVERIFY(floating != &fixture.window);
    floating->activateWindow();
    QTRY_COMPARE(QApplication::activeWindow(), floating);
    for (QWidget *place : {static_cast<QWidget *>(fixture.panel), static_cast<QWidget *>(fixture.frame->titleBar())}) {
        place->setFocus();
        QVERIFY(QApplication::focusWidget() && QApplication::focusWidget()->window() == floating);
        for (QAction *action : fixture.window.actions() + fixture.view->actions())
            QCOMPARE(keyError(fixture, action), QString());
    }
}

void tst_EverythingByKeys::keysOfPlantCommandsAreUnique()
{
    PanelFixture fixture(QStringLiteral("Gauge"));
    for (const QPlcWidgetFactory *factory : standardWidgets())
        fixture.view->editor()->addPanel(factory->name(), {},
                                         LayoutTarget::beside(fixture.frame->panelId(), LayoutSide::Right));
    const auto *actions = fixture.part<ControlCenterActions>();
    const QList<QAction *> commands
        = {actions->initialize, actions->arm, actions->start, actions->resetPlant, actions->stop, actions->giveBack};
    for (const QAction *action : fixture.window.findChildren<QAction *>()) {
        for (const QAction *command : commands) {
            for (const QKeySequence &keys : command->shortcuts())
                QVERIFY2(
                    action == command || !action->shortcuts().contains(keys),
                    qPrintable(
                        QStringLiteral("%1 is for %2 and %3").arg(keys.toString(), textOf(command), textOf(action))));
        }
    }
}

void tst_EverythingByKeys::keysOfAPanelTakePrecedenceOverThoseOfTheTabs()
{
    PanelFixture fixture(QStringLiteral("Setter"));
    QVERIFY(fixture.isReady && fixture.enterPanel());
    const std::size_t tabs = fixture.view->editor()->layout().tabs().size();
    QSignalSpy taken(fixture.panel->actions().first(), &QAction::triggered);
    QCOMPARE(fixture.panel->actions().first()->shortcut(), QKeySequence(QStringLiteral("Ctrl+T")));
    fixture.panel->actions().first()->setVisible(true);
    fixture.press(Qt::Key_T, Qt::ControlModifier);
    QCOMPARE(taken.count(), 1);
    QCOMPARE(fixture.view->editor()->layout().tabs().size(), tabs);
    fixture.frame->titleBar()->setFocus();
    fixture.press(Qt::Key_T, Qt::ControlModifier);
    QCOMPARE(taken.count(), 1);
    QCOMPARE(fixture.view->editor()->layout().tabs().size(), tabs + 1);
}

void tst_EverythingByKeys::noButtonIsForTheMouseOnly_data()
{
    addTypes();
}

void tst_EverythingByKeys::noButtonIsForTheMouseOnly()
{
    QFETCH(QString, type);
    PanelFixture fixture(type);
    QSet<QString> actions;
    for (const QAction *action : fixture.window.findChildren<QAction *>()) {
        if (!action->shortcuts().isEmpty())
            actions << textOf(action);
    }
    QStringList found;
    for (const QAbstractButton *button : fixture.window.findChildren<QAbstractButton *>()) {
        if (!button->isHidden() && isForTheMouseOnly(button, actions))
            found << QStringLiteral("'%1' %2 in %3")
                         .arg(button->text() + button->toolTip(), button->objectName(),
                              QLatin1String(button->parent()->metaObject()->className()));
    }
    QVERIFY2(found.isEmpty(), qPrintable(found.join(QStringLiteral("; "))));
}

void tst_EverythingByKeys::keyboardOpensThePanelMenu()
{
    PanelFixture fixture(QStringLiteral("Gauge"));
    QVERIFY(fixture.enterPanel());
    fixture.press(Qt::Key_F10, Qt::ShiftModifier);
    auto *menu = qobject_cast<QMenu *>(QApplication::activePopupWidget());
    QVERIFY(menu);
    QStringList texts;
    for (const QAction *action : menu->actions())
        texts << textOf(action);
    for (const char *wanted : {"Split right", "Split below", "Duplicate", "Move to tab", "Size", "Show as Bar"})
        QVERIFY2(texts.contains(QString::fromLatin1(wanted)), wanted);
    QTest::keyClick(menu, Qt::Key_Escape);
    QVERIFY(!QApplication::activePopupWidget());
    QVERIFY(fixture.isInPanel());
}

QTEST_MAIN(tst_EverythingByKeys)
#include "tst_EverythingByKeys.moc"
