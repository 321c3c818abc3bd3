// SPDX-License-Identifier: Apache-2.0
#include "SetterTarget.h"

#include "gui/LimitOf.h"
#include "gui/models/ValueFormat.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qplc {

SetterTarget::SetterTarget(QPlcPanelContext *context, QObject *parent)
    : QObject(parent)
    , m_context(context)
    , m_control(context)
{
    m_control.setKeepsControl(true);  // a panel that is closed or set up anew does not stop what a person steers
    connect(&m_control, &QPlcSignalControl::changed, this, [this] {
        look();
        Q_EMIT changed();
    });
    connect(context, &QPlcPanelContext::valuesChanged, this, [this] {
        look();
        Q_EMIT updated();
    });
}

void SetterTarget::setSignal(const QString &reference)
{
    m_control.setSignals(reference.isEmpty() ? QStringList() : QStringList(reference));
}

void SetterTarget::setLimits(std::optional<double> minimum, std::optional<double> maximum)
{
    m_minimum = minimum;
    m_maximum = maximum;
    Q_EMIT changed();
}

bool SetterTarget::isNumber() const
{
    const QPlcSignalType type = m_signal.definition.type;
    return m_signal && type.isNumeric() && (m_signal.element >= 0 || !type.isArray());
}

QString SetterTarget::unit() const
{
    return m_signal ? SiPrefix::unitText(m_signal.definition.unit) : QString();
}

QString SetterTarget::reading(double number, int digits) const
{
    if (!m_signal)
        return numberText(number, digits);
    const QPlcSignalDefinition &definition = m_signal.definition;
    SiPrefix prefix(definition.unit);
    if (hasRange())
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
    if (m_signal)
        m_prefix.next(m_signal.definition.unit, actualNumber());
}

std::optional<double> SetterTarget::minimum() const
{
    std::optional<double> limit = m_signal ? limitOf(m_signal.definition.minimum) : std::nullopt;
    if (m_minimum)
        limit = std::max(limit.value_or(*m_minimum), *m_minimum);
    else if (!limit && m_signal && m_signal.definition.typeName == QLatin1String("Bool"))
        limit = 0.0;
    return limit;
}

std::optional<double> SetterTarget::maximum() const
{
    std::optional<double> limit = m_signal ? limitOf(m_signal.definition.maximum) : std::nullopt;
    if (m_maximum)
        limit = std::min(limit.value_or(*m_maximum), *m_maximum);
    else if (!limit && m_signal && m_signal.definition.typeName == QLatin1String("Bool"))
        limit = 1.0;
    return limit;
}

double SetterTarget::smallStep(double value) const
{
    const double size = hasRange() ? *maximum() - *minimum() : std::max(std::abs(value), 1.0);
    const double step = size / 100.0;
    return m_signal && m_signal.definition.type.isReal() ? step : std::max(1.0, std::round(step));
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
    return isNumber() ? m_signal.number() : std::numeric_limits<double>::quiet_NaN();
}

double SetterTarget::neutral() const
{
    return isNumber() ? m_control.neutral(reference()) : 0.0;
}

}  // namespace qplc
