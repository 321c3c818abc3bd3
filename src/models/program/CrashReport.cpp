// SPDX-License-Identifier: Apache-2.0
#include "CrashReport.h"

#include "models/FmuInstance.h"

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sys/syscall.h>
#include <unistd.h>
#include <utility>

namespace fmu {

namespace {

// Functions that a signal handler may call.
void write(const char *text)
{
    const ssize_t written = ::write(STDERR_FILENO, text, std::strlen(text));
    static_cast<void>(written);
}

[[noreturn]] void endNow(int code)
{
    for (;;)
        ::syscall(SYS_exit_group, code);
}

const char *nameOf(int signal)
{
    switch (signal) {
    case SIGSEGV:
        return "invalid access to memory, or its stack is full";
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
    endNow(1);
}

pid_t ownProcess = 0;  // a process that an FMU has forked may end as it likes

/// Does nothing unless an FMU has called \a function, in the thread of this call.
void tellEnd(const char *function)
{
    if (!qplc::FmuInstance::isCallingHere() || ::getpid() != ownProcess)
        return;
    write("qtplc_fmu: the FMU has ended the process in ");
    write(qplc::FmuInstance::lastCall());
    write(": it has called ");
    write(function);
    write("; tell the maker of the FMU\n");
    endNow(1);
}

}  // namespace

}  // namespace fmu

/// A function of the program comes before the one of the C library, also for the libraries of FMUs.
extern "C" [[noreturn]] __attribute__((visibility("default"))) void _exit(int code)
{
    fmu::tellEnd("_exit()");
    fmu::endNow(code);
}

extern "C" [[noreturn]] __attribute__((visibility("default"))) void _Exit(int code)
{
    fmu::tellEnd("_Exit()");
    fmu::endNow(code);
}

namespace fmu {

void CrashReport::install()
{
    ownProcess = ::getpid();
    std::atexit([] { tellEnd("exit()"); });
    std::at_quick_exit([] { tellEnd("quick_exit()"); });
    struct sigaction action
    {
    };
    action.sa_handler = tellCrash;
    action.sa_flags = SA_ONSTACK;
    sigemptyset(&action.sa_mask);
    for (int signal : {SIGSEGV, SIGFPE, SIGILL, SIGBUS, SIGABRT})
        ::sigaction(signal, &action, nullptr);
    std::signal(SIGALRM, tellHang);
    coverThread();
}

void CrashReport::coverThread() noexcept
{
    static thread_local std::array<char, 32768> room;
    static thread_local bool isCovered = false;
    if (std::exchange(isCovered, true))
        return;
    stack_t former{};
    if (::sigaltstack(nullptr, &former) != 0 || !(former.ss_flags & SS_DISABLE))
        return;  // somebody has thought of it already
    stack_t stack{};
    stack.ss_sp = room.data();
    stack.ss_size = room.size();
    ::sigaltstack(&stack, nullptr);
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
