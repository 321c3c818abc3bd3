// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcBoundInput.h"
#include "QPlcBoundOutput.h"
#include "QPlcCompactSignal.h"
#include "QPlcInput.h"
#include "QPlcOutput.h"
#include "QPlcSlaveNode.h"

/// A node whose inputs and outputs are variables: ports that are set before step() and sent after it.
///
/// ```cpp
/// class Winch : public QPlcCompactSlaveNode
/// {
/// public:
///     Winch() : QPlcCompactSlaveNode(QStringLiteral("Winch")) {}
/// private:
///     QPlcInput<double>  m_tetherSpeed {this, "tetherSpeed"};   // [m/s], > 0 reels out
///     QPlcOutput<double> m_tetherLength{this, "tetherLength"};  // [m]
///     void reset() override { m_tetherLength = 300.0; }
///     void step(const QPlcCycle &cycle) override { m_tetherLength = m_tetherLength + m_tetherSpeed * cycle.dt(); }
/// };
/// ```
///
/// With setTwoPhase(true) outputs() and update() take the place of step():
///
/// ```cpp
/// void outputs() override { m_level = m_volume / area; }                                      // [m]
/// void update(const QPlcCycle &cycle) override { m_volume += m_inflow * cycle.dt(); }         // [m^3]
/// ```
///
/// A cycle of such a node allocates nothing, whatever the ports, unless step() does.
/// Threads: step() on the cycle thread; everything else in the thread of the object, while no cycle runs.
class QTPLC_EXPORT QPlcCompactSlaveNode : public QPlcSlaveNode
{
    Q_OBJECT
public:
    explicit QPlcCompactSlaveNode(const QString &name, RealTimeViolationPolicy policy = ErrorZeroOrderHold,
                                  QObject *parent = nullptr);
    ~QPlcCompactSlaveNode() override;

    /// Lets the node say how far each of its outputs can be trusted (QPlcOutput::setQuality()), at the price of a byte for each: for what measures, and may have nothing to
    /// tell. A master that does not know of this is refused. \pre not connected
    void setSendsQuality(bool sends);
    bool sendsQuality() const;

protected:
    /// Brings the node into its initial state and sets its outputs. Called before every real-time phase, and at a join.
    virtual void reset() { compactInitializeOutputSignals(); }
    /// The inputs have their initial values now.
    virtual void initialized() {}
    /// One cycle: inputs are set; set the outputs.
    virtual void step(const QPlcCycle &cycle)
    {
        Q_UNUSED(cycle)
        compactRealTimeout();
    }

    /// Two-phase node (setTwoPhase()): sets the outputs out of the state alone; called after reset() and after each update().
    virtual void outputs() {}
    /// Two-phase node: inputs are set; moves the state on. step() is not called.
    virtual void update(const QPlcCycle &cycle) { Q_UNUSED(cycle) }

    // The same under the names of the first QtPLC; reset() and step() call them unless overridden.
    virtual void compactInitializeOutputSignals() {}
    virtual void compactRealTimeout() {}

private:
    friend class QPlcPort;
    class PortCode;
    void add(QPlcPort *port);
    void remove(const QPlcPort *port);

    PortCode *const m_code;  // owned by the base class
};
