// SPDX-License-Identifier: Apache-2.0
#include "CanOpenAxisChannels.h"

#include "QPlcDriver.h"

#include <array>

namespace qplc {

namespace {

struct OrderKind
{
    const char *name;
    const char *object;  // that an RPDO needs for it; null: the controlword
};

// In the order of CanOpenAxisChannels::Order.
constexpr OrderKind orderKinds[] = {
    {"enable", nullptr}, {"quickStop", nullptr},  {"faultReset", nullptr}, {"home", nullptr},
    {"mode", "6060:00"}, {"velocity", "60FF:00"}, {"torque", "6071:00"},   {"position", "607A:00"},
};

constexpr const char *shownNames[] = {"state", "enabled", "faulty", "limited", "blocked", "homed"};

struct Measured
{
    const char *name;
    const char *object;
};

constexpr Measured measuredNames[] = {
    {"velocity", "606C:00"}, {"torque", "6077:00"},     {"position", "6064:00"},
    {"mode", "6061:00"},     {"statusword", "6041:00"}, {"errorCode", "603F:00"},
};

}  // namespace

void CanOpenAxisChannels::setPlan(const CanOpenConfiguration &plan)
{
    m_isAxis = plan.isAxis;
    m_mode = plan.mode;
    m_axis = Cia402Axis(plan.limits);
    if (!m_isAxis)
        return;
    int pdo = 0;
    int entry = 0;
    for (int i = 0; i < OrderCount; ++i) {
        const char *object = orderKinds[i].object;
        m_hasTarget[i] = !object || plan.find(QLatin1String(object), false, &pdo, &entry);
    }
    const char *objects[FeedbackCount] = {"6041:00", "6061:00", "6064:00"};
    for (int i = 0; i < FeedbackCount; ++i) {
        if (!plan.find(QLatin1String(objects[i]), true, &pdo, &entry))
            continue;
        const Pdo &owner = plan.pdos.at(pdo);
        m_places[i].pdo = owner.number;
        m_places[i].number = owner.entries.at(entry).number;
        m_places[i].first = owner.firstBit(entry);
        m_places[i].freshTime = plan.freshTime(owner).count();
    }
}

// ---- channels ----

QPlcReadChannel *CanOpenAxisChannels::readChannel(const QString &name)
{
    for (const Shown &shown : m_shown) {
        if (shown.channel->name() == name)
            return shown.channel.get();
    }
    for (int kind = 0; m_isAxis && kind < int(std::size(shownNames)); ++kind) {
        if (name != QLatin1String(shownNames[kind]))
            continue;
        m_shown.push_back({kind, std::make_unique<QPlcReadChannel>(m_driver, name)});
        return m_shown.back().channel.get();
    }
    return nullptr;
}

QPlcWriteChannel *CanOpenAxisChannels::writeChannel(const QString &name, QString *error)
{
    for (int i = 0; m_isAxis && i < OrderCount; ++i) {
        if (name != QLatin1String(orderKinds[i].name))
            continue;
        if (!m_hasTarget[i]) {
            *error = QStringLiteral("no RPDO has object %2, which '%1' needs; add it to one, or choose another mode")
                         .arg(name, QLatin1String(orderKinds[i].object));
            return nullptr;
        }
        if (!m_orders[i])
            m_orders[i] = std::make_unique<QPlcWriteChannel>(m_driver, name);
        return m_orders[i].get();
    }
    return nullptr;
}

QString CanOpenAxisChannels::objectOf(const QString &name) const
{
    for (const Measured &measured : measuredNames) {
        if (m_isAxis && name == QLatin1String(measured.name))
            return QLatin1String(measured.object);
    }
    return name;
}

QStringList CanOpenAxisChannels::names(bool isRead) const
{
    QStringList names;
    if (!m_isAxis)
        return names;
    if (isRead) {
        for (const char *name : shownNames)
            names << QLatin1String(name);
        for (const Measured &measured : measuredNames)
            names << QLatin1String(measured.name);
    } else {
        for (int i = 0; i < OrderCount; ++i) {
            if (m_hasTarget[i])
                names << QLatin1String(orderKinds[i].name);
        }
    }
    return names;
}

// ---- the cycle ----

void CanOpenAxisChannels::begin() noexcept
{
    m_axis.reset();
    m_feedback = {};
    m_outputs = {};
}

void CanOpenAxisChannels::take(const Pdo &pdo, const CanFrame &frame, qint64 time) noexcept
{
    for (int i = 0; m_isAxis && i < FeedbackCount; ++i) {
        const Place &place = m_places[i];
        if (place.pdo != pdo.number)
            continue;
        const double value = place.number.decode(Pdo::bitsOf(frame.data.data(), place.first, place.number.bits));
        if (i == Statusword) {
            m_feedback.statusword = quint16(value);
            m_feedback.isKnown = true;
            m_statusTime = time;
        } else if (i == ModeDisplay) {
            m_feedback.mode = AxisMode(qint8(value));
        } else {
            m_feedback.position = value;
        }
    }
}

bool CanOpenAxisChannels::hasCommand() const noexcept
{
    bool hasOne = false;
    for (const auto &order : m_orders) {
        if (order && !order->hasValue())
            return false;
        hasOne = hasOne || order;
    }
    return hasOne;
}

bool CanOpenAxisChannels::isOn(Order order) const noexcept
{
    return m_orders[order] && m_orders[order]->isOn();
}

double CanOpenAxisChannels::valueOf(Order order, double otherwise) const noexcept
{
    return m_orders[order] ? m_orders[order]->value() : otherwise;
}

AxisCommand CanOpenAxisChannels::command() const noexcept
{
    AxisCommand command;
    command.isSafe = false;
    for (const auto &order : m_orders)
        command.isSafe = command.isSafe || (order && order->isSafe());
    command.enable = isOn(Enable);
    command.quickStop = isOn(QuickStop);
    command.faultReset = isOn(FaultReset);
    command.home = isOn(Home);
    const double mode = valueOf(Mode, double(qint8(m_mode)));
    command.mode = mode >= 1.0 && mode <= 10.0 ? AxisMode(qint8(mode)) : m_mode;
    command.velocity = valueOf(Velocity, 0.0);
    command.torque = valueOf(Torque, 0.0);
    command.position = valueOf(Position, command.position);
    return command;
}

void CanOpenAxisChannels::step(qint64 now) noexcept
{
    if (!m_isAxis || !hasCommand())
        return;
    const qint64 freshTime = m_places[Statusword].freshTime;
    if (freshTime > 0 && now - m_statusTime > freshTime)
        m_feedback.isKnown = false;  // what the drive told is old
    const AxisCommand wanted = command();
    m_isSafe = wanted.isSafe;
    if (m_places[ModeDisplay].pdo < 0)
        m_feedback.mode = wanted.mode;  // the drive does not tell it
    m_outputs = m_axis.step(wanted, m_feedback);
}

void CanOpenAxisChannels::stop() noexcept
{
    m_outputs = m_axis.step(AxisCommand(), m_feedback);
}

AxisState CanOpenAxisChannels::state() const noexcept
{
    return m_feedback.isKnown ? Cia402Axis::stateOf(m_feedback.statusword) : AxisState::Unknown;
}

bool CanOpenAxisChannels::hasAnswered(qint64 since) const noexcept
{
    const AxisState is = state();
    return is != AxisState::Unknown && m_statusTime > since && !(m_isSafe && is == AxisState::OperationEnabled);
}

void CanOpenAxisChannels::show(qint64 now) noexcept
{
    if (!m_feedback.isKnown)
        return;
    const AxisState state = this->state();
    const std::array<double, std::size(shownNames)> values{
        double(quint8(state)),
        state == AxisState::OperationEnabled ? 1.0 : 0.0,
        state == AxisState::Fault || state == AxisState::FaultReaction ? 1.0 : 0.0,
        m_axis.isLimited() ? 1.0 : 0.0,
        m_axis.isBlocked() ? 1.0 : 0.0,
        m_axis.isHomed() ? 1.0 : 0.0,
    };
    for (const Shown &one : m_shown)
        one.channel->set(values[std::size_t(one.kind)], now);
}

}  // namespace qplc
