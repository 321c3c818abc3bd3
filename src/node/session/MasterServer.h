// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Evictions.h"
#include "FairTurns.h"
#include "LongMessages.h"
#include "MasterConnection.h"
#include "MasterDoor.h"
#include "QPlcMasterStatistics.h"
#include "QPlcUnderlyingProtocol.h"
#include "node/security/RightsWatch.h"
#include "protocol/messages/HelloText.h"
#include "realtime/Worker.h"
#include "transport/LocalName.h"

#include <QtCore/QObject>
#include <QtCore/QPointer>
#include <QtCore/QSocketNotifier>

#include <functional>
#include <memory>
#include <vector>

namespace qplc {

/// Who comes and goes at a master: accepts connections, greets, registers nodes and attaches their
/// cyclic channels.
class MasterServer : public QObject
{
    Q_OBJECT
public:
    /// Why a node may not register over a transport; no error: it may.
    using Objection = std::function<Refusal(NodeDeclaration *, const MasterConnection &, const QString &transport)>;

    /// \param master what greetings need to know of the master: its Hello without what depends on
    ///         the client
    /// \param objection why the master does not take a node now that the registry would take; it
    ///         may change what the node says of itself
    /// \param evictions  outlive this object
    MasterServer(NodeRegistry &registry, const ProcessImage &image, CyclicHub &hub, quint64 session,
                 std::function<messages::MasterHello()> hello, Objection objection, const Evictions &evictions,
                 QObject *parent);
    ~MasterServer() override;

    /// Takes effect with listen().
    void setSecurity(const QPlcSecurity &security);
    void setMaximumConnections(int connections);
    /// Adds who was not let in, and what was not carried out.
    void count(QPlcMasterStatistics *statistics) const;

    /// \param name  under which local nodes find the port; empty: none
    /// \param group  for frames to many nodes; null: none
    /// \return false, with the reason in errorString()
    bool listen(const QHostAddress &address, quint16 port, const QString &name, const QHostAddress &group);
    void close();
    quint16 port() const;
    /// Where it listens, or has listened last.
    QHostAddress address() const { return m_address; }
    QString errorString() const { return m_errorString; }

    /// As somebody calls himself, fit to be shown and kept.
    static QString nameOf(const QString &given);
    const std::vector<std::unique_ptr<MasterConnection>> &connections() const { return m_connections; }
    MasterConnection *connectionOf(const NodeSlot *slot) const;
    /// Ends a connection; lost() follows for a node.
    void drop(MasterConnection *connection, const QString &reason);
    /// Ends the connections for which \a refusalOf has an error; they are told so.
    void expel(const std::function<Refusal(MasterConnection *)> &refusalOf);

Q_SIGNALS:
    /// Somebody new; what is sent now comes before the Hello of the master.
    void greeted(qplc::MasterConnection *connection);
    void attached(qplc::MasterConnection *connection);
    /// The node is no longer registered; the connection is deleted afterwards.
    void lost(qplc::MasterConnection *connection, const QString &reason);
    void refused(const QString &name, const QString &address, const QString &reason);
    /// Somebody did not get as far as a message. \param identity  as claimed; empty: none
    void strangerRefused(const QString &identity, const QString &address, const QString &reason);
    /// A message that not everybody may send is about to be carried out.
    void commanded(qplc::MasterConnection *connection, const QPlcMessage &message);
    /// Somebody has proven who it is.
    void authenticated(qplc::MasterConnection *connection);
    /// The files of keys and rights were changed, and cannot be read: who is there stays.
    void rightsUnreadable(const QString &error);
    /// A message was not carried out: its sender has no right to it.
    void denied(qplc::MasterConnection *connection, const QString &reason);
    /// A message that is not about registration.
    void received(qplc::MasterConnection *connection, const QPlcMessage &message);

private:
    /// A node between its registration and its place among the others.
    struct NewNode
    {
        std::shared_ptr<const messages::Register> registration;
        NodeDeclaration declaration;
        std::shared_ptr<NodeSlot> slot;  // null: it is refused, or was not made yet
        Refusal refusal;
    };

