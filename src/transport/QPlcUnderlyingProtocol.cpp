// SPDX-License-Identifier: Apache-2.0
#include "QPlcUnderlyingProtocol.h"

#include "TransportRegistry.h"

using qplc::TransportKind;
using qplc::TransportRegistry;

QPlcUnderlyingProtocol QPlcUnderlyingProtocol::local(const QString &name, QString *error)
{
    return fromString(QStringLiteral("local://") + name, Local, error);
}

QPlcUnderlyingProtocol QPlcUnderlyingProtocol::fromString(const QString &text, Kind kind, QString *error)
{
    const TransportRegistry &registry = TransportRegistry::instance();
    QString ignored;
    QString &reason = error ? *error : ignored;
    QString place = text.trimmed();
    int number = kind;
    if (const int schemeEnd = place.indexOf(QLatin1String("://")); schemeEnd >= 0) {
        number = registry.numberOf(place.left(schemeEnd));
        if (number == 0) {
            reason = QStringLiteral("unknown transport '%1'; use %2")
                         .arg(place.left(schemeEnd + 3), registry.namesText(QStringLiteral("://")));
            return {};
        }
        place.remove(0, schemeEnd + 3);
    }
    const TransportKind *transport = registry.at(number);
    QHostAddress address;
    quint16 port = 0;
    if (!transport || !transport->readPlace(place, text, &address, &port, &reason))
        return {};
    return {Kind(number), address, port};
}

QString QPlcUnderlyingProtocol::kindName() const
{
    const TransportKind *transport = TransportRegistry::instance().at(m_kind);
    return transport ? transport->name() : QStringLiteral("invalid");
}

QString QPlcUnderlyingProtocol::toString() const
{
    const TransportKind *transport = TransportRegistry::instance().at(m_kind);
    if (!transport)
        return QStringLiteral("invalid");
    const QString scheme = m_kind == Automatic ? QString() : transport->name() + QStringLiteral("://");
    return scheme + transport->placeText(m_address, m_port);
}
