// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

/// What the operating system has granted of one real-time option, read back from the system.
///
/// \code
/// QPlcMasterNode master;
/// for (const QPlcRealTimeSetting &setting : master.realTimeSettings()) {
///     if (!setting.granted)
///         qWarning("%s", qPrintable(setting.toString()));
/// }
/// \endcode
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup time
struct QTPLC_EXPORT QPlcRealTimeSetting
{
    QString name;          ///< "scheduling", "cpu", "locked memory", ...
    QString wanted;        ///< what was asked for: "SCHED_FIFO 49"
    QString obtained;      ///< what the system has set: "SCHED_OTHER 0"
    bool granted = false;  ///< wanted and obtained are the same
    QString remedy;        ///< command or setting that helps; empty if it was granted

    /// Returns one line: "scheduling: wanted SCHED_FIFO 49, obtained SCHED_OTHER 0; cure: ..."
    QString toString() const;
};

Q_DECLARE_METATYPE(QPlcRealTimeSetting)
