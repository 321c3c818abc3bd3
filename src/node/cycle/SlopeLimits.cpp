// SPDX-License-Identifier: Apache-2.0
#include "SlopeLimits.h"

#include "QSplitPrimitive.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qplc {

SlopeLimits::SlopeLimits(ProcessImage &image)
    : m_image(image.data())
{
    const QPlcSignalTable &table = image.table();
    for (QPlcSignalIndex index = 0; index < table.size(); ++index) {
        const QPlcSignalDefinition &definition = table.at(index);
        if (!(definition.slope > 0.0))
            continue;
        m_places.resize(std::size_t(table.size()), None);
        m_places[index] = quint16(m_signals.size());
        Signal signal;
        signal.offset = image.offset(index);
        signal.index = index;
        signal.first = m_present.size();
        signal.count = std::size_t(definition.type.count());
        signal.slope = definition.slope;
        signal.isFloat = definition.type.scalar() == QPlcSignalType::Real32;
        m_signals.push_back(signal);
        m_present.resize(m_present.size() + signal.count);
    }
    m_targets.resize(m_present.size());
}

double SlopeLimits::valueOf(const Signal &signal, const char *bytes, std::size_t element) const noexcept
{
    return signal.isFloat ? double(QSplitPrimitive<float>::fromBytes(bytes + element * sizeof(float)))
                          : QSplitPrimitive<double>::fromBytes(bytes + element * sizeof(double));
}

void SlopeLimits::write(const Signal &signal, std::size_t element) noexcept
{
    const double value = m_present[signal.first + element];
    if (signal.isFloat)
        QSplitPrimitive<float>(float(value)).toBytes(m_image + signal.offset + element * sizeof(float));
    else
        QSplitPrimitive<double>(value).toBytes(m_image + signal.offset + element * sizeof(double));
}

void SlopeLimits::aim(QPlcSignalIndex index, const char *target) noexcept
{
    Signal &signal = m_signals[m_places[index]];
    for (std::size_t element = 0; element < signal.count; ++element) {
        const std::size_t place = signal.first + element;
        m_targets[place] = valueOf(signal, target, element);
        if (!signal.isMoving)
            m_present[place] = valueOf(signal, m_image + signal.offset, element);
        // There is no way from or to NaN: such an element is there at once.
        if (!std::isfinite(m_present[place]) || !std::isfinite(m_targets[place]))
            m_present[place] = m_targets[place];
    }
    if (!signal.isMoving)
        ++m_moving;
    signal.isMoving = true;
}

void SlopeLimits::leave(QPlcSignalIndex index) noexcept
{
    if (!isLimited(index))
        return;
    Signal &signal = m_signals[m_places[index]];
    if (signal.isMoving)
        --m_moving;
    signal.isMoving = false;
}

void SlopeLimits::leaveAll() noexcept
{
    for (Signal &signal : m_signals)
        signal.isMoving = false;
    m_moving = 0;
}

void SlopeLimits::leaveAll(const std::vector<bool> &which) noexcept
{
    for (const Signal &signal : m_signals) {
        if (signal.index < which.size() && which[signal.index])
            leave(signal.index);
    }
}

/// \return whether the target is reached
bool SlopeLimits::step(const Signal &signal, double largest) noexcept
{
    bool isThere = true;
    for (std::size_t element = 0; element < signal.count; ++element) {
        double &present = m_present[signal.first + element];
        const double target = m_targets[signal.first + element];
        const double way = target - present;
        const bool isLast = !(std::abs(way) > largest);
        present = isLast ? target : present + std::copysign(largest, way);
        isThere = isThere && isLast;
        write(signal, element);
    }
    return isThere;
}

void SlopeLimits::advance(double seconds) noexcept
{
    if (m_moving == 0)
        return;
    for (Signal &signal : m_signals) {
        if (!signal.isMoving || !step(signal, signal.slope * seconds))
            continue;
        signal.isMoving = false;
        --m_moving;
    }
}

void SlopeLimits::finish() noexcept
{
    for (const Signal &signal : m_signals) {
        if (signal.isMoving)
            step(signal, std::numeric_limits<double>::infinity());
    }
    leaveAll();
}

}  // namespace qplc
