// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "transport/TransportKind.h"

namespace qplc {

/// The transport "sim": cyclic frames on the FrameWire of the simulator that runs the calling
/// thread.
class SimulatedTransport final : public TransportKind
{
public:
    /// Puts it into the registry, once in a program.
    static void install();

    QString name() const override { return QStringLiteral("sim"); }
    bool isOfMachine() const override { return false; }

    std::unique_ptr<HubTransport> makeHubTransport() const override;
    bool admits(const CyclicHub &hub, const Newcomer &node, ChannelError *error) const override;
    std::unique_ptr<HubPeer> makePeer(const CyclicHub &hub, const Newcomer &node, QJsonObject *answer,
                                      ChannelError *error) const override;
    bool beginLink(const ControlEnds &ends, QJsonObject *request, std::unique_ptr<CyclicLink> *link,
                   QString *error) const override;
};

}  // namespace qplc
