// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <memory>

namespace qplc {

/// A folder for the files of one FMU, which nobody else can read, and which is removed at the end.
///
/// A process that crashes or is killed leaves its folder behind. The next process of the same user
/// that makes one removes it: each folder has a file that its process has locked.
class FmuFolder
{
public:
    /// \return null, with the reason in \a error, when there can be none
    static std::unique_ptr<FmuFolder> make(QString *error);
    ~FmuFolder();
    FmuFolder(const FmuFolder &) = delete;
    FmuFolder &operator=(const FmuFolder &) = delete;

    const QString &path() const { return m_path; }

private:
    FmuFolder(const QString &path, int lock)
        : m_path(path)
        , m_lock(lock)
    {
    }
    static void removeLeftovers();

    QString m_path;
    int m_lock;
};

}  // namespace qplc
