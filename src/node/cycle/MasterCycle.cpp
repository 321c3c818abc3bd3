// SPDX-License-Identifier: Apache-2.0
#include "MasterCycle.h"

#include "QSplitPrimitive.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace qplc {

MasterCycle::MasterCycle(const QPlcSignalTable &table, CyclicHub &hub, bool tapFrames, TimeSource *time)
    : m_time(time ? *time : m_alarm)
    , m_image(table)
    , m_signalGuard(m_image, this)
    , m_slopes(m_image)
    , m_hub(hub)
    , m_reports(tapFrames)
    , m_guard(m_reports)
    , m_exchange(m_image, m_signalGuard, m_hub, m_reports, m_statistics, m_time, m_guard, m_stop)
    , m_tap(m_image, m_time)
    , m_snapshot(m_image.totalSize())
    , m_roster(std::make_unique<Roster>())
{
}

MasterCycle::~MasterCycle()
{
    stop();
    setRoster({});
}

// ---- thread of the master ----

bool MasterCycle::start(const Phase &phase)
{
    stop();
    m_phase = phase;
    m_stop = false;
    m_signalGuard.setUsualHold(phase.usualHold);
    clearStatistics();
    const double nanoseconds = double(phase.period.count());
    const bool isTimed = phase.clock.isTimed();
    m_clock.emplace(m_time, isTimed ? std::int64_t(nanoseconds / phase.clock.scale()) : 0, phase.overrunPolicy);
    m_alarm.setPeriod(m_clock->period());
    m_wallStart = isTimed ? wallClockNow() : 0;
    m_number = 0;
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        slot->expectFrom(m_cycleZero);
        slot->faulted = slot->pending = false;
        slot->bucket = 0;
        slot->isSafe = slot->behind = false;
        slot->nextTurn = 0;
        slot->exchange = {};
        if (slot->local)
            slot->local->beginPhase(!isTimed, m_time, phase.usualHold);
    }
    m_guard.start({isTimed ? phase.gapLimit.count() : 0,
                   isTimed ? std::int64_t(double(phase.longestWait.count()) / phase.clock.scale())
                       : phase.clock.isExternal() ? phase.longestWait.count()
                                                  : 0,
                   isTimed ? phase.overrunLimit : 0});
    startGuard();
    m_exchange.start(*m_clock, phase.period, phase.clock, m_cycleZero, phase.realTimeOptions.spin);
    m_tap.start(phase.ring, !isTimed, m_wallStart);
    m_tap.setRoster(&m_roster->text, 0);
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes)
        m_tap.join(*slot, 0);
    m_hasNewNodes = true;
    m_snapshot.publish(m_image.data(), 0);
    if (phase.clock.isExternal()) {
        m_clock->start();
        m_hasEnded = false;
        m_isStepped = true;
        m_gate.open();
        return true;
    }
    return m_thread.start(QStringLiteral("qtplc-master"), phase.realTimeOptions, [this] { run(); });
}

void MasterCycle::stop()
{
    if (!isRunning())
        return;
    m_stop = true;
    if (m_isStepped)
        m_gate.close();
    m_thread.join();
    if (m_isStepped)
        end();
    m_isStepped = false;
    m_cycleZero += m_number + 1;  // frames of this phase can never be taken for frames of the next
    takeCommands();
    m_slopes.finish();
    freeRetired();
}

/// Nodes must hear of it also while nobody calls step(), and again if a frame is lost: from now on
/// the thread runs the cycles.
void MasterCycle::makeSafe()
{
    m_guard.request();
    if (!m_isStepped || m_stop || m_thread.isRunning())
        return;
    m_gate.close();
    if (!m_thread.start(QStringLiteral("qtplc-master"), m_phase.realTimeOptions, [this] { runSafely(); }))
        runCycle(m_clock->next([] { return false; }));  // no thread can be had: nodes are told once
}

/// Cycles are counted from 0 again: what has its initial value now is as if it were of the cycle
/// before.
void MasterCycle::startGuard()
{
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes)
        slot->written.taken = slot->initialCycle(0);  // and so is what it says of contested signals
    for (const QPlcSignalIndex own : {m_phase.timeSignal, m_phase.jitterSignal, m_phase.workloadSignal}) {
        if (own != QPlcInvalidSignalIndex)
            m_signalGuard.set(own, QPlcQuality::Good);
    }
    m_signalGuard.settle(-1);
    m_signalGuard.clearCounters();
}

