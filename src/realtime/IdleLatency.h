// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcRealTimeSetting.h"

namespace qplc {

/// Keeps the processors from sleeping so deep that waking takes longer than wanted, for as long as
/// this object lives (/dev/cpu_dma_latency).
class IdleLatency
{
public:
    IdleLatency() = default;
    ~IdleLatency() { release(); }
    IdleLatency(const IdleLatency &) = delete;
    IdleLatency &operator=(const IdleLatency &) = delete;

    /// \param microseconds  longest time to wake up, >= 0; 0: they do not sleep at all
    QPlcRealTimeSetting limit(int microseconds);
    /// Lets them sleep again.
    void release();

private:
    int m_device = -1;
};

}  // namespace qplc
