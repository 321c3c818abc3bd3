// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LongRead.h"
#include "NodeSession.h"
#include "QPlcSlaveSocket.h"
#include "node/cycle/NodeRegistry.h"
#include "node/security/AccessRights.h"
#include "protocol/messages/ListAnswer.h"
#include "protocol/messages/MessageTable.h"
#include "transport/ConnectionGate.h"
#include "transport/TransportKind.h"

#include <QtCore/QObject>

#include <deque>
#include <functional>
#include <memory>

namespace qplc {

/// Somebody on the control channel of a master: a node, a tool, or a connection that has not said
/// yet what it is.
struct MasterConnection
{
    /// How far somebody has come.
    enum Stage : quint8 {
        Silent,  // has not greeted
        Greeted,
        Attaching,  // registered; its cyclic channel is not there yet
        Attached    // a node that can be initialized: its session says how far that has come
    };

    QPlcSlaveSocket *socket = nullptr;
    Stage stage = Silent;
    Peer peer;                          // who it is, as far as it was proven
    ConnectionGate::Ticket ticket = 0;  // of the door
    QString name;                       // as greeted
    QString uuid;
    QString cyclicKind;                                  // "udp", "tcp"
    const TransportKind *transport = nullptr;            // of this name; null: there is none
    TokenBucket messages{1000, 4000};                    // that nobody has asked it for
    TokenBucket events{2, 32};                           // of a node, that are told one by one
    quint64 token = 0;                                   // names this node on its cyclic TCP connection
    std::unique_ptr<Newcomer> newcomer{};                // while it is Attaching
    std::unique_ptr<ProbeAnswers> probe{};               // while its transport is open, and datagrams are allowed
    Refusal firstRefusal{}, fallbackRefusal{};           // why it may not use one of two transports
    QString fallbackReason;                              // why it uses the second of them; empty: it does not
    std::shared_ptr<NodeSlot> slot;                      // null: no node
    std::shared_ptr<NodeSession> session;                // null: no node that is attached
    qint64 stageSince = 0;                               // [ms] for time-outs
    QStringList features;                                // that both ends have offered
    bool leasesDue = false;                              // they have changed and it was not told yet
    quint64 eventsTold = 0;                              // sequence number of the newest event that was sent
    std::function<void()> nextStep{};                    // of a message that is carried out in steps; null: none
    std::unique_ptr<messages::ListAnswer> listAnswer{};  // being made; null: none. What it asks next waits
    std::shared_ptr<LongRead> longRead{};                // null: none. What it sends next waits
    bool isAhead = false;                                // the message at hand has overtaken others of it
    std::deque<QPlcMessage> keptAnswers{};               // to such messages, until it is their turn

    /// Whether it is TLS, and the peer proven: secrets may travel over it.
    bool isSecured() const { return peer.isSecured && socket->isSecured(); }
    bool uses(QLatin1String feature) const { return features.contains(feature); }
    QString shownName() const { return qplc::shownName(peer, name); }
    /// Whether somebody is called so: as it has greeted or registered, or by its identity.
    bool isOf(const QString &called) const
    {
        return !called.isEmpty() && (called == name || called == peer.provenIdentity());
    }
    bool isNode() const { return slot != nullptr; }
    /// Whether a message of \a kind is the answer that the master waits for: there are as many of
    /// them as the master wants.
    bool owes(QPlcMessage::Kind kind) const { return session && session->owes(kind); }
    /// Sends a struct of protocol/messages. \return false when it is too long
    template<typename Message>
    bool send(const Message &message) const
    {
        return socket->sendMessage(messages::toMessage(message));
    }
    /// Answers the message at hand that it is done, or refuses it; the connection stays.
    void done() { answer(messages::toMessage(messages::Done())); }
    void fail(const QString &error, const QString &text) { answer(messages::toMessage(messages::Failed{error, text})); }

private:
    void answer(const QPlcMessage &message)
    {
        if (isAhead)
            keptAnswers.push_back(message);
        else
            socket->sendMessage(message);
    }
};

}  // namespace qplc
