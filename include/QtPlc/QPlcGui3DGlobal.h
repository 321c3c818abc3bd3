// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#if defined(QTPLC_STATIC)
/// Exports a class or function of QtPlc::Gui3D from the shared library, and imports it in programs.
/// Empty with QTPLC_STATIC, which QtPlc::Core defines for users of a static library.
#define QTPLC_GUI3D_EXPORT
#elif defined(QTPLC_BUILD_GUI3D_LIBRARY)
#define QTPLC_GUI3D_EXPORT Q_DECL_EXPORT
#else
#define QTPLC_GUI3D_EXPORT Q_DECL_IMPORT
#endif