void MasterCycle::storeInitialOutputs(NodeSlot &slot, const char *outputs, const std::vector<bool> &held)
{
    const std::int64_t cycle = slot.initialCycle(0);
    const SignalGuard::Frame frame = SignalGuard::frameFor(m_image, slot.outputLayout, held);
    slot.claims.forget();  // what it said in another phase
    slot.written.isWhole = false;
    m_signalGuard.store(frame, slot.written, outputs, cycle, cycle);
    m_signalGuard.claim(frame, slot.written, slot.claims, outputs, cycle);
}

void MasterCycle::forgetOutputs(std::int64_t usualHold)
{
    m_signalGuard.setUsualHold(usualHold);
    m_signalGuard.forget();
}

void MasterCycle::initialOutputsTaken(Roster roster)
{
    roster.arrange(m_image);
    for (const SignalGuard::Contest &contest : roster.contests)
        m_signalGuard.decide(contest, -1);
    m_signalGuard.settle(-1);
}

void MasterCycle::clearStatistics()
{
    m_cycle = 0;
    m_digest = 0;
    m_statistics.restart(!m_phase.clock.isTimed(), m_hub.strangers(), m_hub.floods());
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes)
        slot->statistics.clear();
}

void MasterCycle::setRoster(const Roster &roster)
{
    freeRetired();
    auto copy = std::make_unique<Roster>(roster);
    copy->arrange(m_image);
    copy->text = copy->describe().toText();
    if (!isRunning()) {
        delete m_pendingRoster.exchange(nullptr);
        adopt(copy.release(), -1);
        freeRetired();
        return;
    }
    delete m_pendingRoster.exchange(copy.release());  // one that was never adopted belongs to nobody else
}

void MasterCycle::freeRetired()
{
    for (Roster *retired = nullptr; m_retiredRosters.pop(&retired);)
        delete retired;
}

bool MasterCycle::setValues(const std::vector<SignalSetting> &settings)
{
    if (!isRunning()) {
        for (const SignalSetting &setting : settings) {
            m_image.setValue(setting.signal, setting.value);
            m_signalGuard.set(setting.signal, setting.quality);
        }
        return true;
    }
    if (!hasRoomFor(settings.size()))
        return false;
    for (const SignalSetting &setting : settings) {
        SetCommand *command = m_setCommands.beginPush();
        command->signal = setting.signal;
        command->quality = setting.quality;
        command->isEndOfWay = false;
        setting.value.toBytes(command->bytes.data());
        m_setCommands.commitPush();
    }
    m_setsGiven += settings.size();
    return true;
}

/// Without cycles no signal is on its way.
bool MasterCycle::endWays(const std::vector<QPlcSignalIndex> &indices)
{
    if (!isRunning())
        return true;
    if (!hasRoomFor(indices.size()))
        return false;
    for (const QPlcSignalIndex signal : indices) {
        SetCommand *command = m_setCommands.beginPush();
        command->signal = signal;
        command->isEndOfWay = true;
        m_setCommands.commitPush();
    }
    m_setsGiven += indices.size();
    return true;
}

bool MasterCycle::hasRoomFor(std::size_t settings) const
{
    return !isRunning()
        || m_setsGiven - m_setsTaken.load(std::memory_order_acquire) + settings <= m_setCommands.capacity();
}

std::vector<char> MasterCycle::values() const
{
    if (!isRunning())
        return std::vector<char>(m_image.data(), m_image.data() + m_image.totalSize());
    std::vector<char> bytes(m_image.totalSize());
    std::uint64_t stamp = 0;
    m_snapshot.read(bytes.data(), &stamp);
    return bytes;
}

QPlcValue MasterCycle::value(QPlcSignalIndex signal) const
{
    return QPlcValue::fromBytes(table().at(signal).type, values().data() + offset(signal));
}

QByteArray MasterCycle::gather(const std::vector<CopyRun> &runs, quint32 size) const
{
    QByteArray frame(int(size), Qt::Uninitialized);
    copyRuns(runs, values().data(), frame.data());
    return frame;
}

QPlcMasterStatistics MasterCycle::statistics() const
{
    QPlcMasterStatistics statistics = m_statistics.summary();
    statistics.imageDigest = m_digest;
    return statistics;
}

// ---- cycle thread ----

void MasterCycle::run() noexcept
{
    const auto shouldStop = [this] { return m_stop.load(std::memory_order_relaxed); };
    m_clock->start();
    while (!shouldStop()) {
        const CycleClock::Tick tick = m_clock->next(shouldStop);
        if (tick.interrupted || isBeyondLimit(tick.cycle))
            break;
        if (tick.stopped && m_guard.isTripped()) {
            m_clock->shift(tick.lateness);  // whoever is to be safe must go on hearing it
            continue;
        }
        if (tick.stopped) {
            m_reports.post({CycleEvent::Overrun, 0, 0, tick.cycle, tick.lateness});
            break;
        }
        runCycle(tick);
        if (isBeyondLimit(m_number + 1))
            break;
        if (m_guard.isTripped() && m_phase.clock.isLockstep())
            pauseSince(m_time.now());
    }
    end();
    m_reports.post({CycleEvent::Ended, 0, 0, m_number});
}

