// SPDX-License-Identifier: Apache-2.0
#include "RingMemory.h"

#include <QtCore/QFile>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <new>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace qplc {

namespace {

constexpr std::uint64_t LargestCapacity = std::uint64_t(1) << 30;
constexpr std::uint32_t LargestDescription = 64U << 20;

std::size_t wholePages(std::size_t size)
{
    const auto page = std::size_t(::sysconf(_SC_PAGESIZE));
    return (size + page - 1) / page * page;
}

struct flock byteLock(RingMemory::Lock lock, short type)
{
    struct flock request = {};
    request.l_type = type;
    request.l_whence = SEEK_SET;
    request.l_start = off_t(lock);
    request.l_len = 1;
    return request;
}

QString fileError(const QString &what, const QByteArray &file)
{
    return QStringLiteral("cannot %1 the ring '%2': %3").arg(what, QFile::decodeName(file), qt_error_string(errno));
}

}  // namespace

std::atomic<std::uint64_t> RingMemory::m_mappings{0};

RingMemory::~RingMemory()
{
    close();
}

void RingMemory::close()
{
    if (m_cycles)
        ::munmap(m_cycles, std::size_t(2 * m_capacity));
    if (m_texts)
        ::munmap(m_texts, std::size_t(2 * m_textCapacity));
    if (m_header)
        ::munmap(m_header, m_headerSize);
    m_cycles = m_texts = nullptr;
    m_header = nullptr;
    m_descriptor = Descriptor();
    m_file.clear();
}

QByteArray RingMemory::folder()
{
    const QByteArray folder = qgetenv("QTPLC_RING_DIR");
    return folder.isEmpty() ? QByteArrayLiteral("/dev/shm") : folder;
}

bool RingMemory::create(const QByteArray &file, std::size_t capacity, const QByteArray &description, QString *error,
                        std::size_t textCapacity)
{
    if (createHidden(file, capacity, description, error, textCapacity) && (file.isEmpty() || publish(file, error)))
        return true;
    close();
    return false;
}

