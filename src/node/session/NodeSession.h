// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcProfile.h"
#include "node/cycle/NodeSlot.h"
#include "protocol/messages/MessageTable.h"

#include <memory>
#include <optional>

namespace qplc {

/// One node as the sequences of a master see it, from the moment it can be initialized until it
/// leaves.
///
/// The master asks for one thing after the other. A node over a network answers later, by a
/// message. A node in the process of the master answers at once. Both are asked in the same way.
///
/// Thread of the master. A program may remove its node whenever it hears of a new state: sequences
/// hold shared pointers, and a session that has left does nothing.
class NodeSession : public std::enable_shared_from_this<NodeSession>
{
public:
    /// How far the node has come; each step is an answer that the master waits for.
    enum Stage : quint8 {
        Idle,
        GivingOutputs,  ///< askOutputs() is under way
        OutputsGiven,
        Initializing,  ///< giveInputs() is under way
        Initialized,
        Starting,  ///< start() is under way
        Running    ///< answers cycles
    };
    /// Transport of a node in the process of the master.
    static QString inProcess() { return QStringLiteral("inprocess"); }

    enum class Answers : quint8 { Later, AtOnce };

    /// What a node says to a request.
    struct Answer
    {
        QString fault;         // empty: done
        QByteArray outputs{};  // to askOutputs()
    };

    NodeSession(std::shared_ptr<NodeSlot> slot, Answers answers);
    virtual ~NodeSession();
    NodeSession(const NodeSession &) = delete;
    NodeSession &operator=(const NodeSession &) = delete;

    const std::shared_ptr<NodeSlot> &slot() const { return m_slot; }
    const QString &name() const { return m_slot->name; }
    bool isListener() const { return m_slot->listener; }
    bool answersAtOnce() const { return m_answers == Answers::AtOnce; }
    /// Whether the others wait for it in an initialization and a start.
    bool isAwaited() const { return answersAtOnce() || !isListener(); }

    Stage stage() const { return m_stage; }
    void setStage(Stage stage)
    {
        m_stage = stage;
        m_wasSeen = false;
    }
    /// Whether the master waits for an answer.
    bool owesAnswer() const { return m_stage == GivingOutputs || m_stage == Initializing || m_stage == Starting; }
    /// Whether a message of \a kind is the answer that the master waits for.
    bool owes(QPlcMessage::Kind kind) const;
    /// Whether somebody who looked before has seen it in this stage.
    bool wasSeen() const { return m_wasSeen; }
    void setSeen() { m_wasSeen = true; }
    /// Whether its code has failed since it was initialized last.
    bool hasFailed() const { return m_hasFailed; }
    void setFailed(bool failed) { m_hasFailed = failed; }

    // ---- requests; no answer: it comes later ----
    /// Asks for the initial outputs.
    /// \param phase number of cycle 0 of a phase that is under way: a node that took part in it may
    ///         go on
    virtual std::optional<Answer> askOutputs(std::optional<quint64> phase) = 0;
    virtual std::optional<Answer> giveInputs(const QByteArray &values) = 0;
    /// Tells it to be ready for the cycles of a phase.
    virtual std::optional<Answer> start(const messages::RealTimeStarted &start) = 0;

    // ---- news ----
    /// All nodes were ready, and the cycles run.
    virtual void cyclesStarted(QPlcProfile::Value profile) = 0;
    /// The initialization or the start of all nodes has ended early.
    virtual void cancel(const QString &reason, bool isStarting) = 0;
    /// The phase is over.
    virtual void stop(const QString &reason) = 0;
    /// The master stops safely.
    virtual void tellSafe() = 0;
    /// Ends the registration of a node that answers later.
    virtual void drop(const QString &reason) = 0;
    /// It belongs to the master no more, and is not asked or told anything.
    virtual void leave() = 0;

    /// The node itself, in this process; null: it is in another one.
    virtual const QPlcSlaveNode *object() const { return nullptr; }

    // ---- for people ----
    /// State of the node, as far as the master knows.
    virtual QPlcSlaveNode::State state() const = 0;
    /// The cycle has seen its code fail. \return how
    virtual QString codeFailed() = 0;
    virtual QString transportName() const = 0;
    /// Whether it uses this transport because another one does not get through.
    virtual bool usesFallback() const { return false; }
    /// Empty: in this process.
    virtual QString address() const = 0;
    /// That it has proven; empty: none.
    virtual QString identity() const { return {}; }

private:
    const std::shared_ptr<NodeSlot> m_slot;
    const Answers m_answers;
    Stage m_stage = Idle;
    bool m_wasSeen = false;
    bool m_hasFailed = false;
};

}  // namespace qplc
