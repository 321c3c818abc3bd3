// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QObject>

#include <chrono>
#include <memory>

class QPlcMasterNode;
class QPlcSlaveNode;

/// Reports to systemd (Type=notify) that the program is ready and what it does, and feeds its
/// watchdog (WatchdogSec=) while cycles go on.
///
/// \code
/// QPlcMasterNode master;
/// QPlcServiceNotifier service(master);
/// if (!master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost)))
///     return 2;
/// service.setReady();
/// \endcode
///
/// QPlcNodeApplication does this for its node. Without a service manager nothing happens.
///
/// The watchdog is fed four times in its time, as long as the event loop of this object runs and no
/// cycle hangs:
/// - The code of a node over the network hangs when it computes the same cycle at two looks.
///   Missing frames are not a hang: QPlcSlaveNode::activateWatchdog() handles those.
/// - A master hangs when its cycles stop for longer than three periods in RealTime or SafeStop. In
///   lockstep, and while the master waits for a late node, time may stand still.
///
/// A service manager whose watchdog is not fed kills the program and starts it again if it is set
/// up to do so. safeState() of the node is not called then. Other nodes hold its outputs and then
/// use the safe values (QPlcQuality), but the devices of the killed node have to become safe by
/// themselves.
///
/// \threadsafe no: it belongs to the thread of the node, whose event loop it needs
///
/// \ingroup programs
class QTPLC_EXPORT QPlcServiceNotifier : public QObject
{
    Q_OBJECT
public:
    /// Reports about a node.
    /// \param node  outlives this object
    /// \param parent  owns this object, if given
    explicit QPlcServiceNotifier(QPlcSlaveNode &node, QObject *parent = nullptr);
    /// Reports about a master.
    /// \param master  outlives this object
    /// \param parent  owns this object, if given
    explicit QPlcServiceNotifier(QPlcMasterNode &master, QObject *parent = nullptr);
    /// Reports that the program ends as wanted (STOPPING=1).
    ~QPlcServiceNotifier() override;

    /// Returns true if a service manager has started this program and wants reports
    /// ($NOTIFY_SOCKET).
    bool isWanted() const;
    /// Returns the time of the watchdog ($WATCHDOG_USEC); 0: there is none for this process.
    std::chrono::microseconds watchdogTime() const;

public Q_SLOTS:
    /// Reports that the program is ready: units that are ordered after it may start. Further calls
    /// do nothing.
    void setReady();
    /// Checks whether cycles go on, feeds the watchdog if they do, and reports the state. A timer
    /// calls this; calls must be further apart than a cycle takes.
    void look();

private:
    struct Q_DECL_HIDDEN Private;
    Q_DECL_HIDDEN explicit QPlcServiceNotifier(std::unique_ptr<Private> data, QObject *parent);
    std::unique_ptr<Private> d;
};
