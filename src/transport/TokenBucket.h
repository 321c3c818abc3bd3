// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QtGlobal>

#include <algorithm>

namespace qplc {

/// Allows something so many times a second on the long run, and some times more after a pause.
/// Looks at no clock: times are ns on any steady clock.
class TokenBucket
{
public:
    /// \param perSecond  1 ... 10^9; \param atOnce  at least 1
    TokenBucket(int perSecond, int atOnce)
        : m_token(1'000'000'000 / perSecond)
        , m_full(m_token * atOnce)
        , m_filled(m_full)
    {
    }
    /// \return false: not now
    bool take(qint64 now) { return takeUpTo(now, 1) == 1; }
    /// \return as many as there are now, at most \a most
    int takeUpTo(qint64 now, int most)
    {
        if (m_filled < m_full)
            m_filled = std::min(m_full, m_filled + std::max<qint64>(now - m_filledAt, 0));
        m_filledAt = now;
        const qint64 taken = std::min<qint64>(most, m_filled / m_token);
        m_filled -= taken * m_token;
        return int(taken);
    }

private:
    qint64 m_token;  // [ns] that it takes to fill in one
    qint64 m_full;
    qint64 m_filled;
    qint64 m_filledAt = 0;
};

}  // namespace qplc
