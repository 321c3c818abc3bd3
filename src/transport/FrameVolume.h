// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace qplc {

/// What travels in one direction in one cycle.
struct FrameVolume
{
    std::size_t frames = 1;
    std::size_t bytes = 0;  // of all frames together
};

/// What travels in one cycle between a master and a node.
struct CycleVolume
{
    FrameVolume inputs;
    FrameVolume outputs;
};

}  // namespace qplc
