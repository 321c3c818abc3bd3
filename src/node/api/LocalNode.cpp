// SPDX-License-Identifier: Apache-2.0
#include "LocalNode.h"

#include "QPlcSlaveNodePrivate.h"

namespace qplc {

bool LocalNode::bind(QPlcSlaveNodePrivate &node, const QPlcSignalTable &table, QString *error)
{
    return node.runtime.bind(table, error);
}

NodeDeclaration LocalNode::declarationOf(const QPlcSlaveNodePrivate &node)
{
    return NodeDeclaration::fromRuntime(node.runtime);
}

LocalNode::LocalNode(QPlcSlaveNodePrivate &node, std::shared_ptr<NodeSlot> slot)
    : NodeSession(std::move(slot), Answers::AtOnce)
    , m_node(node)
{
    this->slot()->local = &m_node.runtime;
}

void LocalNode::join(QPlcMasterNode *master)
{
    m_node.localMaster = master;
    m_node.hasChannel = true;
    m_node.apply(SlaveEvent::AddedLocally);
    m_node.events.masterCame();
}

void LocalNode::leave()
{
    m_hasLeft = true;
    m_node.localMaster.clear();
    m_node.hasChannel = false;
    m_node.apply(SlaveEvent::Leave);
}

std::optional<NodeSession::Answer> LocalNode::askOutputs(std::optional<quint64>)
{
    QString fault;
    m_node.apply(SlaveEvent::OutputsWanted);
    if (m_hasLeft)
        return Answer{QStringLiteral("it has left")};
    if (m_node.runtime.reset(&fault))
        return Answer{QString(), QByteArray(m_node.runtime.outputs(), int(slot()->outputLayout.size()))};
    m_node.apply(SlaveEvent::CodeFailed);
    return Answer{fault};
}

std::optional<NodeSession::Answer> LocalNode::giveInputs(const QByteArray &values)
{
    QString fault;
    if (!m_node.runtime.initialize(values.constData(), &fault)) {
        m_node.apply(SlaveEvent::CodeFailed);
        return Answer{fault};
    }
    m_node.apply(SlaveEvent::ValuesCame);
    if (!m_hasLeft)
        m_node.tellInitialized();
    return Answer{};
}

std::optional<NodeSession::Answer> LocalNode::start(const messages::RealTimeStarted &)
{
    return Answer{};
}

void LocalNode::cyclesStarted(QPlcProfile::Value profile)
{
    m_node.phaseProfile = profile;
    m_node.apply(SlaveEvent::PhaseStarted);
    if (!m_hasLeft)
        Q_EMIT m_node.q->realTimeHasStarted();
}

void LocalNode::cancel(const QString &, bool)
{
    setStage(Idle);
    if (!m_hasLeft)
        m_node.apply(SlaveEvent::InitializationFailed);
}

void LocalNode::stop(const QString &)
{
    setStage(Idle);
    if (m_hasLeft)
        return;
    m_node.makeSafe(QPlcSlaveNode::PhaseEnded);
    if (m_hasLeft)
        return;
    m_node.runtime.stopped();
    m_node.apply(SlaveEvent::PhaseStopped);
    if (!m_hasLeft)
        Q_EMIT m_node.q->realTimeHasStopped();
}

void LocalNode::tellSafe()
{
    if (m_hasLeft)
        return;
    m_node.apply(SlaveEvent::ToldSafeStop);
    if (!m_hasLeft)
        m_node.tellSafe(QPlcSlaveNode::MasterStopsSafely);
}

const QPlcSlaveNode *LocalNode::object() const
{
    return m_node.q;
}

QPlcSlaveNode::State LocalNode::state() const
{
    return m_node.state;
}

QString LocalNode::codeFailed()
{
    const QString text = QString::fromLocal8Bit(m_node.runtime.faultText());
    m_node.apply(SlaveEvent::CodeFailed);
    return text;
}

}  // namespace qplc
