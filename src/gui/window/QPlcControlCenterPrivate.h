// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AboutWindow.h"
#include "AlarmSound.h"
#include "CommandPalette.h"
#include "ConnectStrip.h"
#include "ControlCenterActions.h"
#include "EventLine.h"
#include "HelpWindow.h"
#include "HintLine.h"
#include "LatchBanner.h"
#include "LayoutShelf.h"
#include "MasterSearch.h"
#include "NoteStrip.h"
#include "PanelPlants.h"
#include "PanelWiring.h"
#include "Playback.h"
#include "PlaybackBar.h"
#include "QPlcControlCenter.h"
#include "RecentMasters.h"
#include "RecentRecordings.h"
#include "SignalDock.h"
#include "SignalPlacer.h"
#include "StartPage.h"
#include "StopNotice.h"
#include "StopQuestion.h"
#include "TimeBar.h"
#include "TopBar.h"

#include <QtWidgets/QApplication>

class QStackedWidget;

namespace qplc {
class PanelFrame;
}

/// The parts of the window, and what happens between them.
struct QPlcControlCenter::Private
{
    explicit Private(QPlcControlCenter *window);
    ~Private();

    // -- assembly --
    void makeCentre();
    void makeBars();
    void connectParts();
    void connectPlantActions();
    void connectViewActions();
    void connectPlaybackActions();
    void connectLayoutActions();

    // -- plants --
    void followPlants();
    void followSelection();
    void connectTo(const QString &address);
    qplc::Plant *plantAt(const QString &address);
    void openRecording(const QStringList &paths);
    void fillRecentRecordings();
    void askForRecording();
    void disconnectFrom();
    void perform(qplc::Plant::Action action);
    /// \param how  what the person did, for the line that tells of it
    void stop(const QString &how);
    void stopPlants(const QVector<qplc::Plant *> &plants, const QString &how);
    qplc::Plant *wiredPlant();
    qplc::Plant *takeWiredPlant();

    // -- view --
    void resizeToScreen();
    void showPages();
    void showDock(bool isStart);
    void applyTheme();
    void setRate(double timesPerSecond);
    void openPalette();
    void openPanelPalette();
    QVector<qplc::PaletteItem> paletteItems();
    void appendActions(QVector<qplc::PaletteItem> *items, const QString &group, const QList<QAction *> &actions) const;
    void appendPanels(QVector<qplc::PaletteItem> *items);
    void appendSignals(QVector<qplc::PaletteItem> *items);
    const qplc::PanelFrame *focusedFrame() const;
    static QList<QAction *> actionsOf(const qplc::PanelFrame &frame);
    void openKeys();
    void openDocument(const QString &name);
    void showRecent();
    void askForLayoutFile(bool isToSave);
    void saveLayoutTo(const QString &fileName);

    // -- memory --
    void save();
    void restore();

    QPlcControlCenter *q;
    Theme theme = SystemTheme;
    double rate = 0.0;  // rows of values per second; 0: every cycle
    qplc::WindowContext context;
    qplc::AlarmSound alarmSound{context.events(), [] { QApplication::beep(); }};
    qplc::LayoutEditor editor;
    qplc::LayoutShelf shelf{&editor};
    qplc::PanelWiring wiring{&context};
    qplc::PanelPlants panelPlants{&context};
    qplc::PlantSelection selection{context.plants()};
    qplc::Playback playback{&context};
    qplc::RecentMasters recent;
    qplc::MasterSearch *search = nullptr;
    QList<QPlcWidgetFactory *> factories;
    QList<QAction *> startActions;
    QString layoutFile;
    QString wiredName;         // of the plant that the program wires, if the program says one
    QString requestedAddress;  // what a person has entered for it
    bool isStartPageWanted = false;
    bool isToBeSaved = false;
    bool isDockWanted = true;

    qplc::ControlCenterActions *actions = nullptr;
    qplc::TopBar *topBar = nullptr;
    qplc::LatchBanner *latchBanner = nullptr;
    qplc::HintLine *hint = nullptr;
    qplc::StopNotice *stopNotice = nullptr;
    qplc::StopQuestion *stopQuestion = nullptr;
    qplc::ConnectStrip *connectStrip = nullptr;
    qplc::NoteStrip *noteStrip = nullptr;
    QStackedWidget *pages = nullptr;
    qplc::StartPage *startPage = nullptr;
    qplc::LayoutView *view = nullptr;
    qplc::SignalPlacer *placer = nullptr;
    qplc::SignalDock *dock = nullptr;
    qplc::PlaybackBar *playbackBar = nullptr;
    qplc::TimeBar *timeBar = nullptr;
    qplc::EventLine *eventLine = nullptr;
    qplc::CommandPalette *palette = nullptr;
    qplc::KeysWindow *keys = nullptr;
    qplc::HelpWindow *help = nullptr;
    qplc::AboutWindow *about = nullptr;
};
