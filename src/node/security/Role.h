// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <optional>

namespace qplc {

/// What an identity is in a plant.
enum class Role : quint8 {
    Observer,  ///< looks
    Operator,  ///< looks, starts, stops, sets values
    Node,      ///< takes part in the cycle
    Engineer   ///< may do everything
};
constexpr Role allRoles[] = {Role::Observer, Role::Operator, Role::Node, Role::Engineer};

QString roleName(Role role);
/// Nothing when no role has this name.
std::optional<Role> roleOf(const QString &name);

/// A set of roles.
class Roles
{
public:
    constexpr Roles() = default;
    constexpr Roles(Role role)  // NOLINT(google-explicit-constructor): a role is a set of one
        : m_bits(quint8(1U << unsigned(role)))
    {
    }
    constexpr bool contains(Role role) const { return (m_bits & (1U << unsigned(role))) != 0; }
    constexpr bool isEmpty() const { return m_bits == 0; }
    friend constexpr Roles operator|(Roles a, Roles b)
    {
        Roles both;
        both.m_bits = quint8(a.m_bits | b.m_bits);
        return both;
    }

private:
    quint8 m_bits = 0;
};

}  // namespace qplc
