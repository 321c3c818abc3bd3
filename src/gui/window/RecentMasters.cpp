// SPDX-License-Identifier: Apache-2.0
#include "RecentMasters.h"

#include "WindowSettings.h"

namespace qplc {

namespace {

constexpr int most = 8;

QString key()
{
    return QStringLiteral("ControlCenter/recentMasters");
}

}  // namespace

QStringList RecentMasters::addresses() const
{
    return WindowSettings().value(key()).toStringList().mid(0, most);
}

void RecentMasters::add(const QString &address)
{
    QStringList all = addresses();
    all.removeAll(address);
    all.prepend(address);
    WindowSettings().setValue(key(), QStringList(all.mid(0, most)));
}

}  // namespace qplc
