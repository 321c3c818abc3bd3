// SPDX-License-Identifier: Apache-2.0
#include "SharedChannel.h"

#include "SocketAddress.h"
#include "realtime/TimeSource.h"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstring>
#include <fcntl.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/stat.h>
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
constexpr std::uint32_t LargestCapacity = 1U << 30;
constexpr int NeededSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;

}  // namespace

// ---- memory ----

SharedMemory::~SharedMemory()
{
    if (m_data)
        ::munmap(m_data, m_size);
}

bool SharedMemory::map(QString *error)
{
    m_data = ::mmap(nullptr, m_size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, m_descriptor.number(), 0);
    if (m_data != MAP_FAILED)
        return true;
    m_data = nullptr;
    *error = QStringLiteral("cannot map %1 bytes of shared memory: %2").arg(m_size).arg(systemErrorText());
    return false;
}

bool SharedMemory::create(std::size_t size, QString *error)
{
    m_size = size;
    m_descriptor = Descriptor(::memfd_create("qtplc", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    // Sealed: nobody can make it smaller under the feet of the others.
    if (!m_descriptor.isOpen() || ::ftruncate(m_descriptor.number(), off_t(size)) < 0
        || ::fcntl(m_descriptor.number(), F_ADD_SEALS, NeededSeals) < 0) {
        *error = QStringLiteral("cannot make %1 bytes of shared memory: %2").arg(size).arg(systemErrorText());
        return false;
    }
    return map(error);
}

bool SharedMemory::adopt(Descriptor descriptor, const QString &what, std::size_t size, QString *error)
{
    m_descriptor = std::move(descriptor);
    m_size = size;
    const int seals = ::fcntl(m_descriptor.number(), F_GET_SEALS);
    struct stat status = {};  // what is sealed now keeps its size
    if (seals < 0 || (seals & NeededSeals) != NeededSeals || ::fstat(m_descriptor.number(), &status) < 0)
        *error = QStringLiteral("what the master has passed as %1 is not sealed memory").arg(what);
    else if (status.st_size != off_t(size))
        *error = QStringLiteral("the %1 of the master has %2 bytes instead of %3; update the older of the two programs")
                     .arg(what)
                     .arg(status.st_size)
                     .arg(size);
    else
        return map(error);
    return false;
}

// ---- ring ----

std::uint32_t SharedRing::capacityFor(const FrameVolume &volume)
{
    const std::uint64_t needed = 2 * (std::uint64_t(volume.bytes) + LengthSize * volume.frames);
    std::uint64_t capacity = SmallestCapacity;
    while (capacity < needed)
        capacity *= 2;
    return capacity <= LargestCapacity ? std::uint32_t(capacity) : 0;
}

SharedRing::SharedRing(void *memory, std::uint32_t capacity)
    : m_header(static_cast<Header *>(memory))
    , m_bytes(static_cast<char *>(memory) + HeaderSize)
    , m_capacity(capacity)
{
    static_assert(sizeof(Header) == HeaderSize);
}

void SharedRing::write(std::uint32_t place, const char *bytes, std::uint32_t size) noexcept
{
    const std::uint32_t begin = place & (m_capacity - 1);
    const std::uint32_t first = std::min(size, m_capacity - begin);
    std::memcpy(m_bytes + begin, bytes, first);
    std::memcpy(m_bytes, bytes + first, size - first);
}

void SharedRing::read(std::uint32_t place, char *bytes, std::uint32_t size) const noexcept
{
    const std::uint32_t begin = place & (m_capacity - 1);
    const std::uint32_t first = std::min(size, m_capacity - begin);
    std::memcpy(bytes, m_bytes + begin, first);
    std::memcpy(bytes + first, m_bytes, size - first);
}

bool SharedRing::push(const char *frame, std::size_t size) noexcept
{
    const std::uint32_t tail = m_header->tail.load(std::memory_order_relaxed);
    const std::uint32_t used = tail - m_header->head.load(std::memory_order_acquire);
    if (used > m_capacity || size + LengthSize > m_capacity - used)
        return false;
    const auto length = std::uint32_t(size);
    char bytes[LengthSize];
    std::memcpy(bytes, &length, LengthSize);
    write(tail, bytes, LengthSize);
    write(tail + LengthSize, frame, length);
    m_header->tail.store(tail + LengthSize + length, std::memory_order_seq_cst);
    return true;
}

void SharedRing::wake() noexcept
{
    if (m_header->sleeping.load(std::memory_order_seq_cst) != 0)
        futexWake(&m_header->tail);
}

std::size_t SharedRing::pop(char *frame, std::size_t capacity) noexcept
{
    const std::uint32_t head = m_header->head.load(std::memory_order_relaxed);
    const std::uint32_t tail = m_header->tail.load(std::memory_order_acquire);
    const std::uint32_t used = tail - head;
    if (used < LengthSize)
        return 0;
    char bytes[LengthSize];
    std::uint32_t length = 0;
    read(head, bytes, LengthSize);
    std::memcpy(&length, bytes, LengthSize);
    if (used > m_capacity || length > used - LengthSize || length > capacity || length == 0) {
        m_header->head.store(tail, std::memory_order_release);  // nonsense: begin anew behind it
        return 0;
    }
    read(head + LengthSize, frame, length);
    m_header->head.store(head + LengthSize + length, std::memory_order_release);
    return length;
}

void SharedRing::wait() noexcept
{
    m_header->sleeping.store(1, std::memory_order_seq_cst);
    const std::uint32_t tail = m_header->tail.load(std::memory_order_seq_cst);
    if (tail == m_header->head.load(std::memory_order_relaxed))
        futexWait(&m_header->tail, tail, nullptr);
    m_header->sleeping.store(0, std::memory_order_relaxed);
}

// ---- channel ----

std::size_t SharedChannel::sizeFor(const CycleVolume &volume)
{
    return 2 * SharedRing::HeaderSize + SharedRing::capacityFor(volume.inputs)
        + SharedRing::capacityFor(volume.outputs);
}

bool SharedChannel::create(const CycleVolume &volume, QString *error)
{
    if (SharedRing::capacityFor(volume.inputs) == 0 || SharedRing::capacityFor(volume.outputs) == 0) {
        *error = QStringLiteral("the values of a cycle are too many for shared memory; use tcp");
        return false;
    }
    const bool isThere = m_memory.create(sizeFor(volume), error);
    divide(volume);
    return isThere;
}

bool SharedChannel::adopt(Descriptor descriptor, const CycleVolume &volume, QString *error)
{
    const bool isThere = m_memory.adopt(std::move(descriptor), QStringLiteral("channel"), sizeFor(volume), error);
    divide(volume);
    return isThere;
}

void SharedChannel::divide(const CycleVolume &volume)
{
    auto *memory = static_cast<char *>(m_memory.data());
    if (!memory)
        return;
    const std::uint32_t capacity = SharedRing::capacityFor(volume.inputs);
    inputs = SharedRing(memory, capacity);
    outputs = SharedRing(memory + SharedRing::HeaderSize + capacity, SharedRing::capacityFor(volume.outputs));
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
