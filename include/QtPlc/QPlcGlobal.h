// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/qglobal.h>

/// Marks the public API of QtPlc::Core: the library exports it and hides the rest. It means the
/// same where the library is built and where it is used, and for shared and static libraries.
#define QTPLC_EXPORT Q_DECL_EXPORT

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
