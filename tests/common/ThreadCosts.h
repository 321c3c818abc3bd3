// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

/// What a thread has cost that a cycle must not: allocations and locked mutexes. The functions of
/// the C library are replaced for the whole program, so everything below C++ and Qt is seen, too.
struct ThreadCosts
{
    std::uint64_t allocations = 0;  // malloc() and its like
    std::uint64_t locks = 0;        // pthread_mutex_lock() and its like
    std::uint64_t pageFaults = 0;   // minor and major

    /// false under a sanitizer, which owns the functions of the C library.
    static bool areCounted();
    /// Of the calling thread, since it began.
    static ThreadCosts ofThisThread();

    /// From now on the calling thread counts for ofWatchedThreads(); a second call of a thread does
    /// nothing.
    static void watchThisThread();
    /// Of all watched threads, since each was watched: allocations and locks only.
    static ThreadCosts ofWatchedThreads();

    ThreadCosts operator-(const ThreadCosts &before) const
    {
        return {allocations - before.allocations, locks - before.locks, pageFaults - before.pageFaults};
    }
};
