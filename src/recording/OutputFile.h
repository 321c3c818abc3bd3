// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>
#include <QtCore/QTemporaryFile>

namespace qplc {

/// A file that appears under its name when all of it is written, and not at all when that fails.
class OutputFile
{
public:
    /// What happens with a file of this name. Links, folders and devices are never replaced.
    enum Existing { Refuse, Replace };

    OutputFile(const QString &name, Existing existing);

    /// Makes the file under a temporary name, in the same folder. \return false when there is a
    /// file of this name already, or no file can be made
    bool open(QString *error);
    /// The temporary name, for writers that open files themselves.
    QString temporaryName() const { return m_file.fileName(); }
    bool write(const QByteArray &bytes, QString *error);
    qint64 size() const { return m_file.pos(); }
    /// Gives the file its name. \return false, and no file, when not all of it is on the disk
    bool commit(QString *error);

private:
    bool fail(const QString &reason, QString *error) const;

    QString m_name;
    Existing m_existing;
    QTemporaryFile m_file;
};

}  // namespace qplc
