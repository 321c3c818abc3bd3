// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "TransportKind.h"
#include "protocol/messages/Field.h"

namespace qplc {

/// Datagrams between the UDP ports of master and node.
class UdpKind : public TransportKind
{
public:
    QString name() const override { return QStringLiteral("udp"); }
    std::unique_ptr<HubTransport> makeHubTransport() const override;
    bool admits(const CyclicHub &hub, const Newcomer &node, ChannelError *error) const override;
    std::unique_ptr<HubPeer> makePeer(const CyclicHub &hub, const Newcomer &node, QJsonObject *answer,
                                      ChannelError *error) const override;
    std::unique_ptr<ProbeAnswers> answerProbe(const CyclicHub &hub, const Newcomer &node,
                                              const ProbeNumbers &numbers) const override;
    bool beginLink(const ControlEnds &ends, QJsonObject *request, std::unique_ptr<CyclicLink> *link,
                   QString *error) const override;

protected:
    static SocketAddress addressOf(const Newcomer &node);

    /// What a node says in Register.
    struct Request
    {
        int udpPort = 0;

        static constexpr auto fields = messages::fieldList(messages::field("udpPort", &Request::udpPort));
    };
};

}  // namespace qplc
