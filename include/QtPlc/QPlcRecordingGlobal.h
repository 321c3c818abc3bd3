// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

/// Marks the public API of QtPlc::Recording: the library exports it and hides the rest. It means
/// the same where the library is built and where it is used, and for shared and static libraries.
#define QTPLC_RECORDING_EXPORT Q_DECL_EXPORT
