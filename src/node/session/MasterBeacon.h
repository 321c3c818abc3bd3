// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/Beacon.h"
#include "transport/LocalNotice.h"

#include <QtCore/QTimer>
#include <QtNetwork/QHostAddress>

namespace qplc {

/// Tells where a master is: to programs of this machine and user by a notice, and, if wanted, to
/// the network by a datagram every 2 s. One way: nobody is listened to.
class MasterBeacon
{
public:
    static constexpr int Interval = 2000;  // [ms]

    MasterBeacon();

    /// \param address that the master listens on. Beacons go to the networks of this address: all
    ///         for Any, none beyond this machine for a loopback
    void begin(const QHostAddress &address, const Beacon &beacon, bool isForNetwork);
    void end();

    /// Where programs of this machine connect to, as in "127.0.0.1:50000".
    static QString localAddress(const QHostAddress &address, quint16 port);

private:
    void send();

    LocalNotice m_notice;
    QTimer m_timer;
    QHostAddress m_address;
    QByteArray m_datagram;
};

}  // namespace qplc
