// SPDX-License-Identifier: Apache-2.0
#include "FmuArchive.h"

#include "signals/MessageText.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QSet>

#include <algorithm>
#include <array>
#include <memory>

#include <sys/stat.h>
#include <zip.h>

namespace qplc {

namespace {

struct CloseFile
{
    void operator()(zip_file_t *file) const { zip_fclose(file); }
};
using ZipFile = std::unique_ptr<zip_file_t, CloseFile>;

/// \return what is wrong with the name of an entry; empty: nothing
QString faultOfName(const QString &name)
{
    if (name.isEmpty() || name.toUtf8().size() > FmuArchive::LongestName)
        return QStringLiteral("has no name, or one of more than %1 bytes").arg(FmuArchive::LongestName);
    const auto isControl = [](QChar character) { return character < QLatin1Char(' ') || character == QChar(0x7f); };
    if (std::any_of(name.begin(), name.end(), isControl))
        return QStringLiteral("has control characters in its name");
    const bool hasDrive = name.size() > 1 && name.at(1) == QLatin1Char(':');
    if (name.startsWith(QLatin1Char('/')) || hasDrive)
        return QStringLiteral("has an absolute path");
    const QStringList parts = name.split(QLatin1Char('/'));
    if (parts.contains(QStringLiteral("..")) || parts.contains(QStringLiteral(".")))
        return QStringLiteral("leaves its folder");
    if (parts.size() > FmuArchive::LargestDepth)
        return QStringLiteral("is more than %1 folders deep").arg(FmuArchive::LargestDepth);
    const auto isEmpty = [](const QString &part) { return part.isEmpty(); };
    if (std::any_of(parts.begin(), parts.end() - 1, isEmpty))
        return QStringLiteral("has a folder without a name");
    return {};
}

bool isLink(zip *archive, quint64 index)
{
    zip_uint8_t system = 0;
    zip_uint32_t attributes = 0;
    return zip_file_get_external_attributes(archive, index, 0, &system, &attributes) == 0 && system == ZIP_OPSYS_UNIX
        && S_ISLNK(attributes >> 16);
}

/// Size of an entry when it is unpacked, as the archive says [byte].
qint64 sizeOf(zip *archive, quint64 index)
{
    zip_stat_t status;
    const bool isKnown = zip_stat_index(archive, index, 0, &status) == 0 && (status.valid & ZIP_STAT_SIZE) != 0;
    return isKnown && status.size <= quint64(FmuArchive::LargestContent) ? qint64(status.size)
                                                                         : FmuArchive::LargestContent + 1;
}

QString textOf(zip *archive)
{
    return QString::fromLocal8Bit(zip_strerror(archive));
}

}  // namespace

FmuArchive::~FmuArchive()
{
    if (m_zip)
        zip_discard(m_zip);
}

bool FmuArchive::open(const QString &fileName, QString *error)
{
    const QFileInfo file(fileName);
    if (!file.isFile() || !file.isReadable()) {
        *error = file.exists() ? QStringLiteral("cannot be read as a file; check its rights")
                               : QStringLiteral("there is no such file");
        return false;
    }
    if (file.size() > LargestFile) {
        *error = QStringLiteral("has %1 MiB, more than %2").arg(file.size() >> 20).arg(LargestFile >> 20);
        return false;
    }
    int code = 0;
    m_zip = zip_open(QFile::encodeName(fileName).constData(), ZIP_RDONLY, &code);
    if (!m_zip) {
        zip_error_t reason;
        zip_error_init_with_code(&reason, code);
        *error = QStringLiteral("is not a complete zip archive, as every FMU is: %1")
                     .arg(QString::fromLocal8Bit(zip_error_strerror(&reason)));
        zip_error_fini(&reason);
        return false;
    }
    const qint64 count = zip_get_num_entries(m_zip, 0);
    if (count > MostEntries) {
        *error = QStringLiteral("has %1 entries, more than %2").arg(count).arg(MostEntries);
        return false;
    }
    for (qint64 i = 0; i < count; ++i) {
        if (!addEntry(quint64(i), error))
            return false;
    }
    return true;
}

bool FmuArchive::addEntry(quint64 index, QString *error)
{
    // Some tools of Windows write their own separator.
    const QString name
        = QString::fromUtf8(zip_get_name(m_zip, index, ZIP_FL_ENC_GUESS)).replace(QLatin1Char('\\'), QLatin1Char('/'));
    const QString fault = isLink(m_zip, index) ? QStringLiteral("is a link") : faultOfName(name);
    if (!fault.isEmpty()) {
        *error = QStringLiteral("entry %1 %2; the archive is damaged or hostile, and nothing of it is used")
                     .arg(quoted(name), fault);
        return false;
    }
    const auto isIn = [&](const char *folder) { return name.startsWith(QLatin1String(folder)); };
    const bool isUsed = isIn("binaries/") || isIn("resources/") || isIn("modelDescription.xml");
    if (name.endsWith(QLatin1Char('/')) || !isUsed)
        return true;  // of no interest
    if (m_entries.contains(name)) {
        *error = QStringLiteral("entry %1 is there twice; the archive is damaged or hostile, and nothing of it is used")
                     .arg(quoted(name));
        return false;
    }
    m_entries.insert(name, index);
    return true;
}

QStringList FmuArchive::platforms() const
{
    QSet<QString> found;
    for (auto entry = m_entries.begin(); entry != m_entries.end(); ++entry) {
        const QStringList parts = entry.key().split(QLatin1Char('/'));
        if (parts.size() > 2 && parts.first() == QLatin1String("binaries"))
            found.insert(parts.at(1));
    }
    QStringList platforms = found.values();
    platforms.sort();
    return platforms;
}

bool FmuArchive::read(const QString &name, qint64 largest, QByteArray *content, QString *error)
{
    const auto entry = m_entries.find(name);
    if (entry == m_entries.end()) {
        *error = QStringLiteral("has no %1; it is not an FMU").arg(name);
        return false;
    }
    const ZipFile file(zip_fopen_index(m_zip, *entry, 0));
    if (!file) {
        *error = QStringLiteral("%1 cannot be unpacked: %2").arg(quoted(name), textOf(m_zip));
        return false;
    }
    std::array<char, 65536> buffer{};
    qint64 size = 0;
    while ((size = zip_fread(file.get(), buffer.data(), buffer.size())) > 0) {
        content->append(buffer.data(), int(size));
        if (content->size() > largest) {
            *error = QStringLiteral("%1 has more than %2 MiB").arg(quoted(name)).arg(largest >> 20);
            return false;
        }
    }
    if (size < 0)
        *error = QStringLiteral("%1 cannot be unpacked: it is damaged").arg(quoted(name));
    return size == 0;
}

bool FmuArchive::unpack(const QString &prefix, const QString &folder, QString *error)
{
    // Before anything is written.
    for (auto entry = m_entries.begin(); entry != m_entries.end(); ++entry) {
        m_unpacked += entry.key().startsWith(prefix) ? sizeOf(m_zip, *entry) : 0;
        if (m_unpacked > LargestContent) {
            *error = QStringLiteral("has more than %1 MiB when it is unpacked").arg(LargestContent >> 20);
            return false;
        }
    }
    for (auto entry = m_entries.begin(); entry != m_entries.end(); ++entry) {
        if (!entry.key().startsWith(prefix))
            continue;
        const QString target = folder + QLatin1Char('/') + entry.key();
        if (!QDir().mkpath(QFileInfo(target).path())) {
            *error = QStringLiteral("cannot make the folder of %1; set TMPDIR to a folder with room").arg(target);
            return false;
        }
        if (!copy(*entry, entry.key(), target, error))
            return false;
    }
    return true;
}

bool FmuArchive::copy(quint64 index, const QString &name, const QString &target, QString *error)
{
    QFile output(target);
    if (output.exists() || !output.open(QIODevice::WriteOnly)) {
        *error = QStringLiteral("cannot write %1: %2; set TMPDIR to a folder with room")
                     .arg(target, output.exists() ? QStringLiteral("it exists") : output.errorString());
        return false;
    }
    output.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
    const ZipFile input(zip_fopen_index(m_zip, index, 0));
    if (!input) {
        *error = QStringLiteral("%1 cannot be unpacked: %2").arg(quoted(name), textOf(m_zip));
        return false;
    }
    std::array<char, 65536> buffer{};
    qint64 left = sizeOf(m_zip, index);
    qint64 size = 0;
    while ((size = zip_fread(input.get(), buffer.data(), buffer.size())) > 0) {
        left -= size;
        if (left < 0) {
            *error = QStringLiteral("%1 is larger than the archive says; the archive is damaged or hostile")
                         .arg(quoted(name));
            return false;
        }
        if (output.write(buffer.data(), size) != size) {
            *error = QStringLiteral("cannot write %1: %2; set TMPDIR to a folder with room")
                         .arg(target, output.errorString());
            return false;
        }
    }
    if (size < 0)
        *error = QStringLiteral("%1 cannot be unpacked: it is damaged").arg(quoted(name));
    return size == 0 && output.flush();
}

}  // namespace qplc
