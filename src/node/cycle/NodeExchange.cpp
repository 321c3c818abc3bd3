// SPDX-License-Identifier: Apache-2.0
#include "NodeExchange.h"

#include <algorithm>
#include <limits>

namespace qplc {

namespace {

constexpr std::int64_t Slice = 50'000'000;         // [ns] longest wait without a look at stop and lost nodes
constexpr std::int64_t ContinueAfter = 1'000'000;  // [ns] a stream that was full is offered the rest
constexpr std::int64_t ResendAfter = 20'000'000;   // [ns] a request that must be answered is sent again

}  // namespace

NodeExchange::NodeExchange(ProcessImage &image, SignalGuard &signalGuard, CyclicHub &hub, CycleReports &reports,
                           CycleStatistics &statistics, TimeSource &time, SafetyGuard &guard,
                           const std::atomic<bool> &stop)
    : m_image(image)
    , m_signalGuard(signalGuard)
    , m_hub(hub)
    , m_reports(reports)
    , m_statistics(statistics)
    , m_time(time)
    , m_guard(guard)
    , m_stop(stop)
{
}

void NodeExchange::start(CycleClock &grid, std::chrono::nanoseconds period, QPlcClock clock, std::uint64_t cycleZero,
                         std::int64_t spin)
{
    m_grid = &grid;
    m_period = period;
    m_clock = clock;
    m_cycleZero = cycleZero;
    m_spin = spin;
    m_hasFailed = false;
}

void NodeExchange::begin(const Roster &roster, const Cycle &cycle) noexcept
{
    const bool hasSkipped = cycle.number > m_cycle.number + 1;
    m_roster = &roster;
    m_cycle = cycle;
    m_hasReceived = false;
    m_waitBegin = Never;
    m_isSafe = m_guard.isTripped();
    if (hasSkipped && !m_isSafe)
        m_signalGuard.settle(guardCycle() - 1);  // what has no new value is older by the cycles that were left out, too
}

/// Everything that nodes and master exchange in a cycle stands here, in order.
void NodeExchange::run() noexcept
{
    const Roster &roster = *m_roster;
    cutInputs();
    m_signalGuard.ageAbandoned(guardCycle());
    pasteKnownOutputs();
    for (std::size_t i = 0; i < roster.stages.size(); ++i) {
        const Stage &stage = roster.stages[i];
        askNodes(stage);
        m_statistics.stageEnded(CycleStage::Ask, now());
        stepLocalNodes(stage);
        m_statistics.stageEnded(CycleStage::LocalNodes, now());
        const bool complete = !roster.anyRemote || collectAnswers(i);
        if (roster.anyRemote)
            m_statistics.stageEnded(CycleStage::Collect, now());
        pasteLocalNodes(stage);
        if (!complete)
            return;
        endStage(stage);
    }
    settle();
}

// ---- requests ----

/// Nobody has computed anything in this cycle yet: these are the values of the last one.
void NodeExchange::cutInputs() noexcept
{
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        slot->asked = slot->awaited = slot->answered = slot->late = false;
        slot->exchange.isStored = slot->exchange.isChanged = false;
        slot->due = slot->takesTurn(m_cycle.number);
        if (!slot->due)
            continue;
        copyRuns(slot->inputRuns, m_image.data(), slot->inputs);
        if (!slot->local)
            prepareRequest(*slot);
    }
}

void NodeExchange::prepareRequest(NodeSlot &slot) noexcept
{
    slot.partsEncoded = 0;
    slot.request.cycle = m_cycleZero + m_cycle.number;
    slot.request.info
        = std::uint32_t(std::min<std::int64_t>(m_cycle.lateness, std::numeric_limits<std::uint32_t>::max()));
    const SentCycles &sent = slot.multicast ? slot.multicast->sentCycles : slot.sentCycles;
    slot.request.before = sent.unsentBefore(slot.request.cycle);
}

/// Two-phase nodes have computed the outputs of this cycle in the last one.
void NodeExchange::pasteKnownOutputs() noexcept
{
    for (NodeSlot *slot : m_roster->twoPhase) {
        if (m_isSafe) {
            slot->pending = false;
            continue;
        }
        if (slot->pending)
            store(*slot, slot->local ? slot->local->outputs() : slot->decoder.payload(), guardCycle());
        else
            noteMissing(*slot);
        slot->pending = false;
    }
    if (!m_isSafe)
        decideContests();
}

