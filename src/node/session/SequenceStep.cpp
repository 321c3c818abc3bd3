// SPDX-License-Identifier: Apache-2.0
#include "SequenceStep.h"

#include <algorithm>
#include <iterator>

namespace qplc {

EventLoopTimer::EventLoopTimer()
{
    m_timer.setSingleShot(true);
    m_timer.setInterval(2000);
    QObject::connect(&m_timer, &QTimer::timeout, &m_timer, [this] { elapse(); });
}

void EventLoopTimer::elapse()
{
    m_timer.stop();
    const std::function<void()> timedOut = m_timedOut;  // it may begin another step
    timedOut();
}

void EventLoopTimer::start(std::function<void()> timedOut)
{
    m_timedOut = std::move(timedOut);
    m_timer.start();
}

QString noAnswerText(NodeSession::Stage stage, std::chrono::milliseconds time, const NodeSessions::List &silent)
{
    QStringList names;
    for (const auto &node : silent)
        names << QStringLiteral("'%1'").arg(node->name());
    const QPlcMessage::Kind what = stage == NodeSession::Starting ? QPlcMessage::RealTimeStarted
        : stage == NodeSession::GivingOutputs                     ? QPlcMessage::SendYourInitialOutputStates
                                                                  : QPlcMessage::InitializeWithValues;
    return QStringLiteral("no answer to %1 within %2 ms from node %3; is it busy, or stopped?")
        .arg(QPlcMessage::kindName(what))
        .arg(time.count())
        .arg(names.join(QStringLiteral(", ")));
}

SequenceStep::SequenceStep(StepTimer &timer)
    : m_timer(timer)
{
}

quint64 SequenceStep::begin(Kind kind, const NodeSessions::List &nodes, std::function<void(const QString &)> timedOut)
{
    m_kind = kind;
    m_nodes = nodes;
    for (const auto &node : m_nodes) {
        node->setStage(NodeSession::Stage(owed() - 1));
        node->setFailed(node->hasFailed() && kind != CollectOutputs);
    }
    m_timer.start([this, tell = std::move(timedOut)] { elapsed(tell); });
    return ++m_number;
}

void SequenceStep::elapsed(const std::function<void(const QString &)> &timedOut)
{
    NodeSessions::List silent;
    std::copy_if(m_nodes.begin(), m_nodes.end(), std::back_inserter(silent),
                 [this](const auto &node) { return node->stage() < owed(); });
    const QString text = noAnswerText(NodeSession::Stage(owed() - 1), m_timer.length(), silent);
    timedOut(text);
    for (const auto &node : silent)
        node->drop(text);
}

/// The stage that a node reaches by its answer.
NodeSession::Stage SequenceStep::owed() const
{
    return m_kind == CollectOutputs ? NodeSession::OutputsGiven
        : m_kind == Start           ? NodeSession::Running
                                    : NodeSession::Initialized;
}

void SequenceStep::answered(NodeSession &node) const
{
    node.setStage(owed());
}

bool SequenceStep::complete()
{
    const auto isThere = [this](const auto &node) { return node->stage() >= owed(); };
    if (!isUnderWay() || !std::all_of(m_nodes.begin(), m_nodes.end(), isThere))
        return false;
    m_timer.stop();
    return true;
}

bool SequenceStep::leave(const NodeSession &node)
{
    const auto isIt = [&](const auto &other) { return other.get() == &node; };
    const auto found = std::find_if(m_nodes.begin(), m_nodes.end(), isIt);
    if (found == m_nodes.end())
        return false;
    m_nodes.erase(found);
    return isUnderWay();
}

void SequenceStep::end()
{
    m_timer.stop();
    m_kind = None;
    m_nodes.clear();
}

}  // namespace qplc
