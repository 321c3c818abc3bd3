// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace awe {

/// What WinchStatistics sees of one cycle: signals only, so the drive may be a real one.
struct WinchSample
{
    double time = 0.0;              // that the sample stands for [s]
    double wantedSpeed = 0.0;       // of the tether [m/s], > 0 reels out
    double speed = 0.0;             // what the drive does [m/s]
    double position = 0.0;          // tether that the drive has reeled out since its own beginning [m]
    double current = 0.0;           // [A]
    double electricalPower = 0.0;   // [W], > 0 while it generates
    double tetherLength = 0.0;      // of the plant [m]
    double mechanicalEnergy = 0.0;  // of the plant, that the tether gave to the winch since the beginning [J]
    bool isEnabled = false;         // the drive is there, and follows
};

/// The figures of the winch drive over a flight.
struct WinchReport
{
    double mechanicalEnergy = 0.0;   // last minus first sample [J]
    double electricalEnergy = 0.0;   // [J]
    double losses = 0.0;             // mechanical minus electrical energy [J]
    double speedError = 0.0;         // root of the mean square of (speed - wanted speed) while it was enabled [m/s]
    double largestSpeedError = 0.0;  // while it was enabled [m/s]
    double largestCurrent = 0.0;     // [A]
    double positionError
        // tether reeled out by the drive minus that of the plant, between first and last sample
        // with a drive [m]
        = 0.0;
    double timeDisabled = 0.0;  // without a drive that follows, after it was enabled first [s]
    int interruptions = 0;      // how often that began
};

/// Adds up what the winch drive did, cycle by cycle. step() takes no memory. One thread at a time.
class WinchStatistics
{
public:
    void reset() { *this = WinchStatistics(); }
    void step(const WinchSample &sample);

    /// The figures so far; all zero before the first sample.
    WinchReport report() const;

private:
    WinchSample m_first, m_last;  // of all
    WinchSample m_firstEnabled, m_lastEnabled;
    std::int64_t m_count = 0;
    double m_electricalEnergy = 0.0;  // [J]
    double m_enabledTime = 0.0;       // [s]
    double m_squaredError = 0.0;      // integral [m^2/s]
    WinchReport m_report;             // what needs no sums
};

}  // namespace awe
