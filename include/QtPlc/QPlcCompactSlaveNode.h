// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcBoundInput.h"
#include "QPlcBoundOutput.h"
#include "QPlcCompactSignal.h"
#include "QPlcInput.h"
#include "QPlcOutput.h"
#include "QPlcSlaveNode.h"

/// A node whose inputs and outputs are variables (ports). The inputs are set before each step, and
/// the outputs are sent after it.
///
/// \code
/// class Winch : public QPlcCompactSlaveNode
/// {
/// public:
///     Winch() : QPlcCompactSlaveNode("Winch") {}
///
/// private:
///     QPlcInput<double> m_tetherSpeed{this, "tetherSpeed"};     // [m/s], > 0 reels out
///     QPlcOutput<double> m_tetherLength{this, "tetherLength"};  // [m]
///     void reset() override { m_tetherLength = 300.0; }
///     void step(const QPlcCycle &cycle) override
///     {
///         m_tetherLength = m_tetherLength + m_tetherSpeed * cycle.dt();
///     }
/// };
/// \endcode
///
/// With setTwoPhase(true), outputs() and update() take the place of step():
///
/// \code
/// class Tank : public QPlcCompactSlaveNode
/// {
/// public:
///     Tank() : QPlcCompactSlaveNode("Tank") { setTwoPhase(true); }
///
/// private:
///     QPlcInput<double> m_inflow{this, "inflow", QPlcInputTiming::SameCycle};  // [m^3/s]
///     QPlcOutput<double> m_level{this, "level"};                               // [m]
///     double m_volume = 0.0;                                                   // [m^3]
///     void outputs() override { m_level = m_volume / 2.0; }                    // area of 2 m^2
///     void update(const QPlcCycle &cycle) override { m_volume += m_inflow * cycle.dt(); }
/// };
/// \endcode
///
/// A cycle of such a node allocates no memory, unless step() does.
///
/// \threadsafe no: step(), outputs(), update() and safeState() run on the cycle thread (outputs()
///     and safeState() also in the thread of the object, while no cycle runs). Call everything else
///     in the thread of the object, while no cycle runs
///
/// \ingroup nodes
class QTPLC_EXPORT QPlcCompactSlaveNode : public QPlcSlaveNode
{
    Q_OBJECT
public:
    /// Makes a node that is not connected.
    /// \param name  under which the node registers; unique at its master
    /// \param policy  what the master does when an answer is late
    /// \param parent  owns the node, if given
    explicit QPlcCompactSlaveNode(const QString &name, RealTimeViolationPolicy policy = ErrorZeroOrderHold,
                                  QObject *parent = nullptr);
    /// Ends the cycles of the node with a warning if they still run; safeState() is not called
    /// then. Call disconnectFromMaster() before.
    ~QPlcCompactSlaveNode() override;

    /// Sets whether the node sends the quality of each output (QPlcOutput::setQuality()) with its
    /// value, which costs a byte per output and cycle. Use it for sensors that may have no value.
    /// Default off. The registration fails at a master that does not support it.
    /// \pre the node is not registered
    void setSendsQuality(bool sends);
    /// Returns true if the node sends the quality of each output.
    bool sendsQuality() const;

protected:
    /// Called at each registration, before the ports are compared with the table. Make ports here
    /// whose names follow from the table. An exception ends the registration with its text. The
    /// default does nothing.
    /// \param table  the signal table that the node uses
    virtual void declarePorts(const QPlcSignalTable &table) { Q_UNUSED(table) }
    /// Brings the node into its initial state and sets its outputs. Called in the thread of the
    /// object at each initialization, and when the node joins cycles that run. The default calls
    /// compactInitializeOutputSignals().
    virtual void reset() { compactInitializeOutputSignals(); }
    /// Called in the thread of the object when the inputs have their initial values, after reset()
    /// of all nodes.
    virtual void initialized() {}
    /// Computes one cycle: reads the inputs, sets the outputs. Called on the cycle thread. It has
    /// to end within the period; it must not wait and should not allocate. An exception is a fault
    /// of the node. The default calls compactRealTimeout().
    virtual void step(const QPlcCycle &cycle)
    {
        Q_UNUSED(cycle)
        compactRealTimeout();
    }

    /// Two-phase node: sets the outputs from the state alone, without reading inputs. Called after
    /// reset() and after each update().
    virtual void outputs() {}
    /// Two-phase node: moves the state on by one cycle with the inputs of that cycle. Called
    /// instead of step().
    virtual void update(const QPlcCycle &cycle) { Q_UNUSED(cycle) }

    // The names of the thesis; reset() and step() call them unless overridden.
    /// Does what reset() does; the name of the thesis. Not called if reset() is overridden.
    virtual void compactInitializeOutputSignals() {}
    /// Does what step() does; the name of the thesis. Not called if step() is overridden.
    virtual void compactRealTimeout() {}

private:
    friend class QPlcPort;
    class Q_DECL_HIDDEN PortCode;
    void add(QPlcPort *port);
    void remove(const QPlcPort *port);

    PortCode *const m_code;  // owned by the base class
};
