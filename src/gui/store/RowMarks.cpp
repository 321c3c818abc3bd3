// SPDX-License-Identifier: Apache-2.0
#include "gui/store/RowMarks.h"

#include <algorithm>
#include <limits>

namespace qplc {

void RowMarks::mark(Row row, Mark mark)
{
    if (!m_stretches.empty()) {
        Stretch &last = m_stretches.back();
        const bool hasRoom = last.rows < std::numeric_limits<std::uint32_t>::max();
        if (last.end() == row && last.mark == mark && hasRoom) {
            ++last.rows;
            return;
        }
    }
    if (m_stretches.size() == MostStretches)
        joinOldest();
    m_stretches.push_back({row, 1, mark});
}

/// Half of them become half as many, so that this is seldom.
void RowMarks::joinOldest()
{
    constexpr std::size_t half = MostStretches / 2;
    std::size_t to = 0;
    for (std::size_t from = 0; from < half; from += 2) {
        const Stretch &first = m_stretches[from];
        const Stretch &second = m_stretches[from + 1];
        const Row rows = std::min<Row>(second.end() - first.begin, std::numeric_limits<std::uint32_t>::max());
        m_stretches[to++] = {first.begin, std::uint32_t(rows), std::max(first.mark, second.mark)};
    }
    m_stretches.erase(m_stretches.begin() + std::ptrdiff_t(to), m_stretches.begin() + std::ptrdiff_t(half));
}

void RowMarks::forgetBefore(Row row)
{
    const auto isKept = [row](const Stretch &stretch) { return stretch.end() > row; };
    if (!m_stretches.empty() && !isKept(m_stretches.front()))
        m_stretches.erase(m_stretches.begin(), std::find_if(m_stretches.begin(), m_stretches.end(), isKept));
}

RowMarks::Mark RowMarks::greatest(Row begin, Row end) const
{
    auto stretch = std::partition_point(m_stretches.begin(), m_stretches.end(),
                                        [begin](const Stretch &each) { return each.end() <= begin; });
    Mark greatest = None;
    for (; begin < end && stretch != m_stretches.end() && stretch->begin < end; ++stretch)
        greatest = std::max(greatest, stretch->mark);
    return greatest;
}

}  // namespace qplc
