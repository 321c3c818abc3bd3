// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "realtime/SpscRing.h"

#include <atomic>
#include <optional>

namespace qplc {

/// What a driver has noted, on the way from its reads and writes to the thread that tells it.
struct NotedEvents
{
    /// Of the thread that reads and writes. \return false: it is full
    bool note(quint64 data) noexcept
    {
        if (!m_ring.push(data))
            return false;
        m_isNew.store(true, std::memory_order_relaxed);
        return true;
    }
    /// Likewise: whether there are new ones since the last call.
    bool takeNews() noexcept
    {
        return m_isNew.load(std::memory_order_relaxed) && m_isNew.exchange(false, std::memory_order_relaxed);
    }
    /// Of the thread that tells them.
    bool isEmpty() noexcept { return m_ring.front() == nullptr; }
    /// The oldest one. Likewise.
    std::optional<quint64> take() noexcept
    {
        quint64 data = 0;
        return m_ring.pop(&data) ? std::optional<quint64>(data) : std::nullopt;
    }

private:
    SpscRing<quint64> m_ring{64};
    std::atomic<bool> m_isNew{false};
};

}  // namespace qplc
