// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcRecordingGlobal.h"
#include "QPlcSignalTable.h"

#include <QtCore/QByteArray>
#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtCore/QVector>

#include <chrono>
#include <memory>

/// Reads recordings: a file, the files of a folder, or several of them as one, in the order of
/// their times.
///
/// \code
/// QPlcRecording recording;
/// if (!recording.open("flight.mcap"))
///     qFatal("%s", qPrintable(recording.errorString()));
/// QPlcRecordedRows rows(recording, {"power"}, recording.begin(), recording.end());
/// double largest = 0.0;
/// while (rows.next()) {
///     if (rows.quality(0).isGood())
///         largest = std::max(largest, rows.number(0));
/// }
/// \endcode
///
/// open() reads a few bytes of each file; all else is read when it is needed. Files that were not
/// finished, because their recorder was killed or still writes them, are read up to what was whole
/// at open(). What is damaged is left out and counted. No function reads more than a chunk of about
/// a second at a time, so the memory does not grow with the recording.
///
/// Times are nominal: the start of the phase plus the number of the cycle times the period [ns]. In
/// real time the start is the wall clock (since 1970), in simulations it is 0.
///
/// \threadsafe no: one thread at a time
///
/// \ingroup recording
class QTPLC_RECORDING_EXPORT QPlcRecording
{
public:
    /// One file of the recording.
    struct File
    {
        QString name;             ///< path
        qint64 begin = 0;         ///< time of its first cycle [ns]
        qint64 end = 0;           ///< time of its last cycle [ns]
        quint64 session = 0;      ///< of the master
        quint64 phase = 0;        ///< of this session, from 1
        bool isFinished = false;  ///< it has its summary: its recorder was not killed
        bool isMarked = false;    ///< recorders do not delete it: something has happened in it
    };
    /// What a signal was in an interval of time.
    struct Extremes
    {
        double minimum = 0.0;   ///< of the valid values; only if hasValue
        double maximum = 0.0;   ///< of the valid values; only if hasValue
        bool hasValue = false;  ///< the interval has a valid value
        bool isGood = false;    ///< all of its values have the quality Good
    };
    /// A message of a channel other than /plant.
    struct Message
    {
        qint64 time = 0;     ///< nominal [ns]
        QByteArray content;  ///< JSON, or bytes: docs/recording.md has the channels
    };
    /// When something has happened, and who did it.
    struct Happening
    {
        qint64 time = 0;        ///< nominal, of its cycle [ns]
        qint64 wallTime = 0;    ///< [ns since 1970]; of a simulation as time
        quint64 cycle = 0;      ///< newest one by then; of a value the one that has adopted it
        bool isBefore = false;  ///< it was before the phase, and has led to it
        QString by;             ///< person or program, as windows show it; of an event: node, or Master
        QString role;           ///< that was proven: "Operator", ...; empty: none
        QString address;        ///< of a connection; empty: nobody over a connection did it
        QString client;         ///< uuid of the program; empty: unknown
    };
    /// Something that the event log of the master tells.
    struct Event : Happening
    {
        QString severity;       ///< "info", "warning" or "error"
        QString kind;           ///< "state", "node", "note", ...: docs/protocol.md, section 5.8
        QString text;           ///< sentence for people; of a note what was noted
        QString alarm;          ///< condition that lasts; empty: it was over at once
        bool isActive = false;  ///< of an alarm: it has begun
    };
    /// A signal that was set, or another command.
    struct Command : Happening
    {
        QString command;        ///< "Stop", ...; empty: a signal was set
        QString signalName;     ///< of the signal that was set
        QString from;           ///< value before, as text
        QString to;             ///< value, as text
        QString how;            ///< "set", "program", "lease", "came back" or "lease lost"
        quint64 count = 1;      ///< values that are told together: `from` is of the first one
        bool isAdopted = true;  ///< a cycle of the phase has taken the value
    };
    /// A lease of signals that was taken, released or lost.
    struct Lease : Happening
    {
        QString what;             ///< "taken", "released" or "lost"
        QStringList signalNames;  ///< of the signals
        QStringList from;         ///< who had them before
        QString reason;           ///< of a loss
    };
    /// Signals of some cycles, a column for each signal.
    struct Columns
    {
        QVector<qint64> times;    ///< of each cycle [ns]
        QVector<quint64> cycles;  ///< numbers of the cycles
        struct Column             ///< a signal
        {
            int size = 1;               ///< numbers of a cycle: those of an array stand side by side
            QVector<double> numbers;    ///< size for each cycle; NaN: no number
            QVector<quint8> qualities;  ///< one for each cycle: QPlcQuality::fromByte()
        };
        QVector<Column> columns;  ///< in the order of the names
    };

