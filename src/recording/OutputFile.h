// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QFile>
#include <QtCore/QString>

#include <memory>

namespace qplc {

/// A file that appears under its name when all of it is written, and not at all when that fails.
/// The name StandardOutput stands for that of the program, which gets each part as it is written.
class OutputFile
{
public:
    static constexpr char StandardOutput[] = "-";
    /// What happens with a file of this name. Links, folders and devices are never replaced.
    enum Existing { Refuse, Replace };

    OutputFile(const QString &name, Existing existing);

    /// Makes the file under a temporary name, in the same folder. \return false when there is a
    /// file of this name already, or no file can be made
    bool open(QString *error);
    /// The temporary name, for writers that open files themselves. Empty: it is the standard output
    QString temporaryName() const { return m_file->fileName(); }
    bool write(const QByteArray &bytes, QString *error);
    /// What was written [byte].
    qint64 size() const { return m_size; }
    /// Gives the file its name. \return false, and no file, when not all of it is on the disk
    bool commit(QString *error);

private:
    bool isStandardOutput() const { return m_name == QLatin1String(StandardOutput); }
    bool fail(const QString &reason, QString *error) const;

    QString m_name;
    Existing m_existing;
    std::unique_ptr<QFile> m_file;
    qint64 m_size = 0;
};

}  // namespace qplc