void MasterCycle::end() noexcept
{
    m_tap.end();
    m_statistics.fold();
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes)
        slot->statistics.fold();
}

MasterCycle::Step MasterCycle::step() noexcept
{
    return enterStep();
}

MasterCycle::Step MasterCycle::step(std::uint64_t number,
                                    const std::function<void(ProcessImage &image)> &setInputs) noexcept
{
    m_givenNumber = number;
    m_setInputs = &setInputs;
    const Step result = enterStep();
    m_setInputs = nullptr;
    return result;
}

MasterCycle::Step MasterCycle::enterStep() noexcept
{
    const StepGate::Answer answer = m_gate.enter();
    if (answer == StepGate::Busy)
        return Step::Busy;
    if (answer == StepGate::Closed)
        return m_guard.isTripped() && !m_stop.load(std::memory_order_relaxed) ? Step::Safe : Step::Stopped;
    Step result = Step::Stopped;
    if (m_guard.isTripped())
        result = Step::Safe;  // the thread of the master is about to let the cycles be safe
    else if (!m_hasEnded && !m_stop.load(std::memory_order_relaxed))
        result = runStep();
    m_gate.leave();
    return result;
}

MasterCycle::Step MasterCycle::runStep() noexcept
{
    CycleClock::Tick tick = m_clock->next([] { return false; });
    if (m_setInputs)
        tick.cycle = m_givenNumber;
    m_hasLost = false;
    runCycle(tick);
    const bool isLast = isBeyondLimit(m_number + 1);
    const bool hasFailed = m_exchange.hasFailed();
    m_hasEnded = isLast || hasFailed;  // the thread of the master hears of a failure a little later
    if (isLast)
        m_reports.post({CycleEvent::Ended, 0, 0, m_number});
    if (m_stop.load(std::memory_order_relaxed))
        return Step::Stopped;
    if (m_guard.isTripped())
        return Step::Safe;
    if (hasFailed)
        return Step::Stopped;
    const bool isComplete = !m_roster->anyRemote || m_exchange.isComplete();
    return isComplete && !m_hasLost ? Step::Complete : Step::Late;
}

/// The cycles of a safe stop, where nobody else runs them.
void MasterCycle::runSafely() noexcept
{
    while (!m_stop.load(std::memory_order_relaxed)) {
        const std::int64_t begin = m_time.now();
        runCycle(m_clock->next([] { return false; }));
        pauseSince(begin);
    }
}

/// Nobody is waited for in a safe stop: without a clock something else has to hold the cycles back.
void MasterCycle::pauseSince(std::int64_t begin) noexcept
{
    constexpr std::int64_t longest = 50'000'000;  // [ns] a stop is never noticed later than this
    m_time.sleepUntil(begin + std::min(m_phase.period.count(), longest));
}

/// One cycle. Everything that happens in it stands here, in order.
void MasterCycle::runCycle(const CycleClock::Tick &tick) noexcept
{
    m_number = tick.cycle;
    m_statistics.begin(tick, m_clock->period());
    m_guard.begin(tick, m_clock->period(), m_phase.clock.isTimed() ? m_time.slept() : 0);
    m_hasSetValues = m_slopes.isMoving();
    takeCommands();
    endTerms(tick);
    if (m_guard.isTripped())
        m_slopes.leaveAll();
    m_slopes.advance(double(m_phase.period.count()) * 1e-9);
    writeOwnSignals(tick);
    if (m_guard.isTripped())
        m_roster->safeImage.applyTo(m_image.data());
    m_exchange.begin(*m_roster, {m_number, tick.lateness, tick.deadline});
    if (m_setInputs)
        (*m_setInputs)(m_image);
    if (m_hasNewNodes || m_hasSetValues || tick.skipped > 0 || m_guard.isTripped() || m_tap.hasGap())
        m_tap.keepBefore();
    m_statistics.stageEnded(CycleStage::Commands, now());
    m_exchange.run();
    finish(tick);
}

void MasterCycle::adoptPending() noexcept
{
    if (m_pendingRoster.load(std::memory_order_relaxed)) {
        if (Roster *roster = m_pendingRoster.exchange(nullptr, std::memory_order_acquire))
            adopt(roster, std::int64_t(m_number) - 1);
    }
}

