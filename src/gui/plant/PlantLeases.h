// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LeaseStatus.h"
#include "node/session/ControlClient.h"

#include <QtCore/QTimer>
#include <QtCore/QVector>

#include <optional>

namespace qplc {

/// The leases of one plant: what its master tells of them, and the sign of life while this window
/// holds one.
///
/// A window that hangs says nothing, and loses its leases after Timeout; one that is busy for a
/// second keeps them.
class PlantLeases : public QObject
{
    Q_OBJECT
public:
    static constexpr int Timeout = 1500;         // [ms] longest silence of this window
    static constexpr int HeartbeatPeriod = 200;  // [ms]

    /// "anna@lab", for people.
    static QString whoever();

    explicit PlantLeases(ControlClient &control, QObject *parent = nullptr);

    /// A connection begins. \param hasFeature  whether this master knows leases
    void begin(bool hasFeature);
    /// The connection is gone, and with it all that is known.
    void end();
    bool hasFeature() const { return m_hasFeature; }

    const QVector<LeaseStatus> &all() const { return m_leases; }
    std::optional<LeaseStatus> find(const QString &signal) const;

    /// A request for signals, by which the lease is known to be of this window.
    messages::TakeLease wish(const QStringList &signalNames) const;
    /// All leases, as the master tells them.
    void handle(const std::vector<messages::LeaseEntry> &entries);

Q_SIGNALS:
    void changed();

private:
    void setLeases(const QVector<LeaseStatus> &leases);

    ControlClient &m_control;
    QTimer m_heartbeat;
    QVector<LeaseStatus> m_leases;
    bool m_hasFeature = false;
    std::chrono::nanoseconds m_timeout{0};  // of leases of this connection, and of no other one
};

}  // namespace qplc
