// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArrayList>
#include <QtCore/QString>

namespace qplc {

/// The folder of a device in sysfs, with its small files of text.
///
/// Each access opens its file anew, so that it fails when the device is gone. A file that is not a
/// regular one, or longer than MostBytes, is refused. So a call waits only for the driver of the
/// kernel.
class SysfsFolder
{
public:
    static constexpr int MostBytes = 512;

    SysfsFolder() = default;
    ~SysfsFolder();
    SysfsFolder(const SysfsFolder &) = delete;
    SysfsFolder &operator=(const SysfsFolder &) = delete;

    /// \return false, with errno
    bool open(const QString &path);
    void close();
    QString path() const { return m_path; }

    /// \return false, with errno: ENOENT and ENODEV when the device is gone, EFBIG for a file that
    ///         is too long, ENOTSUP for one that is not a regular file
    bool read(const QByteArray &file, QByteArray *text) const;
    bool write(const QByteArray &file, const QByteArray &text) const;
    bool has(const QByteArray &file) const;
    /// Returns the number in the first of \a files that contains one, or \a fallback.
    double firstNumber(const QByteArrayList &files, double fallback) const;
    bool isWritable(const QByteArray &file) const;
    /// Returns the names that match a pattern: "in_*_label".
    QByteArrayList files(const QString &pattern) const;

private:
    int m_descriptor = -1;
    QString m_path;
};

}  // namespace qplc
