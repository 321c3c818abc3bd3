// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FaultPlan.h"
#include "realtime/Counter.h"

#include <array>

namespace qplc {

/// Decides what happens to each frame of one stream in one direction, and counts it.
///
/// A decision depends on the seed, the stream, the number of the frame and (for a cut) the time
/// alone: the same run gives the same faults again. Used by one thread; the counters may be read by
/// any.
class FaultInjector
{
public:
    enum Kind { Cut, Lost, Corrupted, Duplicated, Reordered, Delayed, Kinds };

    struct Decision
    {
        bool passes = true;          // else the frame is gone
        bool isHeld = false;         // it comes behind the next one that passes; never two at a time
        bool isDuplicated = false;   // a copy comes, too
        std::uint64_t flips = 0;     // not 0: see corrupt()
        std::int64_t delay = 0;      // [ns]
        std::int64_t copyDelay = 0;  // [ns]
    };

    /// \param stream  tells streams with the same seed apart
    FaultInjector(const FaultPlan::Direction &plan, std::uint64_t seed, std::uint64_t stream);

    /// What becomes of the next frame, which is here at \a now [ns].
    Decision decide(std::int64_t now) noexcept;
    /// Turns one to three bits of a frame over, as \a flips says.
    static void corrupt(std::uint64_t flips, char *frame, std::size_t size) noexcept;

    std::uint64_t frames() const noexcept { return m_frames; }
    std::uint64_t count(Kind kind) const noexcept { return m_counts[kind]; }

private:
    std::uint64_t draw(Kind kind) const noexcept;
    bool happens(Kind kind, double probability) noexcept;
    std::int64_t lateness(Kind kind) const noexcept;

    const FaultPlan::Direction m_plan;
    const std::uint64_t m_base;
    std::int64_t m_begin = 0;  // [ns] of the first frame
    bool m_isHolding = false;  // the frame before waits for this one
    Counter m_frames;
    std::array<Counter, Kinds> m_counts;
};

}  // namespace qplc
