// SPDX-License-Identifier: Apache-2.0
#include "TemporaryValues.h"

#include <algorithm>

namespace qplc {

void TemporaryValues::set(Owner owner, const SignalSetting &setting, const QPlcValue &ground, std::int64_t deadline)
{
    const auto [place, isFirst] = m_stacks.try_emplace(setting.signal);
    if (isFirst)
        place->second.ground = ground;
    std::vector<Layer> &layers = place->second.layers;
    layers.erase(
        std::remove_if(layers.begin(), layers.end(), [owner](const Layer &layer) { return layer.owner == owner; }),
        layers.end());
    layers.push_back({owner, setting.value, deadline});
}

std::vector<QPlcSignalIndex> TemporaryValues::signalIndices() const
{
    std::vector<QPlcSignalIndex> indices;
    for (const auto &stack : m_stacks)
        indices.push_back(stack.first);
    return indices;
}

std::optional<std::int64_t> TemporaryValues::nextDeadline() const
{
    std::optional<std::int64_t> next;
    for (const auto &stack : m_stacks) {
        for (const Layer &layer : stack.second.layers)
            next = next ? std::min(*next, layer.deadline) : layer.deadline;
    }
    return next;
}

std::vector<SignalSetting> TemporaryValues::endDue(std::int64_t now)
{
    return end([now](const Layer &layer) { return layer.deadline <= now; });
}

std::vector<SignalSetting> TemporaryValues::endAllOf(Owner owner)
{
    return end([owner](const Layer &layer) { return layer.owner == owner; });
}

/// A layer below another one ends without a trace; what is below the upper one comes back with it.
template<typename Predicate>
std::vector<SignalSetting> TemporaryValues::end(Predicate ends)
{
    std::vector<SignalSetting> returning;
    for (auto stack = m_stacks.begin(); stack != m_stacks.end();) {
        std::vector<Layer> &layers = stack->second.layers;
        const bool isSeen = ends(layers.back());
        layers.erase(std::remove_if(layers.begin(), layers.end(), ends), layers.end());
        if (isSeen)
            returning.push_back({stack->first, layers.empty() ? stack->second.ground : layers.back().value});
        stack = layers.empty() ? m_stacks.erase(stack) : std::next(stack);
    }
    return returning;
}

}  // namespace qplc
