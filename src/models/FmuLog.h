// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FmiFunctions.h"
#include "realtime/SpscRing.h"

#include <QtCore/QString>

#include <array>
#include <atomic>
#include <cstdarg>

namespace qplc {

/// What an FMU reports by its logger, from any of its threads, also within a cycle: kept in a ring,
/// and printed by the thread of its node. It never waits: lines that find no place are counted.
class FmuLog
{
public:
    static constexpr std::size_t Capacity = 256;

    struct Line
    {
        int status = fmi::Ok;
        std::array<char, 32> category{};
        std::array<char, 472> text{};  // longer ones are cut
    };

    /// Adds a line, by any thread.
    void add(int status, const char *category, const char *text) noexcept;
    /// As add(), with the format of printf().
    void addFormatted(int status, const char *category, const char *format, std::va_list arguments) noexcept;

    /// The oldest line. By one thread. \return false when there is none
    bool take(Line *line) noexcept { return m_lines.pop(line); }
    /// How many lines were lost since the last call. By the same thread.
    quint64 takeLost() noexcept { return m_lost.exchange(0, std::memory_order_relaxed); }
    /// The last line that was more than an information; empty: there was none.
    QString lastComplaint();
    void forgetComplaint();

    /// "warning: text (category)", fit to be shown
    static QString textOf(const Line &line);

private:
    /// Only one thread at a time adds lines; another one does not wait for it.
    class Turn;

    SpscRing<Line> m_lines{Capacity};
    std::atomic_flag m_busy = ATOMIC_FLAG_INIT;
    std::atomic<quint64> m_lost{0};
    Line m_complaint;
};

}  // namespace qplc
