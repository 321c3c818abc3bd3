// SPDX-License-Identifier: Apache-2.0
#include "ControlCenterActions.h"

#include "QPlcControlCenter.h"

#include <QtWidgets/QAction>
#include <QtWidgets/QActionGroup>
#include <QtWidgets/QMenu>
#include <QtWidgets/QMenuBar>

namespace qplc {

ControlCenterActions::ControlCenterActions(QPlcControlCenter *window)
    : QObject(window)
    , m_window(window)
{
    plantMenu = window->menuBar()->addMenu(tr("&Plant"));
    viewMenu = window->menuBar()->addMenu(tr("&View"));
    layoutMenu = window->menuBar()->addMenu(tr("&Layout"));
    helpMenu = window->menuBar()->addMenu(tr("&Help"));
    makePlantMenu();
    makeViewMenu();
    makeLayoutMenu();
    keys = add(helpMenu, tr("&Keys"), tr("F1"));
    documentation = add(helpMenu, tr("&Documentation"), tr("Shift+F1"));
    about = add(helpMenu, tr("&Version and licences"));
}

QAction *ControlCenterActions::add(QMenu *menu, const QString &text, const QString &shortcut)
{
    QAction *action = menu->addAction(text);
    if (!shortcut.isEmpty())
        action->setShortcut(shortcut);
    m_window->addAction(action);  // its keys work while the menu bar is hidden
    return action;
}

void ControlCenterActions::makePlantMenu()
{
    connectTo = add(plantMenu, tr("&Connect..."), tr("Ctrl+O"));
    connectTo->setToolTip(tr("To the master of a running plant, here or elsewhere"));
    openRecording = add(plantMenu, tr("&Open a recording..."), tr("Ctrl+R"));
    openRecording->setToolTip(tr("To see, play and measure what a plant has done"));
    recentRecordings = plantMenu->addMenu(tr("&Recent recordings"));
    saveVideo = add(plantMenu, tr("Save a &video of the recording..."), {});
    saveVideo->setToolTip(tr("What the panels show, between the cursors, with the speed of the playback"));
    disconnectFrom = add(plantMenu, tr("&Disconnect"), tr("Ctrl+D"));
    nextPlant = add(plantMenu, tr("&Next plant"), tr("Ctrl+P"));
    plantMenu->addSeparator();
    initialize = add(plantMenu, tr("&Initialize"), tr("F4"));
    arm = add(plantMenu, tr("&Arm"), tr("F9"));
    arm->setToolTip(tr("Permits one start within 5 s, where the master wants it"));
    start = add(plantMenu, tr("&Start"), tr("F5"));
    resetPlant = add(plantMenu, tr("&Reset the plant"), tr("F7"));
    resetPlant->setToolTip(tr("Leaves the safe stop when its cause is gone; nothing moves by it"));
    stop = add(plantMenu, tr("S&top (Esc Esc)"), tr("Ctrl+."));
    stop->setShortcutContext(Qt::ApplicationShortcut);
    giveBack = add(plantMenu, tr("&Give back control"), tr("Ctrl+G"));
    giveBack->setEnabled(false);
    plantMenu->addSeparator();
    startPage = add(plantMenu, tr("Start &page"), tr("Ctrl+Home"));
    quit = add(plantMenu, tr("&Close the window"), tr("Ctrl+Q"));
}

void ControlCenterActions::makeViewMenu()
{
    palette = add(viewMenu, tr("&Commands..."), tr("Ctrl+K"));
    search = add(viewMenu, tr("&Search signals"), tr("Ctrl+F"));
    viewMenu->addSeparator();
    goLive = add(viewMenu, tr("&Live"), tr("L"));
    freeze = add(viewMenu, tr("&Freeze"), tr("Ctrl+Shift+L"));
    shorterSpan = add(viewMenu, tr("Shorter time span"), tr("Ctrl+["));
    longerSpan = add(viewMenu, tr("Longer time span"), tr("Ctrl+]"));
    makePlaybackMenu();
    makeRateMenu();
    viewMenu->addSeparator();
    eventLog = add(viewMenu, tr("&Event log"), tr("F8"));
    note = add(viewMenu, tr("Write a &note..."), tr("N"));
    note->setToolTip(tr("One line for the event log of the plant; it is in its recordings, too"));
    acknowledge = add(viewMenu, tr("&Acknowledge all events"), tr("Ctrl+Shift+A"));
    viewMenu->addSeparator();
    QMenu *themeMenu = viewMenu->addMenu(tr("&Theme"));
    auto *group = new QActionGroup(this);
    for (const QString &name :
         {tr("Theme of the desktop"), tr("Light theme"), tr("Dark theme"), tr("Sunlight theme")}) {
        QAction *action = add(themeMenu, name);
        action->setCheckable(true);
        action->setActionGroup(group);
        themes.append(action);
    }
    touch = add(viewMenu, tr("Large tar&gets for touch"));
    touch->setCheckable(true);
    touch->setToolTip(tr("Buttons, menus and rows of 40 px; a finger that stays opens the context menu"));
    alarmSound = add(viewMenu, tr("Alarm s&ound"));
    alarmSound->setCheckable(true);
    alarmSound->setChecked(true);
    alarmSound->setToolTip(tr("Errors are heard when they happen"));
    fullScreen = add(viewMenu, tr("F&ull screen"), tr("F11"));
    fullScreen->setCheckable(true);
}

void ControlCenterActions::makePlaybackMenu()
{
    QMenu *menu = viewMenu->addMenu(tr("&Playback"));
    play = add(menu, tr("Play or pause"), tr("Ctrl+Space"));
    cycleBack = add(menu, tr("A cycle back"), tr("Alt+Left"));
    cycleOn = add(menu, tr("A cycle on"), tr("Alt+Right"));
    slower = add(menu, tr("Slower playback"), tr("Alt+Down"));
    faster = add(menu, tr("Faster playback"), tr("Alt+Up"));
}

void ControlCenterActions::makeRateMenu()
{
    QMenu *menu = viewMenu->addMenu(tr("&Rate of values"));
    menu->setToolTipsVisible(true);
    auto *group = new QActionGroup(this);
    for (const int rate : {0, 100, 50, 20, 10}) {
        QAction *action = add(menu, rate == 0 ? tr("Rate: every cycle") : tr("Rate: %1 per second").arg(rate));
        action->setCheckable(true);
        action->setActionGroup(group);
        if (rate > 0)
            action->setToolTip(
                tr("For slow links: fewer values come, and what happens between two of them is not seen"));
        rates.append({action, double(rate)});
    }
    showRate(0.0);
}

void ControlCenterActions::makeLayoutMenu()
{
    m_endOfLayouts = layoutMenu->addSeparator();
    addPanel = add(layoutMenu, tr("&Add a panel..."), tr("Ctrl+N"));
    newTab = add(layoutMenu, tr("New &tab"));
    newTab->setToolTip(tr("Ctrl+T"));
    layoutMenu->addSeparator();
    open = add(layoutMenu, tr("&Open..."), tr("Ctrl+Shift+O"));
    save = add(layoutMenu, tr("&Save"), tr("Ctrl+S"));
    saveAs = add(layoutMenu, tr("Save &as..."), tr("Ctrl+Shift+S"));
    reset = add(layoutMenu, tr("&Reset"), tr("Ctrl+Shift+R"));
    m_layouts.clear();
}

void ControlCenterActions::showLayouts(const QStringList &names, const std::function<void(const QString &)> &show)
{
    qDeleteAll(m_layouts);
    m_layouts.clear();
    for (const QString &name : names) {
        auto *action = new QAction(tr("Layout '%1'").arg(name), this);
        if (m_layouts.size() < 9)
            action->setShortcut(tr("Ctrl+%1").arg(m_layouts.size() + 1));
        connect(action, &QAction::triggered, this, [show, name] { show(name); });
        layoutMenu->insertAction(m_endOfLayouts, action);
        m_window->addAction(action);
        m_layouts.append(action);
    }
}

void ControlCenterActions::showTheme(int theme)
{
    themes.at(theme)->setChecked(true);
}

void ControlCenterActions::showRate(double timesPerSecond)
{
    for (const Rate &rate : qAsConst(rates))
        rate.action->setChecked(rate.timesPerSecond == timesPerSecond);
}

QVector<KeysWindow::Group> ControlCenterActions::groups() const
{
    QVector<KeysWindow::Group> all;
    for (const QMenu *menu : {plantMenu, viewMenu, layoutMenu, helpMenu}) {
        KeysWindow::Group group{menu->title().remove(QLatin1Char('&')), {}};
        for (QAction *action : menu->actions()) {
            if (action->menu())
                group.actions.append(action->menu()->actions());
            else if (!action->isSeparator())
                group.actions.append(action);
        }
        all.append(group);
    }
    return all;
}

}  // namespace qplc
