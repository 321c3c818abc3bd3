// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CycleReports.h"
#include "CycleStatistics.h"
#include "QPlcClock.h"
#include "Roster.h"
#include "SafetyGuard.h"
#include "realtime/CycleClock.h"
#include "transport/CyclicHub.h"

#include <atomic>
#include <cstdint>

namespace qplc {

/// What a master and its nodes say to each other in a cycle: inputs out of the process image, stage
/// by stage, and answers into it.
///
/// The inputs of all nodes are cut from the image as the last cycle left it, before anything is
/// pasted; same-cycle inputs are cut again when the stage of their node begins. A stage begins when
/// those nodes of the stages before it have answered whose outputs are read in this cycle; for all
/// others the master waits at the end only. What they answer passes the SignalGuard of the image:
/// same-cycle inputs see guarded values, too.
///
/// Used by the cycle thread.
class NodeExchange
{
public:
    struct Cycle
    {
        std::uint64_t number = 0;   // from 0
        std::int64_t lateness = 0;  // [ns] of its begin
        std::int64_t deadline = 0;  // [ns] of its answers
    };

    /// All of them outlive this object. \param stop  ends every waiting
    NodeExchange(ProcessImage &image, SignalGuard &signalGuard, CyclicHub &hub, CycleReports &reports,
                 CycleStatistics &statistics, TimeSource &time, SafetyGuard &guard, const std::atomic<bool> &stop);

    /// Before a phase. \param grid  of the cycles; time that stands still shifts it
    /// \param spin  [ns] to look for answers again and again before a sleep
    void start(CycleClock &grid, std::chrono::nanoseconds period, QPlcClock clock, std::uint64_t cycleZero,
               std::int64_t spin);
    /// A cycle with all nodes of \a roster begins: the image is then as inputs are cut from it.
    void begin(const Roster &roster, const Cycle &cycle) noexcept;
    /// The cycle that has begun.
    void run() noexcept;
    /// Whether all nodes but listeners have answered in the last cycle.
    bool isComplete() const noexcept;
    /// Whether the code of a node has failed in this phase without which it cannot go on: of any
    /// but a listener in another process.
    bool hasFailed() const noexcept { return m_hasFailed; }

private:
    using Stage = std::vector<Roster::Turn>;
    static constexpr std::int64_t Never = INT64_MIN;

    void cutInputs() noexcept;
    void prepareRequest(NodeSlot &slot) noexcept;
    void pasteKnownOutputs() noexcept;
    void askNodes(const Stage &stage) noexcept;
    void sendRequest(NodeSlot &slot, std::uint8_t flags) noexcept;
    void sendParts(NodeSlot &slot) noexcept;
    void sendMulticast(std::uint8_t flags) noexcept;
    bool continueRequests() noexcept;
    void resendRequests() noexcept;
    void stepLocalNodes(const Stage &stage) noexcept;
    void setFaulted(NodeSlot &slot, bool isFaulted) noexcept;
    void pasteLocalNodes(const Stage &stage) noexcept;
    void awaitEveryone() noexcept;
    std::int64_t deadline(std::size_t stage) const noexcept;
    bool collectAnswers(std::size_t stage) noexcept;
    void waitForLateNodes(std::int64_t deadline) noexcept;
    void waitForStep() noexcept;
    void hearSafeNodes() noexcept;
    void giveUp(std::int64_t waited) noexcept;
    void reportLateNodes() noexcept;
    std::uint16_t nodeToReport() const noexcept;
    void receive(std::int64_t timeout, int alarm = -1) noexcept;
    bool waitForFrames(std::int64_t timeout, int alarm) noexcept;
    void handleAnswer(NodeSlot &slot, const char *frame, std::size_t size) noexcept;
    void store(NodeSlot &slot, const char *outputs, std::int64_t cycle) noexcept;
    void noteMissing(NodeSlot &slot) noexcept;
    void decideContests() noexcept;
    void endStage(const Stage &stage) noexcept;
    void settle() noexcept;
    /// The cycle at hand, as the guard counts.
    std::int64_t guardCycle() const noexcept { return std::int64_t(m_cycle.number); }
    bool anyMissing(bool onlyWaiting) const noexcept;
    bool hasWaitedTooLong(std::int64_t since) noexcept;
    bool mustBeWaitedFor(const NodeSlot &slot) const noexcept
    {
        return !slot.listener && !m_isSafe && (m_clock.isTimed() ? slot.waits() : !slot.behind);
    }
    bool isUnanswered(const NodeSlot &slot) const noexcept
    {
        return slot.asked && !slot.answered && !slot.lost.load(std::memory_order_relaxed);
    }
    bool isAwaited(const NodeSlot &slot) const noexcept { return slot.awaited && isUnanswered(slot); }
    std::int64_t now() noexcept { return m_clock.isTimed() ? m_time.now() : 0; }

    ProcessImage &m_image;
    SignalGuard &m_signalGuard;
    CyclicHub &m_hub;
    CycleReports &m_reports;
    CycleStatistics &m_statistics;
    TimeSource &m_time;
    SafetyGuard &m_guard;
    const std::atomic<bool> &m_stop;

    // of the phase
    CycleClock *m_grid = nullptr;
    std::chrono::nanoseconds m_period{0};  // as the nodes see it
    QPlcClock m_clock;
    std::uint64_t m_cycleZero = 0;
    std::int64_t m_spin = 0;  // [ns]
    bool m_hasFailed = false;

    // of the cycle
    const Roster *m_roster = nullptr;
    Cycle m_cycle;
    bool m_hasReceived = false;        // looked for answers
    std::int64_t m_waitBegin = Never;  // External: first wait for answers [ns]
    bool m_isSafe = false;             // the master stops safely: nodes are told so, and nothing of theirs is taken
};

}  // namespace qplc
