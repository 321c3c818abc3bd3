// SPDX-License-Identifier: Apache-2.0
#include "FakeMemory.h"

#include "realtime/SessionFolder.h"

#include <QtCore/QDir>
#include <QtCore/QFile>

#include <cerrno>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace qplc {

namespace {

const QLatin1String fakePrefix("fake:");

QString chosenFolder()
{
    return QFile::decodeName(qgetenv("QTPLC_FAKE_DEVICES"));
}

QString fakeErrorText(const QString &operation, const QString &path)
{
    return QStringLiteral("cannot %1 the fake device %2: %3; QTPLC_FAKE_DEVICES names another folder")
        .arg(operation, path, qt_error_string(errno));
}

}  // namespace

FakeMemory::~FakeMemory()
{
    close();
}

QString FakeMemory::folder()
{
    const QString chosen = chosenFolder();
    return chosen.isEmpty() ? QFile::decodeName(SessionFolder::path("qtplc-devices")) : chosen;
}

bool FakeMemory::makeFolder()
{
    return chosenFolder().isEmpty() ? SessionFolder::make(QFile::encodeName(folder())) : QDir().mkpath(folder());
}

bool FakeMemory::isFake(const QString &device)
{
    return device.startsWith(fakePrefix);
}

QString FakeMemory::path(const QString &device)
{
    QString name = isFake(device) ? device.mid(fakePrefix.size()) : device;
    return folder() + QLatin1Char('/') + name.replace(QLatin1Char('/'), QLatin1Char('_'));
}

QString FakeMemory::missingText(const QString &device)
{
    return QStringLiteral("there is no fake device '%1': no file %2; start what plays it, with the same "
                          "QTPLC_FAKE_DEVICES, or name a real device")
        .arg(device, path(device));
}

bool FakeMemory::create(const QString &device, std::size_t size, QString *error)
{
    close();
    if (!makeFolder()) {
        *error = fakeErrorText(QStringLiteral("make"), path(device));
        return false;
    }
    // Under another name until it has its size: nobody sees half a device.
    const QByteArray name = QFile::encodeName(path(device));
    const QByteArray unfinished = name + '.' + QByteArray::number(qint64(::getpid()));
    m_size = size;
    const int descriptor = ::open(unfinished.constData(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (descriptor < 0 || ::ftruncate(descriptor, off_t(size)) < 0
        || ::rename(unfinished.constData(), name.constData()) < 0) {
        *error = fakeErrorText(QStringLiteral("make"), path(device));
        if (descriptor >= 0)
            ::close(descriptor);
        return false;
    }
    return map(descriptor, error);
}

bool FakeMemory::open(const QString &device, std::size_t size, QString *error)
{
    close();
    const QString file = path(device);
    const int descriptor = ::open(QFile::encodeName(file).constData(), O_RDWR | O_CLOEXEC);
    if (descriptor < 0) {
        *error = errno == ENOENT ? missingText(device) : fakeErrorText(QStringLiteral("open"), file);
        return false;
    }
    struct stat status = {};
    if (::fstat(descriptor, &status) < 0 || status.st_size == 0 || (size > 0 && status.st_size != off_t(size))) {
        *error = QStringLiteral("the fake device %1 has %2 bytes, and not %3; it is of another kind: remove the file")
                     .arg(file)
                     .arg(status.st_size)
                     .arg(size);
        ::close(descriptor);
        return false;
    }
    m_size = std::size_t(status.st_size);
    return map(descriptor, error);
}

bool FakeMemory::map(int descriptor, QString *error)
{
    m_descriptor = descriptor;
    void *bytes = ::mmap(nullptr, m_size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, m_descriptor, 0);
    if (bytes == MAP_FAILED) {
        *error = QStringLiteral("cannot map %1 bytes of a fake device: %2; close other programs")
                     .arg(m_size)
                     .arg(qt_error_string(errno));
        close();
        return false;
    }
    m_bytes = static_cast<std::atomic<quint8> *>(bytes);
    return true;
}

void FakeMemory::close()
{
    if (m_bytes)
        ::munmap(m_bytes, m_size);
    if (m_descriptor >= 0)
        ::close(m_descriptor);
    m_bytes = nullptr;
    m_descriptor = -1;
    m_size = 0;
}

void FakeMemory::remove(const QString &device)
{
    QFile::remove(path(device));
}

bool FakeMemory::isThere() const noexcept
{
    struct stat status = {};
    return m_bytes && ::fstat(m_descriptor, &status) == 0 && status.st_nlink > 0;
}

}  // namespace qplc
