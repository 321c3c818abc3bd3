// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>

/// Fields of a struct, in order.
///
/// A std::tuple holds the same. To make one costs a compiler so much that a file with all messages
/// took twice as long.
namespace qplc::messages {

template<std::size_t index, typename Field>
struct FieldAt
{
    Field field;
};

template<typename Indexes, typename... Fields>
struct FieldList;
template<std::size_t... indexes, typename... Fields>
struct FieldList<std::index_sequence<indexes...>, Fields...> : FieldAt<indexes, Fields>...
{
    /// Calls \a visitor once, with all fields.
    template<typename Visitor>
    constexpr decltype(auto) visit(const Visitor &visitor) const
    {
        return visitor(FieldAt<indexes, Fields>::field...);
    }
    /// Calls \a visitor with each field.
    template<typename Visitor>
    constexpr void forEach(const Visitor &visitor) const
    {
        (visitor(FieldAt<indexes, Fields>::field), ...);
    }
};

template<typename... Fields>
constexpr FieldList<std::index_sequence_for<Fields...>, Fields...> fieldList(Fields... fields)
{
    return {{fields}...};
}

/// The fields of \a first, then those of \a second.
template<typename First, typename Second>
constexpr auto joined(const First &first, const Second &second)
{
    return first.visit([&second](const auto &...before) {
        return second.visit([&before...](const auto &...after) { return fieldList(before..., after...); });
    });
}

}  // namespace qplc::messages
