// SPDX-License-Identifier: Apache-2.0
#include "AddressResolver.h"

#include <QtNetwork/QHostInfo>

namespace qplc {

namespace {

QString withoutScheme(const QString &address)
{
    const int scheme = address.indexOf(QLatin1String("://"));
    return scheme < 0 ? address : address.mid(scheme + 3);
}

}  // namespace

AddressResolver::~AddressResolver()
{
    cancel();
}

QString AddressResolver::hostToLookUp(const QString &address)
{
    const QString trimmed = address.trimmed();
    if (trimmed.startsWith(QLatin1String("local://")) || withoutScheme(trimmed).startsWith(QLatin1Char('[')))
        return {};
    const QString host = withoutScheme(trimmed).section(QLatin1Char(':'), 0, 0);
    return host == QLatin1String("localhost") || !QHostAddress(host).isNull() ? QString() : host;
}

void AddressResolver::cancel()
{
    if (m_lookup >= 0)
        QHostInfo::abortHostLookup(m_lookup);
    m_lookup = -1;
}

void AddressResolver::resolve(const QString &address)
{
    cancel();
    const QString host = hostToLookUp(address);
    if (host.isEmpty()) {
        parse(address);
        return;
    }
    m_lookup = QHostInfo::lookupHost(host, this, [this, address, host](const QHostInfo &info) {
        m_lookup = -1;
        if (info.addresses().isEmpty()) {
            Q_EMIT failed(QStringLiteral("host '%1' is unknown: %2").arg(host, info.errorString()));
            return;
        }
        const QHostAddress found = info.addresses().constFirst();
        const QString number = found.protocol() == QAbstractSocket::IPv6Protocol
            ? QStringLiteral("[%1]").arg(found.toString())
            : found.toString();
        const QString rest = withoutScheme(address.trimmed());
        parse(address.trimmed().chopped(rest.size()) + number + rest.mid(host.size()));
    });
}

void AddressResolver::parse(const QString &address)
{
    QString error;
    const QPlcUnderlyingProtocol master
        = QPlcUnderlyingProtocol::fromString(address, QPlcUnderlyingProtocol::Automatic, &error);
    if (master.isValid())
        Q_EMIT resolved(master);
    else
        Q_EMIT failed(error);
}

}  // namespace qplc
