// SPDX-License-Identifier: Apache-2.0
#include "HubTransport.h"

#include "HubFaults.h"

namespace qplc {

HubPeer::HubPeer() = default;
HubPeer::~HubPeer() = default;

HubTransport::HubTransport() = default;
HubTransport::~HubTransport() = default;

}  // namespace qplc
