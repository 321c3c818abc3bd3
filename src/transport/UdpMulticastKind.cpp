// SPDX-License-Identifier: Apache-2.0
#include "CyclicHub.h"
#include "UdpKind.h"
#include "UdpLink.h"
#include "UdpTransport.h"
#include "protocol/messages/Vocabulary.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace qplc {

/// A UDP link whose node hears its master in a multicast group.
class UdpMulticastLink final : public UdpLink
{
public:
    explicit UdpMulticastLink(int family)
        : UdpLink(::socket(family, SOCK_DGRAM | SOCK_CLOEXEC, 0))
    {
    }
    ~UdpMulticastLink() override
    {
        if (m_source >= 0 && m_source != m_descriptor)
            ::close(m_source);
    }
    using UdpLink::connectTo;

    /// From now on frames come from the group, and from the master alone.
    /// \return false, with the reason in \a error
    bool joinGroup(const SocketAddress &group, QString *error)
    {
        SocketAddress self;
        SocketAddress master;
        self.length = master.length = sizeof self.storage;
        ::getsockname(m_descriptor, self.data(), &self.length);
        ::getpeername(m_descriptor, master.data(), &master.length);
        ip_mreq request{};
        request.imr_multiaddr = reinterpret_cast<const sockaddr_in *>(group.data())->sin_addr;
        request.imr_interface = reinterpret_cast<const sockaddr_in *>(self.data())->sin_addr;
        const int on = 1;
        m_source = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
        if (self.family() == AF_INET && ::setsockopt(m_source, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0
            && ::bind(m_source, group.data(), group.length) == 0
            && ::setsockopt(m_source, IPPROTO_IP, IP_ADD_MEMBERSHIP, &request, sizeof request) == 0
            && ::connect(m_source, master.data(), master.length) == 0)
            return true;
        *error = QStringLiteral("cannot join the multicast group %1: %2; use udp")
                     .arg(group.toString(), systemErrorText());
        return false;
    }
};

/// As UdpKind, but the master sends the inputs of all nodes at once to its multicast group.
class UdpMulticastKind final : public UdpKind
{
public:
    QString name() const override { return QStringLiteral("udp-multicast"); }
    bool hasGroup() const override { return true; }
    std::unique_ptr<HubTransport> makeHubTransport() const override { return nullptr; }  // that of udp
    bool open(CyclicHub &hub, const MasterPlace &place, QString *error) const override;
    bool admits(const CyclicHub &hub, const Newcomer &node, ChannelError *error) const override;
    std::unique_ptr<HubPeer> makePeer(const CyclicHub &hub, const Newcomer &node, QJsonObject *answer,
                                      ChannelError *error) const override;
    std::unique_ptr<HubPeer> makeGroupPeer(const CyclicHub &hub) const override
    {
        auto *transport = hub.find<UdpTransport>();
        return transport->peer(transport->group());
    }
    bool beginLink(const ControlEnds &ends, QJsonObject *request, std::unique_ptr<CyclicLink> *link,
                   QString *error) const override;
    bool finishLink(const ControlEnds &ends, const QJsonObject &answer, std::unique_ptr<CyclicLink> *link,
                    QString *error) const override;

private:
    /// What a master says in Registered.
    struct Answer
    {
        QString group;  // of IPv4
        quint16 groupPort = 0;

        static constexpr auto fields = messages::fieldList(messages::field("group", &Answer::group),
                                                           messages::field("groupPort", &Answer::groupPort));
    };
};

std::unique_ptr<const TransportKind> makeUdpMulticastKind()
{
    return std::make_unique<UdpMulticastKind>();
}

// ---- the master ----

bool UdpMulticastKind::open(CyclicHub &hub, const MasterPlace &place, QString *error) const
{
    if (place.isSecured && !place.group.isNull()) {
        *error = QStringLiteral("a secured master has no multicast group: with a key for all nodes each of them could "
                                "speak for the master; leave out the group %1, and connect nodes by udp://")
                     .arg(place.group.toString());
        return false;
    }
    return hub.find<UdpTransport>()->openGroup(place.address, place.group, error);
}

bool UdpMulticastKind::admits(const CyclicHub &hub, const Newcomer &node, ChannelError *error) const
{
    if (!UdpKind::admits(hub, node, error))
        return false;
    QString text;
    if (node.isSecured)
        text = QStringLiteral("a secured master sends no datagrams for many nodes; use udp");
    else if (hub.find<UdpTransport>()->group().length == 0)
        text = QStringLiteral("this master has no multicast group; give it one, or use udp");
    else if (node.isOrdered)
        text = QStringLiteral("node '%1' has same-cycle inputs or two phases: it is asked alone; use udp")
                   .arg(node.name);
    else if (node.every > 1)
        text = QStringLiteral("node '%1' wants one of %2 cycles: it is asked alone; use udp")
                   .arg(node.name)
                   .arg(node.every);
    *error = {messages::errorWord::wrongState, text};
    return text.isEmpty();
}

std::unique_ptr<HubPeer> UdpMulticastKind::makePeer(const CyclicHub &hub, const Newcomer &node, QJsonObject *answer,
                                                    ChannelError *error) const
{
    const SocketAddress group = hub.find<UdpTransport>()->group();
    messages::addFields(Answer{QHostAddress(group.data()).toString(), group.port()}, answer);
    return UdpKind::makePeer(hub, node, answer, error);
}

// ---- the node ----

bool UdpMulticastKind::beginLink(const ControlEnds &ends, QJsonObject *request, std::unique_ptr<CyclicLink> *link,
                                 QString *error) const
{
    auto own = std::make_unique<UdpMulticastLink>(ends.master.family());
    quint16 port = 0;
    const bool isConnected = own->connectTo(ends.master, &port, error);
    messages::addFields(Request{port}, request);
    *link = std::move(own);
    return isConnected;
}

bool UdpMulticastKind::finishLink(const ControlEnds &, const QJsonObject &answer, std::unique_ptr<CyclicLink> *link,
                                  QString *error) const
{
    const auto told = messages::fieldsOf<Answer>(answer);
    return static_cast<UdpMulticastLink *>(link->get())
        ->joinGroup(SocketAddress(QHostAddress(told.group), told.groupPort), error);
}

}  // namespace qplc
