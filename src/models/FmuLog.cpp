// SPDX-License-Identifier: Apache-2.0
#include "FmuLog.h"

#include "signals/MessageText.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace qplc {

namespace {

template<std::size_t N>
void copyText(std::array<char, N> *to, const char *from) noexcept
{
    const std::size_t size = from ? ::strnlen(from, N - 1) : 0;
    std::memcpy(to->data(), from ? from : "", size);
    (*to)[size] = '\0';
}

}  // namespace

class FmuLog::Turn
{
public:
    explicit Turn(FmuLog *log) noexcept
        : m_log(log->m_busy.test_and_set(std::memory_order_acquire) ? nullptr : log)
    {
        if (!m_log)
            log->m_lost.fetch_add(1, std::memory_order_relaxed);
    }
    ~Turn()
    {
        if (m_log)
            m_log->m_busy.clear(std::memory_order_release);
    }
    Turn(const Turn &) = delete;
    Turn &operator=(const Turn &) = delete;
    /// The place of the line that is filled next.
    Line *begin(int status, const char *category) noexcept
    {
        if (!m_log)
            return nullptr;
        Line *line = m_log->m_lines.beginPush();
        m_isInRing = line != nullptr;
        if (!m_isInRing)
            m_log->m_lost.fetch_add(1, std::memory_order_relaxed);
        if (!m_isInRing && status == fmi::Ok)
            return nullptr;
        line = m_isInRing ? line : &m_log->m_complaint;
        line->status = status;
        copyText(&line->category, category);
        return line;
    }
    void end(const Line &line) noexcept
    {
        if (line.status != fmi::Ok && m_isInRing)
            m_log->m_complaint = line;
        if (m_isInRing)
            m_log->m_lines.commitPush();
    }

private:
    FmuLog *m_log;
    bool m_isInRing = false;
};

void FmuLog::add(int status, const char *category, const char *text) noexcept
{
    Turn turn(this);
    if (Line *line = turn.begin(status, category)) {
        copyText(&line->text, text);
        turn.end(*line);
    }
}

void FmuLog::addFormatted(int status, const char *category, const char *format, std::va_list arguments) noexcept
{
    Turn turn(this);
    if (Line *line = turn.begin(status, category)) {
        line->text[0] = '\0';
        if (format)
            std::vsnprintf(line->text.data(), line->text.size(), format, arguments);
        turn.end(*line);
    }
}

QString FmuLog::lastComplaint()
{
    const Turn turn(this);
    return m_complaint.status == fmi::Ok ? QString() : printable(QString::fromUtf8(m_complaint.text.data()).trimmed());
}

void FmuLog::forgetComplaint()
{
    const Turn turn(this);
    m_complaint.status = fmi::Ok;
}

QString FmuLog::textOf(const Line &line)
{
    constexpr const char *names[] = {"", "warning: ", "discarded: ", "error: ", "fatal error: ", ""};
    const QString category = QString::fromUtf8(line.category.data());
    const QString kind = QString::fromLatin1(names[std::clamp(line.status, 0, 5)]);
    const QString text = printable(QString::fromUtf8(line.text.data()).trimmed());
    return category.isEmpty() ? kind + text : QStringLiteral("%1%2 (%3)").arg(kind, text, printable(category));
}

}  // namespace qplc
