// SPDX-License-Identifier: Apache-2.0
#include "MasterLeases.h"

#include "node/Logging.h"
#include "protocol/messages/Vocabulary.h"
#include "realtime/TimeSource.h"

#include <algorithm>

namespace qplc {

namespace {

constexpr int longestName = 64;  // [characters] as of nodes

Refusal malformed(const QString &text)
{
    return {messages::errorWord::malformedMessage, text};
}

bool readName(const QString &given, QString *name, Refusal *refusal)
{
    *name = printable(given);
    if (name->size() <= longestName)
        return true;
    *refusal = malformed(QStringLiteral("'whoever' is a text of at most %1 characters").arg(longestName));
    return false;
}

}  // namespace

MasterLeases::MasterLeases(Leases &leases, NodeRegistry &registry, MasterCycle &cycle, MasterWrites &settings)
    : m_leases(leases)
    , m_registry(registry)
    , m_cycle(cycle)
    , m_settings(settings)
    , m_table(cycle.table())
{
    m_timer.setSingleShot(true);
    m_timer.setTimerType(Qt::PreciseTimer);
    connect(&m_timer, &QTimer::timeout, this, &MasterLeases::loseSilent);
}

// ---- taking ----

bool MasterLeases::take(const MasterConnection &asker, const messages::TakeLease &request, Refusal *refusal)
{
    Wish wish;
    const QObject *holder = asker.socket;
    if (!readWish(request, &wish, refusal) || !mayTake(holder, wish.indices, request.takeOver, refusal))
        return false;
    const Leases::Signals kept = keptSignals(holder, wish);
    if (!m_cycle.hasRoomFor(wish.settings.size() + kept.size())) {
        *refusal = {messages::errorWord::wrongState,
                    QStringLiteral("%1 values are too many between two cycles; take fewer signals at a time")
                        .arg(wish.settings.size() + kept.size())};
        return false;
    }
    wish.name = shownName(asker.peer, wish.name.isEmpty() ? asker.name : wish.name);
    const QStringList from = others(holder, wish.indices);
    m_leases.take(wish.indices, holder, wish.name, wish.timeout, monotonicNow());
    m_settings.keepPresent(wish.indices);
    listenToTheEndOf(holder);
    Q_EMIT heldSignalsChanged();
    m_settings.setLeased(holder, wish.settings, refusal);  // there is room, also for the next line
    m_settings.endWays(kept);
    waitForNext();
    const QString fromText
        = from.isEmpty() ? QString() : QStringLiteral(" from '%1'").arg(from.join(QStringLiteral("', '")));
    Q_EMIT changed(JournalEvent::Info,
                   QStringLiteral("'%1' has taken over %2%3").arg(wish.name, names(wish.indices), fromText));
    Q_EMIT told({LeaseNews::Taken, holder, wish.name, wish.indices, from});
    return true;
}

/// What \a holder takes as it is: taking moves nothing, and what somebody else has set before ends.
Leases::Signals MasterLeases::keptSignals(const QObject *holder, const Wish &wish) const
{
    Leases::Signals kept;
    for (const QPlcSignalIndex signal : wish.indices) {
        const auto isOfSignal = [signal](const SignalSetting &setting) { return setting.signal == signal; };
        if (!m_leases.isHeldBy(signal, holder) && std::none_of(wish.settings.begin(), wish.settings.end(), isOfSignal))
            kept.push_back(signal);
    }
    return kept;
}

bool MasterLeases::readWish(const messages::TakeLease &request, Wish *wish, Refusal *refusal) const
{
    wish->timeout = request.timeout.count();
    return readSignals(request.signals, &wish->indices, refusal) && readValues(request.values, wish, refusal)
        && readName(request.whoever, &wish->name, refusal);
}

bool MasterLeases::readSignals(const QStringList &names, Leases::Signals *indices, Refusal *refusal) const
{
    if (names.isEmpty())
        *refusal = malformed(QStringLiteral("'signals' is a list of one or more names of signals"));
    else if (names.size() > m_table.size())
        *refusal
            = malformed(QStringLiteral("'signals' has %1 names, and the table has %2 signals; name each signal once")
                            .arg(names.size())
                            .arg(m_table.size()));
    if (!refusal->error.isEmpty())
        return false;
    std::vector<bool> isNamed(std::size_t(m_table.size()));
    for (const QString &name : names) {
        const QPlcSignalIndex index = m_table.indexOf(name);
        if (index == QPlcInvalidSignalIndex) {
            *refusal = {messages::errorWord::unknownSignal, m_table.unknownSignalText(printable(name))};
            return false;
        }
        if (!isNamed[index])
            indices->push_back(index);
        isNamed[index] = true;
    }
    return true;
}

bool MasterLeases::readValues(const QMap<QString, QString> &texts, Wish *wish, Refusal *refusal) const
{
    std::vector<bool> isTaken(std::size_t(m_table.size()));
    for (const QPlcSignalIndex index : wish->indices)
        isTaken[index] = true;
    for (auto it = texts.begin(); it != texts.end() && refusal->error.isEmpty(); ++it) {
        const QPlcSignalIndex index = m_table.indexOf(it.key());
        SignalSetting setting;
        if (index == QPlcInvalidSignalIndex || !isTaken[index])
            *refusal = malformed(QStringLiteral("'values' contains '%1', which is not in 'signals'; add it there")
                                     .arg(printable(it.key())));
        else if (m_settings.readValue(index, it.value(), &setting, refusal))
            wish->settings.push_back(setting);
    }
    return refusal->error.isEmpty();
}

bool MasterLeases::mayTake(const QObject *holder, const Leases::Signals &indices, bool takeOver, Refusal *refusal) const
{
    std::size_t count = m_leases.all().size();
    for (const QPlcSignalIndex signal : indices) {
        const QString &name = m_table.at(signal).name;
        count += m_leases.find(signal) ? 0 : 1;
        if (m_registry.writer(signal) == NodeRegistry::masterName())
            *refusal
                = {messages::errorWord::signalHasWriter,
                   QStringLiteral("signal '%1' is written by the master itself and cannot be taken over").arg(name)};
        else if (!takeOver && m_leases.isHeldByOther(signal, holder))
            *refusal = leaseRefusal(name, *m_leases.find(signal));
        else if (count > MaximumLeases)
            *refusal = {
                messages::errorWord::wrongState,
                QStringLiteral("more than %1 signals cannot be taken over at a time; release some").arg(MaximumLeases)};
    }
    return refusal->error.isEmpty();
}

/// Who loses something.
QStringList MasterLeases::others(const QObject *holder, const Leases::Signals &indices) const
{
    QStringList others;
    for (const QPlcSignalIndex signal : indices) {
        if (m_leases.isHeldByOther(signal, holder))
            others << m_leases.find(signal)->name;
    }
    others.removeDuplicates();
    return others;
}

// ---- ending ----

bool MasterLeases::release(const MasterConnection &asker, const messages::ReleaseLease &request, Refusal *refusal)
{
    Leases::Signals indices;
    if (!request.signals)
        indices = m_leases.signalsOf(asker.socket);
    else if (!readSignals(*request.signals, &indices, refusal))
        return false;
    for (const QPlcSignalIndex signal : indices) {
        if (m_leases.isHeldByOther(signal, asker.socket)) {
            *refusal = leaseRefusal(m_table.at(signal).name, *m_leases.find(signal));
            return false;
        }
    }
    const auto isFree = [this](QPlcSignalIndex signal) { return m_leases.find(signal) == nullptr; };
    indices.erase(std::remove_if(indices.begin(), indices.end(), isFree), indices.end());
    if (indices.empty())
        return true;
    m_leases.release(indices);
    m_settings.keepPresent(indices);
    m_settings.leaveToWriters();
    Q_EMIT heldSignalsChanged();
    waitForNext();
    Q_EMIT changed(JournalEvent::Info, QStringLiteral("'%1' has released %2").arg(asker.shownName(), names(indices)));
    Q_EMIT told({LeaseNews::Released, asker.socket, asker.shownName(), indices});
    return true;
}

void MasterLeases::heard(const QObject *sender)
{
    if (!m_next)
        return;
    const std::int64_t now = monotonicNow();
    if (now >= *m_next)
        loseSilent();
    if (m_holders.count(sender))
        m_leases.renew(sender, now);  // the timer finds out by itself that it is early
}

void MasterLeases::loseSilent()
{
    lose(m_leases.loseSilent(monotonicNow()), QStringLiteral("has been silent for too long"));
}

void MasterLeases::listenToTheEndOf(const QObject *holder)
{
    if (!m_holders.insert(holder).second)
        return;
    connect(holder, &QObject::destroyed, this, [this, holder] {
        m_holders.erase(holder);
        lose(m_leases.loseAllOf(holder), QStringLiteral("has lost the connection"));
    });
}

void MasterLeases::lose(const Leases::Signals &indices, const QString &why)
{
    std::vector<SignalSetting> neutral;
    std::map<QString, Leases::Signals> byHolder;
    for (const QPlcSignalIndex signal : indices) {
        neutral.push_back({signal, m_table.at(signal).safeValue(), QPlcQuality::Safe});
        byHolder[m_leases.find(signal)->name].push_back(signal);
    }
    m_settings.keepPresent(indices);
    m_settings.setSoon(SettingCause::Lost, neutral);
    waitForNext();
    for (const auto &[name, lost] : byHolder)
        tellLost(name, lost, why);
}

void MasterLeases::tellLost(const QString &name, const Leases::Signals &indices, const QString &why)
{
    QStringList texts;
    for (const QPlcSignalIndex signal : indices)
        texts << QStringLiteral("%1 = %2").arg(m_table.at(signal).name, m_table.at(signal).safeValue().toString());
    Q_EMIT changed(JournalEvent::Warning,
                   QStringLiteral("'%1' %2: %3, until somebody takes or releases the lease")
                       .arg(name, why, texts.join(QStringLiteral(", "))));
    Q_EMIT told({LeaseNews::Lost, nullptr, name, indices, {}, why});
}

void MasterLeases::waitForNext()
{
    const std::int64_t now = monotonicNow();
    m_next = m_leases.nextDeadline();
    if (m_next)
        m_timer.start(int((std::max(*m_next, now) - now) / 1'000'000 + 1));
    else
        m_timer.stop();
}

// ---- showing ----

QString MasterLeases::names(const Leases::Signals &indices) const
{
    QStringList names;
    for (const QPlcSignalIndex signal : indices)
        names << m_table.at(signal).name;
    return names.join(QStringLiteral(", "));
}

QVector<QPlcLease> MasterLeases::list() const
{
    QVector<QPlcLease> list;
    for (const auto &[signal, lease] : m_leases.all())
        list.append({m_table.at(signal).name, lease.name, lease.isLost(), std::chrono::nanoseconds(lease.timeout)});
    return list;
}

std::vector<messages::LeaseEntry> MasterLeases::entries() const
{
    std::vector<messages::LeaseEntry> entries;
    for (const auto &[signal, lease] : m_leases.all())
        entries.push_back(
            {m_table.at(signal).name, lease.name, lease.state(), std::chrono::nanoseconds(lease.timeout)});
    return entries;
}

}  // namespace qplc
