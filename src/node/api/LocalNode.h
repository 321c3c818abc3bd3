// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcProfile.h"
#include "node/cycle/NodeSlot.h"

#include <QtCore/QByteArray>
#include <QtCore/QString>

#include <memory>

class QPlcMasterNode;
class QPlcSlaveNodePrivate;

namespace qplc {

/// A node in the process of its master, as the sequences of the master see it: a session without
/// messages and frames, in which each call is answered at once. Its slot is what the cycles see.
///
/// Thread of the master. The program may remove the node whenever it hears of a new state; the node is
/// left alone from then on.
class LocalNode
{
public:
    explicit LocalNode(QPlcSlaveNodePrivate &node);

    /// Compares the signals of the node with \a table. \return false, with the reason in \a error
    bool bind(const QPlcSignalTable &table, QString *error);
    const NodeRuntime &runtime() const;
    QPlcSlaveNode::State state() const;
    /// It belongs to \a master from now on, and its cycles use \a slot.
    void join(QPlcMasterNode *master, const std::shared_ptr<NodeSlot> &slot);
    void leave();
    bool hasLeft() const { return m_hasLeft; }
    const std::shared_ptr<NodeSlot> &slot() const { return m_slot; }

    /// Brings it into its initial state: the outputs of its runtime are the initial ones.
    /// \return false, with the reason in \a error, when its code threw
    bool askOutputs(QString *error);
    /// \return false, with the reason in \a error, when its code threw
    bool giveInputs(const QByteArray &values, QString *error);
    void initializationFailed();
    /// A real-time phase begins, and ends.
    void start(QPlcProfile::Value profile);
    void stop();
    void tellSafeStop();
    /// Its code threw in a cycle. \return what
    QString codeFailed();

private:
    QPlcSlaveNodePrivate &m_node;
    std::shared_ptr<NodeSlot> m_slot;
    bool m_hasLeft = false;
};

}  // namespace qplc
