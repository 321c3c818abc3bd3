// SPDX-License-Identifier: Apache-2.0
#include "ModbusPlan.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace qplc {

namespace {

struct PlanLimits
{
    int bits;
    int registers;
    int gap;
};

std::vector<std::size_t> inOrderOfPlace(const std::vector<ModbusRegister> &registers)
{
    std::vector<std::size_t> order(registers.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    const auto place = [&registers](std::size_t i) {
        const ModbusRegister &entry = registers[i];
        return std::make_tuple(entry.unit, entry.space, entry.address, i);
    };
    std::sort(order.begin(), order.end(), [&place](std::size_t a, std::size_t b) { return place(a) < place(b); });
    return order;
}

/// Extends the request by a register behind it, if that is near enough and there is room.
bool extend(ModbusRequest *request, const ModbusRegister &next, const PlanLimits &limits)
{
    const int end = request->first + request->count;
    if (next.unit != request->unit || next.space != request->space || next.address > end + limits.gap)
        return false;
    const int count = std::max(end, next.address + next.size()) - request->first;
    if (count > (next.isOfBits() ? limits.bits : limits.registers))
        return false;
    request->count = count;
    return true;
}

std::vector<ModbusBlock> plan(const std::vector<ModbusRegister> &registers, const PlanLimits &limits)
{
    std::vector<ModbusBlock> blocks;
    for (std::size_t i : inOrderOfPlace(registers)) {
        const ModbusRegister &entry = registers[i];
        if (blocks.empty() || !extend(&blocks.back().request, entry, limits))
            blocks.push_back({{entry.unit, entry.space, entry.address, entry.size(), false}, {}});
        blocks.back().members.push_back(i);
    }
    return blocks;
}

}  // namespace

std::vector<ModbusBlock> planToRead(const std::vector<ModbusRegister> &registers, int gap)
{
    return plan(registers, {ModbusRequest::MostBitsRead, ModbusRequest::MostRegistersRead, gap});
}

std::vector<ModbusBlock> planToWrite(const std::vector<ModbusRegister> &registers)
{
    return plan(registers, {ModbusRequest::MostBitsWritten, ModbusRequest::MostRegistersWritten, 0});
}

bool overlap(const ModbusRegister &a, const ModbusRegister &b)
{
    if (a.isPart() && b.isPart() && (a.mask() & b.mask()) == 0)
        return false;
    return a.unit == b.unit && a.space == b.space && a.address < b.address + b.size()
        && b.address < a.address + a.size();
}

}  // namespace qplc
