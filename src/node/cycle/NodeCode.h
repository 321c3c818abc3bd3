// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ListeningInterval.h"
#include "QPlcSlaveNode.h"

#include <QtCore/QString>
#include <QtCore/QVector>

namespace qplc {

/// What a node is to its master, as its program has set it.
struct NodeTraits
{
    static constexpr int LongestName = 64;  // [characters]
    QString name;
    QPlcSlaveNode::RealTimeViolationPolicy policy = QPlcSlaveNode::ErrorZeroOrderHold;
    bool listener = false;
    bool critical = false;
    ListeningInterval interval;
    bool sameCycle = false;  // all inputs
    bool twoPhase = false;
    bool quality = false;        // wants the qualities of its inputs
    bool outputQuality = false;  // gives the qualities of its outputs
    bool hardware = false;       // drives real devices
};

/// What a node program is to NodeRuntime: the signals that it declares, and functions that work on
/// the bytes of frames.
///
/// A kind of node (lists, ports, values from outside) is an implementation of it; the program is
/// called from there. NodeRuntime says when, and catches what is thrown. Frames hold values one
/// behind the other, as the layouts of bind() say, and then their qualities.
///
/// Threads: step() and makeSafe() on the cycle thread; everything else in the thread of the node,
/// while no cycle runs.
class NodeCode
{
public:
    struct Declaration
    {
        QVector<QPlcSignalIndex> inputs;
        QVector<QPlcSignalIndex> outputs;
        QVector<QPlcSignalIndex> sameCycle;  // of the inputs
    };

    NodeCode() = default;
    virtual ~NodeCode() = default;
    NodeCode(const NodeCode &) = delete;
    NodeCode &operator=(const NodeCode &) = delete;

    /// Whether it declares a same-cycle input. Asked before there is a table.
    virtual bool declaresSameCycle() = 0;
    /// Looks its signals up in \a table. \return false, with all that does not fit in \a error
    virtual bool declare(const QPlcSignalTable &table, Declaration *declaration, QString *error) = 0;
    /// Frames will have these layouts, in the order of the declaration; NodeRuntime may add outputs
    /// behind.
    virtual void bind(const QPlcSignalTable &table, const PayloadLayout &inputs, const PayloadLayout &outputs) = 0;
    /// Brings the program into its initial state. \a outputs holds the initial values of the table.
    virtual void reset(char *outputs) = 0;
    virtual void initialize(const char *inputs) = 0;
    /// One cycle. \a outputs holds those of the last one.
    virtual void step(const QPlcCycle &cycle, const char *inputs, char *outputs) = 0;
    virtual void makeSafe(QPlcSlaveNode::SafeStateReason reason, const char *safeInputs) = 0;
    /// The phase has ended.
    virtual void stopped() = 0;
};

}  // namespace qplc
