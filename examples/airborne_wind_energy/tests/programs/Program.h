// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QProcess>
#include <QtCore/QString>

/// A program under test. It is killed by its process id when the object goes, and waited for: no
/// test leaves one behind.
class Program : public QProcess
{
    Q_OBJECT
public:
    /// Starts the program of this path. \param terminal descriptor that becomes its standard error;
    /// -1: a pipe
    explicit Program(const QString &path, const QStringList &arguments, int terminal = -1);
    ~Program() override;

    /// Waits until its standard output, or error, holds \a text. \return false when it did not
    /// come, or the program ended
    bool waitForOutput(const QString &text) { return waitFor(m_output, text); }
    bool waitForErrors(const QString &text) { return waitFor(m_errors, text); }
    /// Waits for its end. \return the exit code; -1 when it crashed or was killed, -2 when it goes
    /// on
    int waitForEnd(int milliseconds = patience);
    void sendSignal(int number);

    /// All that it has written so far.
    QString output() { return read(), QString::fromUtf8(m_output); }
    QString errors() { return read(), QString::fromUtf8(m_errors); }

    static constexpr int patience = 20000;  // [ms], far more than a loaded machine needs

protected:
    void setupChildProcess() override;

private:
    void read();
    bool waitFor(const QByteArray &channel, const QString &text);

    QByteArray m_output;
    QByteArray m_errors;
    int m_terminal;
};

/// What became of a program that ends by itself.
struct Outcome
{
    int exitCode;
    QString output, errors;
};

/// Runs a program to its end.
Outcome runProgram(const QString &path, const QStringList &arguments);

/// Process ids of the programs that \a parent has started and that run.
QList<qint64> childrenOf(qint64 parent);
/// The name of its program, without its folder; empty when there is none.
QByteArray nameOf(qint64 pid);
/// The program of this name that this process has started; 0 when there is none.
qint64 childNamed(const QByteArray &name);
/// Whether the process runs; one that only waits to be buried does not.
bool isRunning(qint64 pid);
/// Waits until none of the processes runs. \return those that still do
QList<qint64> stillRunning(const QList<qint64> &pids);
