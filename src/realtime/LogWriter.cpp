// SPDX-License-Identifier: Apache-2.0
#include "LogWriter.h"

#include <QtCore/QLoggingCategory>
#include <QtCore/QString>

#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <deque>
#include <mutex>
#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <sys/stat.h>
#include <unistd.h>

namespace qplc {

namespace {

/// Whether \a descriptor is the journal of systemd: systemd.exec(5), $JOURNAL_STREAM.
bool isJournal(int descriptor)
{
    struct stat status = {};
    if (::fstat(descriptor, &status) != 0)
        return false;
    return qgetenv("JOURNAL_STREAM")
        == QByteArray::number(quint64(status.st_dev)) + ':' + QByteArray::number(quint64(status.st_ino));
}

/// The severities of syslog, as sd-daemon(3) writes them before a line.
const char *severityOf(QtMsgType type)
{
    switch (type) {
    case QtDebugMsg:
        return "<7>";
    case QtInfoMsg:
        return "<6>";
    case QtWarningMsg:
        return "<4>";
    case QtCriticalMsg:
        return "<2>";
    case QtFatalMsg:
        return "<1>";
    }
    return "";
}

/// Writes all of \a bytes, however long that takes. A descriptor that cannot be written to loses
/// them.
void writeAll(int descriptor, const QByteArray &bytes)
{
    for (int done = 0; done < bytes.size();) {
        const ssize_t written = ::write(descriptor, bytes.constData() + done, std::size_t(bytes.size() - done));
        if (written >= 0) {
            done += int(written);
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
            pollfd ready = {descriptor, POLLOUT, 0};
            ::poll(&ready, 1, -1);
        } else if (errno != EINTR) {
            return;
        }
    }
}

class DescriptorOutput final : public LogOutput
{
public:
    explicit DescriptorOutput(int descriptor)
        : m_descriptor(descriptor)
        , m_toJournal(isJournal(descriptor))
    {
    }
    /// The journal takes each line as a message of its own.
    QByteArray linesOf(QtMsgType type, QByteArray text) const override
    {
        if (m_toJournal)
            text = severityOf(type) + text.replace('\n', QByteArray(1, '\n') + severityOf(type));
        return LogOutput::linesOf(type, text);
    }
    void write(const QByteArray &line) override { writeAll(m_descriptor, line); }

private:
    const int m_descriptor;
    const bool m_toJournal;
};

void leaveRealTime()
{
    const sched_param ordinary = {};
    pthread_setschedparam(pthread_self(), SCHED_OTHER, &ordinary);
    pthread_setname_np(pthread_self(), "qplc-log");
}

}  // namespace

QByteArray LogOutput::linesOf(QtMsgType, QByteArray text) const
{
    return text + '\n';
}

QByteArray LogOutput::gapText(quint64 dropped) const
{
    return "... " + QByteArray::number(dropped) + " lines are missing here: the reader of this log was too slow";
}

struct LogWriter::State
{
    explicit State(std::unique_ptr<LogOutput> to)
        : output(std::move(to))
    {
    }
    void push(const QByteArray &line);
    void tellDropped();
    bool waitForLines(std::unique_lock<std::mutex> *lock);
    void run();

