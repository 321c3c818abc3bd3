// SPDX-License-Identifier: Apache-2.0
#pragma once

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

class QPlcMessage;
class QPlcTimeAxis;
class QPlcWidget;

namespace qplc {
class WindowContext;
}

/// The window as one panel sees it: signals with their past, the time that is shown, theme, numbers for people.
///
/// ```cpp
/// void Compass::contextChanged()
/// {
///     connect(context(), &QPlcPanelContext::changed, this, QOverload<>::of(&QWidget::update));
/// }
/// void Compass::paintEvent(QPaintEvent *)
/// {
///     const QPlcPanelContext::Signal heading = context()->shown(QStringLiteral("heading"));
///     drawNeedle(heading.number(), context()->theme());
/// }
/// ```
/// QPlcWidget::context() gives it to each panel. A reference names a signal or one of its elements: `power`,
/// `position[2]`. A plant may stand in front: `east/power`. Without one it means the plant to which the panel
/// is pinned, or else the selected plant of the window. An expression is a reference or, behind `=`, a
/// formula: `= mean(power, 5)`.
///
/// Times are in nanoseconds since 1970, on the clock of the plant. All plots, gauges and tables of a window
/// share one time axis, two cursors and one pointer. QPlcSignalControl writes signals.
///
/// Threads: the thread of the window.
class QTPLC_GUI_EXPORT QPlcPanelContext : public QObject
{
    Q_OBJECT
public:
    using Time = qint64;  ///< [ns] since 1970
    enum Cursor { CursorA, CursorB };

    /// What a reference means, and its value.
    struct QTPLC_GUI_EXPORT Signal
    {
        QString plant;                    ///< name of its plant; empty: there is no such signal now
        QPlcSignalDefinition definition;  ///< name, type, unit, limits, names of values
        int element = -1;                 ///< of an array; -1: the whole signal
        QPlcValue value;                  ///< of the signal or its element; invalid: there is none
        QPlcQuality quality;              ///< what the master says of the value
        QString writer;                   ///< name of the node that writes it; empty: no node does
        bool isCurrent = false;           ///< the value is usable, and of now or of the time that was asked for
        QString problem;                  ///< why there is nothing, for people; empty: there is a signal

        explicit operator bool() const { return problem.isEmpty(); }
        /// Returns the value as a number, of an array that of \a index; NaN when there is none.
        double number(int index = 0) const;
    };
    /// One step of the past of a number.
    struct Sample
    {
        Time time = 0;                                  ///< of the first value of the step [ns]
        double value = 0.0;                             ///< the first value of the step
        double minimum = 0.0;                           ///< smallest value of the step
        double maximum = 0.0;                           ///< largest value of the step
        QPlcQuality::Kind quality = QPlcQuality::Good;  ///< the least good one of the step
        bool isJoined = false;                          ///< a line leads here from the sample before
    };
    /// One plant of the window.
    struct Plant
    {
        QString name;              ///< empty: there is no such plant
        QColor color;              ///< by which people know it in this window
        bool isConnected = false;  ///< its master answers; false from the moment that it is lost
        bool isLive = false;       ///< its cycles arrive
        bool isStale = false;      ///< its values are old, because it is lost or its cycles stay away
        QString state;             ///< "Real time", "lost"
        QString stateText;         ///< the same with the reason: "Disconnected: Connection refused"
        QString clock;             ///< of its master: "RealTime", "Scaled(2)", "Lockstep"; empty: not known
        double age = -1.0;         ///< time since its values were true [s]; -1: it has none
        Time newest = 0;           ///< time of its newest value [ns]; 0: it has none
    };
    /// How urgent an entry of the event log is.
    enum Severity { Information, Warning, Error };
    /// How numbers of a unit are written.
    struct Prefix
    {
        double factor = 1.0;  ///< multiply numbers by it
        QString unit;         ///< "kW"
    };

    ~QPlcPanelContext() override;

    // -- signals and their past --

