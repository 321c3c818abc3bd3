// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CycleReports.h"
#include "CycleStatistics.h"
#include "CycleTap.h"
#include "NodeExchange.h"
#include "NodeSlot.h"
#include "QPlcClock.h"
#include "QPlcOverrunPolicy.h"
#include "SafetyGuard.h"
#include "SignalGuard.h"
#include "SlopeLimits.h"
#include "StepGate.h"
#include "realtime/AlarmTime.h"
#include "realtime/CycleClock.h"
#include "realtime/CycleThread.h"
#include "realtime/SnapshotBuffer.h"
#include "signals/ProcessImage.h"
#include "transport/CyclicHub.h"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>

namespace qplc {

/// A checked value for a signal that no node writes.
struct SignalSetting
{
    QPlcSignalIndex signal = QPlcInvalidSignalIndex;
    QPlcValue value;  // of the type of the signal
    QPlcQuality quality = QPlcQuality::Good;
};

/// The cycle of a master: keeps time and the process image, and lets a NodeExchange ask the nodes.
/// Owns the thread on which that happens, unless the clock is External: then step() is a cycle, and
/// the thread runs those of a safe stop only.
///
/// Everything is called by the thread of the master; what is marked so also while cycles run.
class MasterCycle : private SignalGuard::Observer
{
public:
    struct Phase
    {
        std::chrono::nanoseconds period{0};
        QPlcClock clock;
        QPlcOverrunPolicy overrunPolicy;  // of a timed clock
        std::uint64_t cycleLimit = 0;     // first number that is not computed; 0: none
        QPlcSignalIndex timeSignal = QPlcInvalidSignalIndex;
        QPlcSignalIndex jitterSignal = QPlcInvalidSignalIndex;
        QPlcSignalIndex workloadSignal = QPlcInvalidSignalIndex;
        QPlcRealTimeOptions realTimeOptions;
        std::chrono::nanoseconds gapLimit{0};  // of a timed clock; 0: none
        // On the clock of the nodes; External: of a step, on the clock of the machine. Not in
        // lockstep. 0: none
        std::chrono::nanoseconds longestWait{0};
        int overrunLimit = 0;                             // in a row; 0: none
        std::int64_t usualHold = SignalGuard::UsualHold;  // [cycles] of signals without `hold`
        std::shared_ptr<RecordRing> ring{};               // gets a record of each cycle; null: there is none
    };

    /// \param time  instead of the clock of the machine; for tests
    MasterCycle(const QPlcSignalTable &table, CyclicHub &hub, bool tapFrames, TimeSource *time = nullptr);
    ~MasterCycle();

    /// The values while no cycle runs.
    ProcessImage &image() { return m_image; }
    /// Number on the wire of cycle 0 of the next phase (or of this one, while it runs).
    std::uint64_t cycleZero() const { return m_cycleZero; }
    /// Lets the next phase begin with a large number, for tests. \pre not running
    void setCycleZero(std::uint64_t number) { m_cycleZero = number; }
    /// Of the wall clock when cycle 0 of the last phase began [ns since 1970]; 0: there was none,
    /// or its clock is not timed.
    std::int64_t cycleZeroTime() const { return m_wallStart; }

    /// How a step has ended.
    enum class Step : std::uint8_t {
        Complete,  ///< all nodes have answered
        Late,      ///< a node that was asked has not, or has left since; the cycles go on without it
        Safe,      ///< the cycles are safe: nothing is computed any more
        Stopped,   ///< no cycles, or they have been stopped meanwhile
        Busy       ///< another thread is in a step: nothing has been done
    };

