// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "IndexListCode.h"
#include "QPlcIOSlaveNode.h"
#include "realtime/ByteRing.h"
#include "realtime/SnapshotBuffer.h"
#include "signals/PayloadLayout.h"

#include <memory>
#include <mutex>
#include <vector>

/// The code of a node whose values come from outside: takes the newest outputs, and publishes the
/// inputs.
class QPlcIOSlaveNode::Code : public qplc::IndexListCode
{
public:
    explicit Code(QPlcIOSlaveNode &ioNode)
        : node(ioNode)
    {
    }

    bool declare(const QPlcSignalTable &table, Declaration *declaration, QString *error) override;
    QPlcSignalIndexList inputList() override { return inputIndices; }
    QPlcSignalIndexList outputList() override { return outputIndices; }
    void bind(const QPlcSignalTable &table, const qplc::PayloadLayout &inputs,
              const qplc::PayloadLayout &outputs) override;
    void reset(char *outputs) override;
    void initialize(const char *inputs) override { newInputs->publish(inputs, 0); }
    void step(const QPlcCycle &cycle, const char *inputs, char *outputs) override;
    void makeSafe(SafeStateReason reason, const char *) override { node.safeState(reason); }
    void stopped() override { node.stopped(); }

    /// Writes the wanted values into the outputs, and passes them on.
    void writeOutputs();
    void passOutputs();

    QPlcIOSlaveNode &node;
    bool readsAll = false;
    QPlcSignalIndexList inputIndices;
    QPlcSignalIndexList outputIndices;
    QPlcSignalList wanted;  // newest value of every output that was ever set

    // made at registration
    mutable std::mutex layoutMutex;  // not for the cycle thread: layouts change only while no cycle runs
    qplc::PayloadLayout inputLayout;
    qplc::PayloadLayout outputLayout;
    std::vector<char> payload;                        // of `wanted`
    std::unique_ptr<qplc::ByteRing> newOutputs;       // owner -> cycle thread
    std::unique_ptr<qplc::SnapshotBuffer> newInputs;  // cycle thread -> anyone
    bool mustPass = false;                            // the payload found the ring full
};
