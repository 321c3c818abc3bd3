// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CycleReports.h"
#include "ListeningInterval.h"
#include "NodeRuntime.h"
#include "QPlcClock.h"
#include "SentCycles.h"
#include "SlaveStatistics.h"
#include "Watchdog.h"
#include "protocol/CyclicFrame.h"
#include "realtime/CycleThread.h"
#include "realtime/InterruptibleWaits.h"
#include "transport/CyclicLink.h"
#include "transport/FrameCutter.h"

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

namespace qplc {

/// The cycles of a slave: takes a frame, computes, answers. Owns the thread on which that happens.
///
/// start() and stop() from the thread of the node; counters from anywhere.
class SlaveCycle
{
public:
    struct Identity
    {
        std::uint64_t session = 0;
        std::uint16_t node = 0;
        std::optional<SealKeys> keys{};  // none: frames are not sealed
    };
    /// Where the inputs of the node lie in the datagrams for many nodes.
    struct Group
    {
        std::uint16_t part = 0;
        std::uint32_t offset = 0;  // [byte]
        std::uint32_t size = 0;    // [byte] of the whole payload; 0: the node gets frames of its own
        std::uint64_t hash = 0;
    };
    struct Phase
    {
        std::chrono::nanoseconds period{0};  // of PeriodRange.h
        QPlcClock clock;
        std::uint64_t cycleZero = 0;           // number on the wire of cycle 0 of the phase
        std::uint64_t firstCycle = 0;          // number on the wire of the first cycle that may come
        std::chrono::nanoseconds watchdog{0};  // 0: none
        // A master sends the first frame when its slowest node is ready: a shorter watchdog waits.
        std::chrono::nanoseconds longestStart = std::chrono::seconds(10);
        bool isSafeByWatchdog = true;                     // else the watchdog reports only
        std::int64_t usualHold = SignalGuard::UsualHold;  // [cycles] of inputs without `hold`
        QPlcRealTimeOptions realTimeOptions;
        Group group{};
        ListeningInterval interval{};
    };

    /// \param runtime  bound, and outlives this object
    SlaveCycle(NodeRuntime &runtime, const Identity &identity, bool tapFrames);
    ~SlaveCycle();

    /// Tells a stream of cyclic frames towards the node where they end.
    FrameCutter inputCutter() const;
    /// Gives the link. \pre not running
    void setLink(std::unique_ptr<CyclicLink> link) { m_link = std::move(link); }

    /// \return false when no thread could be made; errorString() says why
    bool start(const Phase &phase);
    /// The master has sent its last frame: the cycles end by themselves when all frames are there,
    /// or no more come. Does not wait for that; to be called again until hasEnded(): a call may
    /// find the thread just before a wait.
    void finish(const SentCycles::Last &last);
    bool hasEnded() const { return m_ended; }
    /// Waits until the cycle in progress has ended.
    /// \param last  that the master has sent: what did not come until now is missed; none: it is
    ///         not known
    void stop(const std::optional<SentCycles::Last> &last = std::nullopt);
    bool isRunning() const { return m_thread.isRunning(); }
    QString errorString() const { return m_thread.errorString(); }
    const QVector<QPlcRealTimeSetting> &realTimeSettings() const { return m_thread.settings(); }

    CycleReports &reports() { return m_reports; }
    QPlcSlaveNode::Counters counters() const;
    /// How many cycles the one is that is being computed, from 1; 0: none is. \threadsafe yes
    quint64 cycleInProgress() const;
    const SlaveStatistics &statistics() const { return m_statistics; }

private:
    void run() noexcept;
    FrameDecoder ownDecoder() const;
    bool isForOthers(const char *frame, std::size_t size) const noexcept;
    CyclicLink::Status receive(const char **frame, std::size_t *size) noexcept;
    void handle(const char *frame, std::size_t size) noexcept;
    FrameStatus decode(const char *frame, std::size_t size) noexcept;
    void hear(std::int64_t now) noexcept;
    void skipToNewest(std::int64_t now, std::int64_t before) noexcept;
    void compute() noexcept;
    std::uint64_t lostBefore(std::uint64_t cycle, std::uint16_t before) const noexcept;
    void takeRest() noexcept;
    void countMissing() noexcept;
    bool isRepeatedRequest() const noexcept;
    void encodeAnswer() noexcept;
    void sendAnswer() noexcept;
    void makeSafe(QPlcSlaveNode::SafeStateReason reason, const CycleEvent &event) noexcept;
    std::int64_t watchdogTime() const noexcept;
    void checkWatchdog(std::int64_t now) noexcept;
    void setAlarm() noexcept;
    std::int64_t simulated(std::int64_t time) const noexcept;
    std::int64_t lasting(std::chrono::nanoseconds simulated) const noexcept;

    NodeRuntime &m_runtime;
    const Identity m_identity;
    FrameDecoder m_decoder;
    FrameEncoder m_encoder;
    std::unique_ptr<CyclicLink> m_link;
    CycleThread m_thread;
    CycleReports m_reports;
    std::atomic<bool> m_stop{false};
    std::atomic<bool> m_ended{true};
    std::atomic<bool> m_finish{false};
    std::optional<SentCycles::Last> m_last;  // that the master has sent; set before m_finish or m_stop

    // cycle thread
    Phase m_phase;
    std::uint64_t m_endOfTime = 0;  // first cycle on the wire that is too far for a time in nanoseconds
    std::vector<char> m_frames;     // encoded parts of the newest answer, one behind the other
    FrameHeader m_answer;           // of the newest cycle
    bool m_computedAny = false;
    bool m_faulted = false;
    std::uint64_t m_lastCycle = 0;   // computed last
    std::uint16_t m_lastBefore = 0;  // as in the frames of that cycle
    Watchdog m_watchdog;             // hears new frames; see watchdogTime()
    std::optional<InterruptibleWaits> m_waits;

    struct AtomicCounters
    {
        std::atomic<quint64> cycles{0}, missed{0}, skipped{0}, duplicated{0}, outdated{0}, rejected{0}, forged{0},
            watchdog{0}, finished{0};
    } m_counters;
    SlaveStatistics m_statistics;
};

}  // namespace qplc
