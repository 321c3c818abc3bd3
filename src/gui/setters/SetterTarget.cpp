// SPDX-License-Identifier: Apache-2.0
#include "SetterTarget.h"

#include "gui/models/ValueFormat.h"
#include "gui/plant/LimitOf.h"

#include <algorithm>
#include <cmath>

namespace qplc {

SetterTarget::SetterTarget(QObject *parent)
    : QObject(parent)
{
    connect(&m_control, &SignalControl::signalsChanged, this, [this] {
        m_stream.setPlant(signal().plant);
        Q_EMIT changed();
    });
    connect(&m_control, &SignalControl::leaving, this, &SetterTarget::leave);
    connect(&m_control, &SignalControl::changed, this, &SetterTarget::check);
    connect(&m_control, &SignalControl::updated, this, &SetterTarget::updated);
    connect(&m_control, &SignalControl::failed, this, &SetterTarget::failed);
    connect(&m_stream, &ValueStream::failed, this, &SetterTarget::failed);
}

void SetterTarget::setSignal(const SignalReference &reference)
{
    endAction();
    m_control.setSignals(reference.isValid() ? QVector<SignalReference>{reference} : QVector<SignalReference>());
}

void SetterTarget::setLimits(std::optional<double> minimum, std::optional<double> maximum)
{
    m_minimum = minimum;
    m_maximum = maximum;
    Q_EMIT changed();
}

/// What was done to one plant never goes on in another one.
void SetterTarget::leave()
{
    m_stream.flush();
    if (m_isActing) {
        endAction();
        Q_EMIT actionLost();
    }
    Q_EMIT leaving();
}

/// Who has control has changed: what acts must not go on for another one.
void SetterTarget::check()
{
    const bool isStillMine
        = m_control.state() == SignalControl::Mine || (m_control.state() == SignalControl::Free && m_isActing);
    if (m_isActing && !isStillMine) {
        m_isActing = false;
        m_holdsForAction = false;
        m_stream.clear();
        Q_EMIT actionLost();
    }
    Q_EMIT changed();
}

bool SetterTarget::isNumber() const
{
    const PlantList::Signal target = signal();
    return target && target.definition().type.isNumeric()
        && (target.element != SignalReference::Whole || !target.definition().type.isArray());
}

QString SetterTarget::unit() const
{
    return signal() ? SiPrefix::unitText(signal().definition().unit) : QString();
}

QString SetterTarget::reading(double number, int digits) const
{
    if (!signal())
        return numberText(number, digits);
    const QPlcSignalDefinition &definition = signal().definition();
    SiPrefix prefix(definition.unit);
    if (minimum() && maximum())
        prefix = SiPrefix::fitting(definition.unit, std::max(std::abs(*minimum()), std::abs(*maximum())));
    else if (m_prefix.current().tableUnit() == definition.unit)
        prefix = m_prefix.current();
    constexpr int steadyDigits = 4;
    const bool isPlain = prefix.factor() == 1.0 || !definition.valueNames.isEmpty();
    if (isPlain)
        return QStringLiteral("%1 %2").arg(numberText(number, digits, definition.valueNames), unit()).trimmed();
    return QStringLiteral("%1 %2").arg(steadyNumberText(prefix.shown(number), steadyDigits), prefix.unit());
}

void SetterTarget::renewPrefix()
{
    if (signal())
        m_prefix.next(signal().definition().unit, actualNumber());
}

std::optional<double> SetterTarget::minimum() const
{
    std::optional<double> limit = signal() ? limitOf(signal().definition().minimum) : std::nullopt;
    if (m_minimum)
        limit = std::max(limit.value_or(*m_minimum), *m_minimum);
    else if (!limit && signal() && signal().definition().typeName == QLatin1String("Bool"))
        limit = 0.0;
    return limit;
}

std::optional<double> SetterTarget::maximum() const
{
    std::optional<double> limit = signal() ? limitOf(signal().definition().maximum) : std::nullopt;
    if (m_maximum)
        limit = std::min(limit.value_or(*m_maximum), *m_maximum);
    else if (!limit && signal() && signal().definition().typeName == QLatin1String("Bool"))
        limit = 1.0;
    return limit;
}

double SetterTarget::smallStep(double value) const
{
    const double size = minimum() && maximum() ? *maximum() - *minimum() : std::max(std::abs(value), 1.0);
    const double step = size / 100.0;
    return signal() && signal().definition().type.isReal() ? step : std::max(1.0, std::round(step));
}

double SetterTarget::clamped(double value, QString *message) const
{
    const auto tell = [&](const QString &text, double limit) {
        if (message)
            *message = QStringLiteral("%1 %2 %3").arg(text, numberText(limit), unit()).trimmed();
        return limit;
    };
    if (maximum() && value > *maximum())
        return tell(tr("At most"), *maximum());
    if (minimum() && value < *minimum())
        return tell(tr("At least"), *minimum());
    return value;
}

double SetterTarget::actualNumber() const
{
    const QPlcValue value = isNumber() ? actual() : QPlcValue();
    return value.isValid() ? value.toReal() : std::numeric_limits<double>::quiet_NaN();
}

double SetterTarget::neutral() const
{
    return isNumber() ? neutralValue(signal()).toReal() : 0.0;
}

void SetterTarget::sendOnce(const QPlcValue &value)
{
    if (!m_control.mayWrite() || !value.isValid())
        return;
    Plant *plant = signal().plant;
    m_control.follow(plant, plant->setValues({{name(), value}}));
}

bool SetterTarget::sendOnce(double number)
{
    const QPlcValue value = m_control.mayWrite() ? wholeValue(signal(), clamped(number)) : QPlcValue();
    sendOnce(value);
    return value.isValid();
}

void SetterTarget::stream(double number)
{
    if (!m_control.mayWrite())
        return;
    const QPlcValue value = wholeValue(signal(), clamped(number));
    if (value.isValid())
        m_stream.send({{name(), value}});
}

bool SetterTarget::beginAction(double number)
{
    if (!m_control.mayWrite() || !isNumber())
        return false;
    Plant *plant = signal().plant;
    m_isActing = true;
    m_holdsForAction = m_control.state() == SignalControl::Free && plant->hasLeases();
    const QPlcValue value = wholeValue(signal(), clamped(number));
    if (m_holdsForAction)
        m_control.follow(plant, plant->takeLease({name()}, {{name(), value}}));
    else
        stream(number);
    return true;
}

void SetterTarget::endAction()
{
    if (!m_isActing)
        return;
    m_isActing = false;
    m_stream.clear();  // what is under way comes before neutral
    sendOnce(wholeValue(signal(), neutral()));
    if (m_holdsForAction)
        signal().plant->releaseLease({name()});
    m_holdsForAction = false;
}

}  // namespace qplc