    void enter(QPlcSlaveSocket *socket, const Peer &peer, ConnectionGate::Ticket ticket);
    void dropSlow(ConnectionGate::Ticket ticket, const QString &reason);
    bool isTooMuch(MasterConnection *connection, const QPlcMessage &message);
    void dropUnattached(const MasterConnection *connection);
    MasterConnection *connectionOf(const QPlcSlaveSocket *socket) const;
    void arrived(MasterConnection *connection);
    bool admitsLong(MasterConnection *connection, quint32 length);
    void longMessageEnded(MasterConnection *connection);
    void dropOverdue();
    bool beginLongRead(MasterConnection *connection);
    void longReadEnded(const QPlcSlaveSocket *socket);
    void giveLongRead(MasterConnection *connection);
    void freeLongRead(MasterConnection *connection);
    void takeTurn();
    bool serve(MasterConnection *connection);
    bool serveStep(MasterConnection *connection);
    void lookAhead(MasterConnection *connection);
    bool isThere(const MasterConnection *connection) const;
    bool isSettled(MasterConnection *connection, const QPlcMessage &message);
    void sendListAnswer(MasterConnection *connection);
    void deny(MasterConnection *connection, const QString &reason, bool isRegistration);
    void receive(MasterConnection *connection, const QPlcMessage &message);
    void carryOut(MasterConnection *connection, const QPlcMessage &message);
    void dropClosed(const QPlcSlaveSocket *socket);
    void receiveGarbage(MasterConnection *connection);
    void open(MasterConnection *connection, const messages::ClientHello &greeting);
    void open(MasterConnection *connection, messages::Register registration);
    void open(MasterConnection *connection, const std::shared_ptr<const messages::Register> &registration);
    void open(MasterConnection *connection, const messages::AttachCyclicChannel &wish);
    void admit(MasterConnection *connection, const std::shared_ptr<const messages::Register> &registration);
    void enlist(MasterConnection *connection, NewNode &newNode);
    void rejectNode(MasterConnection *connection, const NewNode &newNode);
    Refusal transportRefusal(MasterConnection *connection, NodeDeclaration *declaration) const;
    bool prepareChannel(MasterConnection *connection, messages::Registered *registered);
    void useTransport(MasterConnection *node, const TransportKind &kind) const;
    bool makePeer(MasterConnection *node, messages::Registered *registered);
    void replace(const MasterConnection *newcomer, const QString &name);
    void nodeAttached(MasterConnection *connection);
    void reject(MasterConnection *connection, const QString &error, const QString &reason);
    void expelOne(const QPointer<QPlcSlaveSocket> &socket, const Refusal &refusal);
    Refusal revocation(MasterConnection *connection) const;
    messages::Register registrationOf(const NodeSlot &slot) const;
    void expelRevoked();
    void forget(MasterConnection *connection);
    bool openPorts(const QHostAddress &address, quint16 port);
    bool openTransports(const MasterPlace &place);
    Newcomer newcomer(const MasterConnection &connection, const NodeDeclaration &declaration,
                      const messages::Register &registration) const;
    Refusal channelRefusal(const MasterConnection &connection, const Newcomer &newcomer) const;

    NodeRegistry &m_registry;
    const ProcessImage &m_image;
    CyclicHub &m_hub;
    const quint64 m_session;
    std::function<messages::MasterHello()> m_hello;
    Objection m_objection;
    const messages::HelloText m_greeting;
    const quint32 m_longestMessage;  // [byte] that a client may send
    const Evictions &m_evictions;
    MasterDoor m_door;
    RightsWatch m_rights;
    LocalName m_name;
    QHostAddress m_address;
    bool m_isSecured = false;
    std::vector<std::unique_ptr<MasterConnection>> m_connections;
    FairTurns m_turns;
    LongMessages m_longMessages;
    QTimer m_longMessageTimer;
    Worker m_reader;  // of long messages
    std::unique_ptr<QSocketNotifier> m_readerNotifier;
    QTimer m_nextTurn;
    bool m_isBusy = false;                    // somebody waits since the last turn
    MasterConnection *m_receiving = nullptr;  // whose message is at hand
    QString m_errorString;
    quint64 m_deniedMessages = 0;
};

}  // namespace qplc