    /// Returns what a reference or formula means now, with its newest value.
    Signal signal(const QString &expression) const;
    /// Returns the same with the value of a time. Numbers of the past have 32-bit precision; texts have no past.
    Signal signal(const QString &expression, Time time) const;
    /// Returns the signal with the value that the window shows: of shownTime(), or else of now.
    Signal shown(const QString &expression) const;
    /// Returns the past of a number, oldest first: the steps of begin <= time <= end. NaN is left out.
    /// \param most  steps at most, 4 or above. A step is one cycle, or 2, 4, 8, ... cycles of a longer past
    /// \return as long as the window remembers (10 minutes by default). Empty without such a number
    QVector<Sample> history(const QString &expression, Time begin, Time end, int most = 2000) const;
    /// Returns the past row by row and without a copy, for charts that draw much of it. What it says holds until
    /// signalsChanged(); then ask again.
    QPlcPast past(const QString &expression) const;
    /// Returns all numbers of the plants, as references: for a field in which people choose one.
    QStringList numberNames() const;
    /// Returns all signals of the plants, and the elements of arrays, as references.
    QStringList signalNames() const;

    // -- time --

    /// Returns the time axis that the panels of the window share: to zoom, to pan, and to follow it. Outside of a
    /// window the panel has one of its own. Never null; another one only when QPlcWidget::contextChanged() is called.
    QPlcTimeAxis *timeAxis() const;
    /// Whether the window follows the newest values.
    bool isLive() const;
    /// Returns the left end of the time axis.
    Time begin() const;
    /// Returns the right end of the time axis: of a live window the newest value of the plants of
    /// QPlcWidget::shownSignals(). 0: there are no values.
    Time end() const;
    /// Returns the time whose values gauges and tables show, because a person looks at the past; none: now.
    std::optional<Time> shownTime() const;
    /// Shows a range, and stops following. \pre begin < end
    void showRange(Time begin, Time end);
    /// Follows the newest values again.
    void goLive();
    std::optional<Time> cursor(Cursor which) const;
    void setCursor(Cursor which, std::optional<Time> time);
    /// Returns the time under the mouse, in any plot of the window.
    std::optional<Time> pointer() const;
    void setPointer(std::optional<Time> time);

    // -- plants --

    /// Returns the names of all plants of the window.
    QStringList plants() const;
    /// Returns a plant. \param name  empty: the one that references without a plant mean
    Plant plant(const QString &name = QString()) const;
    /// Stops a plant, as the button STOP does. \param name  as for plant()
    void stop(const QString &name = QString());
    /// Asks a master for what no signal says, such as QPlcMessage::GetStatistics.
    /// \param answered  gets the answer, in the event loop; not called after \a receiver has gone
    /// \param name  as for plant()
    /// \return false: nothing was asked, since there is no connection, or an answer is still to come
    bool ask(const QPlcMessage &question, QObject *receiver, const std::function<void(const QPlcMessage &)> &answered,
             const QString &name = QString());
    /// Writes a line into the event log of the window.
    /// \param source  where it happened: "east", "Trigger"
    void report(Severity severity, const QString &source, const QString &text);

    // -- look --

    QPlcTheme theme() const;
    /// Returns a value with its unit, as the window writes it: "13.90 µs", "ReelIn"; "–" without a value.
    static QString text(const Signal &signal, int digits = 4);
    /// Returns a number with its unit: "1.008 MJ". \param unit  as in the signal table
    static QString text(double number, const QString &unit, int digits = 4);
    /// Returns an age, or another span of time, in few letters: "12 ms", "3.4 s", "5 min".
    static QString ageText(double seconds);
    /// Returns one prefix for many numbers, as an axis needs it. \param size  of the largest one
    static Prefix prefix(const QString &unit, double size);

Q_SIGNALS:
    /// The panel should be drawn again: any of what follows, at most 30 times a second, and not while the
    /// panel is hidden.
    void changed();
    /// There are new values.
    void valuesChanged();
    /// The past of a formula has more old values: worth drawing also where time stands still.
    void pastChanged();
    /// Time axis, shown time, cursors or pointer.
    void timeChanged();
    /// References may mean something else: plants, tables of signals, or the pin of the panel.
    void signalsChanged();
    /// A plant was lost, came back, started or stopped.
    void plantStateChanged(const QString &plant);
    /// Colours or fonts of the window; or the panel has come into another window.
    void themeChanged();

private:
    friend class QPlcWidget;
    friend class QPlcSignalControl;

    explicit QPlcPanelContext(QPlcWidget *panel);
    void setWindow(qplc::WindowContext *window);
    qplc::WindowContext *window() const;
    QString pin() const;

    struct Private;
    std::unique_ptr<Private> d;
};
