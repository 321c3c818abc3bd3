// SPDX-License-Identifier: Apache-2.0
#include "RecorderReport.h"

#include "protocol/messages/State.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace qplc {

namespace {

using messages::RecorderState;

constexpr int MostReads = 16;

/// A state that is not here is that of a recorder that records.
constexpr std::pair<RecorderReport::State, RecorderState> states[]
    = {{RecorderReport::DiskFull, RecorderState::DiskFull},
       {RecorderReport::Failing, RecorderState::Failing},
       {RecorderReport::Stopped, RecorderState::Stopped}};

template<std::size_t Size>
void putText(const QByteArray &text, char (&place)[Size]) noexcept
{
    std::memcpy(place, text.constData(), std::min(std::size_t(text.size()), Size - 1));
}

/// Nothing that is read is trusted: there may be no zero.
template<std::size_t Size>
QString textIn(const char (&place)[Size])
{
    return QString::fromUtf8(place, int(::strnlen(place, Size)));
}

}  // namespace

messages::RecorderEntry toEntry(const RecorderReport &report)
{
    messages::RecorderEntry entry;
    entry.state = RecorderState::Recording;
    for (const auto &[own, told] : states) {
        if (own == report.state)
            entry.state = told;
    }
    entry.file = report.file;
    entry.bytesPerSecond = double(report.bytesPerSecond);
    entry.freeBytes = report.freeBytes;
    entry.error = report.error;
    return entry;
}

RecorderReport toReport(const messages::RecorderEntry &entry)
{
    RecorderReport report;
    report.state = RecorderReport::Recording;
    for (const auto &[own, told] : states) {
        if (told == entry.state)
            report.state = own;
    }
    report.bytesPerSecond = std::uint64_t(std::clamp(entry.bytesPerSecond, 0.0, 1e12));
    report.freeBytes = entry.freeBytes;
    report.file = entry.file;
    report.error = entry.error;
    return report;
}

void RecorderReportPlace::write(const RecorderReport &report) noexcept
{
    Bytes bytes;
    bytes.state = report.state;
    bytes.bytesPerSecond = report.bytesPerSecond;
    bytes.freeBytes = report.freeBytes;
    putText(report.file.toUtf8().right(int(sizeof bytes.file) - 1), bytes.file);
    putText(report.error.toUtf8(), bytes.error);
    std::uint64_t words[std::tuple_size_v<Words>];
    std::memcpy(words, &bytes, sizeof bytes);
    // Of a writer that was killed, it may be odd.
    const std::uint64_t version = m_version.load(std::memory_order_relaxed) | 1;
    m_version.store(version, std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_release);
    for (std::size_t i = 0; i < m_words.size(); ++i)
        m_words[i].store(words[i], std::memory_order_relaxed);
    m_version.store(version + 1, std::memory_order_release);
}

std::optional<RecorderReport> RecorderReportPlace::read() const
{
    for (int attempt = 0; attempt < MostReads; ++attempt) {
        const std::uint64_t before = version();
        std::uint64_t words[std::tuple_size_v<Words>];
        for (std::size_t i = 0; i < m_words.size(); ++i)
            words[i] = m_words[i].load(std::memory_order_relaxed);
        std::atomic_thread_fence(std::memory_order_acquire);
        if (before % 2 != 0 || m_version.load(std::memory_order_relaxed) != before)
            continue;
        Bytes bytes;
        std::memcpy(&bytes, words, sizeof bytes);
        const bool isKnown = bytes.state <= RecorderReport::Stopped;
        return RecorderReport{isKnown ? RecorderReport::State(bytes.state) : RecorderReport::None, bytes.bytesPerSecond,
                              bytes.freeBytes, textIn(bytes.file), textIn(bytes.error)};
    }
    return std::nullopt;
}

}  // namespace qplc
