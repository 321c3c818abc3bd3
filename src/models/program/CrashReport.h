// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace fmu {

/// Tells which function of an FMU has crashed, or does not return, before the process ends.
class CrashReport
{
public:
    /// Watches for signals of a crash, and for functions that end the process. They still end it.
    static void install();
    /// Gives the calling thread a stack of its own for the message, because an FMU may have
    /// overflowed the usual one. Cheap from the second call on. install() does it for the main
    /// thread.
    static void coverThread() noexcept;
    /// Ends the process if it still runs after \a time; with 0 no longer. A handler of a signal may
    /// call it.
    static void endAfter(std::chrono::seconds time);
    /// Ends the process if the event loop of the main thread stands still for \a time, because it
    /// waits for an FMU that another thread has called. In the main thread an FMU has 30 times as
    /// long. Called again and again by that loop.
    static void expectAgainWithin(std::chrono::seconds time);
};

}  // namespace fmu