void NodeExchange::askNodes(const Stage &stage) noexcept
{
    for (const Roster::Turn &turn : stage) {
        NodeSlot &slot = *turn.slot;
        if (!slot.due) {
            if (slot.peer && !slot.isRequestSent())
                sendParts(slot);
            continue;
        }
        copyRuns(slot.sameCycleRuns, m_image.data(), slot.inputs);
        if (!slot.peer)
            continue;
        slot.asked = true;
        slot.firstUnasked = slot.request.cycle + 1;
        slot.awaited = turn.feedsLaterStage && !slot.listener;
        slot.statistics.asked(m_cycle.number, m_statistics.stageBegin(), m_statistics.deadline());
        sendRequest(slot, 0);
        slot.sentCycles.note(slot.request);
    }
    sendMulticast(0);
    if (m_roster->anyRemote) {
        m_statistics.asked();
        m_hub.flush();
    }
}

void NodeExchange::sendRequest(NodeSlot &slot, std::uint8_t flags) noexcept
{
    if (slot.multicast) {
        slot.multicast->toBeSent = true;
        return;
    }
    const auto all = std::uint8_t(m_isSafe ? flags | SafeStopFlag : flags);
    if (all != slot.request.flags)
        slot.partsEncoded = 0;
    slot.request.flags = all;
    slot.partsSent = 0;
    slot.bytesSent = 0;
    sendParts(slot);
}

/// Sends the parts of the multicast group in which a node is asked.
void NodeExchange::sendMulticast(std::uint8_t flags) noexcept
{
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->multicast) {
        if (!slot->multicast->toBeSent)
            continue;
        FrameHeader header = slot->request;
        header.flags = m_isSafe ? flags | SafeStopFlag : flags;
        slot->multicast->send(m_hub, header);
        if (!(flags & ResentFlag))
            slot->multicast->sentCycles.note(header);
        m_reports.tap(TappedFrame::Sent, 0, slot->multicast->frame.data(), slot->multicast->frame.size());
    }
}

/// Sends the parts of the request that are still to be sent, as far as the kernel takes them.
void NodeExchange::sendParts(NodeSlot &slot) noexcept
{
    m_hub.sendRest(slot.peer.get());
    for (; slot.partsSent < slot.encoder.partCount(); ++slot.partsSent) {
        const std::size_t size = slot.encoder.partSize(slot.partsSent);
        char *frame = slot.frames.data() + slot.bytesSent;
        if (slot.partsSent == slot.partsEncoded) {
            slot.encoder.encode(slot.partsSent, slot.request, slot.inputs, frame);
            ++slot.partsEncoded;
        }
        if (!m_hub.send(slot.peer.get(), frame, size))
            return;
        m_reports.tap(TappedFrame::Sent, slot.id, frame, size);
        slot.bytesSent += size;
    }
}

/// Goes on with requests that a stream did not take as a whole. \return whether some of them are
/// still not sent
bool NodeExchange::continueRequests() noexcept
{
    bool unsent = false;
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        if (!isUnanswered(*slot) || slot->isRequestSent())
            continue;
        sendParts(*slot);
        unsent = unsent || (!slot->listener && !slot->isRequestSent());
    }
    m_hub.flush();
    return unsent;
}

/// Sends again what the network may have lost.
void NodeExchange::resendRequests() noexcept
{
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        if (!isAwaited(*slot) || !mustBeWaitedFor(*slot) || !slot->peer->losesFrames())
            continue;
        slot->statistics.resent.add();
        sendRequest(*slot, ResentFlag);
    }
    sendMulticast(ResentFlag);
    m_hub.flush();
}

void NodeExchange::stepLocalNodes(const Stage &stage) noexcept
{
    for (const Roster::Turn &turn : stage) {
        NodeSlot &slot = *turn.slot;
        if (!slot.local || !slot.due)
            continue;
        const quint64 missed = slot.interval.missed(slot.local->cycle().number(), m_cycle.number);
        if (m_isSafe)
            slot.local->makeSafe(QPlcSlaveNode::MasterStopsSafely);
        slot.computed = slot.local->step(QPlcCycle(m_cycle.number, m_period, missed), slot.inputs);
        slot.answered = true;
        slot.exchange.note(m_cycle.number, 0);
        slot.exchange.arrival = m_clock.isTimed() ? slot.local->endOfStep() : 0;
        setFaulted(slot, !slot.computed);
        if (slot.local->wantsSafeStop())
            m_guard.askedBy(slot, m_cycle.number);
        slot.statistics.stepped(slot.local->endOfStep(), slot.local->executionTime(), m_statistics.deadline());
    }
}

