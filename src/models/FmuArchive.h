// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QHash>
#include <QtCore/QString>
#include <QtCore/QStringList>

struct zip;

namespace qplc {

/// The file of an FMU: a zip archive of somebody else. Whatever it contains, nothing is written
/// outside of the folder that unpack() is given, and what is written is limited.
class FmuArchive
{
public:
    static constexpr qint64 LargestFile = 1024LL * 1024 * 1024;     // [byte] the archive itself
    static constexpr qint64 LargestContent = 1024LL * 1024 * 1024;  // [byte] all that is unpacked
    static constexpr qint64 MostEntries = 20'000;
    static constexpr int LongestName = 1024;  // [byte]
    static constexpr int LargestDepth = 32;   // folders inside of each other

    FmuArchive() = default;
    ~FmuArchive();
    FmuArchive(const FmuArchive &) = delete;
    FmuArchive &operator=(const FmuArchive &) = delete;

    /// Opens \a fileName and checks all of its names. \return false, with the reason and the remedy
    /// in \a error
    bool open(const QString &fileName, QString *error);
    /// Folders of `binaries`: the platforms for which there is a library.
    QStringList platforms() const;
    bool contains(const QString &name) const { return m_entries.contains(name); }
    /// The content of an entry. \return false, with \a error, when it is missing, damaged, or
    /// larger than \a largest
    bool read(const QString &name, qint64 largest, QByteArray *content, QString *error);
    /// Writes all entries below \a prefix into \a folder.
    bool unpack(const QString &prefix, const QString &folder, QString *error);

private:
    bool addEntry(quint64 index, QString *error);
    bool copy(quint64 index, const QString &name, const QString &target, QString *error);

    zip *m_zip = nullptr;
    QHash<QString, quint64> m_entries;  // files: their numbers
    qint64 m_unpacked = 0;              // [byte]
};

}  // namespace qplc
