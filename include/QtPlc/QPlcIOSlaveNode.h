// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcQuality.h"
#include "QPlcSlaveNode.h"

#include <memory>

/// A node without code of its own: a program, a window or a file sets its outputs at any time, and
/// reads its inputs at any time.
///
/// \code
/// QPlcSignalIndexList outputs;
/// outputs.insert("tetherSpeed");
/// QPlcIOSlaveNode node("Operator");
/// node.setOutputSignalIndices(outputs);
/// node.connectToMaster(QPlcUnderlyingProtocol::automatic(QHostAddress::LocalHost));
///
/// QPlcSignalList values;
/// values.insert("tetherSpeed", 2.5);
/// node.setOutputSignals(values);  // whenever there is something new
/// \endcode
///
/// The node answers each cycle at once with the newest outputs. It receives the quality of its
/// inputs unless you call setReceivesQuality(false).
///
/// \threadsafe inputSignals() and inputQuality() are; call all other functions in the thread of the
///     object
///
/// \ingroup nodes
class QTPLC_EXPORT QPlcIOSlaveNode : public QPlcSlaveNode
{
    Q_OBJECT
public:
    /// Makes a node that is not connected and has no signals.
    /// \param name  under which the node registers; unique at its master
    /// \param policy  what the master does when an answer is late
    /// \param parent  owns the node, if given
    explicit QPlcIOSlaveNode(const QString &name, RealTimeViolationPolicy policy = SilentZeroOrderHold,
                             QObject *parent = nullptr);
    /// Disconnects from the master.
    ~QPlcIOSlaveNode() override;

    /// Returns the signals that the node reads.
    QPlcSignalIndexList inputSignalIndices() const;
    /// Returns the signals that the node writes.
    QPlcSignalIndexList outputSignalIndices() const;
    /// Returns the newest inputs; an empty list before the first ones came.
    /// \threadsafe yes
    QPlcSignalList inputSignals() const;
    /// Returns the quality of the newest value of an input; Invalid before the first value, and for
    /// a signal that is not an input of this node.
    /// \threadsafe yes
    QPlcQuality inputQuality(QPlcSignalIndex signal) const;

public Q_SLOTS:
    /// Sets the signals that the node reads. A connected node disconnects and registers again. A
    /// node in the process of its master keeps its signals and warns: remove it there and add it
    /// again.
    void setInputSignalIndices(const QPlcSignalIndexList &indices);
    /// Sets the signals that the node writes, by the rules of setInputSignalIndices(). No other
    /// node may write them, unless the signal table names several writers.
    void setOutputSignalIndices(const QPlcSignalIndexList &indices);
    /// Sets the values that the outputs have when the next phase begins. Does the same as
    /// setOutputSignals().
    void setInitialOutputSignals(const QPlcSignalList &signalList);
    /// Sets new values of outputs; outputs that are not in the list keep theirs. The node sends
    /// them with its next answer. A signal that is not an output of this node, and a value that
    /// does not fit the type of its signal, cause a warning and change nothing.
    void setOutputSignals(const QPlcSignalList &signalList);

protected:
    /// Makes all signals of the signal table of this node its inputs, whatever the table of the
    /// process is. setInputSignalIndices() has no effect then, and the node has no outputs.
    /// \pre the node is not registered
    void readAllSignals();

    class Q_DECL_HIDDEN Code;
    /// Makes a node with other code for its frames. Only for kinds of nodes of this library.
    QPlcIOSlaveNode(const QString &name, RealTimeViolationPolicy policy, std::unique_ptr<Code> code, QObject *parent);

private:
    Q_DECL_HIDDEN void registerAgain();

    Code *const m_code;  // owned by the base class
};
