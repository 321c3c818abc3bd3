// SPDX-License-Identifier: Apache-2.0
#include "DurationStatistics.h"

namespace qplc {

void DurationStatistics::clear() noexcept
{
    m_sinceStart.clear();
    m_window.clear();
}

QPlcDurationStatistics DurationStatistics::read(std::int64_t now, QPlcDistribution::Detail detail) const
{
    QPlcDurationStatistics statistics{m_sinceStart.distribution(), m_window.distribution(now)};
    if (detail == QPlcDistribution::FiguresOnly) {
        statistics.sinceStart.bins.clear();
        statistics.last10s.bins.clear();
    }
    return statistics;
}

}  // namespace qplc
