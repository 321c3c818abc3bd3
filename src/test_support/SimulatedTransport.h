// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "transport/TransportKind.h"

namespace qplc {

/// The transports "sim" and "sim-stream": cyclic frames on the FrameWire of the simulator that runs
/// the calling thread. A node over "sim-auto" uses the first one if it gets through.
class SimulatedTransport final : public TransportKind
{
public:
    /// Puts them into the registry, once in a program.
    static void install();

    explicit SimulatedTransport(bool isStream)
        : m_isStream(isStream)
    {
    }
    QString name() const override { return m_isStream ? QStringLiteral("sim-stream") : QStringLiteral("sim"); }
    bool isOfMachine() const override { return false; }

    std::unique_ptr<HubTransport> makeHubTransport() const override;
    bool admits(const CyclicHub &hub, const Newcomer &node, ChannelError *error) const override;
    std::unique_ptr<HubPeer> makePeer(const CyclicHub &hub, const Newcomer &node, QJsonObject *answer,
                                      ChannelError *error) const override;
    std::unique_ptr<ProbeAnswers> answerProbe(const CyclicHub &hub, const Newcomer &node,
                                              const ProbeNumbers &numbers) const override;
    bool beginLink(const ControlEnds &ends, QJsonObject *request, std::unique_ptr<CyclicLink> *link,
                   QString *error) const override;
    bool finishLink(const ControlEnds &ends, const QJsonObject &answer, std::unique_ptr<CyclicLink> *link,
                    QString *error) const override;

private:
    const bool m_isStream;
};

}  // namespace qplc
