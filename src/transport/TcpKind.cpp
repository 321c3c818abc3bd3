// SPDX-License-Identifier: Apache-2.0
#include "StreamLink.h"
#include "StreamTransport.h"
#include "TransportKind.h"

namespace qplc {

/// A TCP connection for each node, beside that of its control messages.
class TcpKind final : public TransportKind
{
public:
    QString name() const override { return QStringLiteral("tcp"); }
    bool hasStreams() const override { return true; }
    std::unique_ptr<HubTransport> makeHubTransport() const override { return std::make_unique<StreamTransport>(); }
    bool admits(const CyclicHub &, const Newcomer &, ChannelError *) const override { return true; }
    std::unique_ptr<HubPeer> makeStreamPeer(int descriptor, const FrameCutter &cutter,
                                            std::size_t largest) const override
    {
        return StreamTransport::peer(descriptor, cutter, largest);
    }
    std::unique_ptr<CyclicLink> makeStreamLink(int descriptor, const FrameCutter &cutter,
                                               std::size_t largest) const override
    {
        return StreamLink::make(descriptor, cutter, largest);
    }
};

std::unique_ptr<const TransportKind> makeTcpKind()
{
    return std::make_unique<TcpKind>();
}

}  // namespace qplc
