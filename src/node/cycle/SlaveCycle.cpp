// SPDX-License-Identifier: Apache-2.0
#include "SlaveCycle.h"

#include "PeriodRange.h"
#include "protocol/LittleEndian.h"

#include <algorithm>
#include <limits>

namespace qplc {

namespace {

constexpr int UselessFrames = 256;  // that are read before a computation at most: a flood keeps no node from its work
constexpr std::int64_t LongestRest = 1'000'000'000;  // [ns] for what is left at the end
constexpr std::int64_t LongestQuiet = 50'000'000;    // [ns] then nothing more is on its way

void count(std::atomic<quint64> &counter, quint64 n = 1) noexcept
{
    counter.store(counter.load(std::memory_order_relaxed) + n, std::memory_order_relaxed);  // one writer
}

FrameSeed seedOf(const SlaveCycle::Identity &identity, const PayloadLayout &layout)
{
    return {identity.session, identity.node, layout.hash()};
}

std::size_t sizeOfInputFrame(const void *decoder, const char *header)
{
    return static_cast<const FrameDecoder *>(decoder)->frameSize(header);
}

}  // namespace

SlaveCycle::SlaveCycle(NodeRuntime &runtime, const Identity &identity, bool tapFrames)
    : m_runtime(runtime)
    , m_identity(identity)
    , m_decoder(ownDecoder())
    , m_encoder(FrameKind::Outputs, seedOf(identity, runtime.outputLayout()),
                runtime.outputLayout().partBorders(maximumPayload(identity.keys.has_value())),
                identity.keys ? &identity.keys->outputs : nullptr)
    , m_reports(tapFrames)
    , m_frames(m_encoder.totalSize())
{
}

/// For frames of the node's own.
FrameDecoder SlaveCycle::ownDecoder() const
{
    return {FrameKind::Inputs, seedOf(m_identity, m_runtime.inputLayout()),
            m_runtime.inputLayout().partBorders(maximumPayload(m_identity.keys.has_value())),
            m_identity.keys ? &m_identity.keys->inputs : nullptr};
}

SlaveCycle::~SlaveCycle()
{
    stop();
}

FrameCutter SlaveCycle::inputCutter() const
{
    return {CyclicHeaderSize, &sizeOfInputFrame, &m_decoder};
}

bool SlaveCycle::start(const Phase &phase)
{
    stop();
    m_phase = phase;
    const Group &group = phase.group;
    m_decoder = group.size == 0
        ? ownDecoder()
        : FrameDecoder(FrameKind::GroupInputs, {m_identity.session, 0, group.hash}, {0, group.size});
    m_decoder.restart(phase.firstCycle);
    m_endOfTime = phase.cycleZero + mostCycles(phase.period);
    m_runtime.beginPhase(!phase.clock.isTimed(), TimeSource::monotonic(), phase.usualHold);
    for (std::atomic<quint64> *counter :
         {&m_counters.cycles, &m_counters.missed, &m_counters.skipped, &m_counters.duplicated, &m_counters.outdated,
          &m_counters.rejected, &m_counters.forged, &m_counters.watchdog, &m_counters.finished})
        counter->store(0);
    m_statistics.restart(phase.clock.isTimed() ? lasting(phase.period) : 0);
    m_computedAny = m_faulted = false;
    m_lastCycle = phase.firstCycle;
    m_lastBefore = 0;
    m_last.reset();
    m_watchdog.start(watchdogTime() == 0 ? 0 : std::max(watchdogTime(), std::int64_t(m_phase.longestStart.count())),
                     monotonicNow());
    m_stop = m_finish = m_ended = false;
    if (m_thread.start(m_runtime.traits().name, phase.realTimeOptions, [this] { run(); }))
        return true;
    m_ended = true;
    return false;
}

void SlaveCycle::finish(const SentCycles::Last &last)
{
    if (!m_finish)
        m_last = last;
    m_finish = true;
    m_thread.interrupt();
}

void SlaveCycle::stop(const std::optional<SentCycles::Last> &last)
{
    if (!m_finish)
        m_last = last;
    m_stop = true;
    while (!m_ended) {  // an interruption just before a wait ends none
        m_thread.interrupt();
        TimeSource::monotonic().sleepUntil(monotonicNow() + 1'000'000);  // [ns]
    }
    m_thread.join();
}

QPlcSlaveNode::Counters SlaveCycle::counters() const
{
    QPlcSlaveNode::Counters counters;
    counters.cycles = m_counters.cycles;
    counters.missed = m_counters.missed;
    counters.skipped = m_counters.skipped;
    counters.duplicated = m_counters.duplicated;
    counters.outdated = m_counters.outdated;
    counters.rejected = m_counters.rejected;
    counters.forged = m_counters.forged;
    counters.watchdog = m_counters.watchdog;
    return counters;
}

quint64 SlaveCycle::cycleInProgress() const
{
    const quint64 begun = m_counters.cycles;
    return m_counters.finished < begun ? begun : 0;
}

void SlaveCycle::run() noexcept
{
    m_waits.emplace();
    setAlarm();
    const char *frame = nullptr;
    std::size_t size = 0;
    bool open = true;
    while (open && !m_stop.load(std::memory_order_relaxed) && !m_finish.load(std::memory_order_relaxed)) {
        switch (receive(&frame, &size)) {
        case CyclicLink::Received:
            handle(frame, size);
            break;
        case CyclicLink::Nothing:
            checkWatchdog(monotonicNow());
            break;
        case CyclicLink::Closed:
            m_reports.post({CycleEvent::LinkClosed, m_identity.node, 0, m_lastCycle - m_phase.cycleZero});
            open = false;
            break;
        }
    }
    if (m_finish && open)
        takeRest();
    if (m_finish || m_stop)
        countMissing();
    m_statistics.fold();
    m_waits.reset();
    m_ended = true;
}

CyclicLink::Status SlaveCycle::receive(const char **frame, std::size_t *size) noexcept
{
    const std::int64_t spin = m_phase.realTimeOptions.spin;
    if (spin > 0) {
        const std::int64_t end = monotonicNow() + spin;
        do {
            const CyclicLink::Status status = m_link->poll(frame, size);
            if (status != CyclicLink::Nothing)
                return status;
        } while (monotonicNow() < end);
    }
    return m_link->receive(frame, size);
}

FrameStatus SlaveCycle::decode(const char *frame, std::size_t size) noexcept
{
    if (isForOthers(frame, size))
        return FrameStatus::Incomplete;  // no error, and no use
    m_reports.tap(TappedFrame::Received, m_identity.node, frame, size);
    const FrameStatus status = m_decoder.decode(frame, size, m_endOfTime);
    switch (status) {
    case FrameStatus::Complete:
    case FrameStatus::Incomplete:
        break;
    case FrameStatus::Duplicate:
        count(m_counters.duplicated);
        break;
    case FrameStatus::Old:
        count(m_counters.outdated);
        break;
    case FrameStatus::Forged:
        if (m_counters.forged.load(std::memory_order_relaxed) == 0)
            m_reports.post({CycleEvent::ForgedFrame, m_identity.node, 0, m_lastCycle - m_phase.cycleZero});
        count(m_counters.forged);
        break;
    default:
        count(m_counters.rejected);
        break;
    }
    return status;
}

/// Whether it is a part of the multicast group that holds the inputs of other nodes.
bool SlaveCycle::isForOthers(const char *frame, std::size_t size) const noexcept
{
    return m_phase.group.size > 0 && size >= CyclicHeaderSize + sizeof(std::uint16_t)
        && loadLittle<std::uint16_t>(frame + CyclicHeaderSize) != m_phase.group.part;
}

/// The watchdog comes first: a frame that has waited while this process was stopped may belong to a
/// phase that is over.
void SlaveCycle::handle(const char *frame, std::size_t size) noexcept
{
    const FrameStatus status = decode(frame, size);
    const bool isTimed = m_phase.clock.isTimed();
    const std::int64_t now = isTimed || m_watchdog.isOn() ? monotonicNow() : 0;
    checkWatchdog(now);
    if (status == FrameStatus::Duplicate && m_computedAny && isRepeatedRequest())
        sendAnswer();
    if (status != FrameStatus::Complete)
        return;  // frames that are no use do not calm the watchdog
    const std::int64_t before = m_watchdog.lastHeard();
    hear(now);
    if (isTimed)
        skipToNewest(now, before);
    compute();
    if (isTimed)
        m_statistics.answered(m_watchdog.lastHeard(), m_runtime.executionTime(), monotonicNow());
}

/// A frame came; the first one of a phase may take longer.
void SlaveCycle::hear(std::int64_t now) noexcept
{
    if (m_computedAny) {
        m_watchdog.hear(now);
        return;
    }
    m_watchdog.start(watchdogTime(), now);
    setAlarm();
}

/// After a pause requests may have queued up; only the newest is worth an answer. Costs a system
/// call only after a pause. Ends also where frames that are no use never end: run() goes on with
/// the rest.
/// \param before  when a frame came before \a now [ns]
void SlaveCycle::skipToNewest(std::int64_t now, std::int64_t before) noexcept
{
    const bool paused = simulated(now - before) > 2 * m_phase.interval.cycles() * m_phase.period.count();
    if (!paused)
        return;
    const char *frame = nullptr;
    std::size_t size = 0;
    int useless = 0;
    while (useless < UselessFrames && !m_stop.load(std::memory_order_relaxed)
           && m_link->poll(&frame, &size) == CyclicLink::Received) {
        const FrameStatus status = decode(frame, size);
        if (status == FrameStatus::Complete) {
            m_watchdog.hear(monotonicNow());
            continue;
        }
        useless += status != FrameStatus::Incomplete;
        checkWatchdog(monotonicNow());
    }
}

/// How many cycles between the last one that was computed and \a cycle were sent to the node.
/// \param before  as in the frames of \a cycle. A number that cannot be counts as none
std::uint64_t SlaveCycle::lostBefore(std::uint64_t cycle, std::uint16_t before) const noexcept
{
    const std::uint64_t between = m_computedAny ? cycle - m_lastCycle - 1 : cycle - m_phase.firstCycle;
    return between - std::min<std::uint64_t>(between, std::uint16_t(before - m_lastBefore));
}

/// What was sent until the end and is there, or comes now: the master has sent its last frame.
void SlaveCycle::takeRest() noexcept
{
    const auto isAllThere = [this] { return m_computedAny && m_lastCycle >= m_last->cycle; };
    const std::int64_t end = monotonicNow() + LongestRest;
    std::int64_t quiet = monotonicNow() + LongestQuiet;
    while (!m_stop && !isAllThere() && monotonicNow() < std::min(end, quiet)) {
        const char *frame = nullptr;
        std::size_t size = 0;
        const CyclicLink::Status status = m_link->poll(&frame, &size);
        if (status == CyclicLink::Closed)
            return;
        if (status == CyclicLink::Nothing) {
            TimeSource::monotonic().sleepUntil(monotonicNow() + 1'000'000);  // [ns]
            continue;
        }
        handle(frame, size);
        quiet = monotonicNow() + LongestQuiet;
    }
}

/// What did not come until the end has been lost.
void SlaveCycle::countMissing() noexcept
{
    const bool isBehind = m_last && (!m_computedAny || m_lastCycle < m_last->cycle);
    if (isBehind && m_last->cycle >= m_phase.firstCycle)
        count(m_counters.missed, lostBefore(m_last->cycle, m_last->before) + 1);
}

void SlaveCycle::compute() noexcept
{
    const std::uint64_t cycle = m_decoder.cycle();
    const std::uint16_t before = m_decoder.header().before;
    const std::uint64_t lost = lostBefore(cycle, before);
    const std::uint64_t missed
        = m_computedAny ? m_phase.interval.missed(m_lastCycle - m_phase.cycleZero, cycle - m_phase.cycleZero) : lost;
    count(m_counters.cycles);
    count(m_counters.missed, lost);
    count(m_counters.skipped, missed - std::min(missed, lost));
    if (m_decoder.header().flags & SafeStopFlag)
        makeSafe(QPlcSlaveNode::MasterStopsSafely,
                 {CycleEvent::ToldSafeStop, m_identity.node, 0, cycle - m_phase.cycleZero});
    const bool computed = m_runtime.step(QPlcCycle(cycle - m_phase.cycleZero, m_phase.period, missed),
                                         m_decoder.payload() + m_phase.group.offset);
    count(m_counters.finished);
    if (!computed && !m_faulted)
        m_reports.post({CycleEvent::NodeFaulted, m_identity.node, 0, cycle - m_phase.cycleZero});
    m_faulted = !computed;
    m_answer.before = std::uint16_t(
        m_computedAny ? std::min<std::uint64_t>(cycle - m_lastCycle, std::numeric_limits<std::uint16_t>::max()) : 0);
    m_computedAny = true;
    m_lastCycle = cycle;
    m_lastBefore = before;
    m_answer.flags = std::uint8_t((computed ? 0 : FaultFlag) | (m_runtime.isSafe() ? SafeStopFlag : 0)
                                  | (m_runtime.wantsSafeStop() ? StopWantedFlag : 0));
    m_answer.cycle = cycle;
    m_answer.info
        = std::uint32_t(std::min<std::int64_t>(m_runtime.executionTime(), std::numeric_limits<std::uint32_t>::max()));
    encodeAnswer();
    sendAnswer();
}

/// Whether the last good frame asks again for the cycle that was computed last; of several parts
/// only the first one counts.
bool SlaveCycle::isRepeatedRequest() const noexcept
{
    const FrameHeader &request = m_decoder.received();
    return (request.flags & ResentFlag) && !(request.flags & PartFlag) && request.cycle == m_lastCycle;
}

void SlaveCycle::encodeAnswer() noexcept
{
    char *frame = m_frames.data();
    for (std::size_t part = 0; part < m_encoder.partCount(); ++part) {
        m_encoder.encode(part, m_answer, m_runtime.outputs(), frame);
        frame += m_encoder.partSize(part);
    }
}

/// The same bytes, however often it is asked for.
void SlaveCycle::sendAnswer() noexcept
{
    const char *frame = m_frames.data();
    for (std::size_t part = 0; part < m_encoder.partCount(); ++part) {
        const std::size_t size = m_encoder.partSize(part);
        m_reports.tap(TappedFrame::Sent, m_identity.node, frame, size);
        m_link->send(frame, size);
        frame += size;
    }
    m_link->flush();
}

/// Once in a phase; nothing but the next phase ends it.
void SlaveCycle::makeSafe(QPlcSlaveNode::SafeStateReason reason, const CycleEvent &event) noexcept
{
    if (m_runtime.isSafe())
        return;
    m_runtime.makeSafe(reason);
    m_reports.post(event);
}

/// Duration on the clock of the master [ns].
std::int64_t SlaveCycle::simulated(std::int64_t time) const noexcept
{
    return std::int64_t(double(time) * m_phase.clock.scale());
}

/// What \a simulated takes of real time [ns].
std::int64_t SlaveCycle::lasting(std::chrono::nanoseconds simulated) const noexcept
{
    return std::int64_t(double(simulated.count()) / m_phase.clock.scale());
}

/// What the watchdog waits for between two frames [ns]; 0: for ever. Where simulated time stands
/// still between two frames, nothing can be over, except for real devices: they must not go on when
/// the program hangs that turns the clock.
std::int64_t SlaveCycle::watchdogTime() const noexcept
{
    if (m_phase.clock.isExternal() && m_runtime.traits().hardware)
        return m_phase.watchdog.count();
    return m_phase.clock.isTimed() ? lasting(m_phase.watchdog) : 0;
}

void SlaveCycle::checkWatchdog(std::int64_t now) noexcept
{
    if (!m_watchdog.isOn())
        return;
    const Watchdog::Answer answer = m_watchdog.look(now);
    if (answer == Watchdog::TooEarly)
        return;
    setAlarm();
    if (answer != Watchdog::Barks)
        return;
    count(m_counters.watchdog);
    if (m_phase.isSafeByWatchdog)
        m_runtime.makeSafe(QPlcSlaveNode::WatchdogReason);
    m_reports.post({CycleEvent::WatchdogTimedOut, m_identity.node, 0, m_lastCycle - m_phase.cycleZero});
}

/// The wait for frames ends when the watchdog wants to be looked at. Not in each cycle: a timer
/// that is set costs a system call.
void SlaveCycle::setAlarm() noexcept
{
    constexpr std::int64_t again = 1'000'000;  // [ns] in case that nothing waits just then
    if (m_watchdog.isOn())
        m_waits->interruptAt(m_watchdog.alarm(), again);
}

}  // namespace qplc
