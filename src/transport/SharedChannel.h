// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Descriptor.h"
#include "FrameVolume.h"

#include <QtCore/QString>

#include <atomic>
#include <cstdint>
#include <memory>

namespace qplc {

/// Memory that processes of one machine share. The kernel frees it with the last process that uses
/// it: nothing is left behind, whoever crashes.
class SharedMemory
{
public:
    SharedMemory() = default;
    ~SharedMemory();
    SharedMemory(const SharedMemory &) = delete;
    SharedMemory &operator=(const SharedMemory &) = delete;

    /// New memory of \a size bytes, all 0. \return false, with the reason in \a error
    bool create(std::size_t size, QString *error);
    /// Memory that another process has created and passed as \a descriptor: only if it has this
    /// size, and is sealed so that it keeps it.
    /// \param what  name of the memory in the reason \return false, with the reason in \a error
    bool adopt(Descriptor descriptor, const QString &what, std::size_t size, QString *error);
    /// To be passed to other processes.
    int descriptor() const { return m_descriptor.number(); }
    void *data() const { return m_data; }

private:
    bool map(QString *error);
    Descriptor m_descriptor;
    std::size_t m_size = 0;
    void *m_data = nullptr;
};

/// A queue of frames from one process to one other, in memory that both share. Trusts no number
/// that the other process has written: at worst frames are lost.
class SharedRing
{
public:
    static constexpr std::uint32_t SmallestCapacity = 64 * 1024;  // [byte]
    static constexpr std::size_t HeaderSize = 128;
    /// [byte] for the frames of two cycles: a power of two. 0: they are too many
    static std::uint32_t capacityFor(const FrameVolume &volume);

    SharedRing() = default;
    /// \param memory  HeaderSize + \a capacity bytes, aligned to 64, 0 at first
    SharedRing(void *memory, std::uint32_t capacity);

    /// \return false when there is no room. Producer only.
    bool push(const char *frame, std::size_t size) noexcept;
    /// Wakes the consumer if it sleeps. Producer only, after one or several push().
    void wake() noexcept;
    /// Copies the oldest frame into \a frame. \return its size, 0 when there is none. Consumer
    /// only.
    std::size_t pop(char *frame, std::size_t capacity) noexcept;
    /// Waits for a frame, or until a signal interrupts it. Consumer only.
    void wait() noexcept;

private:
    struct Header
    {
        alignas(64) std::atomic<std::uint32_t> head;  // consumer: bytes taken, modulo 2^32
        std::atomic<std::uint32_t> sleeping;
        alignas(64) std::atomic<std::uint32_t> tail;  // producer: bytes given, modulo 2^32
    };
    void write(std::uint32_t place, const char *bytes, std::uint32_t size) noexcept;
    void read(std::uint32_t place, char *bytes, std::uint32_t size) const noexcept;

    Header *m_header = nullptr;
    char *m_bytes = nullptr;
    std::uint32_t m_capacity = 0;
};

/// Both directions between a master and one node, with room for what travels in a cycle.
class SharedChannel
{
public:
    /// \return false, with the reason in \a error
    bool create(const CycleVolume &volume, QString *error);
    /// As SharedMemory::adopt().
    bool adopt(Descriptor descriptor, const CycleVolume &volume, QString *error);
    int descriptor() const { return m_memory.descriptor(); }
    static std::size_t sizeFor(const CycleVolume &volume);

    SharedRing inputs;   // master -> node
    SharedRing outputs;  // node -> master

private:
    void divide(const CycleVolume &volume);

    SharedMemory m_memory;
};

/// How nodes wake their master: it says how many answers it waits for, and only the last of them
/// wakes it.
class Doorbell
{
public:
    /// One answer is there. Any node. \param pipe  rung when the master sleeps in poll()
    void ring(int pipe) noexcept;

    // The master only.
    /// Answers that have rung so far, modulo 2^32.
    std::uint32_t count() const noexcept { return m_count.load(); }
    /// To be woken when count() has come this far.
    void want(std::uint32_t count) noexcept { m_wanted.store(count); }
    /// Waits for that, at most \a timeout [ns]; may end before.
    void sleep(std::int64_t timeout) noexcept;
    /// From now on the pipe is rung. \return false when there is no need to sleep
    bool beginPoll() noexcept;
    void endPoll() noexcept { m_sleeping.store(Awake); }

private:
    enum Sleeping : std::uint32_t { Awake, InFutex, InPoll };
    bool isWanted(std::uint32_t count) const noexcept { return std::int32_t(count - m_wanted.load()) >= 0; }

    alignas(64) std::atomic<std::uint32_t> m_count{0};
    std::atomic<std::uint32_t> m_wanted{0};
    std::atomic<std::uint32_t> m_sleeping{Awake};
};

// What docs/protocol.md says of the memory.
static_assert(sizeof(Doorbell) == 64);
static_assert(std::atomic<std::uint32_t>::is_always_lock_free, "processes share these");

}  // namespace qplc
