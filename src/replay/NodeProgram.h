// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QProcess>
#include <QtCore/QStringList>

#include <memory>

namespace qplc {

/// The program of a node, as a process of its own. What it writes to its error output is seen; the
/// rest is not.
class NodeProgram
{
public:
    ~NodeProgram() { end(); }

    /// Whether \a command has the option --security.
    static bool isSecured(const QString &command);
    /// \param command  the program and its arguments, as in a shell; the option --master is added
    bool start(const QString &command, const QString &master, QString *error);
    bool hasEnded() const { return !m_process || m_process->state() == QProcess::NotRunning; }
    /// How it has ended.
    QString endText() const;
    /// Lets it end by itself, as it does when its master has ended, and ends it otherwise.
    void end();

private:
    std::unique_ptr<QProcess> m_process;
};

}  // namespace qplc
