// SPDX-License-Identifier: Apache-2.0
#include "QPlcUnderlyingProtocol.h"

#include "LocalName.h"

#include <QtNetwork/QHostInfo>

namespace {

QHostAddress lookUp(const QString &host, QString *error)
{
    if (host.compare(QLatin1String("localhost"), Qt::CaseInsensitive) == 0)
        return QHostAddress(QHostAddress::LocalHost);
    QHostAddress address;
    if (address.setAddress(host))
        return address;
    const QHostInfo info = QHostInfo::fromName(host);
    if (!info.addresses().isEmpty())
        return info.addresses().constFirst();
    *error = QStringLiteral("unknown host '%1': %2; give a name that resolves, or an IP address")
                 .arg(host, info.errorString());
    return {};
}

/// Splits "HOST:PORT", "HOST", "[IPV6]:PORT"; an empty port text when there is none.
bool split(const QString &text, QString *host, QString *port)
{
    if (text.startsWith(QLatin1Char('['))) {
        const int end = text.indexOf(QLatin1Char(']'));
        *host = text.mid(1, end - 1);
        *port = text.mid(end + 2);
        return end > 1 && (text.size() == end + 1 || (text.at(end + 1) == QLatin1Char(':') && !port->isEmpty()));
    }
    const int colon = text.indexOf(QLatin1Char(':'));
    const bool isIpv6 = text.count(QLatin1Char(':')) > 1;
    *host = colon < 0 || isIpv6 ? text : text.left(colon);
    *port = colon < 0 || isIpv6 ? QString() : text.mid(colon + 1);
    return (colon < 0 || isIpv6 || !port->isEmpty()) && !host->isEmpty();
}

}  // namespace

QPlcUnderlyingProtocol QPlcUnderlyingProtocol::local(const QString &name, QString *error)
{
    bool isNumber = false;
    quint16 port = name.toUShort(&isNumber);
    QString ignored;
    if (!isNumber)
        port = qplc::LocalName::portOf(name, error ? error : &ignored);
    else if (port == 0 && error)
        *error = QStringLiteral("'%1' is no port; use 1 ... 65535").arg(name);
    return port == 0 ? QPlcUnderlyingProtocol() : QPlcUnderlyingProtocol(Local, QHostAddress::LocalHost, port);
}

QPlcUnderlyingProtocol QPlcUnderlyingProtocol::fromString(const QString &text, Kind kind, QString *error)
{
    QString ignored;
    QString &reason = error ? *error : ignored;
    QString rest = text.trimmed();
    for (const Kind named : {Tcp, Udp, UdpMulticast}) {
        const QString scheme = QPlcUnderlyingProtocol(named, {}, 0).kindName() + QStringLiteral("://");
        if (rest.startsWith(scheme)) {
            kind = named;
            rest.remove(0, scheme.size());
        }
    }
    if (rest.startsWith(QLatin1String("local://"))) {
        rest.remove(0, 8);
        for (const QLatin1String host : {QLatin1String("127.0.0.1:"), QLatin1String("localhost:")})
            rest.remove(0, rest.startsWith(host) ? host.size() : 0);
        return local(rest, &reason);
    }
    const int schemeEnd = rest.indexOf(QLatin1String("://"));
    if (schemeEnd >= 0) {
        reason = QStringLiteral("unknown transport '%1'; use tcp://, udp://, udp-multicast:// or local://")
                     .arg(rest.left(schemeEnd + 3));
        return {};
    }
    QString host;
    QString portText;
    if (!split(rest, &host, &portText)) {
        reason = QStringLiteral("'%1' is no address; write HOST:PORT, for example 127.0.0.1:%2")
                     .arg(text)
                     .arg(DefaultPort);
        return {};
    }
    bool isNumber = true;
    const uint port = portText.isEmpty() ? DefaultPort : portText.toUInt(&isNumber);
    if (!isNumber || port == 0 || port > 65535) {
        reason = QStringLiteral("'%1' is no port; use 1 ... 65535").arg(portText);
        return {};
    }
    const QHostAddress address = lookUp(host, &reason);
    return address.isNull() ? QPlcUnderlyingProtocol() : QPlcUnderlyingProtocol(kind, address, quint16(port));
}

QString QPlcUnderlyingProtocol::kindName() const
{
    switch (m_kind) {
    case Tcp:
        return QStringLiteral("tcp");
    case Udp:
        return QStringLiteral("udp");
    case UdpMulticast:
        return QStringLiteral("udp-multicast");
    case Local:
        return QStringLiteral("local");
    case Invalid:
        break;
    }
    return QStringLiteral("invalid");
}

QString QPlcUnderlyingProtocol::toString() const
{
    if (m_kind == Local)
        return QStringLiteral("local://%1").arg(m_port);
    const QString host = m_address.protocol() == QAbstractSocket::IPv6Protocol
        ? QStringLiteral("[%1]").arg(m_address.toString())
        : m_address.toString();
    return QStringLiteral("%1://%2:%3").arg(kindName(), host).arg(m_port);
}
