// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcCycle.h"
#include "QPlcProfile.h"
#include "QPlcQuality.h"
#include "QPlcSignalTable.h"
#include "QPlcSlaveNode.h"
#include "QPlcValue.h"

#include <chrono>
#include <memory>

class QPlcNodeRunnerPrivate;

/// Runs one node without a master: set its inputs, compute a cycle, get its outputs. For tests of a
/// node, and for programs of others that call a node (FMU, DLL).
///
/// \code
/// class Winch : public QPlcCompactSlaveNode
/// {
/// public:
///     Winch() : QPlcCompactSlaveNode("Winch") {}
///
/// private:
///     QPlcInput<double> m_speed{this, "tetherSpeed"};     // [m/s]
///     QPlcOutput<double> m_length{this, "tetherLength"};  // [m]
///     void reset() override { m_length = 300.0; }
///     void step(const QPlcCycle &cycle) override { m_length = m_length + m_speed * cycle.dt(); }
/// };
///
/// Winch winch;
/// QPlcNodeRunner runner(winch);
/// if (!runner.bind(QPlcSignalTable::fromIniFile("winch.ini")) || !runner.initialize())
///     qFatal("%s", qPrintable(runner.errorString()));
/// runner.set("tetherSpeed", 2.0);
/// runner.step();
/// const double length = runner.value("tetherLength").toReal();  // 300.02
/// \endcode
///
/// The node computes exactly what it computes in a plant with the clock Lockstep: the same bits.
/// The rules of the signal table apply as there. An input that is not finite or outside of its
/// limits is counted and not taken: the node reads the last good value, and after `hold` cycles the
/// safe one. An output is treated in the same way, so value() returns what other nodes of a plant
/// read.
///
/// | the node is        | after initialize()          | after step() of cycle k                  |
/// |--------------------|-----------------------------|------------------------------------------|
/// | a usual node       | outputs of its reset()      | outputs of cycle k, from inputs of k     |
/// | a two-phase node   | outputs of cycle 0          | outputs of cycle k + 1                   |
///
/// Set values by name (set(), value()), or get the index of a signal once (indexOf()) and use the
/// functions that have an index. These and step() allocate no memory, except when they fail.
///
/// The class needs neither QCoreApplication nor an event loop. The node emits no Qt signals.
/// Functions that fail return false and set errorString().
///
/// \threadsafe no: one thread at a time for a runner and its node; different runners are
///     independent
///
/// \ingroup nodes
class QTPLC_EXPORT QPlcNodeRunner
{
public:
    /// Makes a runner that is not bound.
    /// \param node  outlives the runner; not connected to a master, and not one of its local nodes
    /// \param period  see setPeriod()
    explicit QPlcNodeRunner(QPlcSlaveNode &node, std::chrono::nanoseconds period = std::chrono::milliseconds(10));
    /// Calls stop().
    ~QPlcNodeRunner();
    QPlcNodeRunner(const QPlcNodeRunner &) = delete;
    QPlcNodeRunner &operator=(const QPlcNodeRunner &) = delete;

    // ---- before the first cycle ----

    /// Looks up the signals of the node in \a table, and checks all that a master checks when a
    /// node registers. Ends a phase, as stop() does. If the process has no table yet
    /// (QPlcSignalIndexTable), it is this one from now on: nodes with lists need it.
    /// \return false when a signal does not exist, has another type, or belongs to another node
    bool bind(const QPlcSignalTable &table);
    /// Returns true after bind() has succeeded.
    bool isBound() const;
    /// Sets the time between two cycles.
    /// \param period  10 us to 10 s, default 10 ms
    /// \return false when \a period is out of range, or while cycles run; nothing has changed then
    bool setPeriod(std::chrono::nanoseconds period);
    /// Returns the time between two cycles.
    std::chrono::nanoseconds period() const;
    /// Sets the profile that the node finds, and that chooses `hold` for signals without this key.
    /// Takes effect at the next reset().
    /// \param profile  default Simulation; Automatic stands for it, too
    void setProfile(QPlcProfile::Value profile);
    /// Brings the node into its initial state: value() returns its initial outputs. Inputs get the
    /// initial values of the table. Ends a phase, as stop() does.
    /// \pre bind() has succeeded
    /// \return false when the code of the node throws, or an initial output is not allowed
    bool reset();
    /// Gives the node its initial inputs and begins a phase: step() computes cycle 0. Calls reset()
    /// before, unless you have called it since the last phase. Set other initial inputs between
    /// both.
    /// \return false when the code of the node throws
    bool initialize();

    // ---- cycles ----

    /// Computes one cycle.
    /// \return false when the code of the node throws, now or before in this phase: it is in its
    ///     safe state then. Also false outside of a phase. True if the node is in a safe state that
    ///     was asked for: it computes nothing then
    bool step();
    /// Lets time pass in which the node is not called, as after an overrun of the master. The next
    /// step() has the number of that cycle, and QPlcCycle::missedCycles() is \a cycles.
    /// \return false outside of a phase, or when time() would go beyond 100 years
    bool skip(quint64 cycles);
    /// Brings the node into its safe state, as a master or a watchdog does: safeState() is called,
    /// and the outputs have their safe values until the next reset().
    void makeSafe(QPlcSlaveNode::SafeStateReason reason = QPlcSlaveNode::MasterStopsSafely);
    /// Ends the phase: safeState(), unless it was called already, and stopped() of the node. Values
    /// stay as they are. No effect outside of a phase.
    void stop();

