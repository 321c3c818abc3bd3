// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanBus.h"

namespace qplc {

/// What the kernel tells of a CAN interface (rtnetlink, without rights).
struct CanLink
{
    CanBus::State state = CanBus::Active;  ///< of the controller
    bool hasEcho = true;  ///< frames come back to their sender when they have reached the bus, not when they are taken
    bool isOneShot = false;  ///< the controller sends each frame once, and drops it if nobody acknowledges it

    /// \param index  of the interface \return the defaults, where the kernel tells nothing
    static CanLink read(int index);
    /// As read(), out of an answer of the kernel to RTM_GETLINK.
    static CanLink fromMessage(const char *message, int size);
};

}  // namespace qplc
