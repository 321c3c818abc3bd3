// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSecurity.h"

#include <QtCore/QString>

#include <optional>

namespace qplc {

/// Where a master is, and how a window proves there who it is, as people write it and windows
/// remember it. A value type.
///
/// ```
/// winch1:50000                                        as the whole program (--security)
/// winch1:50000?keys=/home/anna/south.ini              with a pre-shared key
/// winch1:50000?cert=anna.pem&key=anna.key&ca=ca.pem   with a certificate
/// winch1:50000?security=none                          without security
/// ```
struct PlantAddress
{
    QString master;                        // as QPlcUnderlyingProtocol::fromString() reads it
    std::optional<QPlcSecurity> security;  // none: that of the process

    /// "winch1:50000"; for people.
    static QString withoutSecurity(const QString &text);
    /// \param error  what is wrong, with the remedy; empty: nothing
    static PlantAddress fromString(const QString &text, QString *error);
};

}  // namespace qplc
