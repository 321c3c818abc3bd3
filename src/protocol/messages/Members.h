// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FieldList.h"

#include <initializer_list>
#include <string_view>
#include <type_traits>
#include <utility>

/// Compares the members of a struct with the fields that describe them.
namespace qplc::messages {

/// A stand-in for the value of any member. Never made: the compiler only looks whether it fits.
struct AnyMember
{
    template<typename Member>
    operator Member() const;  // NOLINT(google-explicit-constructor): it stands where a member is initialized
};
template<std::size_t>
using AnyMemberAt = AnyMember;

template<typename Struct, typename Indexes, typename = void>
struct TakesMembers : std::false_type
{
};
// A std::optional takes any value by itself: g++ warns that it does not use our conversion.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
template<typename Struct, std::size_t... Indexes>
struct TakesMembers<Struct, std::index_sequence<Indexes...>, std::void_t<decltype(Struct{AnyMemberAt<Indexes>()...})>>
    : std::true_type
{
};
#pragma GCC diagnostic pop

/// Whether \a Struct has \a count members; each of its bases counts as one.
template<typename Struct, std::size_t count>
constexpr bool hasMembers = TakesMembers<Struct, std::make_index_sequence<count>>::value
    && !TakesMembers<Struct, std::make_index_sequence<count + 1>>::value;

/// How many of \a Fields are members of \a Owner itself.
template<typename Owner, typename... Fields>
constexpr std::size_t countOf = (std::size_t(std::is_same_v<Owner, typename Fields::Struct>) + ... + std::size_t(0));

/// Whether \a Fields of \a Struct describe all members of \a Owner: of the struct, or of its base.
template<typename Struct, typename Owner, typename... Fields>
constexpr bool areMembersOf()
{
    constexpr std::size_t own = countOf<Owner, Fields...>;
    constexpr bool hasBase = std::is_same_v<Struct, Owner> && own < sizeof...(Fields);
    return hasMembers<Owner, own + std::size_t(hasBase)>;
}

/// Whether a list of fields describes all members of \a Struct, and of its base if it names any of
/// them.
template<typename Struct, typename Indexes, typename... Fields>
constexpr bool areAllMembers(const FieldList<Indexes, Fields...> *)
{
    return areMembersOf<Struct, Struct, Fields...>()
        && (areMembersOf<Struct, typename Fields::Struct, Fields...>() && ...);
}

template<typename First, typename Second>
constexpr bool isSameMember([[maybe_unused]] First first, [[maybe_unused]] Second second)
{
    if constexpr (std::is_same_v<First, Second>)
        return first == second;
    else
        return false;
}

constexpr bool areDistinctMembers()
{
    return true;
}
template<typename First, typename... Others>
constexpr bool areDistinctMembers([[maybe_unused]] First first, Others... others)
{
    return !(isSameMember(first, others) || ...) && areDistinctMembers(others...);
}

constexpr bool areDistinctNames(std::initializer_list<std::string_view> names)
{
    for (const std::string_view *first = names.begin(); first != names.end(); ++first) {
        for (const std::string_view *other = first + 1; other != names.end(); ++other) {
            if (*first == *other)
                return false;
        }
    }
    return true;
}

/// Whether a list has one field for each of its members, with a name of its own.
template<typename... Fields>
constexpr bool isEachOnce(const FieldList<Fields...> &fields)
{
    return fields.visit(
        [](const auto &...each) { return areDistinctNames({each.name...}) && areDistinctMembers(each.member...); });
}

}  // namespace qplc::messages
