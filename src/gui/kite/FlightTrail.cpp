// SPDX-License-Identifier: Apache-2.0
#include "FlightTrail.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qplc {

namespace {

/// Rows between two points: a power of two.
SignalStore::Row stepFor(SignalStore::Row rows)
{
    SignalStore::Row step = 1;
    while (rows / step >= SignalStore::Row(FlightTrail::mostPoints) - 1)
        step *= 2;
    return step;
}

}  // namespace

void FlightTrail::read(const SignalStore &store, int firstChannel, int valueChannel, SignalStore::Time begin,
                       SignalStore::Time end)
{
    m_points.clear();
    if (store.isEmpty() || end < begin)
        return;
    const SignalStore::Row first = store.rowAt(begin);
    const SignalStore::Row behind = store.rowAt(end + 1);
    if (first >= behind)
        return;
    const SignalStore::Row step = stepFor(behind - first);
    SignalStore::Row last = first;
    bool isInterrupted = true;
    for (SignalStore::Row row = first; row < behind;
         row = std::min((row / step + 1) * step, std::max(behind - 1, row + 1))) {
        const QVector3D position(store.writtenValue(firstChannel, row), store.writtenValue(firstChannel + 1, row),
                                 store.writtenValue(firstChannel + 2, row));
        isInterrupted = isInterrupted || store.nextBeginAnew(last + 1, row + 1) <= row;
        last = row;
        if (std::isnan(position.x()) || std::isnan(position.y()) || std::isnan(position.z())) {
            isInterrupted = true;
            continue;
        }
        const float value = valueChannel < 0 ? std::numeric_limits<float>::quiet_NaN() : store.value(valueChannel, row);
        m_points.push_back({position, value, !isInterrupted});
        isInterrupted = false;
    }
}

SignalStore::Range FlightTrail::valueRange() const
{
    SignalStore::Range range = {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    for (const Point &point : m_points) {
        if (std::isfinite(point.value)) {
            range.minimum = std::min(range.minimum, point.value);
            range.maximum = std::max(range.maximum, point.value);
        }
    }
    return range;
}

}  // namespace qplc
