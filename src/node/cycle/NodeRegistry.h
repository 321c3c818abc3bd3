// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodeSlot.h"
#include "QPlcSignalTable.h"
#include "protocol/messages/Registration.h"

#include <QtCore/QStringList>
#include <QtCore/QVector>

#include <algorithm>
#include <memory>

namespace qplc {

/// What a node says of itself when it registers.
struct NodeDeclaration : NodeTraits
{
    std::vector<messages::DeclaredSignal> inputs;
    std::vector<messages::DeclaredSignal> outputs;
    /// That the node has set itself, and that leads to its safe state. 0: it has none; not set: the
    /// one of the profile.
    std::optional<std::chrono::nanoseconds> watchdog;

    /// Whether the cycle has an order because of this node.
    bool isOrdered() const
    {
        return twoPhase || std::any_of(inputs.begin(), inputs.end(), [](const messages::DeclaredSignal &input) {
                   return input.sameCycle;
               });
    }
    /// \return false, with the reason in \a error, when \a message names nothing that there is
    static bool fromMessage(const messages::Register &message, NodeDeclaration *declaration, QString *error);
    /// Why a node cannot have this name; empty: it can.
    static QString nameError(const QString &name);
    /// The contrary, without what the node adds itself: uuid, cyclic, faults, watchdog.
    messages::Register toMessage() const;
    /// What the node of \a runtime says. \pre it is bound
    static NodeDeclaration fromRuntime(const NodeRuntime &runtime);
};

/// Why a node is not admitted.
struct Refusal
{
    QString error;  ///< one of messages::errorWord
    QString text;   ///< a sentence with names and remedy
};

/// Who is there, and who writes which signal: one writer for each.
class NodeRegistry
{
public:
    static constexpr int MaximumNodes = 1000;
    /// The name under which the master itself writes signals.
    static QString masterName() { return QStringLiteral("Master"); }

    explicit NodeRegistry(const QPlcSignalTable &table);

    /// Checks \a declaration against the table and the other nodes: make(), then add(). \return
    /// null, with the reason in \a refusal, when the node cannot join
    std::shared_ptr<NodeSlot> admit(const NodeDeclaration &declaration, Refusal *refusal);
    /// A slot for a node that agrees with the table, without a number. Nobody sees it before add().
    /// \return null, with the reason in \a refusal, when it does not agree. \threadsafe yes
    std::shared_ptr<NodeSlot> make(const NodeDeclaration &declaration, Refusal *refusal) const;
    /// A number for a slot.
    quint16 freeId() const;
    /// \return false, with the reason in \a refusal, when other nodes leave no place for \a slot
    bool add(const std::shared_ptr<NodeSlot> &slot, Refusal *refusal);
    void remove(const std::shared_ptr<NodeSlot> &slot);
    const std::vector<std::shared_ptr<NodeSlot>> &nodes() const { return m_nodes; }
    std::shared_ptr<NodeSlot> find(quint16 id) const;

    /// Makes the master the writer of \a signal. \return false when it has another writer
    bool claim(QPlcSignalIndex signal);
    void release(QPlcSignalIndex signal);
    /// Empty: nobody. "A > B" when the table allows several writers, and these are there.
    QString writer(QPlcSignalIndex signal) const { return m_writers.at(signal).join(QStringLiteral(" > ")); }

private:
    /// Indices of the declared signals. \return false with the refusal of the first that does not
    /// fit
    bool resolve(const QString &node, const std::vector<messages::DeclaredSignal> &declared,
                 QVector<QPlcSignalIndex> *indices, Refusal *refusal) const;
    /// Whether node and master have the same safety parameters of all declared signals. \pre they
    /// are \a inputs and \a outputs
    bool agreeOnSafety(const NodeDeclaration &declaration, const QVector<QPlcSignalIndex> &inputs,
                       const QVector<QPlcSignalIndex> &outputs, Refusal *refusal) const;
    /// Whether there is room for one more node, of this name.
    bool hasPlace(const QString &name, Refusal *refusal) const;
    /// Whether \a slot would close a loop of same-cycle inputs, with the path in \a refusal.
    bool closesLoop(const std::shared_ptr<NodeSlot> &slot, Refusal *refusal) const;
    /// Whether the node \a name may write \a signal, with the reason in \a refusal.
    bool mayWrite(const QString &name, QPlcSignalIndex signal, Refusal *refusal) const;
    void addWriter(const QString &name, QPlcSignalIndex signal);

    const QPlcSignalTable m_table;
    QVector<QStringList> m_writers;  // of each signal, in the order of the table
    std::vector<std::shared_ptr<NodeSlot>> m_nodes;
    mutable quint16 m_lastId = 0;
};

}  // namespace qplc
