// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

#include <chrono>

/// A signal that a person or program has taken over: while the lease lasts, the signal has the values of the holder, whatever its writer answers. A value type.
struct QPlcLease
{
    QString signal;
    QString holder;  ///< as shown to people; of a lost lease: who held it last
    bool isLost
        = false;  ///< the holder is gone: the signal stays at its neutral value until somebody takes or releases it
    std::chrono::nanoseconds timeout{0};  ///< longest silence of the holder
};

Q_DECLARE_METATYPE(QPlcLease)
