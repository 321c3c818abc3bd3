// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "RecorderReport.h"
#include "transport/Descriptor.h"

#include <QtCore/QByteArray>
#include <QtCore/QString>

#include <atomic>
#include <cstdint>

namespace qplc {

/// How far records are written and read.
struct RingMarks
{
    alignas(64) std::atomic<std::uint64_t> head{0};  // writer: end of the newest record
    std::atomic<std::uint64_t> oldest{0};            // writer: begin of the oldest record that is whole
    alignas(64) std::atomic<std::uint64_t> read{0};  // recorder: end of what it has put to safety
    std::atomic<std::uint32_t> isRead{0};            // 1: somebody records
};
static_assert(sizeof(RingMarks) == 128);

/// Bytes of records, and how far they are written and read. It belongs to a RingMemory.
struct RingRegion
{
    RingMarks *marks = nullptr;
    char *bytes = nullptr;
    std::uint64_t capacity = 0;  // [byte], a power of two; 0: there are none

    /// Byte \a place of all that was written; behind it, one capacity of bytes may be read.
    char *at(std::uint64_t place) const { return bytes + (place & (capacity - 1)); }
};

/// The memory of a RecordRing, which outlives the process that writes it: a file of mode 0600 in
/// memory (/dev/shm), a page that says what it is, a description, the bytes of the records of
/// cycles, and those of the texts.
///
/// The bytes are mapped twice, one behind the other, so that a record never has to be cut. The
/// writer holds a lock on the file, and a recorder another one: the kernel releases them when
/// their process ends, whatever ends it.
class RingMemory
{
public:
    struct Header
    {
        static constexpr std::uint64_t Magic = 0x33474e4952504c51;  // "QLPRING3"

        std::uint64_t magic = 0;
        std::uint64_t capacity = 0;         // [byte] of records of cycles, a power of two
        std::uint32_t bytesAt = 0;          // [byte] where these begin in the file
        std::uint32_t descriptionSize = 0;  // [byte], right behind this header
        std::uint64_t textCapacity = 0;     // [byte] of texts, behind the records; a power of two, or 0: there are none
        std::int64_t startTime = 0;         // cycle 0 [ns since 1970]; 0: the clock is not timed
        std::atomic<std::uint32_t> wishes{0};  // how often somebody has wanted that the last seconds stay
        std::atomic<std::uint32_t> isCut{0};   // 1: a part of another ring, which nobody has recorded
        RingMarks cycles;
        RingMarks texts;
        RecorderReportPlace report;  // recorder
    };
    static_assert(sizeof(Header) == 1408);
    static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

    enum Lock : std::uint8_t { WriterLock = 0, RecorderLock = 1 };
    /// What somebody does with the ring of a file.
    enum Use : std::uint8_t {
        NoRing,           ///< it is none, of this version and user
        Alive,            ///< its writer has it open
        BeingRead,        ///< a recorder reads what a writer has left
        DeadAndRecorded,  ///< its writer has ended, and its recorder has not read all of it
        Dead              ///< its writer has ended, and nobody has recorded
    };

    RingMemory() = default;
    ~RingMemory();
    RingMemory(const RingMemory &) = delete;
    RingMemory &operator=(const RingMemory &) = delete;

    /// Makes the file, which appears complete and locked by the writer, or not at all. Every page
    /// is there afterwards, so that no write meets a page for the first time.
    /// \param file  path; empty: memory without a file, which ends with this object
    /// \param capacity [byte], a power of two of at least a page
    /// \param textCapacity [byte], the same, or 0
    bool create(const QByteArray &file, std::size_t capacity, const QByteArray &description, QString *error,
                std::size_t textCapacity = 0);
    /// As create(), but the file appears only with publish(): its bytes are there by then.
    bool createHidden(const QByteArray &file, std::size_t capacity, const QByteArray &description, QString *error,
                      std::size_t textCapacity = 0);
    bool publish(const QByteArray &file, QString *error);
    /// Opens a file that create() has made. Nothing in it is trusted.
    bool open(const QByteArray &file, QString *error);
    void close();

    Header *header() const { return m_header; }
    RingRegion cycles() const { return {&m_header->cycles, m_cycles, m_capacity}; }
    RingRegion texts() const { return {&m_header->texts, m_texts, m_textCapacity}; }
    std::uint64_t capacity() const { return m_capacity; }  // of the cycles
    QByteArray description() const;
    /// Where the file is; empty: there is none.
    QByteArray file() const { return m_file; }
    /// \return false when another one holds it
    bool lock(Lock lock) const;
    void unlock(Lock lock) const;
    /// Whether another one holds it.
    bool isLocked(Lock lock) const;
    /// Deletes the file, if it is still this one.
    void remove();

    /// Where rings are: /dev/shm; $QTPLC_RING_DIR, if it is set.
    static QByteArray folder();
    static Use useOf(const QByteArray &file);
    /// Whether a recorder has the ring of \a file. As useOf(), it maps nothing.
    static bool isRecorded(const QByteArray &file);
    /// Rings that this process has mapped so far, for tests. \threadsafe yes
    static std::uint64_t mappings() { return m_mappings.load(std::memory_order_relaxed); }

private:
    bool openFile(const QByteArray &file, Header *start, QString *error);
    bool map(QString *error);
    char *mapTwice(std::uint64_t place, std::uint64_t size) const;
    bool describe(const QByteArray &description, QString *error);

    Descriptor m_descriptor;
    Header *m_header = nullptr;
    char *m_cycles = nullptr;
    char *m_texts = nullptr;
    std::uint64_t m_capacity = 0;
    std::uint64_t m_textCapacity = 0;
    std::size_t m_headerSize = 0;
    QByteArray m_file;

    static std::atomic<std::uint64_t> m_mappings;
};

}  // namespace qplc
