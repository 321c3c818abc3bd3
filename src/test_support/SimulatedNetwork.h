// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <utility>

namespace qplc {

class SimulatedHost;

/// How frames and control connections travel between two hosts, in one direction.
struct SimulatedRoad
{
    std::int64_t delay = 50'000;    // [ns] at least
    std::int64_t jitter = 100'000;  // [ns] more at most
    double loss = 0;                // of frames, 0 ... 1; a control connection repeats what was lost
    double duplication = 0;         // of frames, 0 ... 1
    double reordering = 0;          // of frames, 0 ... 1, that are late by up to \a lateness: others overtake them
    std::int64_t lateness = 0;      // [ns]
    double echo = 0;                // of frames, 0 ... 1, of which a copy arrives up to \a echoTime later
    std::int64_t echoTime = 0;      // [ns]
    bool dropsDatagrams = false;    // as a firewall: frames arrive on streams only
    bool isCut = false;             // nothing arrives, and nobody hears of it
};

/// The roads of a simulated network.
class SimulatedNetwork
{
public:
    SimulatedRoad usual;

    /// From now on, until resetRoads().
    void setRoad(const SimulatedHost &from, const SimulatedHost &to, const SimulatedRoad &road)
    {
        m_special[{&from, &to}] = road;
    }
    void resetRoads() { m_special.clear(); }
    const SimulatedRoad &road(const SimulatedHost &from, const SimulatedHost &to) const
    {
        if (m_special.empty())
            return usual;
        const auto found = m_special.find({&from, &to});  // looked up only, so that addresses decide nothing
        return found == m_special.end() ? usual : found->second;
    }

private:
    std::map<std::pair<const SimulatedHost *, const SimulatedHost *>, SimulatedRoad> m_special;
};

}  // namespace qplc
