// SPDX-License-Identifier: Apache-2.0
#include "SteadyPrefix.h"

namespace qplc {

const SiPrefix &SteadyPrefix::next(const QString &unit, double size)
{
    if (unit != m_prefix.tableUnit()) {
        m_prefix = SiPrefix(unit);
        m_isNew = true;
    }
    const bool hasSize = size > 0.0 || size < 0.0;
    if (!hasSize)
        return m_prefix;
    const SiPrefix wanted = m_prefix.kept(size);
    const bool isTooSmall = wanted.factor() > m_prefix.factor();
    m_tooSmall = isTooSmall ? m_tooSmall + 1 : 0;
    if (!isTooSmall || m_isNew || m_tooSmall >= Patience) {
        m_prefix = wanted;
        m_tooSmall = 0;
    }
    m_isNew = false;
    return m_prefix;
}

}  // namespace qplc
