// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"
#include "QPlcMasterSocket.h"
#include "QPlcSignalIndexList.h"
#include "QPlcSignalIndexTable.h"
#include "QPlcSignalList.h"
#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

#include <QtWidgets/QMainWindow>

#include <memory>

class QAction;

namespace qplc {
class WindowContext;
}

/// The window in which people see, steer and understand running plants.
///
/// ```cpp
/// QPlcControlCenter controlCenter;
/// controlCenter.restoreView();
/// controlCenter.connectToMaster("kite:50000");
/// controlCenter.show();
/// ```
///
/// CMake: `find_package(QtPlc REQUIRED COMPONENTS Gui)`, and `target_link_libraries(window PRIVATE QtPlc::Gui)`.
///
/// Panels (QPlcWidget) stand in tabs, splits and floating windows, which people arrange, undo, save and open. The bar above them shows the selected plant, its state and the next thing to do,
/// and STOP, always. Plants come and go as they like: the window never waits for one, and connects again for ever.
///
/// A program may also wire a node of its own to the window, as the thesis does in listing 4.18: the last part of the class is for that. Such a plant is one among the others.
///
/// Threads: that of the application.
class QTPLC_GUI_EXPORT QPlcControlCenter : public QMainWindow
{
    Q_OBJECT
public:
    enum Theme {
        SystemTheme,  ///< light or dark, as the desktop is, also when it changes
        LightTheme,
        DarkTheme,
        SunlightTheme  ///< black on white, thick lines, for outdoors
    };
    Q_ENUM(Theme)

    /// All standard panels of QtPlc::Gui are available from the begin.
    explicit QPlcControlCenter(QWidget *parent = nullptr);
    ~QPlcControlCenter() override;

    // -- plants --

    /// Connects, for ever, to a master: "host:port", "[::1]:port", "qtplc://host:port", or anything that QPlcUnderlyingProtocol::fromString() reads. Any number of plants.
    /// \param name  for people and references to signals; the address unless given, with a number where it is taken
    /// \return the name of the plant. An address that is none, or where nobody answers, is told in the window.
    QString connectToMaster(const QString &address, const QString &name = QString());
    /// Lets go of a plant, which goes on. Nothing happens when there is none of this name.
    void disconnectFromMaster(const QString &plant);
    /// Names, in the order of connectToMaster().
    QStringList plants() const;
    bool isConnected(const QString &plant) const;
    /// Whether its cycles arrive: the values that the window shows are of now.
    bool isLive(const QString &plant) const;

    // -- panels and layouts --

    /// Makes panels of another type available, for layouts and people. \param factory  owned by others, outlives the window; QPlcWidget::registerFactory() keeps it
    void addAvailableWidget(QPlcWidgetFactory *factory);
    /// Makes panels of a class available, for layouts and people: `addPanel<Compass>()`. Panels of this kind
    /// that a layout has already appear. \param title  what people read; empty: `Panel::typeName()`
    template<typename Panel>
    void addPanel(const QString &title = QString())
    {
        QPlcWidgetFactory *known = QPlcWidget::factory(Panel::typeName());
        addAvailableWidget(known ? known : QPlcWidget::registerFactory(new QPlcWidgetFactoryOf<Panel>(title)));
    }
    /// A layout that comes with the program (JSON as of a file); the first one is the default of resetLayout(), and is shown when nothing else was yet.
    /// \return false: \a error says where it is wrong
    bool addLayout(const QString &name, const QByteArray &json, QString *error = nullptr);
    /// Shows a layout of addLayout(), as a step that can be undone. \return false when there is none of this name
    bool showLayout(const QString &name);
    /// Shows the default layout, as a step that can be undone.
    void resetLayout();
    /// Brings a tab to the front. \return false when the layout has none of this name
    bool showTab(const QString &name);
    /// Takes the layout of a file, as a step that can be undone. \return false: \a error says file, line, column and what is wrong, and nothing has changed
    bool openLayout(const QString &fileName, QString *error = nullptr);
    /// Writes the layout to a file as a whole, or leaves the file as it was.
    bool saveLayout(const QString &fileName, QString *error = nullptr);
    /// As saveLayout() writes it.
    QByteArray layoutJson() const;
    /// Window, layout, theme and plants as they were when the window was closed last (QSettings of the application); the default layout the first time. Saved when the window is closed,
    /// if this was called.
    void restoreView();

    // -- start page: shown while there is no plant --

    /// A big button of the start page, and a command of the window: text, icon, and toolTip, a sentence below the text. \param action  owned by others
    void addStartAction(QAction *action);
    /// A command at the end of the menu 'Help'. \param action  owned by others
    void addHelpAction(QAction *action);
    void showStartPage();
    bool isStartPageShown() const;
    /// A line over the panels until it is closed, or another one comes: "Not real time: ..." An empty text closes it.
    void showHint(const QString &text);
    /// The same with a button for what can be done about it. \param remedy  owned by others, may go before the line does
    void showHint(const QString &text, QAction *remedy);

    Theme theme() const;
    void setTheme(Theme theme);
    /// What all panels of the window share; for the panels of QtPLC itself.
    qplc::WindowContext *context() const;

    // -- for a node that the program wires by hand (thesis, listing 4.18) --
    //
    // The plant appears with connectedToMaster(). Whoever connects connectRequested() gets what people enter at 'Connect...' in place of the window.

    /// The name of the plant, for people and references to signals; said before connectedToMaster(). Without one it is the address that was entered at 'Connect...', or else "plant"; with a number
    /// where the name is taken.
    void setPlantName(const QString &name);
    /// The table of the process, when it was read after the window had been made. Without it, the window takes what QPlcSignalIndexTable::current() says when the plant appears.
    void setSignalIndexTable(const QPlcSignalIndexTable &table);
    /// All signals of the table: the inputs of the node.
    QPlcSignalIndexList inputSignalIndices() const;
    /// What the panels write: the outputs of the node.
    QPlcSignalIndexList outputSignalIndices() const;
    QPlcSignalList initialOutputSignals() const;

public Q_SLOTS:
    /// The values of all cycles since the last call, oldest first.
    void realTimeout(const QList<QPlcSignalList> &signalValues);
    void connectedToMaster();
    /// The node could not connect, or has lost its master: shows \a text, or what \a error means without one.
    void errorWithMaster(QPlcAbstractSocket::Error error, const QString &text = QString());
    void disconnectedFromMaster();
    /// The values with which a phase begins.
    void initialize(const QPlcSignalList &signalValues);
    void started();
    void stopped();

Q_SIGNALS:
    void connectRequested(const QPlcUnderlyingProtocol &protocol);
    void disconnectRequested();
    void inputSignalIndicesChanged(const QPlcSignalIndexList &indices);
    void outputSignalIndicesChanged(const QPlcSignalIndexList &indices);
    void initialOutputSignalsChanged(const QPlcSignalList &values);
    void sendNewOutputSignals(const QPlcSignalList &values);
    /// A command for the master of the wired node.
    void sendMessage(const QPlcMessage &message);

protected:
    void closeEvent(QCloseEvent *event) override;
    QMenu *createPopupMenu() override;

private:
    struct Private;
    std::unique_ptr<Private> d;
};
