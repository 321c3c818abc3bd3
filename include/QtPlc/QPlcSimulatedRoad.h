// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

/// How frames and control connections travel between two hosts of a QPlcSimulator, in one
/// direction.
///
/// \code
/// QPlcSimulator::run(1, [](QPlcSimulator &simulator) {
///     QPlcSimulatedRoad radio;
///     radio.delay = std::chrono::milliseconds(2);
///     radio.loss = 0.01;  // one frame of a hundred
///     simulator.setRoads(radio);
/// });
/// \endcode
///
/// Frames of one sender keep their order, unless \a reordering changes it. A control connection
/// loses nothing and keeps its order, like TCP: lost data are sent again and arrive later.
///
/// Times are 0 to 1 h. A simulator ends the program if a value is out of its range.
///
/// \threadsafe a value type: use it in the thread of the simulator
///
/// \ingroup test
struct QPlcSimulatedRoad
{
    std::chrono::nanoseconds delay{50'000};    ///< shortest time from end to end
    std::chrono::nanoseconds jitter{100'000};  ///< largest random addition to the delay
    double loss = 0.0;                         ///< share of the frames that are lost, 0 to 1
    double duplication = 0.0;                  ///< share of the frames that arrive twice, 0 to 1
    /// Share of the frames that others may overtake, 0 to 1.
    double reordering = 0.0;
    std::chrono::nanoseconds lateness{0};  ///< largest delay of those frames
    /// Frames over datagrams do not arrive, those over streams and control messages do, as behind
    /// some firewalls.
    bool dropsDatagrams = false;
    bool isCut = false;  ///< nothing arrives, and no end is told
};
