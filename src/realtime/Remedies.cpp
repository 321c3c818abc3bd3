// SPDX-License-Identifier: Apache-2.0
#include "Remedies.h"

#include <QtCore/QFile>
#include <QtCore/QHash>
#include <QtCore/QSysInfo>

#include <cerrno>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

namespace qplc {

namespace {

/// "20", "unlimited": the soft limit that `ulimit` shows, in units of \a unit.
QString softLimit(__rlimit_resource resource, rlim_t unit)
{
    rlimit limit{};
    getrlimit(resource, &limit);
    return limit.rlim_cur == RLIM_INFINITY ? QStringLiteral("unlimited") : QString::number(limit.rlim_cur / unit);
}

/// The three usual ways to a right: capability of the file, limit of the user, start by root.
QString grantRight(const QString &program, const QString &capability, const QString &ulimit, const QString &limitLine)
{
    return QStringLiteral(
               "sudo setcap %1+ep '%2'; or write '* - %3' to /etc/security/limits.d/99-realtime.conf and log in "
               "again (ulimit %4 now)")
        .arg(capability, program, limitLine, ulimit);
}

}  // namespace

QString thisProgram()
{
    const QString path = QFile::symLinkTarget(QStringLiteral("/proc/self/exe"));
    return path.isEmpty() ? QStringLiteral("PROGRAM") : path;
}

QString schedulingRemedy(Scheduling wanted, int error, const QString &program)
{
    if (error != EPERM)
        return QStringLiteral("choose another policy or priority; the system says: %1").arg(qt_error_string(error));
    if (!wanted.isRealTime())
        return QStringLiteral("start the program with the policy that it needs: chrt --other 0 '%1'").arg(program);
    if (geteuid() == 0) {
        return QStringLiteral(
            "give the container or control group the right to real time: docker run --cap-add=SYS_NICE "
            "--ulimit rtprio=99, or echo 950000 > /sys/fs/cgroup/cpu/GROUP/cpu.rt_runtime_us");
    }
    const QString limit = QStringLiteral("-r is %1").arg(softLimit(RLIMIT_RTPRIO, 1));
    const QString chrt = QStringLiteral("sudo chrt %1 %2 '%3'")
                             .arg(QLatin1String(wanted.policy == SCHED_RR ? "-r" : "-f"))
                             .arg(wanted.priority)
                             .arg(program);
    return QStringLiteral("%1; or start it by %2")
        .arg(grantRight(program, QStringLiteral("cap_sys_nice"), limit,
                        QStringLiteral("rtprio %1").arg(wanted.priority)),
             chrt);
}

QString inheritanceRemedy()
{
    return QStringLiteral("start the program by chrt without --reset-on-fork (-R), or set the policy in the options");
}

QString cpuRemedy(const QString &allowed)
{
    return QStringLiteral(
               "use one of the processors %1; lscpu -e shows which are there, taskset -p %2 which are allowed")
        .arg(allowed)
        .arg(getpid());
}

QString memoryLockRemedy(int error, const QString &program)
{
    if (error == 0)
        return QStringLiteral("build without sanitizers: mlockall() claimed success and locked nothing");
    const QString limit = QStringLiteral("-l is %1 KiB").arg(softLimit(RLIMIT_MEMLOCK, 1024));
    return grantRight(program, QStringLiteral("cap_ipc_lock"), limit, QStringLiteral("memlock unlimited"));
}

QString heapRemedy()
{
    return QStringLiteral(
               "set a smaller heapReserve (0: none), or allow a larger heap: ulimit [KiB] -d is %1, -v is %2; "
               "only the C library of GNU without sanitizers has a reserve")
        .arg(softLimit(RLIMIT_DATA, 1024), softLimit(RLIMIT_AS, 1024));
}

QString stackRemedy()
{
    return QStringLiteral("set a smaller prefaultStack, or allow a larger stack: ulimit -s (%1 KiB now)")
        .arg(softLimit(RLIMIT_STACK, 1024));
}

QString timerSlackRemedy()
{
    return QStringLiteral("run the thread with a real-time policy (chrt -f 49 '%1'), which has no timer slack")
        .arg(thisProgram());
}

QString kernelRemedy()
{
    static const QHash<QString, QString> packages{{QStringLiteral("x86_64"), QStringLiteral("amd64")},
                                                  {QStringLiteral("arm64"), QStringLiteral("arm64")},
                                                  {QStringLiteral("arm"), QStringLiteral("armmp")},
                                                  {QStringLiteral("i386"), QStringLiteral("686-pae")}};
    const QString machine = QSysInfo::currentCpuArchitecture();
    return QStringLiteral("sudo apt install linux-image-rt-%1, and start that kernel")
        .arg(packages.value(machine, QStringLiteral("ARCHITECTURE")));
}

QString idleLatencyRemedy(int error)
{
    if (error == ENOENT)
        return QStringLiteral(
            "this kernel has no /dev/cpu_dma_latency: sudo modprobe cpuidle, or use a kernel with CONFIG_CPU_IDLE");
    return QStringLiteral("sudo setfacl -m u:$USER:rw /dev/cpu_dma_latency (until the next start), or run it as root");
}

QString governorRemedy()
{
    return QStringLiteral("echo performance | sudo tee /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor");
}

QString idleStateRemedy(int longestExit)
{
    return QStringLiteral("sudo cpupower idle-set --disable-by-latency %1 (package linux-cpupower)").arg(longestExit);
}

QString clockSourceRemedy(bool hasTsc)
{
    return hasTsc
        ? QStringLiteral("echo tsc | sudo tee /sys/devices/system/clocksource/clocksource0/current_clocksource")
        : QStringLiteral("see why the kernel has dropped the time stamp counter: sudo dmesg | grep -i tsc");
}

QString realTimeShareRemedy()
{
    return QStringLiteral(
        "sudo sysctl kernel.sched_rt_runtime_us=950000, and the same line in a file of /etc/sysctl.d; with -1 nothing "
        "stops a cycle that hangs");
}

QString swapRemedy()
{
    return QStringLiteral("sudo swapoff -a, or let programs lock their memory");
}

QString latencyRemedy()
{
    return QStringLiteral(
        "see what else has the processors: ps -eo pcpu,rtprio,args --sort=-pcpu | head; keep one free "
        "for the cycle by the kernel option isolcpus=N, and use it by --cpu N");
}

QString loopbackRemedy()
{
    return QStringLiteral("sudo ip link set lo up; see what is filtered: sudo nft list ruleset");
}

}  // namespace qplc