// ---- answers ----

/// End of the time for \a stage [ns]: the stages share the period equally, and what one of them
/// does not need is left to the next ones.
std::int64_t NodeExchange::deadline(std::size_t stage) const noexcept
{
    const auto stages = std::int64_t(m_roster->stages.size());
    return m_cycle.deadline - m_grid->period() * (stages - std::int64_t(stage + 1)) / stages;
}

/// At the end of the cycle all answers are of interest, except those of listeners: they are taken
/// when they are there.
void NodeExchange::awaitEveryone() noexcept
{
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes)
        slot->awaited = slot->asked && !slot->listener;
}

bool NodeExchange::anyMissing(bool onlyWaiting) const noexcept
{
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        if (isAwaited(*slot) && (!onlyWaiting || mustBeWaitedFor(*slot)))
            return true;
    }
    return false;
}

/// Waits for the answers that later stages read, after the last stage for all. \return false when
/// stop was asked for meanwhile
bool NodeExchange::collectAnswers(std::size_t stage) noexcept
{
    const bool isLast = stage + 1 == m_roster->stages.size();
    if (isLast)
        awaitEveryone();
    const std::int64_t end = deadline(stage);
    if (m_clock.isTimed()) {
        while (anyMissing(false)) {
            const std::int64_t left = end - m_time.now();
            if (m_stop.load(std::memory_order_relaxed))
                return false;  // nobody is late who was not given the time
            if (left <= 0)
                break;
            if (continueRequests())
                receive(std::min(left, ContinueAfter));
            else if (isLast && left <= Slice)
                receive(left, m_time.alarm(end));
            else
                receive(std::min(left, Slice));
        }
        reportLateNodes();
    }
    if (anyMissing(true) && m_clock.isExternal())
        waitForStep();
    else if (anyMissing(true))
        waitForLateNodes(end);
    else if (isLast && m_isSafe && m_clock.isExternal())
        hearSafeNodes();
    else if (isLast && m_roster->anyRemote && !m_hasReceived)
        receive(0);  // what listeners have to say, and nodes that are behind
    if (isLast && m_clock.isExternal() && !m_stop.load(std::memory_order_relaxed) && !m_guard.isTripped())
        reportLateNodes();
    return isLast || !anyMissing(true);
}

void NodeExchange::reportLateNodes() noexcept
{
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        if (!isAwaited(*slot) || slot->late)
            continue;
        slot->late = true;
        slot->statistics.late.add();
        m_statistics.lateAnswer();
        m_guard.answeredLate(*slot, m_cycle.number);
        if (slot->reports() && !m_isSafe)
            m_reports.post({CycleEvent::LateAnswer, slot->id, 0, m_cycle.number});
    }
}

/// The first one of those that time stands still for whose policy is to report it; 0: all of them
/// are silent.
std::uint16_t NodeExchange::nodeToReport() const noexcept
{
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        if (isAwaited(*slot) && slot->waits() && slot->reports())
            return slot->id;
    }
    return 0;
}

/// Time stands still until the nodes that must be waited for have answered (or are lost).
void NodeExchange::waitForLateNodes(std::int64_t deadline) noexcept
{
    if (m_clock.isTimed())
        m_reports.post({CycleEvent::WaitingForNode, nodeToReport(), 0, m_cycle.number});
    const std::int64_t begin = m_time.now();
    std::int64_t resendAt = begin + ResendAfter;
    while (anyMissing(true) && !m_stop.load(std::memory_order_relaxed) && !m_guard.isTripped()
           && !hasWaitedTooLong(begin)) {
        receive(continueRequests() ? ContinueAfter : ResendAfter);
        if (m_time.now() < resendAt)
            continue;
        resendRequests();
        resendAt = m_time.now() + ResendAfter;
    }
    if (m_clock.isTimed()) {
        m_grid->shift(std::max<std::int64_t>(0, m_time.now() - deadline));
        m_reports.post({CycleEvent::WaitingEnded, 0, 0, m_cycle.number});
    }
}

