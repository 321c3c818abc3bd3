// SPDX-License-Identifier: Apache-2.0
#include "SharedChannel.h"

#include "PeerFile.h"
#include "SocketAddress.h"
#include "realtime/TimeSource.h"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstring>
#include <fcntl.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace qplc {

namespace {

void futexWait(std::atomic<std::uint32_t> *word, std::uint32_t value, const timespec *timeout) noexcept
{
    ::syscall(SYS_futex, word, FUTEX_WAIT, value, timeout, nullptr, 0);
}

void futexWake(std::atomic<std::uint32_t> *word) noexcept
{
    ::syscall(SYS_futex, word, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

constexpr std::uint32_t LengthSize = sizeof(std::uint32_t);

}  // namespace

// ---- memory ----

SharedMemory::~SharedMemory()
{
    if (m_data)
        ::munmap(m_data, m_size);
    if (m_descriptor >= 0)
        ::close(m_descriptor);
}

bool SharedMemory::map(QString *error)
{
    m_data = ::mmap(nullptr, m_size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, m_descriptor, 0);
    if (m_data != MAP_FAILED)
        return true;
    m_data = nullptr;
    *error = QStringLiteral("cannot map %1 bytes of shared memory: %2").arg(m_size).arg(systemErrorText());
    return false;
}

bool SharedMemory::create(std::size_t size, QString *error)
{
    m_size = size;
    m_descriptor = ::memfd_create("qtplc", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    // Sealed: nobody can make it smaller under the feet of the others.
    if (m_descriptor < 0 || ::ftruncate(m_descriptor, off_t(size)) < 0
        || ::fcntl(m_descriptor, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) < 0) {
        *error = QStringLiteral("cannot make %1 bytes of shared memory: %2").arg(size).arg(systemErrorText());
        return false;
    }
    return map(error);
}

bool SharedMemory::open(const QString &path, const QString &what, std::size_t size, uid_t owner, QString *error)
{
    PeerFile file;
    m_size = size;
    if (!file.find(path, what, owner, error))
        return false;
    m_descriptor = file.openMemory(size, error);
    return m_descriptor >= 0 && map(error);
}

QString SharedMemory::path() const
{
    return QStringLiteral("/proc/%1/fd/%2").arg(::getpid()).arg(m_descriptor);
}

// ---- ring ----

void SharedRing::write(std::uint32_t place, const char *bytes, std::uint32_t size) noexcept
{
    const std::uint32_t begin = place % Capacity;
    const std::uint32_t first = std::min(size, Capacity - begin);
    std::memcpy(m_bytes + begin, bytes, first);
    std::memcpy(m_bytes, bytes + first, size - first);
}

void SharedRing::read(std::uint32_t place, char *bytes, std::uint32_t size) const noexcept
{
    const std::uint32_t begin = place % Capacity;
    const std::uint32_t first = std::min(size, Capacity - begin);
    std::memcpy(bytes, m_bytes + begin, first);
    std::memcpy(bytes + first, m_bytes, size - first);
}

bool SharedRing::push(const char *frame, std::size_t size) noexcept
{
    const std::uint32_t tail = m_tail.load(std::memory_order_relaxed);
    const std::uint32_t used = tail - m_head.load(std::memory_order_acquire);
    if (used > Capacity || size + LengthSize > Capacity - used)
        return false;
    const auto length = std::uint32_t(size);
    char bytes[LengthSize];
    std::memcpy(bytes, &length, LengthSize);
    write(tail, bytes, LengthSize);
    write(tail + LengthSize, frame, length);
    m_tail.store(tail + LengthSize + length, std::memory_order_seq_cst);
    return true;
}

void SharedRing::wake() noexcept
{
    if (m_sleeping.load(std::memory_order_seq_cst) != 0)
        futexWake(&m_tail);
}

std::size_t SharedRing::pop(char *frame, std::size_t capacity) noexcept
{
    const std::uint32_t head = m_head.load(std::memory_order_relaxed);
    const std::uint32_t tail = m_tail.load(std::memory_order_acquire);
    const std::uint32_t used = tail - head;
    if (used < LengthSize)
        return 0;
    char bytes[LengthSize];
    std::uint32_t length = 0;
    read(head, bytes, LengthSize);
    std::memcpy(&length, bytes, LengthSize);
    if (used > Capacity || length > used - LengthSize || length > capacity || length == 0) {
        m_head.store(tail, std::memory_order_release);  // nonsense: begin anew behind it
        return 0;
    }
    read(head + LengthSize, frame, length);
    m_head.store(head + LengthSize + length, std::memory_order_release);
    return length;
}

void SharedRing::wait() noexcept
{
    m_sleeping.store(1, std::memory_order_seq_cst);
    const std::uint32_t tail = m_tail.load(std::memory_order_seq_cst);
    if (tail == m_head.load(std::memory_order_relaxed))
        futexWait(&m_tail, tail, nullptr);
    m_sleeping.store(0, std::memory_order_relaxed);
}

// ---- doorbell ----

void Doorbell::ring(int pipe) noexcept
{
    const std::uint32_t count = m_count.fetch_add(1) + 1;
    const std::uint32_t sleeping = m_sleeping.load();
    if (sleeping == Awake || !isWanted(count))
        return;
    if (sleeping == InFutex) {
        futexWake(&m_count);
    } else {
        const char byte = 0;
        [[maybe_unused]] const ssize_t written = ::write(pipe, &byte, 1);  // full: rung already
    }
}

void Doorbell::sleep(std::int64_t timeout) noexcept
{
    const timespec limit = timeSpec(timeout);
    m_sleeping.store(InFutex);
    const std::uint32_t count = m_count.load();
    if (!isWanted(count))
        futexWait(&m_count, count, &limit);
    m_sleeping.store(Awake);
}

bool Doorbell::beginPoll() noexcept
{
    m_sleeping.store(InPoll);
    return !isWanted(m_count.load());
}

}  // namespace qplc
