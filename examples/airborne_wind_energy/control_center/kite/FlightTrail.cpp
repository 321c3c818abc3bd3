// SPDX-License-Identifier: Apache-2.0
#include "FlightTrail.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace awe {

namespace {

using Sample = QPlcPanelContext::Sample;

/// Finds the samples of times that grow.
class SampleReader
{
public:
    explicit SampleReader(const FlightTrail::Samples &samples)
        : m_next(samples.begin())
        , m_end(samples.end())
    {
    }
    /// Null when there is none of this time.
    const Sample *at(QPlcPanelContext::Time time)
    {
        while (m_next != m_end && m_next->time < time)
            ++m_next;
        return m_next != m_end && m_next->time == time ? &*m_next : nullptr;
    }

private:
    FlightTrail::Samples::const_iterator m_next;
    FlightTrail::Samples::const_iterator m_end;
};

bool isWritten(const Sample *sample)
{
    return sample && sample->quality < QPlcQuality::Safe;
}

}  // namespace

void FlightTrail::read(const Samples &x, const Samples &y, const Samples &z, const Samples &value)
{
    m_points.clear();
    SampleReader ys(y);
    SampleReader zs(z);
    SampleReader values(value);
    bool isInterrupted = true;
    for (const Sample &each : x) {
        const Sample *second = ys.at(each.time);
        const Sample *third = zs.at(each.time);
        const Sample *color = values.at(each.time);
        if (!isWritten(&each) || !isWritten(second) || !isWritten(third)) {
            isInterrupted = true;
            continue;
        }
        const QVector3D position(float(each.value), float(second->value), float(third->value));
        const bool isJoined = !isInterrupted && each.isJoined && second->isJoined && third->isJoined;
        m_points.push_back({position, color ? float(color->value) : std::numeric_limits<float>::quiet_NaN(), isJoined});
        isInterrupted = false;
    }
}

FlightTrail::Range FlightTrail::valueRange() const
{
    Range range = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Point &point : m_points) {
        if (std::isfinite(point.value)) {
            range.minimum = std::min(range.minimum, double(point.value));
            range.maximum = std::max(range.maximum, double(point.value));
        }
    }
    return range;
}

}  // namespace awe
