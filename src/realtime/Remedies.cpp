// SPDX-License-Identifier: Apache-2.0
#include "Remedies.h"

#include <QtCore/QFile>

#include <cerrno>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

namespace qplc {

namespace {

QString program()
{
    const QString path = QFile::symLinkTarget(QStringLiteral("/proc/self/exe"));
    return path.isEmpty() ? QStringLiteral("PROGRAM") : path;
}

/// "20", "unlimited": the soft limit that `ulimit` shows, in units of \a unit.
QString softLimit(__rlimit_resource resource, rlim_t unit)
{
    rlimit limit{};
    getrlimit(resource, &limit);
    return limit.rlim_cur == RLIM_INFINITY ? QStringLiteral("unlimited") : QString::number(limit.rlim_cur / unit);
}

/// The three usual ways to a right: capability of the file, limit of the user, start by root.
QString grantRight(const QString &capability, const QString &ulimit, const QString &limitLine)
{
    return QStringLiteral(
               "sudo setcap %1+ep '%2'; or write '* - %3' to /etc/security/limits.d/99-realtime.conf and log in "
               "again (ulimit %4 now)")
        .arg(capability, program(), limitLine, ulimit);
}

}  // namespace

QString schedulingRemedy(Scheduling wanted, int error)
{
    if (error != EPERM)
        return QStringLiteral("choose another policy or priority; the system says: %1").arg(qt_error_string(error));
    if (!wanted.isRealTime())
        return QStringLiteral("start the program with the policy that it needs: chrt --other 0 '%1'").arg(program());
    if (geteuid() == 0) {
        return QStringLiteral(
            "give the container or control group the right to real time: docker run --cap-add=SYS_NICE "
            "--ulimit rtprio=99, or echo 950000 > /sys/fs/cgroup/cpu/GROUP/cpu.rt_runtime_us");
    }
    const QString limit = QStringLiteral("-r is %1").arg(softLimit(RLIMIT_RTPRIO, 1));
    const QString chrt = QStringLiteral("sudo chrt %1 %2 '%3'")
                             .arg(QLatin1String(wanted.policy == SCHED_RR ? "-r" : "-f"))
                             .arg(wanted.priority)
                             .arg(program());
    return QStringLiteral("%1; or start it by %2")
        .arg(grantRight(QStringLiteral("cap_sys_nice"), limit, QStringLiteral("rtprio %1").arg(wanted.priority)), chrt);
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

QString memoryLockRemedy(int error)
{
    if (error == 0)
        return QStringLiteral("build without sanitizers: mlockall() claimed success and locked nothing");
    const QString limit = QStringLiteral("-l is %1 kB").arg(softLimit(RLIMIT_MEMLOCK, 1024));
    return grantRight(QStringLiteral("cap_ipc_lock"), limit, QStringLiteral("memlock unlimited"));
}

QString stackRemedy()
{
    return QStringLiteral("set a smaller prefaultStack, or allow a larger stack: ulimit -s (%1 kB now)")
        .arg(softLimit(RLIMIT_STACK, 1024));
}

QString timerSlackRemedy()
{
    return QStringLiteral("run the thread with a real-time policy (chrt -f 49 '%1'), which has no timer slack")
        .arg(program());
}

}  // namespace qplc
