// SPDX-License-Identifier: Apache-2.0
#include "Role.h"

namespace qplc {

QString roleName(Role role)
{
    switch (role) {
    case Role::Observer:
        return QStringLiteral("Observer");
    case Role::Operator:
        return QStringLiteral("Operator");
    case Role::Node:
        return QStringLiteral("Node");
    case Role::Engineer:
        return QStringLiteral("Engineer");
    }
    return {};
}

std::optional<Role> roleOf(const QString &name)
{
    for (Role role : allRoles) {
        if (name == roleName(role))
            return role;
    }
    return std::nullopt;
}

}  // namespace qplc
