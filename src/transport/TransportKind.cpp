// SPDX-License-Identifier: Apache-2.0
#include "TransportKind.h"

#include "QPlcUnderlyingProtocol.h"
#include "protocol/messages/Vocabulary.h"
#include "realtime/Host.h"

#include <QtNetwork/QHostInfo>

namespace qplc {

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

TransportKind::~TransportKind() = default;

bool TransportKind::isAtHand() const
{
    return isOfMachine() == (&Host::current() == &Host::machine());
}

bool TransportKind::readPlace(const QString &place, const QString &text, QHostAddress *address, quint16 *port,
                              QString *error) const
{
    constexpr quint16 usualPort = QPlcUnderlyingProtocol::DefaultPort;
    QString host;
    QString portText;
    if (!split(place, &host, &portText)) {
        *error = QStringLiteral("'%1' is not a valid address; write HOST:PORT, for example 127.0.0.1:%2")
                     .arg(text)
                     .arg(usualPort);
        return false;
    }
    bool isNumber = true;
    const uint number = portText.isEmpty() ? usualPort : portText.toUInt(&isNumber);
    if (!isNumber || number == 0 || number > 65535) {
        *error = QStringLiteral("'%1' is not a valid port; use 1 ... 65535").arg(portText);
        return false;
    }
    *port = quint16(number);
    *address = lookUp(host, error);
    return !address->isNull();
}

QString TransportKind::placeText(const QHostAddress &address, quint16 port) const
{
    const QString host = address.protocol() == QAbstractSocket::IPv6Protocol
        ? QStringLiteral("[%1]").arg(address.toString())
        : address.toString();
    return QStringLiteral("%1:%2").arg(host).arg(port);
}

std::unique_ptr<HubPeer> TransportKind::makePeer(const CyclicHub &, const Newcomer &, QJsonObject *,
                                                 ChannelError *error) const
{
    *error = {messages::errorWord::nodeError, QStringLiteral("'%1' cannot make a channel").arg(name())};
    return nullptr;
}

std::unique_ptr<ProbeAnswers> TransportKind::answerProbe(const CyclicHub &, const Newcomer &,
                                                         const ProbeNumbers &) const
{
    return nullptr;
}

std::unique_ptr<HubPeer> TransportKind::makeStreamPeer(int, const FrameCutter &, std::size_t) const
{
    return nullptr;
}

std::unique_ptr<HubPeer> TransportKind::makeGroupPeer(const CyclicHub &) const
{
    return nullptr;
}

bool TransportKind::beginLink(const ControlEnds &, QJsonObject *, std::unique_ptr<CyclicLink> *, QString *) const
{
    return true;
}

bool TransportKind::finishLink(const ControlEnds &, const QJsonObject &, std::unique_ptr<CyclicLink> *link,
                               QString *error) const
{
    if (!*link)
        *error = QStringLiteral("'%1' cannot make a link").arg(name());
    return *link != nullptr;
}

std::unique_ptr<CyclicLink> TransportKind::makeStreamLink(int, const FrameCutter &, std::size_t) const
{
    return nullptr;
}

}  // namespace qplc