/// A value may have been set because of a roster that came before it: a roster is always adopted
/// before the values that follow it.
void MasterCycle::takeCommands() noexcept
{
    adoptPending();
    while (const SetCommand *command = m_setCommands.front()) {
        adoptPending();
        carryOut(*command);
        m_setCommands.pop();
        m_setsTaken.store(m_setsTaken.load(std::memory_order_relaxed) + 1, std::memory_order_release);
    }
}

void MasterCycle::carryOut(const SetCommand &command) noexcept
{
    if (m_roster->isNeutral(command.signal))
        return;  // the thread of the master has accepted it, and was then so busy that the holder was lost
    // It may have got a writer, which has joined since.
    const bool isOfWriter = m_slopes.isLimited(command.signal) && m_roster->isWritten(command.signal);
    if (command.isEndOfWay || isOfWriter)
        m_slopes.leave(command.signal);  // one that was on its way has set m_hasSetValues
    else
        put(command.signal, command.bytes.data(), command.quality);
}

/// Signals whose term is over get their neutral values here, however busy the thread of the master
/// is; it finds out later. The clock is the real one, also if cycles do not follow it: a person is
/// waited for.
void MasterCycle::endTerms(const CycleClock::Tick &tick) noexcept
{
    if (m_roster->terms.empty())
        return;
    const std::int64_t time = m_phase.clock.isTimed() ? tick.woken : m_time.now();
    if (time < m_nextTerm)
        return;
    m_nextTerm = std::numeric_limits<std::int64_t>::max();
    for (const Roster::HeldTerm &held : m_roster->terms) {
        if (held.term->end(time))
            put(held.signal, m_roster->safeImage.data() + m_image.offset(held.signal), QPlcQuality::Safe);
        else if (!held.term->hasEnded())
            m_nextTerm = std::min(m_nextTerm, held.term->deadline());
    }
}

void MasterCycle::put(QPlcSignalIndex signal, const char *bytes, QPlcQuality quality) noexcept
{
    if (m_slopes.isLimited(signal) && !m_guard.isTripped())
        m_slopes.aim(signal, bytes);
    else
        std::memcpy(m_image.data() + m_image.offset(signal), bytes, std::size_t(table().at(signal).type.size()));
    m_signalGuard.set(signal, quality);
    m_hasSetValues = true;
}

/// \param last  the newest cycle that has ended
void MasterCycle::adopt(Roster *roster, std::int64_t last) noexcept
{
    const auto contains = [](const Roster &where, const NodeSlot *slot) {
        return std::any_of(where.nodes.begin(), where.nodes.end(),
                           [slot](const std::shared_ptr<NodeSlot> &other) { return other.get() == slot; });
    };
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        if (!contains(*roster, slot.get()))
            leave(*slot);
    }
    const bool isHeldAnew = roster->held != m_roster->held;
    for (std::size_t i = 0; i < roster->nodes.size(); ++i) {
        NodeSlot &slot = *roster->nodes[i];
        slot.paste = roster->pasted.empty() ? &slot.outputs : &roster->pasted[i];
        if (!contains(*m_roster, &slot))
            join(slot, last);
        else if (isHeldAnew)
            m_signalGuard.resume(*slot.paste, slot.written, last);
    }
    for (const QPlcSignalIndex signal : roster->abandoned)
        m_signalGuard.abandon(signal);
    for (std::size_t signal = 0; isHeldAnew && signal < roster->held.size(); ++signal) {
        if (roster->held[signal])
            m_signalGuard.keep(SignalGuard::Place(signal));
    }
    m_hasNewNodes = true;
    m_tap.setRoster(&roster->text, m_number);
    Roster *retired = m_roster.release();
    m_roster.reset(roster);
    m_nextTerm = 0;
    if (m_slopes.isMoving())
        m_slopes.leaveAll(m_roster->written);  // what a node writes is its own from the next answer on
    if (!m_retiredRosters.push(retired))
        delete retired;  // 64 changes of the roster between two looks of the owner: better a slow cycle than a leak
}

void MasterCycle::leave(NodeSlot &slot) noexcept
{
    const bool isMissed = slot.asked && !slot.answered;  // the last cycle has told so
    m_hasLost = m_hasLost || (slot.peer && !slot.listener && !isMissed);
    slot.statistics.fold();
    m_signalGuard.leave(*slot.paste, slot.written);
    if (slot.peer)
        m_hub.detach(slot.peer.get());
}