    /// Makes an object without a recording.
    QPlcRecording();
    /// Closes the files.
    ~QPlcRecording();
    /// Takes over what \a other has opened; \a other may only be destroyed or assigned to then.
    QPlcRecording(QPlcRecording &&other) noexcept;
    /// Takes over what \a other has opened, as the constructor does.
    QPlcRecording &operator=(QPlcRecording &&other) noexcept;

    /// Opens a file, or all recordings of a folder. What is no recording in a folder is left out:
    /// notes() tells it.
    /// \param path  of the file or folder
    /// \return false when it is no recording, or flights in it have the same times, as simulations
    ///     do, which begin at 0; errorString() says what to do
    bool open(const QString &path);
    /// Opens several files and folders as one recording.
    /// \param paths  of the files and folders
    /// \return as open() of one
    bool open(const QStringList &paths);
    /// Returns why the last open(), messages(), columns(), events(), commands() or leases() has
    /// failed, as a sentence.
    QString errorString() const;
    /// Returns sentences about what was left out: files of a folder that cannot be read, files
    /// without a cycle, signals that have another type in other files.
    QStringList notes() const;

    /// Returns the name of the plant, as its newest file says it.
    QString plant() const;
    /// Returns the time between two cycles in the newest file.
    std::chrono::nanoseconds period() const;
    /// Returns all signals of all files.
    QPlcSignalTable signalTable() const;
    /// Returns the time of the first cycle [ns].
    qint64 begin() const;
    /// Returns the time of the last cycle [ns].
    qint64 end() const;
    /// Whether times are those of a clock (since 1970), not those of a simulation (since 0).
    bool isTimed() const;
    /// Returns the files, in the order of their times.
    QVector<File> files() const;

    /// Returns the cycles of some time as columns. For longer times, read piece by piece: the next
    /// piece begins 1 ns behind the last time of this one.
    /// \param names  of signals. Texts are no numbers: QPlcRecordedRows has them
    /// \param begin  first time [ns]
    /// \param end  last time [ns]
    /// \param most  cycles at most, 1 or more
    /// \return no columns when a name is not known or a text; errorString() says which one
    Columns columns(const QStringList &names, qint64 begin, qint64 end, int most = 100'000);
    /// Returns the messages of a channel, such as /gaps: cycles that are missing.
    /// \param channel  its name. One that no file has is empty
    /// \param begin  first time [ns]
    /// \param end  last time [ns]
    /// \param most  messages at most, 1 or more
    QVector<Message> messages(const QString &channel, qint64 begin, qint64 end, int most = 100'000);
    /// Returns what the event log of the master tells of some time, notes of people among it.
    ///
    /// \code
    /// QPlcRecording recording;
    /// recording.open("flight.mcap");
    /// for (const auto &event : recording.events(recording.begin(), recording.end())) {
    ///     if (event.kind == QLatin1String("note"))
    ///         qInfo("cycle %llu: %s", event.cycle, qPrintable(event.text));
    /// }
    /// \endcode
    /// \param begin  first time [ns]
    /// \param end  last time [ns]
    /// \param most  events at most, 1 or more
    QVector<Event> events(qint64 begin, qint64 end, int most = 100'000);
    /// Returns who has set signals, and commanded the plant, in some time.
    /// \param begin  first time [ns]
    /// \param end  last time [ns]
    /// \param most  commands at most, 1 or more
    QVector<Command> commands(qint64 begin, qint64 end, int most = 100'000);
    /// Returns who has taken, released and lost leases in some time.
    /// \param begin  first time [ns]
    /// \param end  last time [ns]
    /// \param most  leases at most, 1 or more
    QVector<Lease> leases(qint64 begin, qint64 end, int most = 100'000);
    /// Returns the extremes of a signal in intervals of equal length: a curve of days. It reads the
    /// overviews of the files, so it takes about as long for a day as for a minute.
    /// \param name  of a numeric signal. Without one of this name, no interval has a value
    /// \param element  of an array, from 0
    /// \param begin  first time [ns]
    /// \param end  time behind the last interval [ns]
    /// \param count  intervals, 1 or more
    QVector<Extremes> overview(const QString &name, int element, qint64 begin, qint64 end, int count);
    /// Returns how many damaged places columns(), messages(), events(), commands() and leases()
    /// have left out since open().
    int damages() const;

private:
    friend class QPlcRecordedRows;
    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};
