// SPDX-License-Identifier: Apache-2.0
#include "ProcessGroup.h"

#include <QtPlcCore>

#include <cstdio>

namespace awe {

ProcessGroup::~ProcessGroup()
{
    end(3000);
}

ChildProcess *ProcessGroup::start(const QString &program, const QStringList &arguments, Errors errors)
{
    m_processes.push_back(std::make_unique<ChildProcess>());
    ChildProcess *process = m_processes.back().get();
    process->setProcessChannelMode(errors == ShowErrors ? QProcess::ForwardedErrorChannel : QProcess::SeparateChannels);
    connect(process, qOverload<int, QProcess::ExitStatus>(&QProcess::finished), this,
            [this, program](int exitCode, QProcess::ExitStatus status) {
                Q_EMIT ended(program, status == QProcess::CrashExit ? -1 : exitCode);
            });
    process->start(ChildProcess::pathOf(program), arguments);
    if (process->waitForStarted(5000))
        return process;
    QPlcCoreApplication::printError(QStringLiteral("cannot start %1: %2; is it beside this program?")
                                        .arg(process->program(), process->errorString()));
    m_processes.pop_back();
    return nullptr;
}

void ProcessGroup::end(int milliseconds)
{
    for (const std::unique_ptr<ChildProcess> &process : m_processes) {
        process->disconnect(this);
        if (process->state() == QProcess::NotRunning)
            continue;
        process->terminate();
        if (!process->waitForFinished(milliseconds)) {
            process->kill();
            process->waitForFinished(milliseconds);
        }
    }
    for (const std::unique_ptr<ChildProcess> &process : m_processes)
        std::fputs(process->readAllStandardError().constData(), stderr);
    m_processes.clear();
}

}  // namespace awe
