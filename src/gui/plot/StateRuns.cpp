// SPDX-License-Identifier: Apache-2.0
#include "gui/plot/StateRuns.h"

#include <algorithm>
#include <cmath>

namespace qplc {

/// One that follows the last one of the same value makes it longer.
void StateRuns::addMarkedPart(int begin, int end, float value)
{
    if (!m_markedParts.empty() && m_markedParts.back().end >= begin && m_markedParts.back().value == value)
        m_markedParts.back().end = std::max(m_markedParts.back().end, end);
    else
        m_markedParts.push_back({begin, end, value});
}

void StateRuns::read(const CurveShape &shape)
{
    m_runs.clear();
    m_markedParts.clear();
    m_spikes.clear();
    const CurveShape::Point *before = nullptr;
    for (const CurveShape::Point &point : shape.points()) {
        const float value = std::isnan(point.last) ? point.maximum : point.last;
        // A gap that is narrower than a column is not seen, and splits nothing.
        const bool isGapSeen = !m_runs.empty() && point.x > m_runs.back().end + 1;
        const bool isJoined = before && !m_runs.empty() && (point.isJoined || !isGapSeen);
        if (isJoined) {
            m_runs.back().end = std::max(m_runs.back().end, point.x);
            if (before->mark != RowMarks::None)  // a value holds until the next one, and so does what is wrong with it
                addMarkedPart(before->x, point.x, m_runs.back().value);
        }
        const float former = isJoined ? m_runs.back().value : value;
        const float least = std::min(former, value);
        const float greatest = std::max(former, value);
        if (point.minimum < least || point.maximum > greatest)
            m_spikes.push_back(point.x);
        if (isJoined && former == value)
            m_runs.back().end = point.x + 1;
        else
            m_runs.push_back({point.x, point.x + 1, value});
        if (point.mark != RowMarks::None)
            addMarkedPart(point.x, point.x + 1, value);
        before = &point;
    }
}

}  // namespace qplc