    /// \return false when no thread could be made; errorString() says why
    bool start(const Phase &phase);
    /// One cycle, on the calling thread. \pre the clock is External, or it is Stopped
    /// \threadsafe yes
    Step step() noexcept;
    /// As step(), but the cycle has a number and inputs that somebody else knows: those of a
    /// recording.
    /// \param number  larger than that of the cycle before
    /// \param setInputs  is called with the image from which inputs are about to be cut
    Step step(std::uint64_t number, const std::function<void(ProcessImage &image)> &setInputs) noexcept;
    /// Waits until the cycle in progress has ended. The hub then holds the nodes of the last
    /// roster.
    void stop();
    bool isRunning() const { return m_isStepped || m_thread.isRunning(); }
    /// Lets the cycles be safe from the next one on: nodes are told their safe values and compute
    /// nothing, until stop(). With the clock External, waits until the step in progress has ended.
    void makeSafe();
    bool isSafe() const { return m_guard.isTripped(); }
    QString errorString() const { return m_thread.errorString(); }
    /// Time between two cycles on the clock of the machine [ns]; 0: the clock is not timed.
    std::int64_t period() const { return m_clock ? m_clock->period() : 0; }
    const QVector<QPlcRealTimeSetting> &realTimeSettings() const { return m_thread.settings(); }

    /// Gives the nodes of the cycles from the next one on; also while cycles run, but then the
    /// nodes of this process stay the same.
    void setRoster(const Roster &roster);
    /// Sets signals between two cycles; also while cycles run: then signals with a slope move to
    /// these values, and safe ones have them at once. \return false, and none is set, when too many
    /// are under way
    bool setValues(const std::vector<SignalSetting> &settings);
    /// Keeps each of \a indices where its slope has brought it by now. \return false, and all go
    /// on, when too many are under way
    bool endWays(const std::vector<QPlcSignalIndex> &indices);
    /// Whether a value that is set moves \a signal with a slope.
    bool hasSlope(QPlcSignalIndex signal) const { return m_slopes.isLimited(signal); }
    /// How many values setValues() and endWays() have been given for cycles that run: what they are
    /// given next has the numbers behind it, as RecordedSettings says.
    std::uint64_t settingsGiven() const { return m_setsGiven; }
    /// Whether setValues() and endWays() would take so many now.
    bool hasRoomFor(std::size_t settings) const;
    const QPlcSignalTable &table() const { return m_image.table(); }
    /// Where a signal lies in values() [byte].
    quint32 offset(QPlcSignalIndex signal) const { return m_image.offset(signal); }
    /// The newest values of all signals with their qualities, of one cycle, as they lie in the
    /// process image; also while cycles run.
    std::vector<char> values() const;
    /// Where the quality of a signal lies in values() [byte].
    quint32 qualityOffset(QPlcSignalIndex signal) const { return m_image.qualityOffset(signal); }
    /// An initialization begins: what nodes have written before counts for nothing. \pre not
    /// running
    /// \param usualHold  [cycles] of signals without `hold`
    void forgetOutputs(std::int64_t usualHold);
    /// Takes the initial outputs of a node, which have been checked, but for the signals that are
    /// \a held. \pre not running
    void storeInitialOutputs(NodeSlot &slot, const char *outputs, const std::vector<bool> &held);
    /// The initial outputs of all nodes of \a roster have been taken: what has no value by now is
    /// Safe, or Invalid as ever. \pre not running
    void initialOutputsTaken(Roster roster);
    /// Counters of the values that were not taken; also while cycles run.
    const SignalGuard &signalGuard() const { return m_signalGuard; }
    /// The newest value; also while cycles run.
    QPlcValue value(QPlcSignalIndex signal) const;
    /// The values of a frame, cut from the newest image; also while cycles run.
    QByteArray gather(const std::vector<CopyRun> &runs, quint32 size) const;
    /// Number of the newest complete cycle, from 0; also while cycles run.
    std::uint64_t cycle() const { return m_cycle.load(std::memory_order_relaxed); }
    QPlcMasterStatistics statistics() const;
    const CycleStatistics &cycleStatistics() const { return m_statistics; }
    CycleReports &reports() { return m_reports; }
    /// What goes into the ring of the phase.
    const CycleTap &tap() const { return m_tap; }

private:
    struct SetCommand
    {
        QPlcSignalIndex signal;
        QPlcQuality quality;
        bool isEndOfWay;  // the signal stays where its slope has brought it; there is no value
        std::array<char, QPlcSignalType::MaximumSize> bytes;
    };

