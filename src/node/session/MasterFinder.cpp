// SPDX-License-Identifier: Apache-2.0
#include "MasterFinder.h"

#include "MasterBeacon.h"
#include "node/Logging.h"
#include "transport/LocalNotice.h"

#include <QtNetwork/QNetworkInterface>
#include <QtNetwork/QUdpSocket>

#include <algorithm>
#include <tuple>

namespace qplc {

namespace {

constexpr int pause = 250;          // between two looks [ms]
constexpr int looksForNotices = 4;  // so many looks from one reading of the notices to the next
constexpr int looksForNetworks = 20;

/// A name that somebody has sent, as a short line.
QString shown(const QString &name)
{
    constexpr int most = 40;
    const QString text = printable(name.simplified());
    if (text.size() <= most)
        return text;
    const int cut = text.at(most - 2).isHighSurrogate() ? most - 2 : most - 1;
    return text.left(cut) + QChar(0x2026);
}

FoundMaster foundMaster(const Beacon &beacon, const QString &address, bool isLocal)
{
    return {address, shown(beacon.name), isLocal, beacon.isSecured, beacon.tableHash};
}

bool isAddress(const QByteArray &text)
{
    const int colon = text.lastIndexOf(':');
    QByteArray host = text.left(colon);
    if (host.startsWith('[') && host.endsWith(']'))
        host = host.mid(1, host.size() - 2);
    return colon > 0 && !QHostAddress(QString::fromLatin1(host)).isNull();
}

/// Masters of this machine and user.
QVector<FoundMaster> readNotices()
{
    QVector<FoundMaster> masters;
    for (const QByteArray &notice : LocalNotice::all()) {
        const int end = notice.indexOf('\n');
        const QByteArray address = notice.left(end);
        const auto beacon = Beacon::decode(notice.constData() + end + 1, notice.size() - end - 1);
        if (end > 0 && beacon && isAddress(address))
            masters.append(foundMaster(*beacon, QString::fromLatin1(address), true));
    }
    return masters;
}

}  // namespace

MasterFinder::MasterFinder(QObject *parent, TimeSource &clock)
    : QObject(parent)
    , m_clock(clock)
{
    m_timer.setInterval(pause);
    connect(&m_timer, &QTimer::timeout, this, &MasterFinder::look);
}

MasterFinder::~MasterFinder() = default;

void MasterFinder::start()
{
    if (m_timer.isActive())
        return;
    m_socket = new QUdpSocket(this);
    // Bound to the group: datagrams that are sent to this machine alone are not heard.
    m_socket->bind(QHostAddress(QLatin1String(Beacon::Group)), Beacon::GroupPort,
                   QUdpSocket::ShareAddress | QUdpSocket::ReuseAddressHint);
    m_looks = 0;
    m_timer.start();
    look();
}

void MasterFinder::stop()
{
    m_timer.stop();
    delete m_socket;
    m_socket = nullptr;
    m_heard.clear();
    m_local.clear();
    m_masters.clear();
}

/// Again and again, because networks come and go; one that was joined before stays so.
void MasterFinder::joinNetworks()
{
    m_ownAddresses.clear();
    const bool isBound = m_socket->state() == QAbstractSocket::BoundState;
    const QList<QNetworkInterface> networks = QNetworkInterface::allInterfaces();
    for (const QNetworkInterface &network : networks) {
        if (!network.flags().testFlag(QNetworkInterface::IsUp))
            continue;
        for (const QNetworkAddressEntry &entry : network.addressEntries())
            m_ownAddresses.append(entry.ip());
        if (isBound)
            m_socket->joinMulticastGroup(QHostAddress(QLatin1String(Beacon::Group)), network);
    }
}

void MasterFinder::readDatagrams()
{
    if (m_socket->state() != QAbstractSocket::BoundState)
        return;                           // no multicast here
    char bytes[Beacon::MaximumSize + 1];  // one that is longer is none of ours
    QHostAddress sender;
    for (int left = DatagramsAtOnce; left > 0 && m_socket->hasPendingDatagrams(); --left) {
        const qint64 size = m_socket->readDatagram(bytes, sizeof bytes, &sender);
        handle(bytes, int(size), sender);
    }
}

void MasterFinder::handle(const char *bytes, int size, const QHostAddress &sender)
{
    const auto beacon = Beacon::decode(bytes, size);
    if (!beacon || sender.protocol() != QAbstractSocket::IPv4Protocol)
        return;
    const qint64 now = m_clock.now();
    const auto known = std::find_if(m_heard.begin(), m_heard.end(), [&](const Heard &heard) {
        return heard.sender == sender && heard.beacon.port == beacon->port;
    });
    if (known != m_heard.end())
        *known = {*beacon, sender, now};
    else if (m_heard.size() < MostBeacons)
        m_heard.append({*beacon, sender, now});
}

void MasterFinder::forgetSilent()
{
    const qint64 now = m_clock.now();
    m_heard.erase(std::remove_if(m_heard.begin(), m_heard.end(),
                                 [now](const Heard &heard) { return now - heard.time > Lifetime; }),
                  m_heard.end());
}

/// A master of this machine that is heard over the network, too.
bool MasterFinder::isKnownHere(const Heard &heard, const QVector<FoundMaster> &local) const
{
    if (!heard.sender.isLoopback() && !m_ownAddresses.contains(heard.sender))
        return false;
    const QString end = QLatin1Char(':') + QString::number(heard.beacon.port);
    return std::any_of(local.begin(), local.end(),
                       [&](const FoundMaster &master) { return master.address.endsWith(end); });
}

QVector<FoundMaster> MasterFinder::together(QVector<FoundMaster> local) const
{
    QVector<FoundMaster> others;
    for (const Heard &heard : m_heard) {
        if (!isKnownHere(heard, local))
            others.append(
                foundMaster(heard.beacon, MasterBeacon::localAddress(heard.sender, heard.beacon.port), false));
    }
    const auto isBefore = [](const FoundMaster &a, const FoundMaster &b) {
        return std::tie(a.name, a.address) < std::tie(b.name, b.address);
    };
    std::sort(local.begin(), local.end(), isBefore);
    std::sort(others.begin(), others.end(), isBefore);
    return local + others;
}

void MasterFinder::look()
{
    if (m_socket) {
        if (m_looks % looksForNetworks == 0)
            joinNetworks();
        if (m_looks++ % looksForNotices == 0)
            m_local = readNotices();
        readDatagrams();
    }
    forgetSilent();
    const QVector<FoundMaster> masters = together(m_local);
    if (masters == m_masters)
        return;
    m_masters = masters;
    Q_EMIT changed();
}

}  // namespace qplc
