// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/qglobal.h>

#if defined(QTPLC_STATIC)
/// Exports a class or function of QtPlc::Core from the shared library, and imports it in programs.
/// Empty with QTPLC_STATIC, which QtPlc::Core defines for users of a static library.
#define QTPLC_EXPORT
#elif defined(QTPLC_BUILD_CORE)
#define QTPLC_EXPORT Q_DECL_EXPORT
#else
#define QTPLC_EXPORT Q_DECL_IMPORT
#endif

/// Position of a signal in its table, in the order of the file: 0 to 65533. See
/// QPlcSignalTable::indexOf().
///
/// \ingroup signals
using QPlcSignalIndex = quint16;

/// The index of no signal. Functions that look a signal up return it when the table has no such
/// signal.
///
/// \ingroup signals
constexpr QPlcSignalIndex QPlcInvalidSignalIndex = 0xFFFF;
