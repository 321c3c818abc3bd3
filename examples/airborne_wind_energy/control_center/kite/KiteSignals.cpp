// SPDX-License-Identifier: Apache-2.0
#include "KiteSignals.h"

#include <cmath>

namespace awe {

namespace {

using Signal = QPlcPanelContext::Signal;

bool isVector(const Signal &signal)
{
    return signal && signal.element < 0 && signal.definition.type.count() >= 3;
}

QString elementOf(const QString &reference, int element)
{
    return QStringLiteral("%1[%2]").arg(reference).arg(element);
}

}  // namespace

std::optional<QVector3D> KiteState::relativeWind() const
{
    if (!wind || !velocity)
        return std::nullopt;
    return *wind - *velocity;
}

void KiteSignals::setContext(QPlcPanelContext *context)
{
    if (context != m_context) {
        if (m_context)
            m_context->disconnect(this);
        m_context = context;
        connect(context, &QPlcPanelContext::signalsChanged, this, &KiteSignals::changed);
        connect(context, &QPlcPanelContext::plantStateChanged, this, &KiteSignals::changed);
        connect(context, &QPlcPanelContext::timeChanged, this, &KiteSignals::changed);
        connect(context, &QPlcPanelContext::valuesChanged, this, [this] {
            if (!m_context->shownTime())
                Q_EMIT changed();
        });
    }
    Q_EMIT changed();
}

void KiteSignals::setSettings(const KiteSettings &settings)
{
    m_settings = settings;
    Q_EMIT changed();
}

Signal KiteSignals::find(const QString &reference) const
{
    Signal signal;
    signal.problem = reference;
    return m_context && !reference.isEmpty() ? m_context->shown(reference) : signal;
}

QString KiteSignals::problem() const
{
    if (!m_context || m_context->plants().isEmpty())
        return tr("No plant is connected.");
    const Signal position = m_context->signal(m_settings.position);
    if (!position)
        return tr("There is no signal %1 at the moment: choose another one in the settings.").arg(m_settings.position);
    if (!isVector(position))
        return tr("%1 is not a position: choose a signal with three elements.").arg(m_settings.position);
    if (!m_context->shownTime() && position.quality.kind() == QPlcQuality::Invalid)
        return tr("Waiting for the first values of %1.").arg(m_settings.position);
    return {};
}

std::optional<QVector3D> KiteSignals::vectorOf(const QString &reference) const
{
    const Signal signal = find(reference);
    if (!isVector(signal) || !signal.quality.isUsable())
        return std::nullopt;
    const QVector3D vector(float(signal.number(0)), float(signal.number(1)), float(signal.number(2)));
    const bool isNumber = std::isfinite(vector.x()) && std::isfinite(vector.y()) && std::isfinite(vector.z());
    return isNumber ? std::optional<QVector3D>(vector) : std::nullopt;
}

std::optional<double> KiteSignals::number(const QString &reference) const
{
    const Signal signal = find(reference);
    const double number = signal.number();
    return signal.quality.isUsable() && std::isfinite(number) ? std::optional<double>(number) : std::nullopt;
}

/// All of them, or none: a tether without one of its nodes would have a false shape.
std::vector<QVector3D> KiteSignals::tetherNodes() const
{
    std::vector<QVector3D> nodes;
    if (!m_settings.tetherNode.contains(QLatin1String("%1")))
        return nodes;
    for (int number = 1;; ++number) {
        const QString reference = m_settings.tetherNode.arg(number);
        if (!find(reference))
            return nodes;
        const std::optional<QVector3D> node = vectorOf(reference);
        if (!node)
            return {};
        nodes.push_back(*node);
    }
}

KiteState KiteSignals::state() const
{
    KiteState state;
    state.position = vectorOf(m_settings.position);
    state.velocity = vectorOf(m_settings.velocity);
    state.wind = vectorOf(m_settings.wind);
    state.force = vectorOf(m_settings.force);
    state.tetherLength = number(m_settings.tetherLength);
    state.tetherNodes = tetherNodes();
    state.mastTop = vectorOf(m_settings.mastTop);
    state.value = number(m_settings.color);
    if (!m_context)
        return state;
    state.pastTime = m_context->shownTime();
    if (const Signal position = find(m_settings.position)) {
        const QPlcPanelContext::Plant plant = m_context->plant(position.plant);
        state.isStale = plant.isStale;
        state.age = plant.age;
    }
    if (state.position) {
        const QVector3D sky = vectorOf(m_settings.positionOrientation).value_or(positionOrientation(*state.position));
        if (const auto control = vectorOf(m_settings.controlOrientation)) {
            state.body = bodyOrientation(sky, *control);
            state.course = courseOrientation(sky, control->z());
        }
    }
    return state;
}

bool KiteSignals::readTrail(FlightTrail *trail) const
{
    trail->clear();
    const Signal position = find(m_settings.position);
    if (!isVector(position))
        return false;
    const QPlcPanelContext::Time newest = m_context->plant(position.plant).newest;
    const QPlcPanelContext::Time end = std::min(m_context->shownTime().value_or(newest), newest);
    const auto past = [&](const QString &reference) {
        return m_context->history(reference, end - QPlcPanelContext::Time(m_settings.trail * 1e9), end,
                                  FlightTrail::mostPoints);
    };
    FlightTrail::Samples value;
    const Signal color = find(m_settings.color);
    if (color && color.plant == position.plant) {
        const bool isWhole = color.definition.type.isArray() && color.element < 0;
        value = past(isWhole ? elementOf(m_settings.color, 0) : m_settings.color);
    }
    trail->read(past(elementOf(m_settings.position, 0)), past(elementOf(m_settings.position, 1)),
                past(elementOf(m_settings.position, 2)), value);
    return !trail->points().empty();
}

ColorScale KiteSignals::colorScale(const FlightTrail &trail) const
{
    const FlightTrail::Range range = trail.valueRange();
    ColorScale scale = ColorScale::around(range.minimum, range.maximum);
    if (m_settings.minimum)
        scale.minimum = *m_settings.minimum;
    if (m_settings.maximum)
        scale.maximum = *m_settings.maximum;
    return scale;
}

QString KiteSignals::colorTitle() const
{
    const Signal color = find(m_settings.color);
    if (!color)
        return {};
    const QString unit = color.definition.unit;
    return unit.isEmpty() ? m_settings.color : QStringLiteral("%1 [%2]").arg(m_settings.color, unit);
}

}  // namespace awe
