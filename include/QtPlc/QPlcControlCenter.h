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

/// The window in which people see, operate and understand running plants.
///
/// \code
/// int main(int argc, char **argv)
/// {
///     QPlcGuiApplication application(argc, argv);
///     QPlcControlCenter controlCenter;
///     controlCenter.restoreView();
///     controlCenter.connectToMaster("kite:50000");
///     controlCenter.show();
///     return application.exec();
/// }
/// \endcode
///
/// CMake: `find_package(QtPlc REQUIRED COMPONENTS Gui)`, and `target_link_libraries(window PRIVATE
/// QtPlc::Gui)`.
///
/// Panels (QPlcWidget) stand in tabs, splits and floating windows. People arrange, undo, save and
/// open them. The bar above the panels shows the selected plant, its state, the next possible
/// action, and always STOP. Plants may come and go: the window never waits for one, and connects
/// again and again.
///
/// A program may also wire a node of its own to the window, as the thesis does in listing 4.18: the
/// last functions of the class are for that. Such a plant is one among the others.
///
/// \threadsafe no: use it in the main thread
///
/// \ingroup controlcenter
class QTPLC_GUI_EXPORT QPlcControlCenter : public QMainWindow
{
    Q_OBJECT
public:
    /// Colours of the window.
    enum Theme {
        SystemTheme,   ///< light or dark like the desktop, also when that changes
        LightTheme,    ///< dark texts on a light background
        DarkTheme,     ///< light texts on a dark background
        SunlightTheme  ///< black on white with thick lines, for outdoors
    };
    Q_ENUM(Theme)

    /// Makes a window without plants. All standard panels of QtPlc::Gui are available.
    /// \param parent  owns the window, if given
    explicit QPlcControlCenter(QWidget *parent = nullptr);
    /// Disconnects from all plants, which keep running. Signals that this window holds get their
    /// neutral value.
    ~QPlcControlCenter() override;

    // -- plants --

    /// Connects to a master, and connects again whenever the connection is lost. Any number of
    /// plants is possible. The window reports invalid addresses and masters that do not answer.
    /// \param address  "host:port", "[::1]:port", "qtplc://host:port", or a text for
    ///     QPlcUnderlyingProtocol::fromString()
    /// \param name  for people and for references to signals; empty: the address. A number is added
    ///     if the name exists already
    /// \return the name of the plant
    QString connectToMaster(const QString &address, const QString &name = QString());
    /// Opens a recording. It stands among the plants: panels show its signals, and a bar plays it.
    /// Nothing in it can be commanded.
    ///
    /// \code
    /// QPlcControlCenter controlCenter;
    /// QString error;
    /// if (controlCenter.openRecording({"flight.mcap"}, &error).isEmpty())
    ///     qWarning("%s", qPrintable(error));
    /// \endcode
    ///
    /// \param paths  files, and folders with files `*.mcap`, which are shown as one recording
    /// \param error  gets a sentence if the function fails; may be null
    /// \param name  for people and for references to signals; empty: the name of the first file. A
    ///     number is added if the name exists already
    /// \return the name of the plant; empty if a file cannot be read
    QString openRecording(const QStringList &paths, QString *error = nullptr, const QString &name = QString());
    /// Disconnects from a plant, which keeps running, or closes a recording, and removes it from
    /// the window. Does nothing for an unknown name.
    void disconnectFromMaster(const QString &plant);
    /// Returns the names of the plants, in the order in which they came.
    QStringList plants() const;
    /// Returns true if the master of the plant answers; false for a recording and an unknown name.
    bool isConnected(const QString &plant) const;
    /// Returns true if cycles of the plant arrive, so that the window shows present values; false
    /// for an unknown name.
    bool isLive(const QString &plant) const;

    // -- panels and layouts --

    /// Makes another kind of panel available, for layouts and people.
    /// \param factory  not owned, outlives the window; QPlcWidget::registerFactory() can own it
    void addAvailableWidget(QPlcWidgetFactory *factory);
    /// Makes a class of panels available, for layouts and people. Panels of this kind that a layout
    /// already contains appear.
    /// \param title  what people read; empty: `Panel::typeName()`
    template<typename Panel>
    void addPanel(const QString &title = QString())
    {
        QPlcWidgetFactory *known = QPlcWidget::factory(Panel::typeName());
        addAvailableWidget(known ? known : QPlcWidget::registerFactory(new QPlcWidgetFactoryOf<Panel>(title)));
    }
    /// Adds a layout that comes with the program. The first one is the default of resetLayout(),
    /// and the window shows it if it has shown no layout yet.
    /// \param name  what people read in the menu
    /// \param json  contents of a layout file
    /// \param error  if given: file position and reason of a failure
    /// \return false if \a json is not a layout; nothing has changed then
    bool addLayout(const QString &name, const QByteArray &json, QString *error = nullptr);
    /// Shows a layout of addLayout(); people can undo it.
    /// \return false for an unknown name
    bool showLayout(const QString &name);
    /// Shows the default layout; people can undo it.
    void resetLayout();
    /// Brings a tab of the layout to the front.
    /// \return false if there is no tab of this name
    bool showTab(const QString &name);
    /// Shows the layout of a file; people can undo it.
    /// \param error  if given: file, line, column and reason of a failure
    /// \return false if the file cannot be read or is not a layout; nothing has changed then
    bool openLayout(const QString &fileName, QString *error = nullptr);
    /// Writes the layout to a file. On a failure the former contents of the file stay.
    /// \param error  if given: reason of a failure
    bool saveLayout(const QString &fileName, QString *error = nullptr);
    /// Returns the layout as saveLayout() writes it.
    QByteArray layoutJson() const;
    /// Restores window, layout, theme and plants from the last time (QSettings of the application);
    /// the first time it shows the default layout. After this call the window saves them when it
    /// closes.
    void restoreView();

