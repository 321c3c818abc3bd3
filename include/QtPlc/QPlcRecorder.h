// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcRecordingGlobal.h"

#include <QtCore/QObject>
#include <QtCore/QString>

#include <chrono>
#include <memory>

class QPlcMasterNode;

/// Records every cycle of a plant into files.
///
/// \code
/// QPlcMasterNode master;
/// QPlcRecorder recorder;
/// recorder.setTarget("/var/lib/qtplc/recordings/");
/// recorder.setMaster(&master);          // each phase, from its first cycle on
/// if (!recorder.start())
///     qWarning("%s", qPrintable(recorder.errorString()));
/// \endcode
///
/// The master writes each cycle into a ring in memory, whether or not it is recorded. The recorder
/// reads the rings on a thread of its own, and writes MCAP files, which `qtplc verify` and other
/// programs read. In real time the master never waits for it. If the disk is full or stalls, the
/// ring keeps the cycles of about a minute, and the recorder tries again each second.
///
/// In a folder, a file ends after segmentDuration() or segmentSize(), and with the phase. The
/// oldest files are deleted as keepAtMost() and its like say; marked ones stay. A file that is
/// being written has `.part` behind its name. If the process is killed, the next recorder in this
/// folder finishes the file, and goes on with what is left in the ring.
///
/// \threadsafe no: call from the thread that owns the object
///
/// \ingroup recording
class QTPLC_RECORDING_EXPORT QPlcRecorder : public QObject
{
    Q_OBJECT
public:
    /// What the recorder does at the moment.
    enum State {
        Off,        ///< it has not been started
        Waiting,    ///< no phase is running
        Recording,  ///< cycles go into a file
        Retrying,   ///< the file cannot be written; the recorder tries again each second
        Paused      ///< `qtplc record stop FOLDER` wants that nothing is recorded
    };
    Q_ENUM(State)
    /// Why a function has failed.
    enum Error {
        NoError,      ///< nothing has failed
        TargetError,  ///< nothing can be recorded to the target
        RingError,    ///< a phase cannot be recorded
        WriteError    ///< the file cannot be written at the moment
    };
    Q_ENUM(Error)
    /// Figures since start().
    struct Status
    {
        State state = Off;            ///< at the moment
        QString file;                 ///< the newest one
        quint64 cycles = 0;           ///< recorded
        quint64 missing = 0;          ///< that could not be recorded: they are in a gap
        quint64 bytes = 0;            ///< written
        double bytesPerSecond = 0.0;  ///< written, over the last seconds
        quint64 freeBytes = 0;        ///< of the disk
        QString error;                ///< the newest one; empty: there was none
    };

    /// Makes a recorder that is off.
    /// \param parent  owns the recorder, if given
    explicit QPlcRecorder(QObject *parent = nullptr);
    /// Stops it.
    ~QPlcRecorder() override;

    /// Sets where recordings go. Takes effect at the next start().
    /// \param path  a folder that is there, or a name that ends with '/': a file for each phase and
    ///     segment is made in it. Otherwise a file that is not there yet; further phases go into
    ///     NAME-2, NAME-3, ...
    void setTarget(const QString &path);
    /// Returns the target.
    QString target() const;
    /// Whether the target is a folder.
    bool isFolder() const;
    /// Sets after which time a file of a folder ends; 1 s or longer, default 1 h.
    void setSegmentDuration(std::chrono::seconds duration);
    /// Returns after which time a file of a folder ends.
    std::chrono::seconds segmentDuration() const;
    /// Sets at which size a file of a folder ends [byte]; 1 MiB or more, default 256 MiB.
    void setSegmentSize(quint64 bytes);
    /// Returns at which size a file of a folder ends [byte].
    quint64 segmentSize() const;
    /// Deletes files of the folder that were begun longer ago. \param age  default 0: there is no
    /// limit
    void setLongestAge(std::chrono::seconds age);
    /// Deletes the oldest files of the folder while all have more. \param bytes  default 0: there
    /// is no limit
    void setLargestTotal(quint64 bytes);
    /// Deletes the oldest files of the folder while the disk has less free. \param bytes  default 1
    /// GiB; 0: there is no limit
    void setLeastFree(quint64 bytes);

    /// Records the phases of \a master, which runs in this process, each from its first cycle on.
    /// \param master  outlives the recorder or is null
    void setMaster(QPlcMasterNode *master);
    /// Looks for plants whose masters run on this computer under this user, and records them. A
    /// master that was killed is recorded to its last cycle.
    /// \param plant  name of a plant; empty: all of them
    void setPlant(const QString &plant);

    /// Begins. \return false when nothing can be recorded to the target; error() says why
    bool start();
    /// Records what is in the rings by now, and finishes the files.
    /// \return false when a file could not be finished; the next start in the folder does it
    bool stop();
    /// Records a phase. \param ring  its file, as QPlcMasterNode::ringIsReady() gives it
    /// \return false when another recorder records it, or the recorder is off
    bool addRing(const QString &ring);
    /// Keeps the cycles from 30 s before to 10 s after now: their files in the folder get `_marked`
    /// in their names and are not deleted. \return false: nothing is being recorded
    bool mark();
    /// Waits until all phases that have ended are in their files.
    /// \return false when that took longer
    bool waitForFinished(std::chrono::milliseconds timeout);

    /// Returns the state and the figures.
    Status status() const;
    /// Returns what the recorder does.
    State state() const;
    /// Returns the newest error.
    Error error() const;
    /// Returns the newest error as a sentence.
    QString errorString() const;

Q_SIGNALS:
    /// Emitted when the state has changed.
    void stateChanged(QPlcRecorder::State state);
    /// Emitted when a file was begun: cycles go into it from now on.
    /// \param file  path; in a folder, it changes when the file is complete or marked
    /// \param plant  name
    void fileStarted(const QString &file, const QString &plant);
    /// Emitted when a file is complete.
    /// \param file  path
    /// \param cycles  that are in it
    /// \param missing  cycles that could not be recorded
    void fileFinished(const QString &file, quint64 cycles, quint64 missing);
    /// Emitted when the master has ended without the end of its phase; comes after fileFinished().
    void masterLost(const QString &file);
    /// Emitted when error() has changed.
    void errorOccurred();

private:
    struct Q_DECL_HIDDEN Private;
    bool setError(Error error, const QString &text);
    void tell();
    std::unique_ptr<Private> d;
};