    std::unique_ptr<LogOutput> output;  // its end may take long, so the thread destroys it
    mutable std::mutex mutex;
    std::condition_variable changed;
    std::deque<QByteArray> lines;
    int bytes = 0;       // of lines, and of what is being written
    quint64 untold = 0;  // dropped lines that no line has told yet
    quint64 dropped = 0;
    quint64 written = 0;
    bool isEnding = false;
    bool hasThread = false;  // set before anybody writes
};

/// Signals that a process may be sent go to the main thread. The stack is small: a program may lock
/// all of its memory.
bool LogWriter::startThread(const std::shared_ptr<State> &state)
{
    constexpr std::size_t stackSize = 256 << 10;  // [byte]
    const auto body = [](void *argument) -> void * {
        const std::unique_ptr<std::shared_ptr<State>> share(static_cast<std::shared_ptr<State> *>(argument));
        (*share)->run();
        return nullptr;
    };
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
    pthread_attr_setstacksize(&attributes, stackSize);
    sigset_t all;
    sigset_t before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    auto share = std::make_unique<std::shared_ptr<State>>(state);
    pthread_t thread;
    const bool isStarted = pthread_create(&thread, &attributes, body, share.get()) == 0;
    if (isStarted)
        (void)share.release();  // the thread's
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    pthread_attr_destroy(&attributes);
    return isStarted;
}

void LogWriter::State::push(const QByteArray &line)
{
    bytes += line.size();
    lines.push_back(line);
}

void LogWriter::State::tellDropped()
{
    const QByteArray text = output->gapText(untold);
    untold = 0;
    if (!text.isEmpty())
        push(output->linesOf(QtWarningMsg, text));
    changed.notify_all();
}

/// \return false: there are none, and the writer ends
bool LogWriter::State::waitForLines(std::unique_lock<std::mutex> *lock)
{
    const auto hasWork = [this] { return !lines.empty() || untold > 0 || isEnding; };
    while (!hasWork()) {
        lock->unlock();
        const int pause = output->rest();
        lock->lock();
        if (pause == 0)
            changed.wait(*lock, hasWork);
        else
            changed.wait_for(*lock, std::chrono::milliseconds(pause), hasWork);
    }
    if (lines.empty() && untold > 0)
        tellDropped();
    return !lines.empty() || !isEnding;
}

void LogWriter::State::run()
{
    leaveRealTime();
    std::unique_lock<std::mutex> lock(mutex);
    while (waitForLines(&lock)) {
        if (lines.empty())
            continue;
        const QByteArray line = lines.front();
        lines.pop_front();
        lock.unlock();
        output->write(line);
        lock.lock();
        bytes -= line.size();
        ++written;
        changed.notify_all();
    }
    lock.unlock();
    output.reset();
}

LogWriter::LogWriter(int descriptor)
    : LogWriter(std::make_unique<DescriptorOutput>(descriptor))
{
}

LogWriter::LogWriter(std::unique_ptr<LogOutput> output)
    : d(std::make_shared<State>(std::move(output)))
{
    d->hasThread = startThread(d);
}

LogWriter::~LogWriter()
{
    flush(patience);
    const std::lock_guard<std::mutex> lock(d->mutex);
    d->isEnding = true;
    d->changed.notify_all();
}

void LogWriter::write(const QByteArray &line)
{
    if (!d->hasThread) {
        d->output->write(line);
        return;
    }
    const std::lock_guard<std::mutex> lock(d->mutex);
    if (d->bytes > 0 && d->bytes + line.size() > mostBytes) {
        ++d->untold;
        ++d->dropped;
        return;
    }
    if (d->untold > 0)
        d->tellDropped();
    d->push(line);
    d->changed.notify_all();
}

void LogWriter::write(QtMsgType type, const QByteArray &text)
{
    write(d->output->linesOf(type, text));
}

bool LogWriter::flush(int milliseconds)
{
    std::unique_lock<std::mutex> lock(d->mutex);
    return d->changed.wait_for(lock, std::chrono::milliseconds(milliseconds),
                               [this] { return d->bytes == 0 && d->untold == 0; });
}

quint64 LogWriter::dropped() const
{
    const std::lock_guard<std::mutex> lock(d->mutex);
    return d->dropped;
}

quint64 LogWriter::written() const
{
    const std::lock_guard<std::mutex> lock(d->mutex);
    return d->written;
}

LogWriter &LogWriter::ofStandardError()
{
    static auto *const writer = new LogWriter(STDERR_FILENO);  // other threads may log until the very end
    return *writer;
}

namespace {

void writeMessage(QtMsgType type, const QMessageLogContext &context, const QString &text)
{
    const QString message = qFormatLogMessage(type, context, text);
    if (!message.isNull())
        LogWriter::ofStandardError().write(type, message.toLocal8Bit());
    if (type == QtFatalMsg)
        LogWriter::ofStandardError().flush(LogWriter::patience);  // the program ends behind this
}

}  // namespace

void LogWriter::takeMessages()
{
    ofStandardError();  // its thread starts before the program locks its memory
    const QtMessageHandler present = qInstallMessageHandler(nullptr);
    const QtMessageHandler ofQt = qInstallMessageHandler(nullptr);
    qInstallMessageHandler(present == ofQt ? writeMessage : present);
}

void LogWriter::releaseMessages()
{
    const QtMessageHandler present = qInstallMessageHandler(nullptr);
    if (present == writeMessage)
        LogWriter::ofStandardError().flush(patience);
    else
        qInstallMessageHandler(present);
}

}  // namespace qplc
