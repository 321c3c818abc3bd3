// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodeSessions.h"

#include <QtCore/QTimer>

#include <chrono>
#include <functional>

namespace qplc {

/// Lets a step wait for a limited time.
class StepTimer
{
public:
    virtual ~StepTimer() = default;
    /// Calls \a timedOut once after length(), unless it is stopped or started again before.
    virtual void start(std::function<void()> timedOut) = 0;
    virtual void stop() = 0;
    virtual std::chrono::milliseconds length() const = 0;
};

/// In the event loop of Qt.
class EventLoopTimer final : public StepTimer
{
public:
    EventLoopTimer();
    void setLength(std::chrono::milliseconds length) { m_timer.setInterval(length); }

    void start(std::function<void()> timedOut) override;
    void stop() override { m_timer.stop(); }
    std::chrono::milliseconds length() const override { return m_timer.intervalAsDuration(); }
    bool isActive() const { return m_timer.isActive(); }
    /// The time is over.
    void elapse();

private:
    QTimer m_timer;
    std::function<void()> m_timedOut;
};

/// That \a silent did not give the answer that leads from \a stage to the next one.
QString noAnswerText(NodeSession::Stage stage, std::chrono::milliseconds time, const NodeSessions::List &silent);

/// The step at hand of the sequences that all nodes go through together: every node that is waited
/// for owes one answer, and the next step begins when all have given it. There is one such sequence
/// at a time.
class SequenceStep
{
public:
    enum Kind : quint8 { None, CollectOutputs, DistributeInputs, Start };

    explicit SequenceStep(StepTimer &timer);

    /// Each of \a nodes now owes the answer of this step.
    /// \param timedOut  called with a sentence when some of them do not give it in time; then they
    ///         are dropped, so that the next sequence does not wait for them
    /// \return the number of the step, for isStill()
    quint64 begin(Kind kind, const NodeSessions::List &nodes, std::function<void(const QString &)> timedOut);
    Kind kind() const { return m_kind; }
    bool isUnderWay() const { return m_kind != None; }
    /// Whether this step has neither ended nor been followed by another one: who calls code of a
    /// program asks it then.
    bool isStill(quint64 number) const { return isUnderWay() && m_number == number; }
    quint64 number() const { return m_number; }

    const NodeSessions::List &nodes() const { return m_nodes; }
    /// \a node has given its answer.
    void answered(NodeSession &node) const;
    /// Stops the time when nobody owes an answer any more. \return whether it is so
    bool complete();
    /// \return whether the step has waited for \a node
    bool leave(const NodeSession &node);
    void end();

private:
    NodeSession::Stage owed() const;
    void elapsed(const std::function<void(const QString &)> &timedOut);

    StepTimer &m_timer;
    Kind m_kind = None;
    quint64 m_number = 0;  // of those that have begun
    NodeSessions::List m_nodes;
};

}  // namespace qplc