void MasterCycle::join(NodeSlot &slot, std::int64_t last) noexcept
{
    const std::int64_t cycle = slot.initialCycle(last + 1);
    m_signalGuard.resume(*slot.paste, slot.written, last);
    if (!slot.initialOutputs.empty()) {
        m_signalGuard.store(*slot.paste, slot.written, slot.initialOutputs.data(), cycle, cycle);
        m_signalGuard.claim(*slot.paste, slot.written, slot.claims, slot.initialOutputs.data(), cycle);
    }
    slot.exchange = {};
    slot.expectFrom(m_cycleZero + m_number);
    slot.nextTurn = 0;
    slot.behind = false;
    m_tap.join(slot, m_number);
    if (slot.peer)
        m_hub.attach(slot.peer.get());
}

void MasterCycle::writeReal(QPlcSignalIndex signal, double value) noexcept
{
    if (signal == QPlcInvalidSignalIndex)
        return;
    char *bytes = m_image.data() + m_image.offset(signal);
    if (m_image.table().at(signal).type.scalar() == QPlcSignalType::Real32)
        QSplitPrimitive<float>(float(value)).toBytes(bytes);
    else
        QSplitPrimitive<double>(value).toBytes(bytes);
}

void MasterCycle::valueRefused(std::uint16_t writer, SignalGuard::Place place, const ValueFault &fault,
                               bool isFirst) noexcept
{
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes)
        slot->exchange.isChanged = slot->exchange.isChanged || slot->id == writer;
    if (isFirst)
        m_reports.post({CycleEvent::ValueRefused, writer, std::uint16_t(place), m_number, 0, fault});
}

void MasterCycle::signalBecameSafe(SignalGuard::Place place) noexcept
{
    m_reports.post({CycleEvent::SignalSafe, 0, std::uint16_t(place), m_number});
}

void MasterCycle::writeOwnSignals(const CycleClock::Tick &tick) noexcept
{
    if (m_phase.timeSignal != QPlcInvalidSignalIndex) {
        const qint64 time = m_wallStart + qint64(m_number) * m_phase.period.count();
        QSplitPrimitive<qint64>(time).toBytes(m_image.data() + m_image.offset(m_phase.timeSignal));
    }
    writeReal(m_phase.jitterSignal, double(tick.lateness) * 1e-9);
    writeReal(m_phase.workloadSignal, double(m_statistics.workload()) * 1e-9);
}

void MasterCycle::finish(const CycleClock::Tick &tick) noexcept
{
    m_digest.store(m_image.digest(m_digest.load(std::memory_order_relaxed)), std::memory_order_relaxed);
    record(tick);
    m_snapshot.publish(m_image.data(), m_number);
    m_cycle.store(m_number, std::memory_order_relaxed);
    const std::int64_t end = now();
    m_statistics.stageEnded(CycleStage::Finish, end);
    m_statistics.end(end);
    foldStatistics();
}

void MasterCycle::record(const CycleClock::Tick &tick) noexcept
{
    const auto flag = [](bool isSet, RecordedCycle::Flag value) { return isSet ? std::uint32_t(value) : 0; };
    const bool isTimed = m_phase.clock.isTimed();
    CycleTap::Cycle cycle{m_number, tick.skipped, isTimed ? tick.lateness : 0};
    cycle.flags = flag(m_guard.isTripped(), RecordedCycle::Safe) | flag(tick.caughtUp, RecordedCycle::CaughtUp)
        | flag(std::exchange(m_hasNewNodes, false), RecordedCycle::NewNodes) | flag(isTimed, RecordedCycle::Timed)
        | flag(m_roster->anyRemote && !m_exchange.isComplete(), RecordedCycle::Incomplete)
        | flag(m_hasSetValues, RecordedCycle::SetValues);
    cycle.digest = m_digest.load(std::memory_order_relaxed);
    cycle.wallTime = isTimed ? wallClockNow() : 0;
    cycle.settings = m_setsTaken.load(std::memory_order_relaxed);
    m_tap.record(cycle, *m_roster, m_stop, m_guard);
}

/// Of one node in each cycle, in turn, and then of the master itself: all at once would make a
/// cycle long.
void MasterCycle::foldStatistics() noexcept
{
    const std::size_t turn = std::size_t(m_number) % (m_roster->nodes.size() + 1);
    if (turn < m_roster->nodes.size())
        m_roster->nodes[turn]->statistics.fold();
    else
        m_statistics.fold();
}

void MasterCycle::sourceChanged(SignalGuard::Place place, std::uint16_t from, std::uint16_t to) noexcept
{
    if (from != 0 && to != 0)
        m_reports.post({CycleEvent::SourceChanged, to, std::uint16_t(place), m_number, from});
}

}  // namespace qplc
