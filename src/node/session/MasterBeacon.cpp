// SPDX-License-Identifier: Apache-2.0
#include "MasterBeacon.h"

#include "node/Logging.h"
#include "realtime/Host.h"

#include <QtNetwork/QNetworkInterface>
#include <QtNetwork/QUdpSocket>

#include <algorithm>

namespace qplc {

namespace {

bool isAny(const QHostAddress &address)
{
    return address == QHostAddress(QHostAddress::Any) || address == QHostAddress(QHostAddress::AnyIPv4)
        || address == QHostAddress(QHostAddress::AnyIPv6);
}

bool hasAddress(const QNetworkInterface &network, const QHostAddress &address)
{
    const QList<QNetworkAddressEntry> entries = network.addressEntries();
    return std::any_of(entries.begin(), entries.end(),
                       [&](const QNetworkAddressEntry &entry) { return entry.ip() == address; });
}

/// Whether beacons of a master that listens on \a address go to \a network.
bool isReached(const QNetworkInterface &network, const QHostAddress &address)
{
    const QNetworkInterface::InterfaceFlags flags = network.flags();
    if (!flags.testFlag(QNetworkInterface::IsUp))
        return false;
    if (address.isLoopback())
        return flags.testFlag(QNetworkInterface::IsLoopBack);
    if (flags.testFlag(QNetworkInterface::IsLoopBack) || !flags.testFlag(QNetworkInterface::CanMulticast))
        return false;
    return isAny(address) || hasAddress(network, address);
}

}  // namespace

MasterBeacon::MasterBeacon()
{
    m_timer.setInterval(Interval);
    QObject::connect(&m_timer, &QTimer::timeout, &m_timer, [this] { send(); });
}

QString MasterBeacon::localAddress(const QHostAddress &address, quint16 port)
{
    const QHostAddress own = isAny(address) ? QHostAddress(QHostAddress::LocalHost) : address;
    const bool isIpv6 = own.protocol() == QAbstractSocket::IPv6Protocol;
    return (isIpv6 ? QStringLiteral("[%1]:%2") : QStringLiteral("%1:%2")).arg(own.toString()).arg(port);
}

void MasterBeacon::begin(const QHostAddress &address, const Beacon &beacon, bool isForNetwork)
{
    end();
    if (&Host::current() != &Host::machine())
        return;  // programs of the machine cannot reach it
    m_address = address;
    m_datagram = beacon.encoded();
    m_notice.post(localAddress(address, beacon.port).toLatin1() + '\n' + m_datagram);
    const bool isIpv6Alone = address.protocol() == QAbstractSocket::IPv6Protocol && !isAny(address);
    if (isForNetwork && isIpv6Alone && !address.isLoopback())
        qCWarning(lcMaster).noquote() << "no beacon from" << address.toString()
                                      << "- beacons travel over IPv4; listen on an IPv4 address, or give the address "
                                         "to those who connect";
    if (!isForNetwork || isIpv6Alone)
        return;
    m_timer.start();
    send();
}

void MasterBeacon::end()
{
    m_timer.stop();
    m_notice.withdraw();
}

/// A network that is away for a while is no news: the next datagram may get through. No router
/// forwards it: the TTL of multicast is 1 unless a program sets another one.
void MasterBeacon::send()
{
    const QList<QNetworkInterface> networks = QNetworkInterface::allInterfaces();
    for (const QNetworkInterface &network : networks) {
        if (!isReached(network, m_address))
            continue;
        QUdpSocket socket;
        if (!socket.bind(isAny(m_address) ? QHostAddress(QHostAddress::AnyIPv4) : m_address, 0))
            continue;
        socket.setMulticastInterface(network);
        socket.writeDatagram(m_datagram, QHostAddress(QLatin1String(Beacon::Group)), Beacon::GroupPort);
    }
}

}  // namespace qplc
