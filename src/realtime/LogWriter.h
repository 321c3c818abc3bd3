// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QtGlobal>

#include <memory>

class QMessageLogContext;
class QString;

namespace qplc {

/// Where the lines of a LogWriter go. Only the thread of the writer uses it.
class LogOutput
{
public:
    virtual ~LogOutput() = default;
    /// A message of one or more lines as this output has it, with the last end of line.
    virtual QByteArray linesOf(QtMsgType type, QByteArray text) const;
    /// Writes a line with its end, however long that takes. An output that cannot be written to
    /// loses it.
    virtual void write(const QByteArray &line) = 0;
    /// What stands in the place of lines that were dropped; empty: nothing.
    virtual QByteArray gapText(quint64 dropped) const;
    /// All lines are written. \return [ms] until it is called again, if no line comes before; 0: it
    /// is not
    virtual int rest() { return 0; }
};

/// Writes lines on a thread of its own, so that nobody waits for their reader: a terminal that was
/// stopped with Ctrl-S, a journal that stands still, a pipe that is full, a disk that hangs.
///
/// What the reader does not take waits here, up to mostBytes; further lines are dropped, and a line
/// in their place tells how many. The thread has ordinary scheduling even in a program that was
/// started by `chrt`. Where the system makes no thread, write() writes itself.
/// \threadsafe yes
class LogWriter
{
public:
    static constexpr int mostBytes = 1 << 20;
    static constexpr int patience = 1000;  // [ms] for what has not been written when a program ends

    /// \param descriptor  stays open; the writer does not own it
    explicit LogWriter(int descriptor);
    explicit LogWriter(std::unique_ptr<LogOutput> output);
    /// Waits for a reader that reads, but not longer than patience.
    ~LogWriter();
    LogWriter(const LogWriter &) = delete;
    LogWriter &operator=(const LogWriter &) = delete;

    /// Takes a line with its end. Never waits for the reader.
    void write(const QByteArray &line);
    /// Takes a message of one or more lines, without the last end of line. If the descriptor is the
    /// journal of systemd, each line gets the severity.
    void write(QtMsgType type, const QByteArray &text);
    /// Waits until all has been written. \return false: it took longer than \a milliseconds
    bool flush(int milliseconds);
    /// Lines that were dropped since the beginning.
    quint64 dropped() const;
    /// Lines that the output has taken since the beginning.
    quint64 written() const;

    /// The writer of the process for its standard error output: it lives as long as the process.
    static LogWriter &ofStandardError();
    /// From here on, ofStandardError() writes the messages of Qt (qWarning(), qCInfo()). A message
    /// handler that somebody else has installed stays.
    static void takeMessages();
    /// Waits for what has not been written, and lets Qt write messages itself again.
    static void releaseMessages();

private:
    struct State;
    static bool startThread(const std::shared_ptr<State> &state);
    std::shared_ptr<State> d;  // the thread has its own share: it may never return from write()
};

}  // namespace qplc