bool RingMemory::createHidden(const QByteArray &file, std::size_t capacity, const QByteArray &description,
                              QString *error, std::size_t textCapacity)
{
    close();
    m_capacity = capacity;
    m_textCapacity = textCapacity;
    m_headerSize = wholePages(sizeof(Header) + std::size_t(description.size()));
    const QByteArray folder = file.left(file.lastIndexOf('/'));
    m_descriptor = Descriptor(file.isEmpty() ? ::memfd_create("qtplc-ring", MFD_CLOEXEC)
                                             : ::open(folder.constData(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
    // Taken now: a write into memory that a full file system cannot give would end the process.
    const std::size_t size = m_headerSize + capacity + textCapacity;
    const int taken = m_descriptor.isOpen() ? ::posix_fallocate(m_descriptor.number(), 0, off_t(size)) : errno;
    if (taken != 0) {
        errno = taken;
        *error = fileError(QStringLiteral("take %1 bytes of memory for").arg(size), file);
        close();
        return false;
    }
    if (map(error) && describe(description, error))
        return true;
    close();
    return false;
}

bool RingMemory::describe(const QByteArray &description, QString *error)
{
    new (m_header) Header();
    m_header->capacity = m_capacity;
    m_header->bytesAt = std::uint32_t(m_headerSize);
    m_header->descriptionSize = std::uint32_t(description.size());
    m_header->textCapacity = m_textCapacity;
    std::memcpy(reinterpret_cast<char *>(m_header) + sizeof(Header), description.constData(),
                std::size_t(description.size()));
    m_header->magic = Header::Magic;
    if (lock(WriterLock))
        return true;
    *error = fileError(QStringLiteral("lock"), {});
    return false;
}

bool RingMemory::publish(const QByteArray &file, QString *error)
{
    const QByteArray self = "/proc/self/fd/" + QByteArray::number(m_descriptor.number());
    if (::linkat(AT_FDCWD, self.constData(), AT_FDCWD, file.constData(), AT_SYMLINK_FOLLOW) != 0) {
        *error = fileError(QStringLiteral("publish"), file);
        return false;
    }
    m_file = file;
    return true;
}

/// Both halves of the address range show the same bytes of the file. \return null when there is no
/// memory
char *RingMemory::mapTwice(std::uint64_t place, std::uint64_t size) const
{
    void *range = ::mmap(nullptr, 2 * size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (range == MAP_FAILED)
        return nullptr;
    char *bytes = static_cast<char *>(range);
    for (int half = 0; half < 2; ++half) {
        if (::mmap(bytes + std::size_t(half) * size, size, PROT_READ | PROT_WRITE,
                   MAP_SHARED | MAP_FIXED | MAP_POPULATE, m_descriptor.number(), off_t(place))
            == MAP_FAILED) {
            ::munmap(range, 2 * size);
            return nullptr;
        }
    }
    return bytes;
}

bool RingMemory::map(QString *error)
{
    m_mappings.fetch_add(1, std::memory_order_relaxed);
    void *header
        = ::mmap(nullptr, m_headerSize, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, m_descriptor.number(), 0);
    if (header != MAP_FAILED)
        m_header = static_cast<Header *>(header);
    m_cycles = mapTwice(m_headerSize, m_capacity);
    m_texts = m_textCapacity > 0 ? mapTwice(m_headerSize + m_capacity, m_textCapacity) : nullptr;
    if (m_header && m_cycles && (m_texts || m_textCapacity == 0))
        return true;
    *error = fileError(QStringLiteral("map %1 bytes of").arg(2 * (m_capacity + m_textCapacity)), m_file);
    return false;
}

/// Nothing that is not checked here is relied on later.
bool RingMemory::openFile(const QByteArray &file, Header *start, QString *error)
{
    close();
    m_descriptor = Descriptor(::open(file.constData(), O_RDWR | O_CLOEXEC | O_NOFOLLOW));
    struct stat status = {};
    if (!m_descriptor.isOpen() || ::fstat(m_descriptor.number(), &status) != 0) {
        *error = fileError(QStringLiteral("open"), file);
        return false;
    }
    const bool isWhole = S_ISREG(status.st_mode) && status.st_uid == ::getuid()
        && ::pread(m_descriptor.number(), static_cast<void *>(start), sizeof *start, 0) == ssize_t(sizeof *start);
    const auto isCapacity = [](std::uint64_t capacity) {
        return capacity <= LargestCapacity && capacity >= 4096 && (capacity & (capacity - 1)) == 0;
    };
    if (isWhole && start->magic == Header::Magic && isCapacity(start->capacity)
        && (start->textCapacity == 0 || isCapacity(start->textCapacity)) && start->descriptionSize <= LargestDescription
        && start->bytesAt == wholePages(sizeof(Header) + start->descriptionSize)
        && std::uint64_t(status.st_size) == start->bytesAt + start->capacity + start->textCapacity)
        return true;
    *error = QStringLiteral("'%1' is not a ring of this version of QtPLC and of this user; masters keep theirs as "
                            "'%2/qtplc-ring-...'")
                 .arg(QFile::decodeName(file), QFile::decodeName(folder()));
    return false;
}

bool RingMemory::open(const QByteArray &file, QString *error)
{
    Header start;
    if (openFile(file, &start, error)) {
        m_capacity = start.capacity;
        m_textCapacity = start.textCapacity;
        m_headerSize = start.bytesAt;
        m_file = file;
        if (map(error))
            return true;
    }
    close();
    return false;
}

RingMemory::Use RingMemory::useOf(const QByteArray &file)
{
    RingMemory memory;
    Header start;
    QString error;
    if (!memory.openFile(file, &start, &error))
        return NoRing;
    if (memory.isLocked(WriterLock))
        return Alive;
    if (memory.isLocked(RecorderLock))
        return BeingRead;
    return start.cycles.isRead.load() != 0 ? DeadAndRecorded : Dead;
}

bool RingMemory::isRecorded(const QByteArray &file)
{
    RingMemory memory;
    Header start;
    QString error;
    return memory.openFile(file, &start, &error) && memory.isLocked(RecorderLock);
}

QByteArray RingMemory::description() const
{
    const auto most = std::uint32_t(m_headerSize - sizeof(Header));
    return {reinterpret_cast<const char *>(m_header) + sizeof(Header),
            int(std::min<std::uint32_t>(m_header->descriptionSize, most))};
}

bool RingMemory::lock(Lock lock) const
{
    struct flock request = byteLock(lock, F_WRLCK);
    return ::fcntl(m_descriptor.number(), F_OFD_SETLK, &request) == 0;
}

void RingMemory::unlock(Lock lock) const
{
    struct flock request = byteLock(lock, F_UNLCK);
    ::fcntl(m_descriptor.number(), F_OFD_SETLK, &request);
}

bool RingMemory::isLocked(Lock lock) const
{
    struct flock request = byteLock(lock, F_WRLCK);
    return ::fcntl(m_descriptor.number(), F_OFD_GETLK, &request) == 0 && request.l_type != F_UNLCK;
}

void RingMemory::remove()
{
    struct stat ours = {};
    struct stat there = {};
    if (!m_file.isEmpty() && ::fstat(m_descriptor.number(), &ours) == 0 && ::lstat(m_file.constData(), &there) == 0
        && ours.st_ino == there.st_ino && ours.st_dev == there.st_dev)
        ::unlink(m_file.constData());
    m_file.clear();
}

}  // namespace qplc
