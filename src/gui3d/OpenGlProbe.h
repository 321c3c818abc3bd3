// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

namespace qplc {

/// Whether pictures can be drawn with OpenGL here. A value type.
struct OpenGlProbe
{
    QString error;     // one sentence; empty: they can
    QString renderer;  // "llvmpipe (LLVM 15.0.6, 256 bits)"

    /// Tries it, once for each program. The environment variable QTPLC_OPENGL=off says no, for
    /// drivers that break.
    static const OpenGlProbe &instance();
    static OpenGlProbe probe();
};

}  // namespace qplc
