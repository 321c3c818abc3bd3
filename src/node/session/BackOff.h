// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QtGlobal>

#include <algorithm>
#include <chrono>

namespace qplc {

/// Pauses between attempts to connect: 0.1 s at first, then twice as long each time up to 5 s, all
/// of them +-20 %, so that many nodes that have lost one master do not come back all at once.
class BackOff
{
public:
    static constexpr std::chrono::milliseconds Shortest{100};
    static constexpr std::chrono::milliseconds Longest{5000};

    static constexpr std::chrono::milliseconds ShortestPatience{2000};
    static constexpr std::chrono::milliseconds LongestPatience{16000};

    /// How long the next attempt may take: 2 s at first, then twice as long each time up to 16 s. A
    /// master that hundreds ask at once answers late, and who gives up stands at the end of its
    /// queue again.
    std::chrono::milliseconds patience() const { return std::clamp(10 * m_pause, ShortestPatience, LongestPatience); }
    /// An attempt has succeeded: the next pause is the shortest again.
    void reset() { m_pause = Shortest; }
    /// \param chance  0 ... 1, by chance
    std::chrono::milliseconds next(double chance)
    {
        const double pause = double(m_pause.count()) * (0.8 + 0.4 * chance);
        m_pause = std::min(2 * m_pause, Longest);
        return std::chrono::milliseconds(qint64(pause));
    }
    /// The longest pause: a refusal does not pass by itself.
    std::chrono::milliseconds afterRefusal(double chance)
    {
        m_pause = Longest;
        return next(chance);
    }

private:
    std::chrono::milliseconds m_pause = Shortest;
};

}  // namespace qplc
