// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

/// How frames and control connections travel between two hosts of a QPlcSimulator, in one direction.
///
/// Frames of one sender keep their order, unless \a reordering disorders them. A control connection
/// loses nothing and keeps its order, as TCP does: what is lost there is sent again and comes later.
///
/// \code
/// QPlcSimulatedRoad radio;
/// radio.delay = std::chrono::milliseconds(2);
/// radio.loss = 0.01;  // one frame of a hundred
/// simulator.setRoads(radio);
/// \endcode
struct QPlcSimulatedRoad
{
    std::chrono::nanoseconds delay{50'000};    ///< shortest time from end to end
    std::chrono::nanoseconds jitter{100'000};  ///< at most this is added, by chance
    double loss = 0.0;                         ///< share of the frames that are lost, 0 ... 1
    double duplication = 0.0;                  ///< share of the frames that arrive twice, 0 ... 1
    double reordering = 0.0;                   ///< share of the frames that others may overtake, 0 ... 1
    std::chrono::nanoseconds lateness{0};      ///< by how much those are late at most
    bool isCut = false;                        ///< nothing arrives, and no end is told
};
