// SPDX-License-Identifier: Apache-2.0
#include "SlaveProcesses.h"

#include <csignal>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

bool SlaveProcesses::start(const QStringList &arguments)
{
    std::vector<QByteArray> texts{"qtplc_cycle_bench"};
    for (const QString &argument : arguments)
        texts.push_back(argument.toLocal8Bit());
    std::vector<char *> pointers;
    for (QByteArray &text : texts)
        pointers.push_back(text.data());
    pointers.push_back(nullptr);
    const pid_t process = ::fork();
    if (process == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        ::execv("/proc/self/exe", pointers.data());
        ::_exit(127);
    }
    if (process > 0)
        m_ids.append(process);
    return process > 0;
}

bool SlaveProcesses::allAlive() const
{
    for (const qint64 process : m_ids) {
        siginfo_t ended{};
        ::waitid(P_PID, id_t(process), &ended, WEXITED | WNOHANG | WNOWAIT);
        if (ended.si_pid != 0)
            return false;
    }
    return true;
}

SlaveProcesses::~SlaveProcesses()
{
    // The kernel may spin for a child that shares the core of a real-time process: leave real time
    // first.
    const sched_param ordinary{};
    ::sched_setscheduler(0, SCHED_OTHER, &ordinary);
    for (const qint64 process : qAsConst(m_ids))
        ::kill(pid_t(process), SIGKILL);
    for (const qint64 process : qAsConst(m_ids))
        ::waitpid(pid_t(process), nullptr, 0);
}
