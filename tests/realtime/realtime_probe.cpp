// SPDX-License-Identifier: Apache-2.0
// Starts one cycle thread with the options of the command line, prints a line for each setting and
// what the thread itself saw, and ends. Runs as a process of its own under chrt, without rights, or
// to its death.
#include "realtime/CycleThread.h"
#include "realtime/RealTimeSetup.h"

#include <QtCore/QStringList>

#include <cstdio>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace {

/// Takes all rights to real time away from this process.
void dropRights()
{
    const rlimit none{0, 0};
    setrlimit(RLIMIT_RTPRIO, &none);
    setrlimit(RLIMIT_MEMLOCK, &none);
    if (geteuid() == 0 && setuid(65534) != 0)
        std::fprintf(stderr, "setuid(65534) failed\n");
    prctl(PR_SET_DUMPABLE, 1UL, 0UL, 0UL, 0UL);  // for the leak checker
}

QPlcRealTimeOptions parse(const QStringList &arguments)
{
    QPlcRealTimeOptions options;
    const auto valueOf = [&arguments](const char *name) {
        const int at = arguments.indexOf(QLatin1String(name));
        return at < 0 ? -1 : arguments.value(at + 1).toInt();
    };
    if (valueOf("--fifo") >= 0) {
        options.policy = QPlcRealTimeOptions::Fifo;
        options.priority = valueOf("--fifo");
    }
    if (arguments.contains(QLatin1String("--other")))
        options.policy = QPlcRealTimeOptions::Other;
    options.lockMemory = arguments.contains(QLatin1String("--lock"));
    return options;
}

}  // namespace

int main(int argc, char **argv)
{
    QStringList arguments;
    for (int i = 1; i < argc; ++i)
        arguments += QString::fromLocal8Bit(argv[i]);
    if (arguments.contains(QLatin1String("--drop")))
        dropRights();

    qplc::CycleThread thread;
    qplc::Scheduling seen;
    const bool throws = arguments.contains(QLatin1String("--throw"));
    const bool started = thread.start(QStringLiteral("probe"), parse(arguments), [&seen, throws] {
        if (throws)
            throw std::runtime_error("body of the probe threw");
        seen = qplc::Scheduling::current();
    });
    if (!started) {
        std::fprintf(stderr, "%s\n", qPrintable(thread.errorString()));
        return 1;
    }
    thread.join();
    for (const QPlcRealTimeSetting &setting : thread.settings())
        std::printf("%s %s\n", setting.granted ? "granted" : "refused", qPrintable(setting.toString()));
    std::printf("seen %s\n", qPrintable(seen.toString()));
    return 0;
}
