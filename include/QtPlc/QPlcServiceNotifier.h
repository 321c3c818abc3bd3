// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QObject>

#include <chrono>
#include <memory>

class QPlcMasterNode;
class QPlcSlaveNode;

/// Tells the service manager that started this program (systemd, with Type=notify) that the program is up, and what it does; and feeds its watchdog (WatchdogSec=) from the cycle.
///
/// ```cpp
/// QPlcMasterNode master;
/// QPlcServiceNotifier service(master);
/// if (!master.startServer(protocol))
///     return 2;
/// service.setReady();
/// ```
///
/// QPlcNodeApplication does so for its node. Without a service manager nothing happens.
///
/// The watchdog is fed four times in its time, as long as the event loop of this object lives, and no cycle hangs:
/// - the code of a node over the network that computes one and the same cycle at two looks hangs. Frames that do not come are no hang: that is the business of QPlcSlaveNode::activateWatchdog();
/// - cycles of a master that do not follow each other for longer than three periods hang, in RealTime and SafeStop. In lockstep, and while the master waits for a late node, time may stand still.
///
/// A service manager whose watchdog is not fed kills the program and, if it is told so, starts it anew. The safe state of a node is not called then: its outputs are held and safe at all other
/// nodes (QPlcQuality), but what it drives itself has to become safe by itself.
///
/// Threads: that of the node, whose event loop it needs.
class QTPLC_EXPORT QPlcServiceNotifier : public QObject
{
    Q_OBJECT
public:
    /// \param node  outlives this object
    explicit QPlcServiceNotifier(QPlcSlaveNode &node, QObject *parent = nullptr);
    /// \param master  outlives this object
    explicit QPlcServiceNotifier(QPlcMasterNode &master, QObject *parent = nullptr);
    /// Tells that the program ends as wanted.
    ~QPlcServiceNotifier() override;

    /// Whether a service manager has started this program, and wants to be told.
    bool isWanted() const;
    /// Time of the watchdog; 0: there is none.
    std::chrono::microseconds watchdogTime() const;

public Q_SLOTS:
    /// The program is up: those that are ordered after it may start. Only the first call counts.
    void setReady();
    /// Looks whether cycles go on, feeds the watchdog if they do, and tells how far they are. Called by itself; two calls are further apart than a cycle takes.
    void look();

private:
    struct Private;
    explicit QPlcServiceNotifier(std::unique_ptr<Private> data, QObject *parent);
    std::unique_ptr<Private> d;
};
