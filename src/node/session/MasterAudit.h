// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MasterServer.h"
#include "RealTimePhase.h"

namespace qplc {

/// Writes into the journal who came to a master, what was refused, and who has commanded what.
class MasterAudit : public QObject
{
public:
    /// All of them outlive this object.
    MasterAudit(const MasterServer &server, Journal &journal, const RealTimePhase &phase);
};

}  // namespace qplc