/// As in lockstep, but for the limit: it is that of all stages together, and what happens then is
/// up to each node. Nodes that are given up are waited for again when they have answered.
void NodeExchange::waitForStep() noexcept
{
    if (m_waitBegin == Never)
        m_waitBegin = m_time.now();
    const std::int64_t longest = m_guard.longestWait();
    std::int64_t time = m_time.now();
    std::int64_t resendAt = time + ResendAfter;
    while (anyMissing(true) && !m_stop.load(std::memory_order_relaxed) && !m_guard.isTripped()) {
        const std::int64_t left = m_waitBegin + longest - time;
        if (left <= 0) {
            giveUp(time - m_waitBegin);
            return;
        }
        receive(std::min(left, continueRequests() ? ContinueAfter : ResendAfter));
        time = m_time.now();
        if (time < resendAt)
            continue;
        resendRequests();
        resendAt = time + ResendAfter;
    }
}

/// Nothing depends on their answers, but those that come in time say that a node is well again. It
/// takes a period at most, as in real time.
void NodeExchange::hearSafeNodes() noexcept
{
    const std::int64_t end = m_time.now() + std::min<std::int64_t>(m_period.count(), Slice);
    while (anyMissing(false) && !m_stop.load(std::memory_order_relaxed)) {
        const std::int64_t left = end - m_time.now();
        if (left <= 0)
            return;
        receive(continueRequests() ? std::min(left, ContinueAfter) : left);
    }
}

/// A node with a Wait policy or a critical one stops the plant safely; the cycles go on without any
/// other.
void NodeExchange::giveUp(std::int64_t waited) noexcept
{
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        if (isAwaited(*slot) && mustBeWaitedFor(*slot) && (slot->waits() || slot->critical))
            m_guard.waitedFor(*slot, m_cycle.number, waited);
    }
    reportLateNodes();
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes)
        slot->behind = slot->behind || isAwaited(*slot);
}

bool NodeExchange::isComplete() const noexcept
{
    return std::none_of(m_roster->nodes.begin(), m_roster->nodes.end(), [](const std::shared_ptr<NodeSlot> &slot) {
        return slot->asked && !slot->answered && !slot->listener;
    });
}

bool NodeExchange::hasWaitedTooLong(std::int64_t since) noexcept
{
    const auto isMissing
        = [this](const std::shared_ptr<NodeSlot> &slot) { return isAwaited(*slot) && mustBeWaitedFor(*slot); };
    const auto missing = std::find_if(m_roster->nodes.begin(), m_roster->nodes.end(), isMissing);
    return missing != m_roster->nodes.end() && m_guard.waitedFor(**missing, m_cycle.number, m_time.now() - since);
}

void NodeExchange::receive(std::int64_t timeout, int alarm) noexcept
{
    const std::int64_t begin = now();
    const bool arrived = waitForFrames(timeout, alarm);
    m_statistics.waited(now() - begin);
    m_hasReceived = true;
    if (!arrived)
        return;
    HubFrame incoming;
    while (m_hub.next(&incoming))
        handleAnswer(*static_cast<NodeSlot *>(incoming.peer->owner), incoming.bytes, incoming.size);
    m_statistics.setArrivals(m_hub.strangers(), m_hub.floods());
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        if (slot->peer && slot->peer->isClosed() && !slot->lost.exchange(true))
            m_reports.post({CycleEvent::LinkClosed, slot->id, 0, m_cycle.number});
    }
}

bool NodeExchange::waitForFrames(std::int64_t timeout, int alarm) noexcept
{
    if (m_spin == 0 || timeout <= m_spin)
        return m_hub.wait(timeout, alarm);
    const std::int64_t end = m_time.now() + m_spin;
    do {
        if (m_hub.wait(0))
            return true;
    } while (m_time.now() < end);
    return m_hub.wait(timeout - m_spin, alarm);
}

