// SPDX-License-Identifier: Apache-2.0
#include "WindowSettings.h"

#include <QtCore/QCoreApplication>

namespace qplc {

namespace {

const QString ownOrganization = QStringLiteral("QtPLC");
const QString ownGroup = QStringLiteral("ControlCenter");

QString organization()
{
    const QString named = QCoreApplication::organizationName();
    return named.isEmpty() ? ownOrganization : named;
}

}  // namespace

WindowSettings::WindowSettings()
    : QSettings(QSettings::defaultFormat(), QSettings::UserScope, organization(), QCoreApplication::applicationName())
{
    setFallbacksEnabled(false);
    if (organizationName() != ownOrganization || childGroups().contains(ownGroup))
        return;
    const QSettings former(format(), scope(), QStringLiteral("Unknown Organization"), applicationName());
    for (const QString &key : former.allKeys()) {
        if (key.startsWith(ownGroup + QLatin1Char('/')))
            setValue(key, former.value(key));
    }
}

}  // namespace qplc