    // -- start page: shown while there is no plant --

    /// Adds a large button to the start page, which is shown while there is no plant, and a command
    /// to the window. The button shows text, icon and tool tip (a sentence below the text).
    /// \param action  not owned, outlives the window
    void addStartAction(QAction *action);
    /// Adds a command at the end of the menu 'Help'.
    /// \param action  not owned
    void addHelpAction(QAction *action);
    /// Shows the start page, also while a plant is connected.
    void showStartPage();
    /// Returns true while the start page covers the panels.
    bool isStartPageShown() const;
    /// Shows a line above the panels until a person closes it or another one replaces it: "Not real
    /// time: ..."
    /// \param text  empty: closes the line
    void showHint(const QString &text);
    /// Shows the same with a button for what people can do about it.
    /// \param remedy  not owned; may be deleted while the line is shown
    void showHint(const QString &text, QAction *remedy);

    /// Returns the colours that were chosen.
    Theme theme() const;
    /// Sets the colours of the window.
    void setTheme(Theme theme);
    /// Returns what all panels of the window share. Only for panels of QtPLC.
    qplc::WindowContext *context() const;

    // -- for a node that the program wires by hand (thesis, listing 4.18) --

    /// Sets the name of the plant of the wired node, for people and for references to signals. Call
    /// it before connectedToMaster(). Without it the name is the address that a person has entered
    /// at 'Connect...', or "plant". A number is added if the name exists already.
    void setPlantName(const QString &name);
    /// Takes the table of the process (QPlcSignalIndexTable::current()) as the table of the wired
    /// node, and emits inputSignalIndicesChanged(). Call it when the program has read a table after
    /// it made the window.
    void signalIndexTableChanged();
    /// Returns all signals of the table of the process: the inputs of the wired node.
    QPlcSignalIndexList inputSignalIndices() const;
    /// Returns the signals that panels write: the outputs of the wired node.
    QPlcSignalIndexList outputSignalIndices() const;
    /// Returns the values of the outputs at the begin of a phase.
    QPlcSignalList initialOutputSignals() const;

public Q_SLOTS:
    /// Takes values of the wired node.
    /// \param signalValues  values of all cycles since the last call, oldest first
    void realTimeout(const QList<QPlcSignalList> &signalValues);
    /// Tells the window that the wired node is connected: its plant appears.
    void connectedToMaster();
    /// Tells the window that the wired node could not connect, or has lost its master. The window
    /// shows it.
    /// \param error  kind of the failure
    /// \param text  sentence for people; empty: a sentence about \a error
    void errorWithMaster(QPlcAbstractSocket::Error error, const QString &text = QString());
    /// Tells the window that the wired node is not connected any more.
    void disconnectedFromMaster();
    /// Tells the window the values with which a phase begins.
    void initialize(const QPlcSignalList &signalValues);
    /// Tells the window that the real-time phase has begun.
    void started();
    /// Tells the window that the real-time phase has ended.
    void stopped();

Q_SIGNALS:
    /// Emitted when a person enters an address at 'Connect...'. If it is connected to a receiver,
    /// the receiver connects the wired node; otherwise the window connects by itself.
    void connectRequested(const QPlcUnderlyingProtocol &protocol);
    /// Emitted when a person wants to disconnect the wired node.
    void disconnectRequested();
    /// Emitted when inputSignalIndices() has changed.
    void inputSignalIndicesChanged(const QPlcSignalIndexList &indices);
    /// Emitted when outputSignalIndices() has changed.
    void outputSignalIndicesChanged(const QPlcSignalIndexList &indices);
    /// Emitted when initialOutputSignals() has changed.
    void initialOutputSignalsChanged(const QPlcSignalList &values);
    /// Emitted when a panel writes signals of the wired node.
    /// \param values  only those that are new
    void sendNewOutputSignals(const QPlcSignalList &values);
    /// Emitted when a person gives a command to the master of the wired node.
    void sendMessage(const QPlcMessage &message);

protected:
    void closeEvent(QCloseEvent *event) override;
    QMenu *createPopupMenu() override;

private:
    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};
