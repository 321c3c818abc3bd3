// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>

namespace qplc {

namespace messages {
struct RecorderEntry;
}

/// What the recorder of a ring says of itself.
struct RecorderReport
{
    enum State : std::uint32_t {
        None,       ///< it has said nothing
        Recording,  ///< cycles go into a file
        DiskFull,   ///< the disk has no room: it tries again each second
        Failing,    ///< the file cannot be written for another reason: it tries again each second
        Stopped     ///< somebody wants that nothing is recorded
    };

    State state = None;
    std::uint64_t bytesPerSecond = 0;  ///< written, over the last seconds
    std::uint64_t freeBytes = 0;       ///< of the disk
    QString file;                      ///< the newest one; of a long path, its end
    QString error;                     ///< the newest one; empty: there was none. Of a long one, its begin
};

/// A report as a master tells it, and back: missing cycles are not in it.
messages::RecorderEntry toEntry(const RecorderReport &report);
RecorderReport toReport(const messages::RecorderEntry &entry);

/// The place of a RecorderReport in the header of a ring: of a fixed size, for one writer and
/// readers in other processes. Neither waits for the other, also if one is killed meanwhile.
class RecorderReportPlace
{
public:
    void write(const RecorderReport &report) noexcept;
    /// Nothing: it is being written, or its writer was killed meanwhile.
    std::optional<RecorderReport> read() const;
    /// Another one after each write().
    std::uint64_t version() const noexcept { return m_version.load(std::memory_order_acquire); }

private:
    struct Bytes
    {
        std::uint64_t state = 0;
        std::uint64_t bytesPerSecond = 0;
        std::uint64_t freeBytes = 0;
        char file[512] = {};  // UTF-8, with a zero behind it
        char error[512] = {};
    };
    using Words = std::array<std::atomic<std::uint64_t>, sizeof(Bytes) / sizeof(std::uint64_t)>;
    static_assert(sizeof(Bytes) % sizeof(std::uint64_t) == 0);

    std::atomic<std::uint64_t> m_version{0};  // odd: it is being written
    Words m_words{};
};

}  // namespace qplc
