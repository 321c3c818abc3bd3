// SPDX-License-Identifier: Apache-2.0
#include "FaultInjector.h"

namespace qplc {

namespace {

/// Spreads neighbouring numbers over all 64-bit numbers (the finalizer of SplitMix64).
std::uint64_t spread(std::uint64_t x) noexcept
{
    x += 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

/// 0 <= result < 1
double fraction(std::uint64_t x) noexcept
{
    return double(x >> 11) * 0x1p-53;
}

}  // namespace

FaultInjector::FaultInjector(const FaultPlan::Direction &plan, std::uint64_t seed, std::uint64_t stream)
    : m_plan(plan)
    , m_base(spread(seed) ^ spread(~stream))
{
}

/// Depends on no other draw: a fault more or less in the plan leaves all others as they are.
std::uint64_t FaultInjector::draw(Kind kind) const noexcept
{
    return spread(m_base + spread(m_frames * Kinds + kind));
}

bool FaultInjector::happens(Kind kind, double probability) noexcept
{
    if (!(fraction(draw(kind)) < probability))
        return false;
    m_counts[kind].add();
    return true;
}

std::int64_t FaultInjector::lateness(Kind kind) const noexcept
{
    const std::uint64_t random = spread(draw(kind) + 1);
    return m_plan.delay + std::int64_t(fraction(random) * double(m_plan.jitter));
}

FaultInjector::Decision FaultInjector::decide(std::int64_t now) noexcept
{
    if (m_frames == 0)
        m_begin = now;
    m_frames.add();
    Decision decision;
    if (m_plan.isCut(now - m_begin)) {
        m_counts[Cut].add();
        decision.passes = false;
        return decision;
    }
    decision.passes = !happens(Lost, m_plan.loss);
    if (!decision.passes)
        return decision;
    if (happens(Corrupted, m_plan.corrupt))
        decision.flips = spread(draw(Corrupted)) | 1;
    decision.isDuplicated = happens(Duplicated, m_plan.duplicate);
    m_isHolding = decision.isHeld = !m_isHolding && happens(Reordered, m_plan.reorder);
    decision.delay = lateness(Delayed);
    decision.copyDelay = lateness(Duplicated);
    m_counts[Delayed].add(decision.delay > 0 ? 1 : 0);
    return decision;
}

void FaultInjector::corrupt(std::uint64_t flips, char *frame, std::size_t size) noexcept
{
    if (size == 0)
        return;
    const std::uint64_t first = spread(flips) % (8 * size);
    const auto flip = [&](std::uint64_t bit) { frame[bit / 8] = char(frame[bit / 8] ^ (1 << bit % 8)); };
    flip(first);
    // Neighbours, so that no bit is turned back.
    for (std::uint64_t i = 1; i <= (flips >> 1) % 3 && first + i < 8 * size; ++i)
        flip(first + i);
}

}  // namespace qplc
