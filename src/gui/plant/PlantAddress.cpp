// SPDX-License-Identifier: Apache-2.0
#include "PlantAddress.h"

#include <QtCore/QStringList>
#include <QtCore/QUrlQuery>

namespace qplc {

namespace {

const QString securityKey = QStringLiteral("security");
const QString keysKey = QStringLiteral("keys");
const QString identityKey = QStringLiteral("identity");
const QString certificateKey = QStringLiteral("cert");
const QString privateKeyKey = QStringLiteral("key");
const QString authorityKey = QStringLiteral("ca");

}  // namespace

QString PlantAddress::withoutSecurity(const QString &text)
{
    return text.section(QLatin1Char('?'), 0, 0).trimmed();
}

PlantAddress PlantAddress::fromString(const QString &text, QString *error)
{
    error->clear();
    PlantAddress address;
    address.master = withoutSecurity(text);
    const QString query = text.section(QLatin1Char('?'), 1);
    if (query.isEmpty())
        return address;
    const QUrlQuery parts(query);
    const auto valueOf = [&parts](const QString &key) { return parts.queryItemValue(key, QUrl::FullyDecoded); };
    const QStringList known{securityKey, keysKey, identityKey, certificateKey, privateKeyKey, authorityKey};
    for (const auto &[key, value] : parts.queryItems()) {
        if (!known.contains(key) || value.isEmpty()) {
            *error = QStringLiteral("'%1' in the address '%2' is not a valid option; use ?security=none, ?keys=FILE or "
                                    "?cert=FILE&key=FILE&ca=FILE")
                         .arg(key, text);
            return address;
        }
    }
    if (parts.hasQueryItem(keysKey))
        address.security = QPlcSecurity::preSharedKeys(valueOf(keysKey), valueOf(identityKey));
    else if (parts.hasQueryItem(certificateKey))
        address.security
            = QPlcSecurity::certificates(valueOf(certificateKey), valueOf(privateKeyKey), valueOf(authorityKey));
    else if (valueOf(securityKey) == QLatin1String("none"))
        address.security = QPlcSecurity();
    else
        *error = QStringLiteral("the address '%1' does not say how to connect; use ?security=none, ?keys=FILE or "
                                "?cert=FILE&key=FILE&ca=FILE")
                     .arg(text);
    return address;
}

}  // namespace qplc
