// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcDurationStatistics.h"
#include "QPlcGuiGlobal.h"
#include "QPlcPast.h"
#include "QPlcQuality.h"
#include "QPlcSignalDefinition.h"
#include "QPlcTheme.h"

#include <QtCore/QObject>
#include <QtCore/QVector>

#include <functional>
#include <memory>
#include <optional>

class QAbstractItemModel;
class QPlcMessage;
class QPlcSignalControl;
class QPlcTimeAxis;
class QPlcWidget;

namespace qplc {
class WindowContext;
}  // namespace qplc

/// The window as one panel sees it: signals and their history, the time that is shown, theme, and
/// texts of numbers.
///
/// \code
/// class Compass : public QPlcWidget
/// {
/// protected:
///     void contextChanged() override
///     {
///         connect(context(), &QPlcPanelContext::changed, this, QOverload<>::of(&QWidget::update));
///     }
///     void paintEvent(QPaintEvent *) override
///     {
///         const QPlcPanelContext::Signal heading = context()->shown("heading");
///         QPainter painter(this);
///         painter.setPen(heading.isCurrent ? context()->theme().text : context()->theme().stale);
///         painter.drawText(rect(), heading ? QPlcPanelContext::text(heading) : heading.problem);
///     }
/// };
/// \endcode
///
/// QPlcWidget::context() returns it. A reference names a signal or one of its elements: `power`,
/// `position[2]`. A plant may come first: `east/power`. Without it the reference belongs to the
/// plant to which the panel is pinned, or else to the selected plant of the window. An expression
/// is a reference or, behind `=`, a formula: `= mean(power, 5)`.
///
/// Times are in nanoseconds since 1970, on the clock of the plant. All plots, gauges and tables of
/// a window share a time axis, two cursors and a pointer. To write signals use QPlcSignalControl.
///
/// Outside of a window there are no plants: functions return empty results and setters do nothing.
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI_EXPORT QPlcPanelContext : public QObject
{
    Q_OBJECT
public:
    using Time = qint64;  ///< time [ns] since 1970-01-01 UTC
    /// The two cursors of a window.
    enum Cursor {
        CursorA,  ///< first cursor
        CursorB   ///< second cursor
    };

    /// The meaning of an expression, and its value.
    struct QTPLC_GUI_EXPORT Signal
    {
        QString plant;                    ///< name of its plant; empty: there is no such signal now
        QPlcSignalDefinition definition;  ///< name, type, unit, limits, names of values
        int element = -1;                 ///< element of an array, from 0; -1: the whole signal
        /// Value of the signal or its element; invalid: there is none.
        QPlcValue value;
        QPlcQuality quality;  ///< quality of the value
        QString writer;       ///< node that writes the signal; empty: no node does
        /// The value is usable, and it is the newest one or the one of the wanted time.
        bool isCurrent = false;
        /// Time since the value was valid [s]; -1 without a value, and for a value of the past.
        double age = -1.0;
        /// What is special about the value, for people: "stale, 3 s", "at rest", "held 2 cycles",
        /// "at 12:03:04.500"; empty: it is a usable value of now.
        QString note;
        QString problem;  ///< why there is no signal, for people; empty: there is one

        /// Returns true if there is such a signal, even if it has no value yet.
        explicit operator bool() const { return problem.isEmpty(); }
        /// Returns the value as a number; NaN if there is none.
        /// \param index  element of an array, from 0
        double number(int index = 0) const;
    };
    /// One step of the history of a number.
    struct Sample
    {
        /// Time of the first value of the step [ns].
        Time time = 0;
        double value = 0.0;                             ///< first value of the step
        double minimum = 0.0;                           ///< smallest value of the step
        double maximum = 0.0;                           ///< largest value of the step
        QPlcQuality::Kind quality = QPlcQuality::Good;  ///< worst quality in the step
        /// Draw a line from the sample before to this one.
        bool isJoined = false;
    };
    /// One plant of the window.
    struct Plant
    {
        QString name;  ///< empty: there is no such plant
        QColor color;  ///< colour that marks it in this window
        /// Its master answers; false at once when the connection is lost.
        bool isConnected = false;
        bool isLive = false;     ///< its cycles arrive
        bool isRunning = false;  ///< its master is in real time
        /// Its values are stale, because it is lost or its cycles do not arrive.
        bool isStale = false;
        QString state;      ///< "Real time", "lost"
        QString stateText;  ///< the same with the reason: "Disconnected: Connection refused"
        /// Clock of its master: "RealTime", "Scaled(2)", "Lockstep"; empty: not known.
        QString clock;
        double age = -1.0;  ///< age of its values [s]; -1: it has none
        /// Rows of values per second that arrive, over the last 2 s [Hz].
        double rate = 0.0;
        Time newest = 0;  ///< time of its newest value [ns]; 0: it has none
    };
    /// A duration that a master measures in each cycle.
    struct Duration
    {
        QString owner;                      ///< "Master", or the name of a node
        QString name;                       ///< "lateness" (only of the master), "execution", "roundTrip"
        QPlcDurationStatistics statistics;  ///< how it was distributed
    };
    /// Severity of an entry of the event log.
    enum Severity {
        Information,  ///< for people who look at the log
        Warning,      ///< needs attention
        Error         ///< needs action
    };
    /// How numbers of a unit are written.
    struct Prefix
    {
        double factor = 1.0;  ///< multiply numbers by it before you write them
        QString unit;         ///< unit with its prefix: "kW"
    };

    /// Destroys the context; only its panel does this.
    ~QPlcPanelContext() override;

    // -- signals and their past --

    /// Returns the present meaning of an expression, with the newest value.
    Signal signal(const QString &expression) const;
    /// Returns the same with the value at a time. Values of the past have 32-bit precision; texts
    /// have no past.
    Signal signal(const QString &expression, Time time) const;
    /// Returns the signal with the value that the window shows: that of shownTime(), else the
    /// newest one.
    Signal shown(const QString &expression) const;
    /// Returns the history of a number in begin <= time <= end, oldest first. NaN is left out.
    /// \param most  number of steps at most, 4 or more. A step is one cycle, or 2, 4, 8, ... cycles
    ///     of a longer history
    /// \return as much as the window remembers (10 minutes by default); empty if there is no such
    ///     number
    QVector<Sample> history(const QString &expression, Time begin, Time end, int most = 2000) const;
    /// Returns the history of a number row by row and without a copy, for charts that draw much of
    /// it. It is valid until signalsChanged(); then ask again.
    QPlcPast past(const QString &expression) const;
    /// Returns the same, with names without a plant in the expression, also in a formula, as those
    /// of \a plant: to compare plants.
    QPlcPast past(const QString &expression, const QString &plant) const;
    /// Returns references of all numbers of all plants, for a field in which people choose one.
    QStringList numberNames() const;
    /// Returns references of all signals of all plants, and of the elements of arrays.
    QStringList signalNames() const;

    // -- time --

    /// Returns the time axis that the panels of the window share: to zoom, to pan, and to follow
    /// it. The window owns it. Outside of a window the panel has one of its own. Never null. It is
    /// another one only after QPlcWidget::contextChanged().
    QPlcTimeAxis *timeAxis() const;
    /// Returns true if the window follows the newest values.
    bool isLive() const;
    /// Returns the left end of the time axis.
    Time begin() const;
    /// Returns the right end of the time axis. In a live window it is the newest value of the
    /// plants of QPlcWidget::shownSignals(). 0: there are no values.
    Time end() const;
    /// Returns the time whose values gauges and tables show, because a person looks at the past;
    /// not set: the newest values.
    std::optional<Time> shownTime() const;
    /// Shows a range of time, and stops following new values.
    /// \pre begin < end
    void showRange(Time begin, Time end);
    /// Follows the newest values again.
    void goLive();
    /// Returns the time of a cursor; not set: the cursor is not shown.
    std::optional<Time> cursor(Cursor which) const;
    /// Moves a cursor in all plots of the window.
    /// \param time  not set: hides the cursor
    void setCursor(Cursor which, std::optional<Time> time);
    /// Returns the time under the mouse, in any plot of the window; not set: there is none.
    std::optional<Time> pointer() const;
    /// Moves the pointer in all plots of the window.
    /// \param time  not set: hides the pointer
    void setPointer(std::optional<Time> time);

    // -- plants --

    /// Returns the names of all plants of the window.
    QStringList plants() const;
    /// Returns a plant.
    /// \param name  empty: the plant of references without a plant
    Plant plant(const QString &name = QString()) const;
    /// Stops a plant, as the button STOP does. Does nothing if there is no such plant.
    /// \param name  empty: the plant of references without a plant
    void stop(const QString &name = QString());
    /// Asks a master for the durations of its cycles and its nodes, with histograms.
    /// \param receiver  while it exists, \a answered may be called
    /// \param answered  gets the durations, in the event loop; nothing if the connection ends
    /// \param name  plant; empty: the plant of references without a plant
    /// \return false if nothing was asked, as ask() does
    bool askDurations(QObject *receiver, const std::function<void(const QVector<Duration> &)> &answered,
                      const QString &name = QString());
    /// Asks a master for anything else that is not a signal. Commands are not possible: to stop a
    /// plant, call stop(); to set signals, use QPlcSignalControl.
    /// \param question  of the kind GetState, GetSignals, GetStatistics, GetSchedule, GetLeases or
    ///     GetEvents (docs/protocol.md, section 5)
    /// \param receiver  while it exists, \a answered may be called
    /// \param answered  gets the answer once, in the event loop: of the kind Failed, with `error`
    ///     and `text`, if the master refuses or the connection ends before. If a master does not
    ///     answer within 5 s, the window ends the connection
    /// \param name  plant; empty: the plant of references without a plant
    /// \return false if nothing was asked: the kind is another one, there is no connection, a
    ///     command of the window waits for its answer, or 16 questions of panels do
    bool ask(const QPlcMessage &question, QObject *receiver, const std::function<void(const QPlcMessage &)> &answered,
             const QString &name = QString());
    /// Writes a line into the event log of the window.
    /// \param source  where it happened: "east", "Trigger"
    /// \param text  one sentence for people
    void report(Severity severity, const QString &source, const QString &text);

    // -- tables: models for the views of Qt, with titles, texts, colours and tool tips --

    /// Data of a row of createSignalModel(), besides those of Qt.
    enum SignalRole {
        ReferenceRole = Qt::UserRole  ///< QString: the signal or element; empty: a plant or a node
    };
    /// Data of createNodeModel(), besides those of Qt.
    enum NodeRole {
        SortRole = Qt::UserRole,  ///< of a cell: numbers as numbers, durations in ns
        HealthRole                ///< of a row: 0 good, 1 warning, 2 error, 3 not known
    };
    /// Data of a row of eventModel(), besides those of Qt.
    enum EventRole {
        SeverityRole = Qt::UserRole,  ///< Severity
        AcknowledgedRole,             ///< bool: nobody has to acknowledge it any more
        ActiveRole,                   ///< bool: what it tells of still lasts
        FollowersRole,                ///< int: alarms that came with it, and may come from it
        EventTimeRole,                ///< qint64: [ms] since 1970
        NoteRole                      ///< bool: a person has written it
    };
    /// Returns a tree of all plants, their nodes, the signals that these write, and elements of
    /// arrays. Values are those of shownTime(). They are renewed at most 10 times a second, where a
    /// view shows them. People can drag rows onto other panels.
    /// \param parent  owns it \return null outside of a window
    QAbstractItemModel *createSignalModel(QObject *parent) const;
    /// Returns a table of masters and nodes of all plants with their state, durations and counters.
    /// Durations are those of the last 10 s, the largest ones those since the start.
    /// \param parent  owns it \return null outside of a window
    QAbstractItemModel *createNodeModel(QObject *parent) const;
    /// Returns the event log of the window, the newest event last; it keeps 10 000 events. Set
    /// AcknowledgedRole of a row to acknowledge it. Null outside of a window.
    QAbstractItemModel *eventModel() const;
    /// Returns the number of warnings and errors that nobody has acknowledged.
    int unacknowledgedEvents() const;
    /// Acknowledges all warnings and errors of the log; unacknowledgedEvents() is 0 then.
    void acknowledgeEvents();

    // -- look --

    /// Returns colours and fonts of the window. They change with themeChanged().
    QPlcTheme theme() const;
    /// Returns a value with its unit, as the window writes it: "13.90 µs", "ReelIn"; "–" without a
    /// value.
    /// \param digits  significant digits of a number
    static QString text(const Signal &signal, int digits = 4);
    /// Returns a number with its unit: "1.008 MJ".
    /// \param unit  as in the signal table
    /// \param digits  significant digits
    static QString text(double number, const QString &unit, int digits = 4);
    /// Returns an age or another span of time in a few characters: "12 ms", "3.4 s", "5 min".
    /// \param seconds  0 or more
    static QString ageText(double seconds);
    /// Returns one prefix for many numbers, as an axis needs it.
    /// \param unit  as in the signal table
    /// \param size  absolute value of the largest number
    static Prefix prefix(const QString &unit, double size);

Q_SIGNALS:
    /// Emitted when the panel should be drawn again, for any of the reasons below: at most 30 times
    /// a second, and not while the panel is hidden.
    void changed();
    /// Emitted when there are new values.
    void valuesChanged();
    /// Emitted when the history of a formula has got more old values, which is worth drawing also
    /// while time stands still.
    void pastChanged();
    /// Emitted when the time axis, the shown time, a cursor or the pointer has changed.
    void timeChanged();
    /// Emitted when references may mean something else: plants, signal tables, or the pin of the
    /// panel have changed.
    void signalsChanged();
    /// Emitted when a plant was lost, came back, started or stopped.
    /// \param plant  its name
    void plantStateChanged(const QString &plant);
    /// Emitted when unacknowledgedEvents() changes.
    void unacknowledgedEventsChanged();
    /// Emitted when theme() has changed, or the panel was put into another window.
    void themeChanged();

private:
    friend class QPlcWidget;
    friend class QPlcSignalControl;

    Q_DECL_HIDDEN explicit QPlcPanelContext(QPlcWidget *panel);
    Q_DECL_HIDDEN void setWindow(qplc::WindowContext *window);
    Q_DECL_HIDDEN qplc::WindowContext *window() const;
    Q_DECL_HIDDEN QString pin() const;

    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};
