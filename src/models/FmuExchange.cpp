// SPDX-License-Identifier: Apache-2.0
#include "FmuExchange.h"

#include <algorithm>
#include <cstring>

namespace qplc {

FmuExchange::Place FmuExchange::add(const FmuVariable &variable)
{
    Q_ASSERT(variable.isNumber());
    const bool isDiscrete = m_splitsDiscrete && variable.variability != FmuVariable::Continuous;
    auto group = std::find_if(m_groups.begin(), m_groups.end(), [&](const Group &other) {
        return other.kind == variable.kind && other.isDiscrete == isDiscrete;
    });
    if (group == m_groups.end()) {
        m_groups.emplace_back();
        group = std::prev(m_groups.end());
        group->kind = variable.kind;
        group->isDiscrete = isDiscrete;
    }
    const int number = int(std::distance(m_groups.begin(), group));
    const auto known = std::find(group->references.begin(), group->references.end(), variable.reference);
    if (known != group->references.end())
        return {number, group->offsets[std::size_t(std::distance(group->references.begin(), known))]};
    const Place place{number, group->size};
    group->references.push_back(variable.reference);
    group->offsets.push_back(group->size);
    group->count += std::size_t(variable.count);
    group->size += std::size_t(variable.count) * std::size_t(QPlcSignalType(variable.scalar(m_version)).elementSize());
    group->values.resize(group->size / sizeof(double) + 1);
    if (isDiscrete)
        group->last.resize(group->size);
    return place;
}

int FmuExchange::get(FmuInstance &instance) noexcept
{
    int worst = fmi::Ok;
    for (Group &group : m_groups) {
        const int status = instance.get(group.kind, group.references.data(), group.references.size(),
                                        group.values.data(), group.count);
        worst = std::max(worst, status);
    }
    return worst > fmi::Warning ? worst : int(fmi::Ok);
}

int FmuExchange::set(FmuInstance &instance, bool discrete) noexcept
{
    int worst = fmi::Ok;
    for (Group &group : m_groups) {
        if (group.isDiscrete && !discrete)
            continue;
        const int status = instance.set(group.kind, group.references.data(), group.references.size(),
                                        group.values.data(), group.count);
        worst = std::max(worst, status);
        if (group.isDiscrete)
            std::memcpy(group.last.data(), group.bytes(), group.size);
    }
    return worst > fmi::Warning ? worst : int(fmi::Ok);
}

bool FmuExchange::hasDiscreteChange() const noexcept
{
    return std::any_of(m_groups.begin(), m_groups.end(), [](const Group &group) {
        return group.isDiscrete && std::memcmp(group.last.data(), group.bytes(), group.size) != 0;
    });
}

}  // namespace qplc
