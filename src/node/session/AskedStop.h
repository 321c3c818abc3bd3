// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QObject>
#include <QtCore/QPointer>
#include <QtCore/QString>

namespace qplc {

/// Who stopped the phase that ran last, on request. A value type.
struct AskedStop
{
    QPointer<QObject> asker;  // its connection; null: it has ended
    QString whoever;          // "anna@lab"; empty: nobody stopped the last phase on request
    QString how;              // "Esc Esc", for people; empty: not told
    qint64 time = 0;          // [ns] since 1970
};

}  // namespace qplc
