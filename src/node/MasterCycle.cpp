// SPDX-License-Identifier: Apache-2.0
#include "MasterCycle.h"

#include "QSplitPrimitive.h"

#include <algorithm>
#include <limits>

namespace qplc {

namespace {

constexpr std::int64_t Slice = 50'000'000;         // [ns] longest wait without a look at stop and lost nodes
constexpr std::int64_t ContinueAfter = 1'000'000;  // [ns] a stream that was full is offered the rest
constexpr std::int64_t ResendAfter = 20'000'000;   // [ns] a request that must be answered is sent again

}  // namespace

MasterCycle::MasterCycle(const QPlcSignalTable &table, CyclicHub &hub, bool tapFrames, TimeSource &time)
    : m_time(time)
    , m_image(table)
    , m_hub(hub)
    , m_reports(tapFrames)
    , m_snapshot(m_image.size())
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
    clearStatistics();
    const double nanoseconds = double(phase.period.count());
    m_clock.emplace(m_time, phase.clock.isLockstep() ? 0 : std::int64_t(nanoseconds / phase.clock.scale()),
                    phase.overrunPolicy);
    m_wallStart = phase.clock.isLockstep() ? 0 : wallClockNow();
    m_number = 0;
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        slot->decoder.restart(m_cycleZero);
        slot->faulted = false;
        if (slot->local)
            slot->local->setLockstep(phase.clock.isLockstep(), m_time);
    }
    m_snapshot.publish(m_image.data(), 0);
    return m_thread.start(QStringLiteral("qtplc-master"), phase.realTimeOptions, [this] { run(); });
}

void MasterCycle::stop()
{
    if (!m_thread.isRunning())
        return;
    m_stop = true;
    m_thread.join();
    m_cycleZero += m_number + 1;  // frames of this phase can never be taken for frames of the next
    takeCommands();
    freeRetired();
}

void MasterCycle::clearStatistics()
{
    m_cycle = 0;
    m_digest = 0;
    m_statistics.restart(m_phase.clock.isLockstep(), m_hub.strangers());
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes)
        slot->statistics.clear();
}

void MasterCycle::setRoster(const Roster &roster)
{
    freeRetired();
    auto copy = std::make_unique<Roster>(roster);
    if (!isRunning()) {
        delete m_pendingRoster.exchange(nullptr);
        adopt(copy.release());
        freeRetired();
        return;
    }
    for (const std::shared_ptr<NodeSlot> &slot : roster.nodes) {
        if (slot->local)
            slot->local->setLockstep(m_phase.clock.isLockstep(), m_time);
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
        for (const SignalSetting &setting : settings)
            m_image.setValue(setting.signal, setting.value);
        return true;
    }
    if (m_setsGiven - m_setsTaken.load(std::memory_order_acquire) + settings.size() > m_setCommands.capacity())
        return false;
    for (const SignalSetting &setting : settings) {
        SetCommand *command = m_setCommands.beginPush();
        command->signal = setting.signal;
        setting.value.toBytes(command->bytes.data());
        m_setCommands.commitPush();
    }
    m_setsGiven += settings.size();
    return true;
}

std::vector<char> MasterCycle::values() const
{
    if (!isRunning())
        return std::vector<char>(m_image.data(), m_image.data() + m_image.size());
    std::vector<char> bytes(m_image.size());
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
        if (tick.stopped) {
            m_reports.post({CycleEvent::Overrun, 0, 0, tick.cycle, tick.lateness});
            break;
        }
        runCycle(tick);
        if (isBeyondLimit(m_number + 1))
            break;
    }
    m_reports.post({CycleEvent::Ended, 0, 0, m_number});
}

/// One cycle. Everything that happens in it stands here, in order.
void MasterCycle::runCycle(const CycleClock::Tick &tick) noexcept
{
    m_number = tick.cycle;
    m_statistics.begin(tick, m_clock->period());
    takeCommands();
    writeOwnSignals(tick);
    m_statistics.stageEnded(CycleStage::Commands, now());
    askNodes(tick);
    m_statistics.stageEnded(CycleStage::Ask, now());
    stepLocalNodes();
    m_statistics.stageEnded(CycleStage::LocalNodes, now());
    if (m_anyRemote) {
        collectAnswers(tick.deadline);
        m_statistics.stageEnded(CycleStage::Collect, now());
    }
    finish();
}

void MasterCycle::takeCommands() noexcept
{
    if (m_pendingRoster.load(std::memory_order_relaxed)) {
        if (Roster *roster = m_pendingRoster.exchange(nullptr, std::memory_order_acquire))
            adopt(roster);
    }
    while (const SetCommand *command = m_setCommands.front()) {
        std::memcpy(m_image.data() + m_image.offset(command->signal), command->bytes.data(),
                    std::size_t(m_image.table().at(command->signal).type.size()));
        m_setCommands.pop();
        m_setsTaken.store(m_setsTaken.load(std::memory_order_relaxed) + 1, std::memory_order_release);
    }
}

