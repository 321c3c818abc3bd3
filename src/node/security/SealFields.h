// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/FrameSeal.h"
#include "protocol/messages/Registration.h"

#include <optional>

namespace qplc {

/// What a master tells its node to seal frames with: field `seal` of Registered. Only for a secured
/// connection.
messages::Seal sealOf(const SealKeys &keys);
/// Nothing unless both keys are whole.
std::optional<SealKeys> sealKeys(const messages::Seal &seal);

}  // namespace qplc
