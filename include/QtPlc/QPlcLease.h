// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

#include <chrono>

/// A lease: the permission of the master to set a signal that a node writes. While the lease lasts,
/// the signal has the values of the holder, whatever its writer sends.
///
/// \code
/// QPlcMasterNode master;
/// for (const QPlcLease &lease : master.leases())
///     qInfo("%s is held by %s", qPrintable(lease.signal), qPrintable(lease.holder));
/// \endcode
///
/// QPlcSignalControl takes and releases leases for a panel.
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup master
struct QPlcLease
{
    QString signal;  ///< name of the signal
    QString holder;  ///< person or program, as windows show it; of a lost lease the last holder
    /// The holder is gone: the signal stays at its neutral value until another person takes or
    /// releases the lease.
    bool isLost = false;
    /// Longest silence of the holder before the lease is lost.
    std::chrono::nanoseconds timeout{0};
};

Q_DECLARE_METATYPE(QPlcLease)
