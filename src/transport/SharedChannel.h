// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <atomic>
#include <cstdint>
#include <memory>
#include <sys/types.h>

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
    /// The memory that another process has made and calls \a path: only if it is sealed and belongs
    /// to \a owner, see PeerFile.
    /// \param what  name of the memory in the reason \return false, with the reason in \a error
    bool open(const QString &path, const QString &what, std::size_t size, uid_t owner, QString *error);
    /// What other processes of the same user find this memory under, while it exists here:
    /// "/proc/4711/fd/9".
    QString path() const;
    void *data() const { return m_data; }

private:
    bool map(QString *error);
    int m_descriptor = -1;
    std::size_t m_size = 0;
    void *m_data = nullptr;
};

/// A queue of frames from one process to one other. Trusts no number that the other process has
/// written: at worst frames are lost.
class SharedRing
{
public:
    static constexpr std::uint32_t Capacity = 64 * 1024;  // [byte]

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
    void write(std::uint32_t place, const char *bytes, std::uint32_t size) noexcept;
    void read(std::uint32_t place, char *bytes, std::uint32_t size) const noexcept;

    alignas(64) std::atomic<std::uint32_t> m_head{0};  // consumer: bytes taken, modulo 2^32
    std::atomic<std::uint32_t> m_sleeping{0};
    alignas(64) std::atomic<std::uint32_t> m_tail{0};  // producer: bytes given, modulo 2^32
    alignas(64) char m_bytes[Capacity];
};

/// Both directions between a master and one node.
struct SharedChannel
{
    SharedRing inputs;   // master -> node
    SharedRing outputs;  // node -> master
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
static_assert(sizeof(SharedRing) == 65664 && sizeof(SharedChannel) == 2 * 65664 && sizeof(Doorbell) == 64);
static_assert(std::atomic<std::uint32_t>::is_always_lock_free, "processes share these");

}  // namespace qplc
