// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace qplc {

/// The permission of one start: a token that is valid for a while and can be used once. Looks at no
/// clock.
class Arming
{
public:
    static constexpr std::int64_t ValidFor = 5'000'000'000;  // [ns]

    /// \param token  by chance, not 0; takes the place of one that was there
    void arm(std::uint64_t token, std::int64_t now)
    {
        m_token = token;
        m_deadline = now + ValidFor;
    }
    void disarm() { m_token = 0; }
    bool isArmed(std::int64_t now) const { return m_token != 0 && now < m_deadline; }
    /// Whether \a token permits a start now.
    bool permits(std::uint64_t token, std::int64_t now) const { return isArmed(now) && token == m_token; }
    /// Whether a program or person who shows \a token may start now. \param isRequired else 0 is
    /// good enough
    bool permitsStart(std::uint64_t token, std::int64_t now, bool isRequired) const
    {
        return permits(token, now) || (!isRequired && token == 0);
    }
    /// Of the permission that is there.
    std::uint64_t token() const { return m_token; }

private:
    std::uint64_t m_token = 0;  // 0: not armed
    std::int64_t m_deadline = 0;
};

}  // namespace qplc
