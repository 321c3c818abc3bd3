// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CyclicLink.h"
#include "DatagramProbe.h"
#include "FrameCutter.h"
#include "FrameVolume.h"
#include "HubTransport.h"

#include <QtCore/QJsonObject>
#include <QtCore/QString>
#include <QtNetwork/QHostAddress>

#include <cstddef>
#include <memory>

namespace qplc {

class CyclicHub;

/// Where a master listens.
struct MasterPlace
{
    QHostAddress address;
    QHostAddress group;  // for frames to many nodes; null: none
    bool isSecured = false;
    quint64 session = 0;  // of this run of the master
};

/// A node that registers, as its master sees it.
struct Newcomer
{
    QString name;
    QHostAddress address;  // of its control connection
    bool isSecured = false;
    bool isOrdered = false;  // has same-cycle inputs or two phases
    int every = 1;           // [cycles] for each frame
    QJsonObject request;     // its Register, with the fields of the transport
    CycleVolume volume;      // known when makePeer() is called
};

/// The control connection of a node that registers, as the node sees it.
struct ControlEnds
{
    SocketAddress node;
    SocketAddress master;
    quint64 session = 0;  // that the master says in its Hello
    CycleVolume volume;   // of the node
};

/// Why there can be no cyclic channel.
struct ChannelError
{
    QString word;  // one of messages::errorWord
    QString text;  // a sentence with the remedy
};

/// One way on which cyclic frames travel, for both ends: a row of the TransportRegistry.
///
/// One row serves all masters and nodes: what a master has opened belongs to the HubTransport in
/// its hub, what a node has opened to its link. docs/howto/add-a-transport.md shows a whole one.
class TransportKind
{
public:
    TransportKind() = default;
    virtual ~TransportKind();
    TransportKind(const TransportKind &) = delete;
    TransportKind &operator=(const TransportKind &) = delete;

    /// What a node calls it in Register, and addresses have before "://".
    virtual QString name() const = 0;
    /// Whether frames are sealed where the control connection is secured.
    virtual bool isSealed() const { return true; }
    /// Whether each node opens a stream for its frames, which begins with AttachCyclicChannel.
    virtual bool hasStreams() const { return false; }
    /// Whether the inputs of many nodes travel in one frame.
    virtual bool hasGroup() const { return false; }

    /// Of a kind that stands for two others, the one that a node uses if a DatagramProbe gets
    /// through. Null: it stands for itself.
    virtual const TransportKind *first() const { return nullptr; }
    /// The one that it uses otherwise.
    virtual const TransportKind *fallback() const { return nullptr; }

    /// Whether its frames travel on the machine; else between hosts of a simulator
    /// (Host::current()).
    virtual bool isOfMachine() const { return true; }
    /// Whether Host::current() has it.
    bool isAtHand() const;

    // ---- addresses ----

    /// Reads what follows "NAME://" in \a text: \a place. Here HOST:PORT; names of hosts are looked
    /// up, which may block.
    /// \return false, with the reason in \a error
    virtual bool readPlace(const QString &place, const QString &text, QHostAddress *address, quint16 *port,
                           QString *error) const;
    /// The contrary: "127.0.0.1:50000".
    virtual QString placeText(const QHostAddress &address, quint16 port) const;

    // ---- the master; its thread ----

    /// What a hub needs for its nodes. Null: that of another kind does it.
    virtual std::unique_ptr<HubTransport> makeHubTransport() const { return nullptr; }
    /// What it needs beyond HubTransport::open().
    /// \return false, with the reason in \a error: the master cannot listen
    virtual bool open(CyclicHub & /*hub*/, const MasterPlace & /*place*/, QString * /*error*/) const { return true; }
    /// \return whether a node may use it; else the reason is in \a error. Its signals have not been
    /// looked at yet
    virtual bool admits(const CyclicHub &hub, const Newcomer &node, ChannelError *error) const = 0;
    /// The peer of an admitted node. Fields that the node needs are added to \a answer, its
    /// Registered. Not called where nodes have streams.
    /// \return null, with the reason in \a error, when there is none
    virtual std::unique_ptr<HubPeer> makePeer(const CyclicHub &hub, const Newcomer &node, QJsonObject *answer,
                                              ChannelError *error) const;
    /// Answers the questions of a node that has not attached yet. Null: it cannot.
    virtual std::unique_ptr<ProbeAnswers> answerProbe(const CyclicHub &hub, const Newcomer &node,
                                                      const ProbeNumbers &numbers) const;
    /// The peer behind the connected stream \a descriptor, which it owns. \pre hasStreams()
    virtual std::unique_ptr<HubPeer> makeStreamPeer(int descriptor, const FrameCutter &cutter,
                                                    std::size_t largestFrame) const;
    /// A peer that is all nodes at once. \pre hasGroup(), and open() was given a group
    virtual std::unique_ptr<HubPeer> makeGroupPeer(const CyclicHub &hub) const;

    // ---- the node; its thread ----

    /// Begins a link before the node registers. Fields that the master needs are added to \a
    /// request, its Register.
    /// \return false, with the reason in \a error; \a link may stay null
    virtual bool beginLink(const ControlEnds &ends, QJsonObject *request, std::unique_ptr<CyclicLink> *link,
                           QString *error) const;
    /// Makes \a link ready as \a answer says, the Registered of the master. Not called where nodes
    /// have streams.
    /// \return false, with the reason in \a error
    virtual bool finishLink(const ControlEnds &ends, const QJsonObject &answer, std::unique_ptr<CyclicLink> *link,
                            QString *error) const;
    /// The link over the connected stream \a descriptor, which it owns. \pre hasStreams()
    virtual std::unique_ptr<CyclicLink> makeStreamLink(int descriptor, const FrameCutter &cutter,
                                                       std::size_t largestFrame) const;
};

}  // namespace qplc
