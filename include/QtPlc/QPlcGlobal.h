// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/qglobal.h>

#if defined(QTPLC_STATIC)
#define QTPLC_EXPORT
#elif defined(QTPLC_BUILD_CORE)
#define QTPLC_EXPORT Q_DECL_EXPORT
#else
#define QTPLC_EXPORT Q_DECL_IMPORT
#endif

/// Position of a signal in its table, in file order: 0 ... 65533. See QPlcSignalIndexTable.
using QPlcSignalIndex = quint16;

/// Marks "no such signal"; never the index of a signal.
constexpr QPlcSignalIndex QPlcInvalidSignalIndex = 0xFFFF;