void MasterCycle::adopt(Roster *roster) noexcept
{
    const auto contains = [](const Roster &where, const NodeSlot *slot) {
        return std::any_of(where.nodes.begin(), where.nodes.end(),
                           [slot](const std::shared_ptr<NodeSlot> &other) { return other.get() == slot; });
    };
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        if (slot->peer && !contains(*roster, slot.get()))
            m_hub.detach(slot->peer.get());
    }
    for (const std::shared_ptr<NodeSlot> &slot : roster->nodes) {
        if (contains(*m_roster, slot.get()))
            continue;
        if (!slot->initialOutputs.empty())
            copyRuns(slot->outputRuns, slot->initialOutputs.data(), m_image.data());
        slot->decoder.restart(m_cycleZero + m_number);
        if (slot->peer)
            m_hub.attach(slot->peer.get());
    }
    m_anyRemote = std::any_of(roster->nodes.begin(), roster->nodes.end(),
                              [](const std::shared_ptr<NodeSlot> &slot) { return slot->peer != nullptr; });
    Roster *retired = m_roster.release();
    m_roster.reset(roster);
    if (!m_retiredRosters.push(retired))
        delete retired;  // 64 changes of the roster between two looks of the owner: better a slow cycle than a leak
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

void MasterCycle::writeOwnSignals(const CycleClock::Tick &tick) noexcept
{
    if (m_phase.timeSignal != QPlcInvalidSignalIndex) {
        const qint64 time = m_wallStart + qint64(m_number) * m_phase.period.count();
        QSplitPrimitive<qint64>(time).toBytes(m_image.data() + m_image.offset(m_phase.timeSignal));
    }
    writeReal(m_phase.jitterSignal, double(tick.lateness) * 1e-9);
    writeReal(m_phase.workloadSignal, double(m_statistics.workload()) * 1e-9);
}

void MasterCycle::askNodes(const CycleClock::Tick &tick) noexcept
{
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        copyRuns(slot->inputRuns, m_image.data(), slot->inputs.data());
        slot->answered = false;
        slot->request.cycle = std::uint32_t(m_cycleZero + m_number);
        slot->request.info
            = std::uint32_t(std::min<std::int64_t>(tick.lateness, std::numeric_limits<std::uint32_t>::max()));
        if (!slot->peer)
            continue;
        slot->statistics.asked(m_number, m_statistics.stageBegin(), m_statistics.deadline());
        sendRequest(*slot, 0);
    }
    if (m_anyRemote) {
        m_statistics.asked();
        m_hub.flush();
    }
}

void MasterCycle::sendRequest(NodeSlot &slot, std::uint8_t flags) noexcept
{
    slot.request.flags = flags;
    slot.partsSent = 0;
    slot.bytesSent = 0;
    sendParts(slot);
}

/// Sends the parts of the request that are still to be sent, as far as the kernel takes them.
void MasterCycle::sendParts(NodeSlot &slot) noexcept
{
    m_hub.sendRest(slot.peer.get());
    for (; slot.partsSent < slot.encoder.partCount(); ++slot.partsSent) {
        const std::size_t size = slot.encoder.partSize(slot.partsSent);
        char *frame = slot.frames.data() + slot.bytesSent;
        slot.encoder.encode(slot.partsSent, slot.request, slot.inputs.data(), frame);
        if (!m_hub.send(slot.peer.get(), frame, size))
            return;
        m_reports.tap(TappedFrame::Sent, slot.id, frame, size);
        slot.bytesSent += size;
    }
}

/// Goes on with requests that a stream did not take as a whole. \return whether some of them are still not sent
bool MasterCycle::continueRequests() noexcept
{
    bool unsent = false;
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        if (!isAwaited(*slot) || slot->isRequestSent())
            continue;
        sendParts(*slot);
        unsent = unsent || !slot->isRequestSent();
    }
    return unsent;
}

/// Sends again what the network may have lost.
void MasterCycle::resendRequests() noexcept
{
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        if (!isAwaited(*slot) || !mustBeWaitedFor(*slot) || !slot->peer->isUdp())
            continue;
        slot->statistics.resent.add();
        sendRequest(*slot, ResentFlag);
    }
    m_hub.flush();
}

void MasterCycle::stepLocalNodes() noexcept
{
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        if (!slot->local)
            continue;
        const QPlcCycle &last = slot->local->cycle();
        const quint64 missed = m_number > last.number() + 1 ? m_number - last.number() - 1 : 0;
        slot->computed = slot->local->step(QPlcCycle(m_number, m_phase.period, missed), slot->inputs.data());
        slot->answered = true;
        if (!slot->computed && !slot->faulted)
            m_reports.post({CycleEvent::NodeFaulted, slot->id, 0, m_number});
        slot->faulted = !slot->computed;
        slot->statistics.stepped(slot->local->endOfStep(), slot->local->executionTime(), m_statistics.deadline());
    }
}