void NodeExchange::handleAnswer(NodeSlot &slot, const char *frame, std::size_t size) noexcept
{
    m_reports.tap(TappedFrame::Received, slot.id, frame, size);
    switch (slot.decoder.decode(frame, size, slot.firstUnasked)) {
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
    case FrameStatus::Forged:
        if (slot.statistics.forged == 0)
            m_reports.post({CycleEvent::ForgedFrame, slot.id, 0, m_cycle.number});
        slot.statistics.forged.add();
        return;
    default:
        slot.statistics.rejected.add();
        return;
    }
    // An answer to an older cycle is late and counted as such, but still newer than what the image
    // holds.
    const bool current = slot.decoder.cycle() == m_cycleZero + m_cycle.number;
    if (current && !slot.answered && !slot.late)
        m_guard.answeredInTime(slot);
    slot.answered = slot.answered || current;
    slot.behind = false;
    slot.isSafe.store(slot.decoder.header().flags & SafeStopFlag, std::memory_order_relaxed);
    if (slot.decoder.header().flags & StopWantedFlag)
        m_guard.askedBy(slot, m_cycle.number);
    const std::int64_t arrival = now();
    slot.statistics.answered(slot.decoder.cycle() - m_cycleZero, arrival, slot.decoder.header().info);
    slot.exchange.note(slot.decoder.cycle() - m_cycleZero, slot.decoder.header().before);
    slot.exchange.arrival = arrival;
    slot.exchange.info = m_clock.isTimed() ? slot.decoder.header().info : 0;
    if (current)
        m_statistics.answered(arrival);
    setFaulted(slot, slot.decoder.header().flags & FaultFlag);
    slot.pending = false;
    if (slot.isSafe.load(std::memory_order_relaxed) && !m_isSafe)
        m_guard.becameSafe(slot, m_cycle.number);
    if (m_isSafe || slot.faulted)
        return;
    if (slot.twoPhase && current)
        slot.pending = true;  // the outputs of the next cycle
    else
        store(slot, slot.decoder.payload(), std::int64_t(slot.decoder.cycle() - m_cycleZero) + (slot.twoPhase ? 1 : 0));
}

/// The guard does not wait until somebody has read the report.
void NodeExchange::setFaulted(NodeSlot &slot, bool isFaulted) noexcept
{
    if (isFaulted && !slot.faulted) {
        m_reports.post({CycleEvent::NodeFaulted, slot.id, 0, m_cycle.number});
        m_guard.codeFailed(slot, m_cycle.number);
        m_hasFailed = m_hasFailed || slot.local || !slot.listener;
    }
    slot.faulted = isFaulted;
}

/// Local nodes saw the image as it was when their stage began, whatever their order: their outputs
/// come in only now.
void NodeExchange::pasteLocalNodes(const Stage &stage) noexcept
{
    for (const Roster::Turn &turn : stage) {
        NodeSlot &slot = *turn.slot;
        if (m_isSafe || !slot.local || !slot.due || !slot.computed)
            continue;
        if (slot.twoPhase)
            slot.pending = true;
        else
            store(slot, slot.local->outputs(), guardCycle());
    }
}

// ---- values ----

/// \param cycle  to which the values belong; a listener is never late
void NodeExchange::store(NodeSlot &slot, const char *outputs, std::int64_t cycle) noexcept
{
    const std::int64_t written = slot.listener ? guardCycle() : cycle;
    slot.exchange.isStored = true;
    slot.exchange.isChanged = written != guardCycle() || slot.outputs.hasDoubt(outputs);
    m_signalGuard.store(*slot.paste, slot.written, outputs, written, guardCycle());
    m_signalGuard.claim(*slot.paste, slot.written, slot.claims, outputs, written);
}

void NodeExchange::decideContests() noexcept
{
    for (const SignalGuard::Contest &contest : m_roster->contests)
        m_signalGuard.decide(contest, guardCycle());
}

/// The values of this cycle are not there, and what reads them cannot wait.
void NodeExchange::noteMissing(NodeSlot &slot) noexcept
{
    const bool isNeverLate = slot.listener && !slot.lost.load(std::memory_order_relaxed);
    if (isNeverLate)
        slot.written.taken = guardCycle();
    else
        m_signalGuard.miss(*slot.paste, slot.written, guardCycle());
}

/// Later stages read what this one has written, or what is left of it.
void NodeExchange::endStage(const Stage &stage) noexcept
{
    if (m_isSafe)
        return;
    for (const Roster::Turn &turn : stage) {
        if (turn.feedsLaterStage && !turn.slot->twoPhase)
            noteMissing(*turn.slot);
    }
    decideContests();
}

/// The cycle ends: whatever has no value of it is older by one.
void NodeExchange::settle() noexcept
{
    if (m_isSafe)
        return;
    for (const std::shared_ptr<NodeSlot> &slot : m_roster->nodes) {
        if (!slot->twoPhase)
            noteMissing(*slot);
    }
    decideContests();
    m_signalGuard.settle(guardCycle());
}

}  // namespace qplc
