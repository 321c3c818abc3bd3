// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

/// What became of one wish of the QPlcRealTimeOptions, checked by its effect.
struct QTPLC_EXPORT QPlcRealTimeSetting
{
    QString name;      ///< "scheduling", "cpu", "locked memory", ...
    QString wanted;    ///< "SCHED_FIFO 49"
    QString obtained;  ///< "SCHED_OTHER 0"
    bool granted = false;
    QString remedy;  ///< command that cures a refusal; empty when granted

    /// "scheduling: wanted SCHED_FIFO 49, obtained SCHED_OTHER 0; cure: ..."
    QString toString() const;
};

Q_DECLARE_METATYPE(QPlcRealTimeSetting)
