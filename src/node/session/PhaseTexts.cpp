// SPDX-License-Identifier: Apache-2.0
#include "PhaseTexts.h"

#include "node/statistics/StatisticsReply.h"
#include "realtime/TimeSource.h"

#include <algorithm>

namespace qplc {

namespace {

constexpr int mostNames = 50;      // of signals, in one text
constexpr int waitForRoom = 1000;  // [ms]
constexpr int longestValue = 200;  // [characters] of a value in a text
constexpr int unreadPause = 10;    // [s] between statistics that nobody records

messages::RecordedDuration newest(const QPlcDurationStatistics &duration)
{
    return {duration.last10s.p50, duration.last10s.p99, duration.last10s.maximum};
}

QString valueText(const QPlcSignalDefinition &signal, const QPlcValue &value)
{
    const QString text = signal.textOf(value);
    return text.size() <= longestValue ? text : text.left(longestValue - 1) + QChar(0x2026);
}

QString causeName(const SettingCause &cause)
{
    switch (cause.kind) {
    case SettingCause::Asked:
        return cause.owner ? QStringLiteral("set") : QStringLiteral("program");
    case SettingCause::Taken:
        return QStringLiteral("lease");
    case SettingCause::CameBack:
        return QStringLiteral("came back");
    case SettingCause::Lost:
        return QStringLiteral("lease lost");
    }
    return {};
}

}  // namespace

PhaseTexts::PhaseTexts(const MasterServer &server, Journal &journal, const MasterWrites &writes,
                       const MasterLeases &leases, RealTimePhase &phase, const MasterCycle &cycle,
                       const NodeRegistry &registry)
    : m_server(server)
    , m_journal(journal)
    , m_leases(leases)
    , m_phase(phase)
    , m_cycle(cycle)
    , m_registry(registry)
    , m_table(cycle.table())
{
    m_waitingTimer.setSingleShot(true);
    connect(&m_waitingTimer, &QTimer::timeout, this, &PhaseTexts::tellWaiting);
    connect(&m_statisticsTimer, &QTimer::timeout, this, [this] {
        if (m_phase.ring().isRead() || ++m_seconds % unreadPause == 0)
            tellStatistics();
    });
    connect(&journal, &Journal::appended, this, &PhaseTexts::eventsHappened);
    connect(&writes, &MasterWrites::giving, this, &PhaseTexts::set);
    connect(&leases, &MasterLeases::told, this, &PhaseTexts::leaseChanged);
    connect(
        &server, &MasterServer::commanded, this,
        [this](const MasterConnection *connection, const QPlcMessage &message) { commanded(*connection, message); });
    phase.ring().setBegin([this] { begin(); });
}

// ---- a phase ----

/// What leads to the phase belongs to it: what has happened since the last one, who has set the
/// values that signals have, and who holds them.
void PhaseTexts::begin()
{
    m_isBefore = true;
    const quint64 newest = m_journal.events().newest();
    m_toldEvents = std::max(m_toldEvents, newest - std::min<quint64>(newest, MostBefore));
    eventsHappened();
    for (const auto &[text, time] : m_commands)
        tell(RecordedText::Command, text, 0, time);
    m_commands.clear();
    for (auto &[signal, setting] : m_newest) {
        setting.number = 0;
        tellSetting(setting);
    }
    std::map<std::pair<QString, bool>, std::vector<QPlcSignalIndex>> held;
    const QVector<QPlcLease> leases = m_leases.list();
    for (const QPlcLease &lease : leases)
        held[{lease.holder, lease.isLost}].push_back(m_table.indexOf(lease.signal));
    for (const auto &[holder, indices] : held)
        leaseChanged({holder.second ? LeaseNews::Lost : LeaseNews::Taken, nullptr, holder.first, indices});
    m_seconds = 0;
    m_statisticsTimer.start(1000);
}

void PhaseTexts::close()
{
    if (!m_phase.ring().isOpen())
        return;
    for (const auto &[key, setting] : m_waiting)
        tellSetting(setting);
    m_waiting.clear();
    tellStatistics();
    m_statisticsTimer.stop();
    m_phase.ring().close();
}

template<typename Text>
void PhaseTexts::tell(RecordedText::Topic topic, const Text &text, quint64 number, qint64 time)
{
    PhaseRing &ring = m_phase.ring();
    if (!ring.isOpen())
        return;
    m_isBefore = m_isBefore && !m_phase.isRunning();
    RecordedText head;
    head.cycle = m_isBefore ? RecordedText::BeforePhase : m_cycle.cycle();
    head.settings = number;
    head.wallTime = time;
    head.topic = topic;
    ring.tell(head, messages::lineOf(messages::toObject(text)));
}

// ---- events ----

void PhaseTexts::eventsHappened()
{
    if (!m_phase.ring().isOpen())
        return;  // the next phase begins with them
    for (const JournalEvent &event : m_journal.events().after(m_toldEvents, EventLog::Capacity)) {
        m_toldEvents = event.sequence;
        if (!hasRoom(&m_otherRoom))
            continue;
        messages::RecordedEvent text;
        static_cast<messages::EventEntry &>(text) = toEntry(event);
        text.address = event.address;
        tell(RecordedText::Event, text, 0, event.time);
    }
}

/// \return false: it is counted only. \pre the ring is open
bool PhaseTexts::hasRoom(TokenBucket *bucket)
{
    if (bucket->take(monotonicNow()))
        return true;
    m_phase.ring().leaveOut();
    return false;
}

// ---- commands and values ----

/// Who has the connection \a socket, as far as the master knows. Null: the program of the master.
template<typename Text>
void PhaseTexts::setPerson(const QObject *socket, Text *text) const
{
    const auto &connections = m_server.connections();
    const auto found = std::find_if(connections.begin(), connections.end(),
                                    [socket](const auto &each) { return socket && each->socket == socket; });
    text->by = NodeRegistry::masterName();
    if (found == connections.end())
        return;
    const MasterConnection &connection = **found;
    text->by = connection.shownName();
    text->address = connection.socket->peerName();
    text->client = connection.uuid;
    if (connection.peer.isSecured)
        text->role = roleName(connection.peer.role);
}

void PhaseTexts::commanded(const MasterConnection &connection, const QPlcMessage &message)
{
    if (message.kind() == QPlcMessage::SetSignals || message.kind() == QPlcMessage::TakeLease
        || message.kind() == QPlcMessage::ReleaseLease || message.kind() == QPlcMessage::Note)
        return;  // they are told with their values and signals, or as an event
    const bool isOpen = m_phase.ring().isOpen();
    if (isOpen && !hasRoom(&m_otherRoom))
        return;
    messages::RecordedCommand text;
    setPerson(connection.socket, &text);
    text.command = message.kindName();
    if (isOpen) {
        tell(RecordedText::Command, text);
        return;
    }
    m_commands.emplace_back(text, wallClockNow());
    if (m_commands.size() > MostBefore)
        m_commands.pop_front();
}

void PhaseTexts::set(const SettingCause &cause, QPlcSignalIndex signal, const QPlcValue &former, const QPlcValue &value,
                     quint64 number)
{
    const QPlcSignalDefinition &definition = m_table.at(signal);
    Setting setting;
    setPerson(cause.owner, &setting.text);
    setting.number = number;
    setting.time = wallClockNow();
    setting.text.signal = definition.name;
    setting.text.from = valueText(definition, former);
    setting.text.to = valueText(definition, value);
    setting.text.how = causeName(cause);
    const std::pair<QPlcSignalIndex, QString> key{signal, setting.text.by};
    const auto waiting = m_waiting.find(key);
    if (waiting != m_waiting.end()) {  // the first of them had `from`
        setting.text.from = waiting->second.text.from;
        setting.count += waiting->second.count;
    }
    if (m_newest.size() < MostSignals || m_newest.count(signal) > 0)
        m_newest[signal] = setting;
    if (!m_phase.ring().isOpen())
        return;
    if (m_room.take(monotonicNow())) {
        m_waiting.erase(key);
        tellSetting(setting);
        return;
    }
    if (waiting == m_waiting.end() && m_waiting.size() >= MostSignals) {
        m_phase.ring().leaveOut();
        return;
    }
    m_waiting[key] = setting;
    if (!m_waitingTimer.isActive())
        m_waitingTimer.start(waitForRoom);
}

void PhaseTexts::tellSetting(const Setting &setting)
{
    messages::RecordedSetting text = setting.text;
    if (setting.count > 1)
        text.count = setting.count;
    tell(RecordedText::Command, text, setting.number, setting.time);
}

void PhaseTexts::tellWaiting()
{
    while (!m_waiting.empty() && m_room.take(monotonicNow())) {
        const auto oldest
            = std::min_element(m_waiting.begin(), m_waiting.end(),
                               [](const auto &one, const auto &other) { return one.second.time < other.second.time; });
        tellSetting(oldest->second);
        m_waiting.erase(oldest);
    }
    if (!m_waiting.empty())
        m_waitingTimer.start(waitForRoom);
}

// ---- leases ----

QStringList PhaseTexts::names(const std::vector<QPlcSignalIndex> &indices) const
{
    QStringList names;
    for (const QPlcSignalIndex signal : indices)
        names << m_table.at(signal).name;
    return names;
}

/// Many signals are told in several texts.
void PhaseTexts::leaseChanged(const LeaseNews &news)
{
    static const char *const kinds[] = {"taken", "released", "lost"};
    messages::RecordedLease text;
    if (news.holder)
        setPerson(news.holder, &text);
    text.by = news.name;
    text.what = QLatin1String(kinds[news.kind]);
    text.from = news.from;
    text.reason = news.reason;
    const QStringList all = names(news.indices);
    for (int i = 0; i < all.size(); i += mostNames) {
        text.signals = all.mid(i, mostNames);
        if (m_phase.ring().isOpen() && hasRoom(&m_otherRoom))
            tell(RecordedText::Lease, text);
    }
}

// ---- statistics ----

/// Of many nodes, each text has the next ones.
void PhaseTexts::tellStatistics()
{
    const QPlcCycleStatistics statistics = statisticsOf(m_cycle, m_registry, QPlcDistribution::FiguresOnly);
    messages::RecordedStatistics text{newest(statistics.lateness),      newest(statistics.execution),
                                      newest(statistics.roundTrip),     newest(statistics.slack),
                                      messages::countersOf(statistics), {}};
    const int count = statistics.nodes.size();
    for (int i = 0; i < std::min(count, MostNodes); ++i) {
        const QPlcNodeStatistics &node = statistics.nodes.at((m_nextNode + i) % count);
        text.nodes.push_back({node.name, newest(node.execution), newest(node.roundTrip), newest(node.slack),
                              messages::countersOf(node)});
    }
    m_nextNode = count > MostNodes ? (m_nextNode + MostNodes) % count : 0;
    tell(RecordedText::Statistics, text);
}

}  // namespace qplc
