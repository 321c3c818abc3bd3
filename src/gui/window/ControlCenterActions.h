// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "KeysWindow.h"

#include <functional>

class QActionGroup;
class QMainWindow;
class QMenu;
class QPlcControlCenter;

namespace qplc {

class LayoutShelf;

/// All commands of the window: its menus are made of them, the palette of commands finds them, and
/// the list of keys shows them.
class ControlCenterActions : public QObject
{
    Q_OBJECT
public:
    explicit ControlCenterActions(QPlcControlCenter *window);

    struct Rate
    {
        QAction *action;
        double timesPerSecond;  // 0: every cycle
    };

    QMenu *plantMenu = nullptr;
    QMenu *viewMenu = nullptr;
    QMenu *layoutMenu = nullptr;
    QMenu *helpMenu = nullptr;

    // Plant
    QAction *connectTo = nullptr;
    QAction *openRecording = nullptr;
    QMenu *recentRecordings = nullptr;  // filled when it opens
    QAction *saveVideo = nullptr;
    QAction *disconnectFrom = nullptr;
    QAction *nextPlant = nullptr;
    QAction *initialize = nullptr;
    QAction *arm = nullptr;
    QAction *start = nullptr;
    QAction *resetPlant = nullptr;
    QAction *stop = nullptr;
    QAction *giveBack = nullptr;
    QAction *startPage = nullptr;
    QAction *quit = nullptr;
    // View
    QAction *palette = nullptr;
    QAction *search = nullptr;
    QAction *goLive = nullptr;
    QAction *freeze = nullptr;
    QAction *shorterSpan = nullptr;
    QAction *longerSpan = nullptr;
    QAction *play = nullptr;
    QAction *cycleBack = nullptr;
    QAction *cycleOn = nullptr;
    QAction *slower = nullptr;
    QAction *faster = nullptr;
    QVector<Rate> rates;
    QAction *eventLog = nullptr;
    QAction *note = nullptr;
    QAction *acknowledge = nullptr;
    QAction *fullScreen = nullptr;
    QAction *touch = nullptr;
    QAction *alarmSound = nullptr;
    QList<QAction *> themes;  // in the order of QPlcControlCenter::Theme
    // Layout
    QAction *open = nullptr;
    QAction *save = nullptr;
    QAction *saveAs = nullptr;
    QAction *reset = nullptr;
    QAction *newTab = nullptr;
    QAction *addPanel = nullptr;
    QAction *undo = nullptr;
    QAction *redo = nullptr;
    // Help
    QAction *keys = nullptr;
    QAction *documentation = nullptr;
    QAction *about = nullptr;

    /// The layouts of the program stand at the begin of their menu.
    void showLayouts(const QStringList &names, const std::function<void(const QString &)> &show);
    void showTheme(int theme);
    void showRate(double timesPerSecond);
    /// By menu.
    QVector<KeysWindow::Group> groups() const;

private:
    QAction *add(QMenu *menu, const QString &text, const QString &keys = {});
    void makePlantMenu();
    void makeViewMenu();
    void makePlaybackMenu();
    void makeRateMenu();
    void makeLayoutMenu();

    QMainWindow *m_window;
    QList<QAction *> m_layouts;
    QAction *m_endOfLayouts = nullptr;
};

}  // namespace qplc
