// SPDX-License-Identifier: Apache-2.0
#include "Program.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QDeadlineTimer>
#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QThread>

#include <algorithm>
#include <csignal>
#include <unistd.h>

Program::Program(const QString &path, const QStringList &arguments, int terminal)
    : m_terminal(terminal)
{
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    for (const char *variable : {"QT_LOGGING_RULES", "QT_MESSAGE_PATTERN", "NO_COLOR"})
        environment.remove(QString::fromLatin1(variable));
    setProcessEnvironment(environment);
    start(path, arguments);
    waitForStarted(patience);
}

Program::~Program()
{
    if (state() == NotRunning)
        return;
    kill();
    waitForFinished(patience);
}

void Program::setupChildProcess()
{
    if (m_terminal >= 0)
        ::dup2(m_terminal, STDERR_FILENO);
}

void Program::read()
{
    m_output += readAllStandardOutput();
    m_errors += readAllStandardError();
}

bool Program::waitFor(const QByteArray &channel, const QString &text)
{
    const QByteArray wanted = text.toUtf8();
    const QDeadlineTimer deadline(patience);
    read();
    while (!channel.contains(wanted) && state() != NotRunning && !deadline.hasExpired()) {
        waitForReadyRead(20);  // one channel only; the other one is read beside
        read();
    }
    return channel.contains(wanted);
}

int Program::waitForEnd(int milliseconds)
{
    if (state() != NotRunning && !waitForFinished(milliseconds))
        return -2;
    read();
    return exitStatus() == NormalExit ? exitCode() : -1;
}

void Program::sendSignal(int number)
{
    if (processId() > 0)
        ::kill(pid_t(processId()), number);
}

Outcome runProgram(const QString &path, const QStringList &arguments)
{
    Program program(path, arguments);
    const int exitCode = program.waitForEnd();
    return {exitCode, program.output(), program.errors()};
}

namespace {

/// State letter and parent of a process from /proc; 'X' when there is none.
struct ProcessStatus
{
    char state = 'X';
    qint64 parent = 0;
};

ProcessStatus statusOf(qint64 pid)
{
    QFile file(QStringLiteral("/proc/%1/stat").arg(pid));
    if (!file.open(QIODevice::ReadOnly))
        return {};
    const QByteArray text = file.readAll();
    const QList<QByteArray> fields = text.mid(text.lastIndexOf(')') + 2).split(' ');
    return fields.size() > 1 ? ProcessStatus{fields.at(0).at(0), fields.at(1).toLongLong()} : ProcessStatus{};
}

}  // namespace

QList<qint64> childrenOf(qint64 parent)
{
    QList<qint64> children;
    const QStringList entries = QDir(QStringLiteral("/proc")).entryList(QDir::Dirs | QDir::NoDotAndDotDot);
    for (const QString &entry : entries) {
        const qint64 pid = entry.toLongLong();
        if (pid > 0 && statusOf(pid).parent == parent && isRunning(pid))
            children << pid;
    }
    return children;
}

QByteArray nameOf(qint64 pid)
{
    QFile file(QStringLiteral("/proc/%1/cmdline").arg(pid));
    return file.open(QIODevice::ReadOnly) ? file.readAll().split('\0').constFirst().split('/').constLast()
                                          : QByteArray();
}

qint64 childNamed(const QByteArray &name)
{
    for (qint64 pid : childrenOf(QCoreApplication::applicationPid())) {
        if (nameOf(pid) == name)
            return pid;
    }
    return 0;
}

bool isRunning(qint64 pid)
{
    const char state = statusOf(pid).state;
    return state != 'X' && state != 'Z';
}

QList<qint64> stillRunning(const QList<qint64> &pids)
{
    const QDeadlineTimer deadline(Program::patience);
    QList<qint64> running = pids;
    while (!running.isEmpty() && !deadline.hasExpired()) {
        running.erase(std::remove_if(running.begin(), running.end(), [](qint64 pid) { return !isRunning(pid); }),
                      running.end());
        if (!running.isEmpty())
            QThread::msleep(10);
    }
    return running;
}
