// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/messages/Leases.h"

namespace qplc {

/// A signal that a person or program has taken over, as a window sees it. A value type.
struct LeaseStatus
{
    using State = messages::LeaseState;
    static constexpr State Held = State::Held;
    static constexpr State Lost
        = State::Lost;  // the signal stays at its neutral value until somebody takes or releases it

    QString signal;
    QString holder;  // "anna@lab"; of a lost lease: who held it last
    State state = Held;
    bool isMine = false;  // of this window; never when lost

    friend bool operator==(const LeaseStatus &a, const LeaseStatus &b)
    {
        return a.signal == b.signal && a.holder == b.holder && a.state == b.state && a.isMine == b.isMine;
    }
};

}  // namespace qplc