    void run() noexcept;
    Step enterStep() noexcept;
    Step runStep() noexcept;
    void runSafely() noexcept;
    void end() noexcept;
    void runCycle(const CycleClock::Tick &tick) noexcept;
    bool isBeyondLimit(std::uint64_t cycle) const noexcept
    {
        return m_phase.cycleLimit > 0 && cycle >= m_phase.cycleLimit && !m_guard.isTripped();
    }
    void pauseSince(std::int64_t begin) noexcept;
    void takeCommands() noexcept;
    void carryOut(const SetCommand &command) noexcept;
    void endTerms(const CycleClock::Tick &tick) noexcept;
    void put(QPlcSignalIndex signal, const char *bytes, QPlcQuality quality) noexcept;
    void adoptPending() noexcept;
    void adopt(Roster *roster, std::int64_t last) noexcept;
    void leave(NodeSlot &slot) noexcept;
    void join(NodeSlot &slot, std::int64_t last) noexcept;
    void writeOwnSignals(const CycleClock::Tick &tick) noexcept;
    void writeReal(QPlcSignalIndex signal, double value) noexcept;
    void finish(const CycleClock::Tick &tick) noexcept;
    void record(const CycleClock::Tick &tick) noexcept;
    void foldStatistics() noexcept;
    std::int64_t now() noexcept { return m_phase.clock.isTimed() ? m_time.now() : 0; }
    void clearStatistics();
    void startGuard();
    void valueRefused(std::uint16_t writer, SignalGuard::Place place, const ValueFault &fault,
                      bool isFirst) noexcept override;
    void signalBecameSafe(SignalGuard::Place place) noexcept override;
    void sourceChanged(SignalGuard::Place place, std::uint16_t from, std::uint16_t to) noexcept override;
    void freeRetired();

    AlarmTime m_alarm;
    TimeSource &m_time;
    ProcessImage m_image;
    SignalGuard m_signalGuard;
    SlopeLimits m_slopes;
    CyclicHub &m_hub;
    CycleThread m_thread;
    CycleReports m_reports;
    std::atomic<bool> m_stop{false};
    bool m_isStepped = false;  // cycles run, and the clock is External
    StepGate m_gate;
    SafetyGuard m_guard;
    NodeExchange m_exchange;
    CycleTap m_tap;
    std::atomic<Roster *> m_pendingRoster{nullptr};
    SpscRing<Roster *> m_retiredRosters{64};
    SpscRing<SetCommand> m_setCommands{256};
    std::size_t m_setsGiven = 0;  // thread of the master
    std::atomic<std::size_t> m_setsTaken{0};
    SnapshotBuffer m_snapshot;

    // cycle thread
    Phase m_phase;
    std::optional<CycleClock> m_clock;
    std::unique_ptr<Roster> m_roster;
    std::uint64_t m_cycleZero = 0;
    std::uint64_t m_number = 0;       // of the cycle in progress, from 0
    std::int64_t m_wallStart = 0;     // [ns since 1970]
    std::int64_t m_nextTerm = 0;      // [ns] no term of the roster is over before
    bool m_hasNewNodes = false;       // since the last cycle, or their signals have been taken over
    bool m_hasLost = false;           // nodes since the last cycle, which had their answers
    bool m_hasSetValues = false;      // since the last cycle, or signals have moved on their slopes
    bool m_hasEnded = false;          // External: the limit is reached, or a node has failed
    std::uint64_t m_givenNumber = 0;  // of the step at hand, if m_setInputs is there
    const std::function<void(ProcessImage &image)> *m_setInputs = nullptr;

    // both
    std::atomic<std::uint64_t> m_cycle{0};
    std::atomic<std::uint64_t> m_digest{0};
    CycleStatistics m_statistics{&m_hub};
};

}  // namespace qplc
