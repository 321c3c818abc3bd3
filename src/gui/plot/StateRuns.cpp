// SPDX-License-Identifier: Apache-2.0
#include "gui/plot/StateRuns.h"

#include <algorithm>
#include <cmath>

namespace qplc {

void StateRuns::read(const CurveShape &shape)
{
    m_runs.clear();
    m_spikes.clear();
    const CurveShape::Point *before = nullptr;
    for (const CurveShape::Point &point : shape.points()) {
        const float value = std::isnan(point.last) ? point.maximum : point.last;
        const bool isJoined = before && point.isJoined && !m_runs.empty();
        if (isJoined)
            m_runs.back().end = std::max(m_runs.back().end, point.x);
        const float former = isJoined ? m_runs.back().value : value;
        const float least = std::min(former, value);
        const float greatest = std::max(former, value);
        if (point.minimum < least || point.maximum > greatest)
            m_spikes.push_back(point.x);
        if (isJoined && former == value && m_runs.back().mark == point.mark)
            m_runs.back().end = point.x + 1;
        else
            m_runs.push_back({point.x, point.x + 1, value, point.mark});
        before = &point;
    }
}

}  // namespace qplc
