// SPDX-License-Identifier: Apache-2.0
#include "LocalNode.h"

#include "QPlcSlaveNodePrivate.h"

namespace qplc {

LocalNode::LocalNode(QPlcSlaveNodePrivate &node)
    : m_node(node)
{
}

bool LocalNode::bind(const QPlcSignalTable &table, QString *error)
{
    return m_node.runtime.bind(table, error);
}

const NodeRuntime &LocalNode::runtime() const
{
    return m_node.runtime;
}

QPlcSlaveNode::State LocalNode::state() const
{
    return m_node.state;
}

void LocalNode::join(QPlcMasterNode *master, const std::shared_ptr<NodeSlot> &slot)
{
    m_slot = slot;
    m_slot->local = &m_node.runtime;
    m_node.localMaster = master;
    m_node.hasChannel = true;
    m_node.apply(SlaveEvent::AddedLocally);
}

void LocalNode::leave()
{
    m_hasLeft = true;
    m_node.localMaster.clear();
    m_node.hasChannel = false;
    m_node.apply(SlaveEvent::Leave);
}

bool LocalNode::askOutputs(QString *error)
{
    m_node.apply(SlaveEvent::OutputsWanted);
    if (m_hasLeft) {
        *error = QStringLiteral("it has left");
        return false;
    }
    if (m_node.runtime.reset(error))
        return true;
    m_node.apply(SlaveEvent::CodeFailed);
    return false;
}

bool LocalNode::giveInputs(const QByteArray &values, QString *error)
{
    if (!m_node.runtime.initialize(values.constData(), error)) {
        m_node.apply(SlaveEvent::CodeFailed);
        return false;
    }
    m_node.apply(SlaveEvent::ValuesCame);
    if (!m_hasLeft)
        m_node.tellInitialized();
    return true;
}

void LocalNode::initializationFailed()
{
    if (!m_hasLeft)
        m_node.apply(SlaveEvent::InitializationFailed);
}

void LocalNode::start(QPlcProfile::Value profile)
{
    m_node.phaseProfile = profile;
    m_node.apply(SlaveEvent::PhaseStarted);
    if (!m_hasLeft)
        Q_EMIT m_node.q->realTimeHasStarted();
}

void LocalNode::stop()
{
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

void LocalNode::tellSafeStop()
{
    if (m_hasLeft)
        return;
    m_node.apply(SlaveEvent::ToldSafeStop);
    if (!m_hasLeft)
        m_node.tellSafe(QPlcSlaveNode::MasterStopsSafely);
}

QString LocalNode::codeFailed()
{
    const QString text = QString::fromLocal8Bit(m_node.runtime.faultText());
    m_node.apply(SlaveEvent::CodeFailed);
    return text;
}

}  // namespace qplc
