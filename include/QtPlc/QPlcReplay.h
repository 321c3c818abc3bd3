// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <memory>
#include <optional>

class QPlcSlaveNode;

namespace qplc {
struct ReplayResult;
}

/// Lets a node compute a recorded flight again, in a test: it gets the inputs of the recording,
/// cycle by cycle, and its outputs are compared with those of the recording, bit by bit.
///
/// \code
/// QPlcReplay replay("flight.mcap");
/// if (!replay.runProgram("./winch --drum 0.25"))
///     qWarning("%s", qPrintable(replay.text()));
/// \endcode
///
/// The node is a program, or an object of the test. Both connect to a master of the replay as they
/// do to that of their plant, so their code is the same in the field and here. The node computes
/// the cycles that it has computed in the flight: requests that were skipped or lost are left out,
/// and late answers are compared with what the master has taken later. Signals with
/// `volatile = yes` in the signal table are not compared. docs/recording.md says which nodes can be
/// replayed.
///
/// \threadsafe no: one thread, with a QCoreApplication and outside of QPlcSimulator::run()
///
/// \ingroup test
class QPlcReplay
{
public:
    /// A value that differs from that of the recording.
    struct Difference
    {
        /// Stands for the initial values of the node, which come before its first cycle.
        static constexpr quint64 Initial = ~quint64(0);
        QString signal;     ///< name
        quint64 cycle = 0;  ///< whose inputs the node had, or Initial
        double time = 0.0;  ///< of this cycle [s], since the start of the phase
        QString recorded;   ///< value in the recording
        QString computed;   ///< value that the node has computed now
    };

    /// Makes a replay, which reads the recording in each run.
    /// \param recording  a file that a recorder has written. It begins before the node joins
    explicit QPlcReplay(const QString &recording);

    /// Sets the name of the node in the recording. Default: that under which it registers.
    void setNodeName(const QString &name) { m_name = name; }
    /// Sets from when on outputs are compared. The node computes all cycles before, too, for its
    /// state. \param seconds  since the start of the phase, 0 or more; default 0
    void setFrom(double seconds) { m_from = seconds; }

    /// Starts a program for each registration of its node in the recording, lets it compute, and
    /// ends it.
    /// \param command  the program and its arguments, as you start it for the plant, but without
    ///     --master
    /// \return true when outputs were compared and all of them are equal; otherwise text() says why
    bool runProgram(const QString &command);
    /// Lets \a node compute the cycles of its first registration in the recording.
    /// \param node  without real devices and without a master; outlives the call
    /// \return true when outputs were compared and all of them are equal; otherwise text() says why
    bool run(QPlcSlaveNode &node);

    /// Returns a sentence about the last run: the first difference with both values, or why nothing
    /// was compared, or how many cycles are equal.
    QString text() const;
    /// Returns the number of cycles that the node has computed in the last run.
    quint64 cycles() const;
    /// Returns the number of cycles whose outputs were compared in the last run. The recording does
    /// not show outputs whose answers were lost.
    quint64 compared() const;
    /// Returns the number of values that differ in the last run.
    quint64 differences() const;
    /// Returns the first value that differs in the last run; none: all are equal.
    std::optional<Difference> firstDifference() const;

private:
    bool replay(const QString &command, QPlcSlaveNode *node);

    QString m_recording;
    QString m_name;
    double m_from = 0.0;
    std::shared_ptr<const qplc::ReplayResult> m_result;
};
