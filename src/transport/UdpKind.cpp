// SPDX-License-Identifier: Apache-2.0
#include "UdpKind.h"

#include "CyclicHub.h"
#include "UdpLink.h"
#include "UdpTransport.h"
#include "protocol/messages/Vocabulary.h"

namespace qplc {

std::unique_ptr<const TransportKind> makeUdpKind()
{
    return std::make_unique<UdpKind>();
}

std::unique_ptr<HubTransport> UdpKind::makeHubTransport() const
{
    return std::make_unique<UdpTransport>();
}

bool UdpKind::admits(const CyclicHub &, const Newcomer &node, ChannelError *error) const
{
    const int port = messages::fieldsOf<Request>(node.request).udpPort;
    const bool isPort = port >= 1 && port <= 65535;
    if (!isPort)
        *error = {messages::errorWord::malformedMessage, QStringLiteral("UDP port %1 is out of 1 ... 65535").arg(port)};
    return isPort;
}

std::unique_ptr<HubPeer> UdpKind::makePeer(const CyclicHub &hub, const Newcomer &node, QJsonObject *,
                                           ChannelError *) const
{
    return hub.find<UdpTransport>()->peer(addressOf(node), node.volume.outputs);
}

std::unique_ptr<ProbeAnswers> UdpKind::answerProbe(const CyclicHub &hub, const Newcomer &node,
                                                   const ProbeNumbers &numbers) const
{
    return hub.find<UdpTransport>()->answerProbe(addressOf(node), numbers);
}

SocketAddress UdpKind::addressOf(const Newcomer &node)
{
    return {node.address, quint16(messages::fieldsOf<Request>(node.request).udpPort)};
}

bool UdpKind::beginLink(const ControlEnds &ends, QJsonObject *request, std::unique_ptr<CyclicLink> *link,
                        QString *error) const
{
    quint16 port = 0;
    *link = UdpLink::open(ends.master, &port, error);
    messages::addFields(Request{port}, request);
    return *link != nullptr;
}

}  // namespace qplc
