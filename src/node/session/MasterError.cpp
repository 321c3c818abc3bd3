// SPDX-License-Identifier: Apache-2.0
#include "MasterError.h"

#include "node/cycle/NodeRegistry.h"

#include <utility>

namespace qplc {

namespace {

/// What an error of the master is about.
JournalEvent::Kind kindOf(QPlcMasterNode::Error error)
{
    switch (error) {
    case QPlcMasterNode::SignalError:
        return JournalEvent::Set;
    case QPlcMasterNode::NodeError:
        return JournalEvent::Node;
    case QPlcMasterNode::InitializationError:
        return JournalEvent::Fault;
    default:
        return JournalEvent::State;
    }
}

}  // namespace

MasterError::MasterError(Journal &journal, std::function<void(QPlcMasterNode::Error)> heard)
    : m_journal(journal)
    , m_heard(std::move(heard))
{
}

bool MasterError::clear()
{
    m_value = QPlcMasterNode::NoError;
    m_text.clear();
    return true;
}

bool MasterError::set(QPlcMasterNode::Error value, const QString &text)
{
    return set(value, text, NodeRegistry::masterName(), kindOf(value));
}

bool MasterError::set(QPlcMasterNode::Error value, const QString &text, const QString &source, JournalEvent::Kind kind)
{
    m_value = value;
    m_text = text;
    const auto severity = value == QPlcMasterNode::StateError ? JournalEvent::Warning : JournalEvent::Error;
    if (kind == JournalEvent::Fault)
        m_journal.raise(QStringLiteral("fault of ") + source, severity, kind, source, text);
    else
        m_journal.tell(severity, kind, source, text);
    m_heard(value);
    return false;
}

}  // namespace qplc
