// SPDX-License-Identifier: Apache-2.0
#include "KiteSignals.h"

#include <cmath>

namespace qplc {

std::optional<QVector3D> KiteState::relativeWind() const
{
    if (!wind || !velocity)
        return std::nullopt;
    return *wind - *velocity;
}

void KiteSignals::setContext(WindowContext *context)
{
    if (m_context)
        m_context->disconnect(this);
    m_context = context;
    if (context) {
        connect(context->curveSources(), &CurveSources::changed, this, &KiteSignals::bind);
        connect(context->timeView(), &TimeView::displayTimeChanged, this, &KiteSignals::changed);
        connect(context->timeView(), &TimeView::viewChanged, this, &KiteSignals::changed);
    }
    bind();
}

void KiteSignals::setSettings(const KiteSettings &settings)
{
    m_settings = settings;
    bind();
}

void KiteSignals::setPin(const QString &plant)
{
    m_pin = plant;
    bind();
}

void KiteSignals::bind()
{
    disconnect(m_updates);
    disconnect(m_states);
    m_position = find(m_settings.position);
    m_velocity = find(m_settings.velocity);
    m_wind = find(m_settings.wind);
    m_controlOrientation = find(m_settings.controlOrientation);
    m_positionOrientation = find(m_settings.positionOrientation);
    m_force = find(m_settings.force);
    m_tetherLength = find(m_settings.tetherLength);
    m_color = find(m_settings.color);
    if (m_position) {
        m_updates = connect(m_position.plant, &Plant::updated, this, [this] {
            if (!pastTime())
                Q_EMIT changed();
        });
        m_states = connect(m_position.plant, &Plant::stateChanged, this, &KiteSignals::changed);
    }
    Q_EMIT changed();
}

PlantList::Signal KiteSignals::find(const QString &text) const
{
    const SignalReference reference = SignalReference::fromString(text);
    return m_context && reference.isValid() ? m_context->plants()->resolve(reference, m_pin) : PlantList::Signal();
}

QString KiteSignals::problem() const
{
    if (!m_context || m_context->plants()->size() == 0)
        return tr("No plant is connected.");
    if (!m_position)
        return tr("There is no signal %1 at the moment: choose another one in the settings.").arg(m_settings.position);
    if (m_position.definition().type.count() < 3)
        return tr("%1 is no position: a signal with three elements is needed.").arg(m_settings.position);
    if (!pastTime() && m_position.quality().kind() == QPlcQuality::Invalid)
        return tr("Waiting for the first values of %1.").arg(m_settings.position);
    return {};
}

std::optional<TimeView::Time> KiteSignals::pastTime() const
{
    return m_context ? m_context->timeView()->displayTime() : std::nullopt;
}

std::optional<double> KiteSignals::element(const PlantList::Signal &signal, int element) const
{
    if (!signal || element >= signal.definition().type.count())
        return std::nullopt;
    double value = std::numeric_limits<double>::quiet_NaN();
    if (const auto time = pastTime()) {
        const SignalStore *store = signal.plant->store();
        const int channel = signal.plant->values().channels().channel(signal.index, element);
        const std::optional<SignalStore::Row> row = store ? store->rowHoldingAt(*time) : std::nullopt;
        if (row && channel != ChannelMap::NoChannel)
            value = double(store->writtenValue(channel, *row));
    } else if (signal.quality().isUsable()) {
        bool isNumber = false;
        value = signal.plant->value(signal.index).toReal(element, &isNumber);
        if (!isNumber)
            return std::nullopt;
    }
    return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

std::optional<QVector3D> KiteSignals::vector(const PlantList::Signal &signal) const
{
    const auto x = element(signal, 0);
    const auto y = element(signal, 1);
    const auto z = element(signal, 2);
    if (!x || !y || !z)
        return std::nullopt;
    return QVector3D(float(*x), float(*y), float(*z));
}

std::optional<double> KiteSignals::number(const PlantList::Signal &signal) const
{
    return element(signal, signal.element == SignalReference::Whole ? 0 : signal.element);
}

KiteState KiteSignals::state() const
{
    KiteState state;
    state.position = vector(m_position);
    state.velocity = vector(m_velocity);
    state.wind = vector(m_wind);
    state.force = vector(m_force);
    state.tetherLength = number(m_tetherLength);
    state.value = number(m_color);
    state.pastTime = pastTime();
    if (m_position) {
        state.quality = m_position.plant->quality();
        state.age = m_position.plant->age();
    }
    if (state.position) {
        const QVector3D sky = vector(m_positionOrientation).value_or(positionOrientation(*state.position));
        if (const auto control = vector(m_controlOrientation)) {
            state.body = bodyOrientation(sky, *control);
            state.course = courseOrientation(sky, control->z());
        }
    }
    return state;
}

bool KiteSignals::readTrail(FlightTrail *trail) const
{
    trail->clear();
    const SignalStore *store = m_position ? m_position.plant->store() : nullptr;
    if (!store || store->isEmpty() || m_position.definition().type.count() < 3)
        return false;
    const int position = m_position.plant->values().channels().channel(m_position.index, 0);
    const bool isColored = m_color && m_color.plant == m_position.plant && m_color.definition().type.isNumeric();
    const int element = m_color.element == SignalReference::Whole ? 0 : m_color.element;
    const int color = isColored ? m_color.plant->values().channels().channel(m_color.index, element) : -1;
    if (position == ChannelMap::NoChannel)
        return false;
    const TimeView::Time newest = store->newestTime();
    const TimeView::Time end = std::min(pastTime().value_or(newest), newest);
    trail->read(*store, position, color, end - TimeView::Time(m_settings.trail * 1e9), end);
    return !trail->points().empty();
}

ColorScale KiteSignals::colorScale(const FlightTrail &trail) const
{
    const SignalStore::Range range = trail.valueRange();
    ColorScale scale = ColorScale::around(double(range.minimum), double(range.maximum));
    if (m_settings.minimum)
        scale.minimum = *m_settings.minimum;
    if (m_settings.maximum)
        scale.maximum = *m_settings.maximum;
    return scale;
}

QString KiteSignals::colorTitle() const
{
    if (!m_color)
        return {};
    const QString unit = m_color.definition().unit;
    return unit.isEmpty() ? m_settings.color : QStringLiteral("%1 [%2]").arg(m_settings.color, unit);
}

}  // namespace qplc
