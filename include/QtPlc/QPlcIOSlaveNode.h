// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcQuality.h"
#include "QPlcSlaveNode.h"

#include <memory>

/// A node whose outputs are set from outside, at any time, and answered with at once: what people, files and other programs write into a plant.
///
/// ```cpp
/// QPlcIOSlaveNode node("Operator");
/// node.setOutputSignalIndices(indices);          // before it connects
/// node.connectToMaster(master);
/// ...
/// node.setOutputSignals(values);                 // whenever there is something new
/// ```
///
/// Threads: all functions in the thread of the object; inputSignals() in any.
class QTPLC_EXPORT QPlcIOSlaveNode : public QPlcSlaveNode
{
    Q_OBJECT
public:
    explicit QPlcIOSlaveNode(const QString &name, RealTimeViolationPolicy policy = SilentZeroOrderHold,
                             QObject *parent = nullptr);
    ~QPlcIOSlaveNode() override;

    QPlcSignalIndexList inputSignalIndices() const;
    QPlcSignalIndexList outputSignalIndices() const;
    /// The newest inputs; empty before the first. \threadsafe yes
    QPlcSignalList inputSignals() const;
    /// Quality of the newest value of an input; Invalid before the first, and for a signal that is no input. \threadsafe yes
    QPlcQuality inputQuality(QPlcSignalIndex signal) const;

public Q_SLOTS:
    /// Signals that the node wants. A connected node registers again.
    void setInputSignalIndices(const QPlcSignalIndexList &indices);
    /// Signals that the node writes. A connected node registers again.
    void setOutputSignalIndices(const QPlcSignalIndexList &indices);
    /// Values that the outputs have at the begin of the next phase; those left out begin as they are.
    void setInitialOutputSignals(const QPlcSignalList &signalList);
    /// New values of outputs; those left out stay. Signals that are not outputs of this node are ignored with a warning.
    void setOutputSignals(const QPlcSignalList &signalList);

protected:
    /// Makes all signals of the table of the node inputs, whatever the table of the process is;
    /// setInputSignalIndices() has no effect then, and there are no outputs. \pre not connected
    void readAllSignals();

    class Code;
    /// For nodes of this library that do more with the frames.
    QPlcIOSlaveNode(const QString &name, RealTimeViolationPolicy policy, std::unique_ptr<Code> code, QObject *parent);

private:
    void registerAgain();

    Code *const m_code;  // owned by the base class
};
