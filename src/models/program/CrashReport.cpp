// SPDX-License-Identifier: Apache-2.0
#include "CrashReport.h"

#include "models/FmuInstance.h"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <unistd.h>

namespace fmu {

namespace {

// Functions that a signal handler may call.
void write(const char *text)
{
    const ssize_t written = ::write(STDERR_FILENO, text, std::strlen(text));
    static_cast<void>(written);
}

const char *nameOf(int signal)
{
    switch (signal) {
    case SIGSEGV:
        return "invalid access to memory";
    case SIGFPE:
        return "invalid arithmetic";
    case SIGILL:
        return "invalid instruction";
    case SIGBUS:
        return "bus error";
    default:
        return "it has aborted the process";
    }
}

void tellCrash(int signal)
{
    if (qplc::FmuInstance::isCalling()) {
        write("qtplc_fmu: the FMU has crashed in ");
        write(qplc::FmuInstance::lastCall());
        write(": ");
        write(nameOf(signal));
        write("; tell the maker of the FMU\n");
    }
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

constexpr int mostPatience = 30;
// Handlers of signals use them, too.
std::atomic<unsigned> patience{0};  // [s] of one alarm; 0: the process has to end
std::atomic<int> alarms{0};         // since the loop was there

void tellHang(int)
{
    if (patience > 0 && qplc::FmuInstance::isCallingHere() && ++alarms < mostPatience) {
        ::alarm(patience);
        return;
    }
    if (qplc::FmuInstance::isCalling()) {
        write("qtplc_fmu: the FMU does not return from ");
        write(qplc::FmuInstance::lastCall());
        write("; this process ends\n");
    } else {
        write("qtplc_fmu: the end takes too long; this process ends\n");
    }
    std::_Exit(1);
}

/// exit() calls this, in the thread that has called exit().
void tellExit()
{
    if (!qplc::FmuInstance::isCallingHere())
        return;
    write("qtplc_fmu: the FMU has ended the process in ");
    write(qplc::FmuInstance::lastCall());
    write(": it has called exit(); tell the maker of the FMU\n");
    std::_Exit(1);
}

}  // namespace

void CrashReport::install()
{
    std::atexit(tellExit);
    for (int signal : {SIGSEGV, SIGFPE, SIGILL, SIGBUS, SIGABRT})
        std::signal(signal, tellCrash);
    std::signal(SIGALRM, tellHang);
}

void CrashReport::endAfter(std::chrono::seconds time)
{
    patience = 0;
    ::alarm(static_cast<unsigned>(time.count()));
}

void CrashReport::expectAgainWithin(std::chrono::seconds time)
{
    patience = static_cast<unsigned>(time.count());
    alarms = 0;
    ::alarm(patience);
}

}  // namespace fmu
