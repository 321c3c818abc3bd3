// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#if defined(QTPLC_STATIC)
/// Exports a class or function of QtPlc::Hardware from the shared library, and imports it in
/// programs. Empty with QTPLC_STATIC, which QtPlc::Core defines for users of a static library.
#define QTPLC_HARDWARE_EXPORT
#elif defined(QTPLC_BUILD_HARDWARE_LIBRARY)
#define QTPLC_HARDWARE_EXPORT Q_DECL_EXPORT
#else
#define QTPLC_HARDWARE_EXPORT Q_DECL_IMPORT
#endif
