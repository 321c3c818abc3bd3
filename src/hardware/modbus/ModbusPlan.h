// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ModbusLink.h"

#include <vector>

namespace qplc {

/// A request, and which values it carries.
struct ModbusBlock
{
    ModbusRequest request;
    std::vector<std::size_t> members;  // indices of registers
};

/// The fewest requests that read these registers. \param gap how many bits or registers that nobody
/// wants may be read between two that are wanted
std::vector<ModbusBlock> planToRead(const std::vector<ModbusRegister> &registers, int gap);
/// The fewest requests that write these registers, and nothing else. \pre none of them overlap
std::vector<ModbusBlock> planToWrite(const std::vector<ModbusRegister> &registers);
/// Whether they share a bit or a register of a device; parts of a register share it only if they
/// have bits in common.
bool overlap(const ModbusRegister &a, const ModbusRegister &b);

}  // namespace qplc