bool MasterCycle::anyMissing(bool onlyWaiting) const noexcept
{
    return std::any_of(m_roster->nodes.begin(), m_roster->nodes.end(),
                       [this, onlyWaiting](const std::shared_ptr<NodeSlot> &slot) {
                           return isAwaited(*slot) && (!onlyWaiting || mustBeWaitedFor(*slot));
                       });
}

void MasterCycle::collectAnswers(std::int64_t deadline) noexcept
{
    if (!m_phase.clock.isLockstep()) {
        while (anyMissing(false)) {
            const std::int64_t left = deadline - m_time.now();
            if (m_stop.load(std::memory_order_relaxed))
                return;  // nobody is late who was not given the time
            if (left <= 0)
                break;
            receive(std::min(left, continueRequests() ? ContinueAfter : Slice));
        }
        reportLateNodes();
    }
    if (anyMissing(true))
        waitForLateNodes(deadline);
    else if (m_phase.clock.isLockstep())
        receive(0);  // what listeners have to say
}

void MasterCycle::reportLateNodes() noexcept
{
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        if (!isAwaited(*slot))
            continue;
        slot->statistics.late.add();
        m_statistics.lateAnswers.add();
        if (slot->reports())
            m_reports.post({CycleEvent::LateAnswer, slot->id, 0, m_number});
    }
}

/// Time stands still until the nodes that must be waited for have answered (or are lost).
void MasterCycle::waitForLateNodes(std::int64_t deadline) noexcept
{
    const bool lockstep = m_phase.clock.isLockstep();
    if (!lockstep)
        m_reports.post({CycleEvent::WaitingForNode, 0, 0, m_number});
    std::int64_t resendAt = m_time.now() + ResendAfter;
    while (anyMissing(true) && !m_stop.load(std::memory_order_relaxed)) {
        receive(continueRequests() ? ContinueAfter : ResendAfter);
        if (m_time.now() < resendAt)
            continue;
        resendRequests();
        resendAt = m_time.now() + ResendAfter;
    }
    if (!lockstep) {
        m_clock->shift(std::max<std::int64_t>(0, m_time.now() - deadline));
        m_reports.post({CycleEvent::WaitingEnded, 0, 0, m_number});
    }
}

void MasterCycle::receive(std::int64_t timeout) noexcept
{
    const std::int64_t begin = now();
    const bool arrived = m_hub.wait(timeout);
    m_statistics.waited(now() - begin);
    if (!arrived)
        return;
    CyclicHub::Incoming incoming;
    while (m_hub.next(&incoming))
        takeAnswer(*static_cast<NodeSlot *>(incoming.peer->owner), incoming.frame, incoming.size);
    m_statistics.setStrangers(m_hub.strangers());
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        if (slot->peer && slot->peer->isClosed() && !slot->lost.exchange(true))
            m_reports.post({CycleEvent::LinkClosed, slot->id, 0, m_number});
    }
}

void MasterCycle::takeAnswer(NodeSlot &slot, const char *frame, std::size_t size) noexcept
{
    m_reports.tap(TappedFrame::Received, slot.id, frame, size);
    switch (slot.decoder.decode(frame, size)) {
    case FrameStatus::Complete:
        break;
    case FrameStatus::Incomplete:
        return;
    case FrameStatus::Duplicate:
        slot.statistics.duplicated.add();
        return;
    case FrameStatus::Old:
        slot.statistics.reordered.add();
        return;
    default:
        slot.statistics.rejected.add();
        return;
    }
    // An answer to an older cycle is late and counted as such, but still newer than what the image holds.
    const bool current = slot.decoder.cycle() == m_cycleZero + m_number;
    slot.answered = slot.answered || current;
    const std::int64_t arrival = now();
    slot.statistics.answered(slot.decoder.cycle() - m_cycleZero, arrival, slot.decoder.header().info);
    if (current)
        m_statistics.answered(arrival);
    const bool faulted = slot.decoder.header().flags & FaultFlag;
    if (faulted && !slot.faulted)
        m_reports.post({CycleEvent::NodeFaulted, slot.id, 0, m_number});
    slot.faulted = faulted;
    if (!faulted)
        paste(slot, slot.decoder.payload());
}

bool MasterCycle::paste(NodeSlot &slot, const char *outputs) noexcept
{
    if (const PayloadLayout::Field *field = slot.firstNotFinite(outputs)) {
        m_reports.post({CycleEvent::NotFinite, slot.id, field->signal, m_number});
        return false;
    }
    copyRuns(slot.outputRuns, outputs, m_image.data());
    return true;
}

void MasterCycle::finish() noexcept
{
    // Local nodes saw the image of the cycle before, whatever their order: their outputs come in only now.
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        if (slot->local && slot->computed)
            paste(*slot, slot->local->outputs());
    }
    m_digest.store(m_image.digest(m_digest.load(std::memory_order_relaxed)), std::memory_order_relaxed);
    m_snapshot.publish(m_image.data(), m_number);
    m_cycle.store(m_number, std::memory_order_relaxed);
    const std::int64_t end = now();
    m_statistics.stageEnded(CycleStage::Finish, end);
    m_statistics.end(end);
}

}  // namespace qplc
