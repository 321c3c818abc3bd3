// SPDX-License-Identifier: Apache-2.0
#include "ProfileDefaults.h"

#include "SignalGuard.h"

namespace qplc {

using namespace std::chrono_literals;

const ProfileDefaults &ProfileDefaults::of(QPlcProfile::Value profile)
{
    static constexpr ProfileDefaults simulation{
        SignalGuard::HoldForever, 0ns, 0, QPlcSlaveNode::WatchdogReaction::Report, 0ns, 0ns, true};
    static constexpr ProfileDefaults plant{
        SignalGuard::UsualHold, 500ms, 4, QPlcSlaveNode::WatchdogReaction::SafeState, 5s, 1s, false};
    Q_ASSERT(profile != QPlcProfile::Automatic);
    return profile == QPlcProfile::Simulation ? simulation : plant;
}

ChosenProfile chooseProfile(const ProfileFacts &facts)
{
    if (facts.wanted != QPlcProfile::Automatic)
        return {facts.wanted, QStringLiteral("set at the master")};
    if (facts.ofManifest != QPlcProfile::Automatic)
        return {facts.ofManifest, QStringLiteral("set by the manifest")};
    if (facts.hasManifest)
        return {QPlcProfile::Plant, QStringLiteral("the plant has a manifest")};
    if (!facts.hardwareNode.isEmpty())
        return {QPlcProfile::Plant, QStringLiteral("node '%1' drives real devices").arg(facts.hardwareNode)};
    if (facts.networkAddress.isEmpty())
        return {QPlcProfile::Simulation,
                QStringLiteral("no real devices, and the master listens on this computer only")};
    if (!facts.clock.isTimed())
        return {QPlcProfile::Simulation,
                QStringLiteral("no real devices, and the clock is %1")
                    .arg(facts.clock.isExternal() ? QStringLiteral("External") : QStringLiteral("Lockstep"))};
    return {QPlcProfile::Plant, QStringLiteral("the master listens on %1").arg(facts.networkAddress)};
}

}  // namespace qplc
