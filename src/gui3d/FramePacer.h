// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace qplc {

/// How long to wait between two pictures: at most 30 a second, and so few that drawing takes a
/// fixed share of the time, however slow the driver. A value type.
class FramePacer
{
public:
    static constexpr double shortestInterval = 33.0;  // [ms]
    static constexpr double longestInterval = 500.0;  // [ms]
    static constexpr double windowShare = 0.2;        // of the time of the window's thread
    static constexpr double pictureShare = 0.6;       // of a picture's interval from the wish to the picture

    /// \param windowTime   that the thread of the window was busy with the picture [ms]
    /// \param pictureTime  from the wish to the picture [ms]
    void frameDone(double windowTime, double pictureTime)
    {
        m_windowTime += 0.2 * (windowTime - m_windowTime);
        m_pictureTime += 0.2 * (pictureTime - m_pictureTime);
    }
    /// From one wish to the next [ms].
    double interval() const
    {
        const double wanted = std::max(m_windowTime / windowShare, m_pictureTime / pictureShare);
        return std::clamp(wanted, shortestInterval, longestInterval);
    }

private:
    double m_windowTime = 0;   // smoothed [ms]
    double m_pictureTime = 0;  // [ms]
};

}  // namespace qplc
