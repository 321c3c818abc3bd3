// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MasterLeases.h"
#include "RealTimePhase.h"
#include "ViewerPushes.h"

namespace qplc {

/// Leases, set values and events of a master: who has done what goes into the journal, and to all
/// who want to hear of it.
class MasterViewers : public QObject
{
public:
    /// All of them outlive this object.
    MasterViewers(const MasterServer &server, Journal &journal, const MasterWrites &settings,
                  const MasterLeases &leases, RealTimePhase &phase, const QPlcSignalTable &table);

private:
    const MasterConnection *connectionOf(const QObject *socket) const;

    const MasterServer &m_server;
    ViewerPushes m_pushes;
};

}  // namespace qplc
