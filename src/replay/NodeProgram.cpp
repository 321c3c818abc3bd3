// SPDX-License-Identifier: Apache-2.0
#include "NodeProgram.h"

#include <algorithm>

namespace qplc {

namespace {

constexpr int LongestStart = 10'000;  // [ms]
constexpr int LongestEnd = 5'000;     // [ms] by itself, and when it is asked to

}  // namespace

bool NodeProgram::isSecured(const QString &command)
{
    const QStringList words = QProcess::splitCommand(command);
    return std::any_of(words.begin(), words.end(), [](const QString &word) {
        return word == QLatin1String("--security") || word.startsWith(QLatin1String("--security="));
    });
}

bool NodeProgram::start(const QString &command, const QString &master, QString *error)
{
    end();
    const QStringList program = QProcess::splitCommand(command);
    if (program.isEmpty()) {
        *error = QStringLiteral("no program is given");
        return false;
    }
    m_process = std::make_unique<QProcess>();
    m_process->setProcessChannelMode(QProcess::ForwardedErrorChannel);
    m_process->setStandardOutputFile(QProcess::nullDevice());
    m_process->start(program.value(0), program.mid(1) + QStringList{QStringLiteral("--master"), master});
    if (m_process->waitForStarted(LongestStart))
        return true;
    *error = QStringLiteral("cannot start '%1': %2").arg(program.value(0), m_process->errorString());
    m_process.reset();
    return false;
}

QString NodeProgram::endText() const
{
    if (!m_process)
        return QStringLiteral("it was not started");
    return m_process->exitStatus() == QProcess::CrashExit ? QStringLiteral("it has crashed")
                                                          : QStringLiteral("exit code %1").arg(m_process->exitCode());
}

void NodeProgram::end()
{
    if (!m_process)
        return;
    if (!hasEnded() && !m_process->waitForFinished(LongestEnd)) {
        m_process->terminate();
        if (!m_process->waitForFinished(LongestEnd)) {
            m_process->kill();
            m_process->waitForFinished(LongestEnd);
        }
    }
    m_process.reset();
}

}  // namespace qplc
