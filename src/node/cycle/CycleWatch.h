// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace qplc {

/// Judges by looks at even intervals whether cycles go on, or hang.
class CycleWatch
{
public:
    /// \param mark  what changes with each cycle; 0: nothing is under way that could hang
    /// \param patience  looks that may find the same mark before that is a hang
    /// \return whether the cycles go on
    bool look(std::uint64_t mark, std::int64_t patience = 0)
    {
        m_still = mark == 0 || mark != m_mark ? 0 : m_still + 1;
        m_mark = mark;
        return m_still <= patience;
    }

private:
    std::uint64_t m_mark = 0;
    std::int64_t m_still = 0;
};

}  // namespace qplc
