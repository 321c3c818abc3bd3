// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QTemporaryDir>

/// While it lives, masters leave their notices in a folder of this test alone, and nobody else's
/// are seen.
class RuntimeFolder
{
public:
    RuntimeFolder() { qputenv("XDG_RUNTIME_DIR", m_folder.path().toLocal8Bit()); }
    ~RuntimeFolder() { qunsetenv("XDG_RUNTIME_DIR"); }

    QString path() const { return m_folder.path(); }
    /// Of the notices.
    QString notices() const { return m_folder.filePath(QStringLiteral("qtplc-masters")); }

private:
    const QTemporaryDir m_folder;
};
