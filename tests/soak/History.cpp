// SPDX-License-Identifier: Apache-2.0
#include "History.h"

#include <QtCore/QFile>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace soak {

namespace {

static_assert(sizeof(Record) == 112, "histories are read as they were written");

/// What the scheduler tells a thread of itself; nothing where the kernel does not tell.
class ThreadWaits
{
public:
    ThreadWaits()
        : thread(quint32(::syscall(SYS_gettid)))
        , m_file(::open("/proc/thread-self/schedstat", O_RDONLY | O_CLOEXEC))
    {
    }
    ~ThreadWaits()
    {
        if (m_file >= 0)
            ::close(m_file);
    }
    /// [ns] that the thread was ready to run and did not.
    qint64 now() const
    {
        char text[64];
        const ssize_t size = m_file < 0 ? 0 : ::pread(m_file, text, sizeof text - 1, 0);
        if (size <= 0)
            return 0;
        text[size] = 0;
        const char *second = std::strchr(text, ' ');
        return second ? std::strtoll(second, nullptr, 10) : 0;
    }
    const quint32 thread;

private:
    int m_file;
};

}  // namespace

qint64 monotonicNow() noexcept
{
    timespec time{};
    ::clock_gettime(CLOCK_MONOTONIC, &time);
    return qint64(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

quint64 bitsOf(double number) noexcept
{
    quint64 bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    return bits;
}

double fromBits(quint64 bits) noexcept
{
    double number = 0.0;
    std::memcpy(&number, &bits, sizeof number);
    return number;
}

quint64 checkOf(const Record &record) noexcept
{
    quint64 sum = 0xcbf29ce484222325ULL;
    quint64 words[sizeof(Record) / sizeof(quint64)];
    std::memcpy(words, &record, sizeof record);
    for (std::size_t i = 0; i + 1 < sizeof words / sizeof words[0]; ++i)  // the last one is the check itself
        sum = (sum ^ words[i]) * 0x100000001b3ULL;
    return sum;
}

Record makeRecord(Record::Kind kind, int subject, std::initializer_list<quint64> numbers, quint64 cycle) noexcept
{
    Record record;
    record.kind = kind;
    record.subject = subject < 0 ? Record::Nobody : quint16(subject);
    record.cycle = cycle;
    int i = 0;
    for (const quint64 number : numbers)
        record.numbers[i++] = number;
    return record;
}

HistoryWriter::~HistoryWriter() = default;

void HistoryWriter::append(Record::Kind kind, int subject, std::initializer_list<quint64> numbers,
                           quint64 cycle) noexcept
{
    append(makeRecord(kind, subject, numbers, cycle));
}

HistoryFile::~HistoryFile()
{
    if (m_file >= 0)
        ::close(m_file);
}

bool HistoryFile::open(const QString &fileName, QString *error)
{
    m_file = ::open(QFile::encodeName(fileName).constData(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0644);
    if (m_file < 0)
        *error = QStringLiteral("cannot make %1: %2; give an empty folder").arg(fileName, qt_error_string(errno));
    return m_file >= 0;
}

void HistoryFile::append(Record record) noexcept
{
    thread_local const ThreadWaits waits;
    if (record.time == 0)
        record.time = monotonicNow();
    record.thread = waits.thread;
    record.waited = waits.now();
    record.check = checkOf(record);
    const ssize_t written = ::write(m_file, &record, sizeof record);
    Q_UNUSED(written)  // a history with a hole does not read
}

bool History::read(const QString &fileName, History *history, QString *error)
{
    QFile file(fileName);
    if (!file.open(QIODevice::ReadOnly)) {
        *error = QStringLiteral("cannot read %1: %2").arg(fileName, file.errorString());
        return false;
    }
    const std::size_t count = std::size_t(file.size()) / sizeof(Record);
    history->isTorn = std::size_t(file.size()) % sizeof(Record) != 0;
    history->records.resize(count);
    file.read(reinterpret_cast<char *>(history->records.data()), qint64(count * sizeof(Record)));
    for (std::size_t i = 0; i < count; ++i) {
        if (checkOf(history->records[i]) != history->records[i].check) {
            *error = QStringLiteral("%1: record %2 is not what was written").arg(fileName).arg(i);
            return false;
        }
    }
    return true;
}

}  // namespace soak
