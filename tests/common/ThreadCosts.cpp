// SPDX-License-Identifier: Apache-2.0
#include "ThreadCosts.h"

#include <atomic>
#include <cstdlib>
#include <dlfcn.h>
#include <pthread.h>
#include <sys/resource.h>

#if defined(QTPLC_CALLS_SANITIZED) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define QTPLC_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define QTPLC_SANITIZED
#endif
#endif

namespace {

thread_local ThreadCosts thisThread;
thread_local bool isWatched = false;
std::atomic<std::uint64_t> watchedAllocations{0};
std::atomic<std::uint64_t> watchedLocks{0};

[[maybe_unused]] void countAllocation()
{
    ++thisThread.allocations;
    if (isWatched)
        watchedAllocations.fetch_add(1, std::memory_order_relaxed);
}

[[maybe_unused]] void countLock()
{
    ++thisThread.locks;
    if (isWatched)
        watchedLocks.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

#ifndef QTPLC_SANITIZED
// These stand before glibc's and call them by the names that glibc gives them; operator new comes
// here, too.
// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp,readability-inconsistent-*)
extern "C" {
void *__libc_malloc(std::size_t size);
void *__libc_calloc(std::size_t count, std::size_t size);
void *__libc_realloc(void *memory, std::size_t size);
void *__libc_memalign(std::size_t alignment, std::size_t size);

void *malloc(std::size_t size)
{
    countAllocation();
    return __libc_malloc(size);
}

void *calloc(std::size_t count, std::size_t size)
{
    countAllocation();
    return __libc_calloc(count, size);
}

void *realloc(void *memory, std::size_t size)
{
    countAllocation();
    return __libc_realloc(memory, size);
}

void *aligned_alloc(std::size_t alignment, std::size_t size)
{
    countAllocation();
    return __libc_memalign(alignment, size);
}

int pthread_mutex_lock(pthread_mutex_t *mutex)
{
    static const auto next = reinterpret_cast<int (*)(pthread_mutex_t *)>(::dlsym(RTLD_NEXT, "pthread_mutex_lock"));
    countLock();
    return next(mutex);
}
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp,readability-inconsistent-*)
#endif

bool ThreadCosts::areCounted()
{
#ifdef QTPLC_SANITIZED
    return false;
#else
    return true;
#endif
}

ThreadCosts ThreadCosts::ofThisThread()
{
    rusage usage{};
    ::getrusage(RUSAGE_THREAD, &usage);
    ThreadCosts costs = thisThread;
    costs.pageFaults = std::uint64_t(usage.ru_minflt + usage.ru_majflt);
    return costs;
}

void ThreadCosts::watchThisThread()
{
    isWatched = true;
}

ThreadCosts ThreadCosts::ofWatchedThreads()
{
    return {watchedAllocations.load(), watchedLocks.load(), 0};
}
