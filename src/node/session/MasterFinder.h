// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/Beacon.h"
#include "realtime/TimeSource.h"

#include <QtCore/QObject>
#include <QtCore/QTimer>
#include <QtCore/QVector>
#include <QtNetwork/QHostAddress>

class QUdpSocket;

namespace qplc {

/// A master that somebody could connect to. What comes from a network is said by whoever wants to:
/// it is to be shown, and not to be trusted.
struct FoundMaster
{
    QString address;  // "192.168.1.5:50000"
    QString name;     // of at most 40 characters, all of them fit to be shown
    bool isLocal = false;
    bool isSecured = false;
    quint64 tableHash = 0;

    friend bool operator==(const FoundMaster &a, const FoundMaster &b)
    {
        return a.address == b.address && a.name == b.name && a.isLocal == b.isLocal && a.isSecured == b.isSecured
            && a.tableHash == b.tableHash;
    }
};

/// Looks for masters: on this machine by their notices, and on the networks by their beacons. Sends
/// nothing. It looks four times a second, at a bounded number of datagrams: a flood of them costs
/// no more.
class MasterFinder : public QObject
{
    Q_OBJECT
public:
    static constexpr int MostBeacons = 64;             // others are not seen until one of them goes
    static constexpr int DatagramsAtOnce = 128;        // in each look
    static constexpr qint64 Lifetime = 6'000'000'000;  // of a beacon [ns]

    /// \param clock  outlives the finder
    explicit MasterFinder(QObject *parent = nullptr, TimeSource &clock = TimeSource::monotonic());
    ~MasterFinder() override;

    /// Begins to look. Without multicast it finds the masters of this machine alone.
    void start();
    /// Forgets what was found.
    void stop();
    /// Those of this machine first.
    QVector<FoundMaster> masters() const { return m_masters; }
    /// What the timer does.
    void look();
    /// One datagram, as if it had come over the network.
    void handle(const char *bytes, int size, const QHostAddress &sender);

Q_SIGNALS:
    /// masters() are others than before.
    void changed();

private:
    struct Heard
    {
        Beacon beacon;
        QHostAddress sender;
        qint64 time;  // [ns]
    };
    void joinNetworks();
    void readDatagrams();
    void forgetSilent();
    bool isKnownHere(const Heard &heard, const QVector<FoundMaster> &local) const;
    QVector<FoundMaster> together(QVector<FoundMaster> local) const;

    TimeSource &m_clock;
    QTimer m_timer;
    QUdpSocket *m_socket = nullptr;
    int m_looks = 0;
    QVector<Heard> m_heard;
    QVector<FoundMaster> m_local;
    QList<QHostAddress> m_ownAddresses;
    QVector<FoundMaster> m_masters;
};

}  // namespace qplc
