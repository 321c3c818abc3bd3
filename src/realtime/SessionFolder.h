// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>

namespace qplc {

/// Where programs of one user on one computer find each other: in the folder of the session,
/// $XDG_RUNTIME_DIR, or in /tmp where there is none, as in a service. QStandardPaths knows the same
/// and warns wherever there is no session of a desktop.
class SessionFolder
{
public:
    /// Of the folder \a name, which may not be there.
    static QByteArray path(const char *name);
    /// Makes the folder \a path if it is not there. \return whether it is there and belongs to this
    /// user alone; else errno tells why not
    static bool make(const QByteArray &path);
};

}  // namespace qplc
