// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "node/cycle/NodeRegistry.h"
#include "node/session/NodeSession.h"

class QPlcMasterNode;
class QPlcSlaveNodePrivate;

namespace qplc {

/// A node in the process of its master: without messages and frames, so each request is answered at
/// once.
///
/// The program may remove the node whenever it hears of a new state; the node is left alone from
/// then on.
class LocalNode final : public NodeSession
{
public:
    /// Compares the signals of \a node with \a table. \return false, with the reason in \a error
    static bool bind(QPlcSlaveNodePrivate &node, const QPlcSignalTable &table, QString *error);
    /// What \a node says of itself. \pre it is bound
    static NodeDeclaration declarationOf(const QPlcSlaveNodePrivate &node);

    /// From now on the cycles that use \a slot call \a node.
    LocalNode(QPlcSlaveNodePrivate &node, std::shared_ptr<NodeSlot> slot);
    /// It belongs to \a master from now on.
    void join(QPlcMasterNode *master);

    std::optional<Answer> askOutputs(std::optional<quint64> phase) override;
    std::optional<Answer> giveInputs(const QByteArray &values) override;
    std::optional<Answer> start(const messages::RealTimeStarted &start) override;
    void cyclesStarted(QPlcProfile::Value profile) override;
    void cancel(const QString &reason, bool isStarting) override;
    void stop(const QString &reason) override;
    void tellSafe() override;
    void drop(const QString &) override {}
    void leave() override;

    const QPlcSlaveNode *object() const override;
    QPlcSlaveNode::State state() const override;
    QString codeFailed() override;
    QString transportName() const override { return inProcess(); }
    QString address() const override { return {}; }

private:
    QPlcSlaveNodePrivate &m_node;
    bool m_hasLeft = false;
};

}  // namespace qplc
