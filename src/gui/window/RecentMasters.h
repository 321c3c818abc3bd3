// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QStringList>

namespace qplc {

/// Addresses of masters that a person connected to, newest first, at most eight; kept in the
/// QSettings of the application.
class RecentMasters
{
public:
    QStringList addresses() const;
    void add(const QString &address);
};

}  // namespace qplc
