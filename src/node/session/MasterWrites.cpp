// SPDX-License-Identifier: Apache-2.0
#include "MasterWrites.h"

#include "protocol/messages/Vocabulary.h"
#include "realtime/TimeSource.h"

#include <algorithm>

namespace qplc {

namespace {

constexpr int retryPause = 5;  // [ms] when the cycle had no room

}  // namespace

Refusal leaseRefusal(const QString &signal, const Leases::Lease &lease)
{
    return {messages::errorWord::leaseHeld,
            lease.isLost()
                ? QStringLiteral("signal '%1' was taken over by '%2', who is lost; take or release the lease first")
                      .arg(signal, lease.name)
                : QStringLiteral("signal '%1' is taken over by '%2'; ask for its release, or take it over")
                      .arg(signal, lease.name)};
}

MasterWrites::MasterWrites(NodeRegistry &registry, MasterCycle &cycle, const Leases &leases)
    : m_registry(registry)
    , m_cycle(cycle)
    , m_leases(leases)
    , m_table(cycle.table())
{
    m_timer.setSingleShot(true);
    m_timer.setTimerType(Qt::PreciseTimer);
    connect(&m_timer, &QTimer::timeout, this, [this] {
        payDebts();
        bringBack(m_temporary.endDue(monotonicNow()));
    });
}

bool MasterWrites::setSignals(const QObject *owner, const messages::SetSignals &wish, Refusal *refusal)
{
    std::vector<SignalSetting> settings;
    if (!readValues(owner, wish.values, &settings, refusal))
        return false;
    std::vector<QPlcValue> former;
    for (const SignalSetting &setting : settings)
        former.push_back(presentValue(setting.signal));
    if (!give({SettingCause::Asked, owner}, settings, refusal))
        return false;
    if (wish.duration) {
        keepFor(owner, settings, former, monotonicNow() + wish.duration->count());
    } else {
        for (const SignalSetting &setting : settings)
            m_temporary.forget(setting.signal);
    }
    for (std::size_t i = 0; i < settings.size(); ++i)
        Q_EMIT valueSet(owner, settings[i].signal, former[i], settings[i].value);
    waitForNext();
    return true;
}

bool MasterWrites::setSignal(const QString &name, const QPlcValue &value, Refusal *refusal)
{
    QPlcSignalIndex index = QPlcInvalidSignalIndex;
    SignalSetting setting;
    if (!isSettable(nullptr, name, &index, refusal) || !checkValue(index, value, &setting, refusal))
        return false;
    const QPlcValue former = presentValue(index);
    if (!give({}, {setting}, refusal))
        return false;
    m_temporary.forget(index);
    Q_EMIT valueSet(nullptr, index, former, setting.value);
    return true;
}

bool MasterWrites::setLeased(const QObject *holder, const std::vector<SignalSetting> &settings, Refusal *refusal)
{
    return give({SettingCause::Taken, holder}, settings, refusal);
}

void MasterWrites::endWays(const std::vector<QPlcSignalIndex> &indices)
{
    std::vector<QPlcSignalIndex> moving;
    for (const QPlcSignalIndex signal : indices) {
        m_debts.erase(signal);
        if (!m_cycle.hasSlope(signal))
            continue;
        m_given.erase(signal);
        moving.push_back(signal);
    }
    m_cycle.endWays(moving);
}

void MasterWrites::setSoon(SettingCause::Kind cause, const std::vector<SignalSetting> &settings)
{
    for (const SignalSetting &setting : settings)
        m_debts[setting.signal] = {cause, setting};
    payDebts();
    waitForNext();
}

void MasterWrites::keepPresent(const std::vector<QPlcSignalIndex> &indices)
{
    for (const QPlcSignalIndex signal : indices)
        m_temporary.forget(signal);
}

/// Whether the values of a signal are those of its writer, and nobody has taken it over.
bool MasterWrites::isOfWriter(QPlcSignalIndex signal) const
{
    return !m_registry.writer(signal).isEmpty() && !m_leases.find(signal);
}

void MasterWrites::leaveToWriters()
{
    for (const QPlcSignalIndex signal : m_temporary.signalIndices()) {
        if (isOfWriter(signal))
            m_temporary.forget(signal);
    }
    const auto leave = [this](auto *values) {
        for (auto value = values->begin(); value != values->end();)
            value = isOfWriter(value->first) ? values->erase(value) : std::next(value);
    };
    leave(&m_given);
    leave(&m_debts);
}

// ---- checks ----

bool MasterWrites::isSettable(const QObject *owner, const QString &name, QPlcSignalIndex *signal,
                              Refusal *refusal) const
{
    *signal = m_table.indexOf(name);
    const Leases::Lease *lease = m_leases.find(*signal);
    if (*signal == QPlcInvalidSignalIndex)
        *refusal = {messages::errorWord::unknownSignal, m_table.unknownSignalText(name)};
    else if (lease && !m_leases.isHeldBy(*signal, owner))
        *refusal = leaseRefusal(name, *lease);
    else if (!lease && !m_registry.writer(*signal).isEmpty())
        *refusal = {messages::errorWord::signalHasWriter,
                    QStringLiteral("signal '%1' is written by '%2'; stop that node to set it from outside")
                        .arg(name, m_registry.writer(*signal))};
    return refusal->error.isEmpty();
}

bool MasterWrites::checkValue(QPlcSignalIndex signal, const QPlcValue &value, SignalSetting *setting,
                              Refusal *refusal) const
{
    const QPlcSignalDefinition &definition = m_table.at(signal);
    *setting = {signal, value.convertedTo(definition.type)};
    if (!setting->value.isValid() || !setting->value.isFinite()) {
        *refusal = {messages::errorWord::invalidValue,
                    QStringLiteral("%1 does not fit signal '%2' of type %3")
                        .arg(value.toString(), definition.name, definition.type.name())};
        return false;
    }
    if (!definition.isInRange(setting->value)) {
        *refusal = {messages::errorWord::invalidValue,
                    QStringLiteral("%1 is out of range for signal '%2'; use %3 %4")
                        .arg(value.toString(), definition.name, definition.rangeText(), definition.unit)
                        .trimmed()};
        return false;
    }
    return true;
}

bool MasterWrites::readValues(const QObject *owner, const QMap<QString, QString> &texts,
                              std::vector<SignalSetting> *settings, Refusal *refusal) const
{
    for (auto it = texts.begin(); it != texts.end(); ++it) {
        QPlcSignalIndex index = QPlcInvalidSignalIndex;
        SignalSetting setting;
        if (!isSettable(owner, it.key(), &index, refusal) || !readValue(index, it.value(), &setting, refusal))
            return false;
        settings->push_back(setting);
    }
    return true;
}

bool MasterWrites::readValue(QPlcSignalIndex signal, const QString &text, SignalSetting *setting,
                             Refusal *refusal) const
{
    QString error;
    const QPlcValue value = QPlcValue::fromString(m_table.at(signal).type, text, &error);
    if (error.isEmpty())
        return checkValue(signal, value, setting, refusal);
    *refusal
        = {messages::errorWord::invalidValue, QStringLiteral("signal '%1': %2").arg(m_table.at(signal).name, error)};
    return false;
}

// ---- setting ----

bool MasterWrites::give(const SettingCause &cause, const std::vector<SignalSetting> &settings, Refusal *refusal)
{
    if (!m_cycle.hasRoomFor(settings.size())) {
        *refusal = {messages::errorWord::wrongState,
                    QStringLiteral("%1 changes are too many between two cycles; send them in smaller groups")
                        .arg(settings.size())};
        return false;
    }
    quint64 number = m_cycle.isRunning() ? m_cycle.settingsGiven() : 0;
    for (const SignalSetting &setting : settings) {
        number += m_cycle.isRunning() ? 1 : 0;
        Q_EMIT giving(cause, setting.signal, formerValue(setting.signal), setting.value, number);
    }
    m_cycle.setValues(settings);
    for (const SignalSetting &setting : settings) {
        m_given[setting.signal] = setting.value;
        m_debts.erase(setting.signal);
    }
    return true;
}

void MasterWrites::keepFor(const QObject *owner, const std::vector<SignalSetting> &settings,
                           const std::vector<QPlcValue> &former, std::int64_t deadline)
{
    for (std::size_t i = 0; i < settings.size(); ++i)
        m_temporary.set(owner, settings[i], former[i], deadline);
    if (!m_owners.insert(owner).second)
        return;
    connect(owner, &QObject::destroyed, this, [this, owner] {
        m_owners.erase(owner);
        bringBack(m_temporary.endAllOf(owner));
    });
}

QPlcValue MasterWrites::presentValue(QPlcSignalIndex signal) const
{
    const auto debt = m_debts.find(signal);
    if (debt != m_debts.end())
        return debt->second.setting.value;
    return formerValue(signal);
}

/// What the cycle has, or was given.
QPlcValue MasterWrites::formerValue(QPlcSignalIndex signal) const
{
    const auto given = m_given.find(signal);
    return given != m_given.end() ? given->second : m_cycle.value(signal);
}

void MasterWrites::bringBack(const std::vector<SignalSetting> &settings)
{
    setSoon(SettingCause::CameBack, settings);
    for (const SignalSetting &setting : settings)
        Q_EMIT valueCameBack(setting.signal, setting.value);
}

/// One by one: the cycle may have room for some of them.
void MasterWrites::payDebts()
{
    while (!m_debts.empty()) {
        Refusal refusal;
        const Debt debt = m_debts.begin()->second;
        if (!give({debt.cause, nullptr}, {debt.setting}, &refusal))  // erases what it could give
            return;
    }
}

void MasterWrites::waitForNext()
{
    const std::optional<std::int64_t> next = m_temporary.nextDeadline();
    if (!m_debts.empty()) {
        m_timer.start(retryPause);
    } else if (next) {
        const std::int64_t pause = *next - monotonicNow();
        m_timer.start(int(std::max<std::int64_t>(pause, 0) / 1'000'000 + 1));
    } else {
        m_timer.stop();
    }
}

}  // namespace qplc
