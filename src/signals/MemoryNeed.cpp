// SPDX-License-Identifier: Apache-2.0
#include "MemoryNeed.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cinttypes>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <new>
#include <sys/resource.h>
#include <unistd.h>

namespace qplc {

namespace {

thread_local const MemoryNeed *innermostNeed = nullptr;
std::terminate_handler formerHandler = nullptr;

/// [MB] of addresses that the program has; 0: unknown. Takes no memory.
std::uint64_t usedMegabytes() noexcept
{
    std::array<char, 32> text = {};
    const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    const ssize_t size = file < 0 ? 0 : ::read(file, text.data(), text.size() - 1);
    if (file >= 0)
        ::close(file);
    return size > 0 ? std::strtoull(text.data(), nullptr, 10) * std::uint64_t(::sysconf(_SC_PAGESIZE)) / 1'000'000 : 0;
}

bool isOutOfMemory() noexcept
{
    try {
        if (const std::exception_ptr thrown = std::current_exception())
            std::rethrow_exception(thrown);
    } catch (const std::bad_alloc &) {
        return true;
    } catch (...) {
        return false;
    }
    return false;
}

}  // namespace

/// The message, made in memory that is there.
struct MemoryText
{
    MemoryText() noexcept
    {
        add("%s: out of memory", program_invocation_short_name);
        if (innermostNeed && innermostNeed->m_bytes > 0)
            add(" for %s, which needs at least %" PRIu64 " bytes", innermostNeed->m_what, innermostNeed->m_bytes);
        else if (innermostNeed)
            add(" for %s", innermostNeed->m_what);
        add("; the program has %" PRIu64 " MB of addresses", usedMegabytes());
        rlimit limit = {};
        const bool isLimited = ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
        if (isLimited)
            add(", and may have %" PRIu64 " MB; raise the limit (ulimit -v, LimitAS= of a service)",
                std::uint64_t(limit.rlim_cur) / 1'000'000);
        else
            add("; end other programs, or raise the limit of its service (MemoryMax=)");
        add("%s%s\n", innermostNeed ? ", or " : "", innermostNeed ? innermostNeed->m_remedy : "");
    }
    [[gnu::format(printf, 2, 3)]] void add(const char *format, ...) noexcept
    {
        va_list values;
        va_start(values, format);
        const int added = std::vsnprintf(text.data() + size, text.size() - std::size_t(size), format, values);
        va_end(values);
        size = std::min(size + std::max(added, 0), int(text.size()) - 1);
    }

    std::array<char, 512> text = {};
    int size = 0;
};

namespace {

void endWithMessage()
{
    if (!isOutOfMemory())
        formerHandler();
    const MemoryText message;
    (void)!::write(STDERR_FILENO, message.text.data(), std::size_t(message.size));
    ::_exit(EXIT_FAILURE);
}

}  // namespace

MemoryNeed::MemoryNeed(const char *what, std::uint64_t bytes, const char *remedy) noexcept
    : m_what(what)
    , m_bytes(bytes)
    , m_remedy(remedy)
    , m_outer(innermostNeed)
{
    innermostNeed = this;
}

MemoryNeed::~MemoryNeed()
{
    innermostNeed = m_outer;
}

void MemoryNeed::tellAtTheEnd() noexcept
{
    const std::terminate_handler present = std::set_terminate(&endWithMessage);
    if (present != &endWithMessage)
        formerHandler = present;
}

}  // namespace qplc