    /// Returns true from initialize() to stop().
    bool isRunning() const;
    /// Returns the number of the next cycle, from 0.
    quint64 nextCycle() const;
    /// Returns the time of the next cycle since the start of the phase: nextCycle() * period(),
    /// exactly.
    std::chrono::nanoseconds time() const;
    /// Returns true if the node is in its safe state.
    bool isSafe() const;
    /// Returns true if the code of the node has thrown in this phase.
    bool hasFailed() const;
    /// Returns true if the node has called QPlcSlaveNode::requestSafeStop() in this phase. As in a
    /// plant, its outputs of this cycle count, and the next step() brings it into its safe state.
    bool wantsSafeStop() const;
    /// Returns what failed last, as a sentence with the remedy; empty: nothing has failed yet.
    QString errorString() const;
    /// Returns a number that stands for all values of all cycles of this phase, in their order. It
    /// is QPlcMasterStatistics::imageDigest of a lockstep plant with the same table, if this node
    /// reads the same inputs there, and all other signals stay at their initial values.
    quint64 digest() const;

    // ---- signals ----

    /// Returns the table of bind().
    const QPlcSignalTable &table() const;
    /// Returns the signals that the node reads and does not write itself, in the order of their
    /// declaration.
    QVector<QPlcSignalIndex> inputs() const;
    /// Returns the signals that the node writes, in the order of their declaration.
    QVector<QPlcSignalIndex> outputs() const;
    /// Returns the index of an input or output of the node; QPlcInvalidSignalIndex if it has none
    /// of this name, with the reason in errorString().
    QPlcSignalIndex indexOf(const QString &name) const;
    /// Returns true if the node reads the signal and does not write it.
    bool isInput(QPlcSignalIndex index) const;
    /// Returns true if the node writes the signal.
    bool isOutput(QPlcSignalIndex index) const;

    /// Sets an input for the next cycles; before the first one, the initial input. Numbers are
    /// converted to the type of the signal; a single number sets all elements of an array. A text
    /// may name a value of the signal ("ReelIn"). Limits are checked by step().
    /// \return false when the node has no such input, or \a value does not fit its type
    bool set(const QString &name, const QPlcValue &value);
    /// Returns the value of an output, or of an input as it was set; an invalid value if the node
    /// has no such signal.
    QPlcValue value(const QString &name) const;
    /// Returns the value for people: a name of a value if the signal has such ("ReelIn"), else
    /// QPlcValue::toString(). Empty if the node has no such signal.
    QString text(const QString &name) const;

    /// Sets an input, as set() does.
    /// \return false when \a index is not an input, or \a value does not fit
    bool setValue(QPlcSignalIndex index, const QPlcValue &value);
    /// Sets one element of an input with a numeric type or DateTime [ns]. A real signal rounds \a
    /// value to its precision; an integer signal rounds it to an integer.
    /// \return false when \a index is not such an input, there is no such element, or the integer
    ///     is out of the range of the type
    bool setReal(QPlcSignalIndex index, double value, int element = 0);
    /// Sets one element of an input from an integer, as above.
    bool setInteger(QPlcSignalIndex index, qint64 value, int element = 0);
    /// Sets an input from the packed little-endian bytes of its type (QPlcSignalType).
    /// \pre \a bytes has the size of the type
    /// \return false when \a index is not an input
    bool setBytes(QPlcSignalIndex index, const void *bytes);
    /// Returns the value of an input as it was set, or of an output; an invalid value if \a index
    /// is neither.
    QPlcValue value(QPlcSignalIndex index) const;
    /// Returns one element as a number; 0 for texts, other signals and other elements.
    double real(QPlcSignalIndex index, int element = 0) const;
    /// Returns one element as an integer, by the rules of QPlcValue::toInt64().
    qint64 integer(QPlcSignalIndex index, int element = 0) const;
    /// Returns the packed little-endian bytes of the value. The pointer is valid until the next
    /// bind(). Null if \a index is neither an input nor an output.
    const char *bytes(QPlcSignalIndex index) const;

    /// Sets the quality that the writer of an input gives with its value; default Good. If it is
    /// Safe or Invalid, the value is not taken.
    /// \return false when \a index is not an input
    bool setQuality(QPlcSignalIndex index, QPlcQuality quality);
    /// Returns the quality of a signal after the last cycle. Of an input: Good if the node has read
    /// the value that was set; Held or Safe if the value was not taken.
    QPlcQuality quality(QPlcSignalIndex index) const;
    /// Returns how many values of a signal were not taken in this phase, because they were not
    /// finite or outside of the limits.
    quint64 refusedValues(QPlcSignalIndex index) const;

private:
    const std::unique_ptr<QPlcNodeRunnerPrivate> d;
};
