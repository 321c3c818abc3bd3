// SPDX-License-Identifier: Apache-2.0
#include "CycleCosts.h"

#include <algorithm>

CycleCosts::CycleCosts(quint64 cycles)
    : m_begin(std::min<quint64>(1000, cycles / 4))
    , m_end(cycles - std::min<quint64>(50, cycles / 4))
{
}

void CycleCosts::take(quint64 cycle)
{
    if (!m_hasBegun && cycle >= m_begin) {
        m_hasBegun = true;
        m_before = ThreadCosts::ofThisThread();
    } else if (!m_hasEnded && cycle >= m_end) {
        m_hasEnded = true;
        m_spent = ThreadCosts::ofThisThread() - m_before;
    }
}

QJsonObject CycleCosts::toJson() const
{
    if (!m_hasEnded)
        return {};
    return {{QStringLiteral("allocations"), double(m_spent.allocations)},
            {QStringLiteral("locks"), double(m_spent.locks)},
            {QStringLiteral("page_faults"), double(m_spent.pageFaults)}};
}
