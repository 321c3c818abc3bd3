// SPDX-License-Identifier: Apache-2.0
#include "EventFile.h"

#include "protocol/messages/StoredEvent.h"
#include "realtime/TimeSource.h"
#include "transport/SocketAddress.h"

#include <QtCore/QFile>
#include <QtCore/QFileInfo>

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace qplc {

namespace {

constexpr std::int64_t pauseOfTries = NanosecondsPerSecond;
constexpr std::int64_t pauseOfSyncs = NanosecondsPerSecond;
constexpr qint64 longestLine = 64 << 10;  // [byte] of an event, and much more

/// \return false; \a problem has the reason that the system gives
bool refuse(QString *problem)
{
    *problem = systemErrorText();
    return false;
}

/// The first of the folders that systemd has made for the service; empty: there is none.
QString folderOfService()
{
    for (const char *variable : {"LOGS_DIRECTORY", "STATE_DIRECTORY"}) {
        const QByteArray folder = qgetenv(variable).split(':').constFirst();
        if (folder.startsWith('/'))
            return QFile::decodeName(folder);
    }
    return {};
}

QString usualFolder()
{
    const QString ofService = folderOfService();
    if (!ofService.isEmpty())
        return ofService;
    const QByteArray state = qgetenv("XDG_STATE_HOME");
    if (state.startsWith('/'))
        return QFile::decodeName(state) + QStringLiteral("/qtplc");
    if (::geteuid() == 0)
        return QStringLiteral("/var/log/qtplc");
    const QByteArray home = qgetenv("HOME");
    return home.startsWith('/') ? QFile::decodeName(home) + QStringLiteral("/.local/state/qtplc") : QString();
}

/// Why nobody else may have a part in a file or folder with these attributes; empty: all is well.
QString weaknessOf(const struct stat &status)
{
    if (status.st_uid != ::geteuid())
        return QStringLiteral("it belongs to another user");
    if ((status.st_mode & (S_IWGRP | S_IWOTH)) != 0)
        return QStringLiteral("other users may write to it; use chmod go-w");
    if (S_ISREG(status.st_mode) && status.st_nlink != 1)
        return QStringLiteral("it has a second name (a hard link)");
    return S_ISREG(status.st_mode) || S_ISDIR(status.st_mode) ? QString() : QStringLiteral("it is not a file");
}

bool isOurs(const Descriptor &opened, QString *problem)
{
    struct stat status = {};
    if (::fstat(opened.number(), &status) != 0)
        return refuse(problem);
    *problem = weaknessOf(status);
    return problem->isEmpty();
}

}  // namespace

EventFile::Report EventFile::SharedReport::report() const
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    return m_report;
}

void EventFile::SharedReport::change(const std::function<void(Report *)> &change)
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    change(&m_report);
}

EventFile::EventFile(Place place, std::shared_ptr<SharedReport> report, qint64 mostBytes)
    : m_place(std::move(place))
    , m_report(std::move(report))
    , m_mostBytes(mostBytes)
{
}

EventFile::~EventFile()
{
    if (m_isDirty)
        ::fdatasync(m_file.number());
}

EventFile::Place EventFile::usualPlace(const QString &name)
{
    const QString folder = usualFolder();
    return {folder.isEmpty() ? QString() : QStringLiteral("%1/%2.jsonl").arg(folder, name), true};
}

QString EventFile::numbered(const QString &path, int number)
{
    return number == 0 ? path : QStringLiteral("%1.%2").arg(path).arg(number);
}

// ---- writing ----

void EventFile::write(const QByteArray &line)
{
    QString problem;
    const bool isTried = m_file.isOpen() || monotonicNow() >= m_nextTry;
    const bool isWritten = isTried && open(&problem) && makeRoom(&problem) && append(line, &problem);
    const bool isSafe = isWritten && syncWhenDue(&problem);
    if (isTried && !isSafe)
        fail(problem);
    m_report->change([&](Report *report) {
        report->fails = !isSafe;
        report->lost += isWritten ? 0 : 1;
    });
}

void EventFile::fail(const QString &problem)
{
    m_file = Descriptor();
    m_isDirty = false;
    m_nextTry = monotonicNow() + pauseOfTries;
    m_report->change([&](Report *report) {
        report->problem = QStringLiteral("%1: %2").arg(m_place.path, problem);
        report->fails = true;
    });
}

bool EventFile::append(const QByteArray &line, QString *problem)
{
    const ssize_t written = ::write(m_file.number(), line.constData(), std::size_t(line.size()));
    if (written == line.size()) {
        m_size += written;
        m_isDirty = true;
        return true;
    }
    errno = written < 0 ? errno : ENOSPC;
    refuse(problem);
    (void)!::ftruncate(m_file.number(), m_size);  // a part of a line is worth nothing
    return false;
}

bool EventFile::syncWhenDue(QString *problem)
{
    if (!m_isDirty || monotonicNow() < m_nextSync)
        return true;
    m_isDirty = false;
    const bool isDone = ::fdatasync(m_file.number()) == 0 || refuse(problem);
    m_nextSync = monotonicNow() + pauseOfSyncs;
    return isDone;
}

/// Before the first line the file is opened, so that everybody sees where it is, and if it can be
/// written to.
int EventFile::rest()
{
    QString problem;
    const bool isNew = !m_file.isOpen() && m_nextTry == 0;
    if ((isNew && !open(&problem)) || !syncWhenDue(&problem))
        fail(problem);
    return m_isDirty ? int((m_nextSync - monotonicNow()) / 1'000'000) + 1 : 0;
}

/// Gives a full file its number. Numbers go up as far as the first free one: what fails and is
/// tried again pushes no file out.
bool EventFile::makeRoom(QString *problem)
{
    if (m_size < m_mostBytes)
        return true;
    const auto nameOf = [this](int number) { return QFile::encodeName(numbered(QFile::decodeName(m_name), number)); };
    int oldest = 1;
    while (oldest < mostFiles - 1 && ::faccessat(m_folder.number(), nameOf(oldest).constData(), F_OK, 0) == 0)
        ++oldest;
    for (int number = oldest; number > 0; --number) {
        if (::renameat(m_folder.number(), nameOf(number - 1).constData(), m_folder.number(), nameOf(number).constData())
            != 0)
            return refuse(problem);
    }
    ::fdatasync(m_file.number());
    ::fsync(m_folder.number());
    m_file = Descriptor();
    return openFile(m_name, problem);
}

// ---- opening ----

bool EventFile::open(QString *problem)
{
    if (m_file.isOpen())
        return true;
    const QFileInfo path(m_place.path);
    if (path.fileName().isEmpty()) {
        *problem = QStringLiteral("there is no folder for it; name one with --events FILE");
        return false;
    }
    if (!openFolder(problem))
        return false;
    m_name = QFile::encodeName(path.fileName());
    return m_place.isUsual ? lockUnused(problem) : openFile(m_name, problem);
}

/// A folder that somebody has chosen is his affair.
bool EventFile::openFolder(QString *problem)
{
    const QString folder = QFileInfo(m_place.path).path();
    for (int end = 0; m_place.isUsual && end >= 0;) {
        end = folder.indexOf(QLatin1Char('/'), end + 1);
        ::mkdir(QFile::encodeName(folder.left(end)).constData(), S_IRWXU);  // most of them are there
    }
    m_folder = Descriptor(::open(QFile::encodeName(folder).constData(),
                                 O_RDONLY | O_DIRECTORY | O_CLOEXEC | (m_place.isUsual ? O_NOFOLLOW : 0)));
    if (!m_folder.isOpen())
        return refuse(problem);
    return !m_place.isUsual || isOurs(m_folder, problem);
}

/// The first file of the usual name that no other master writes to.
bool EventFile::lockUnused(QString *problem)
{
    const QFileInfo path(m_place.path);
    for (int number = 1; number <= mostMasters; ++number) {
        const QString name = number == 1
            ? path.fileName()
            : QStringLiteral("%1-%2.%3").arg(path.completeBaseName()).arg(number).arg(path.suffix());
        m_name = QFile::encodeName(name);
        if (openFile(m_name, problem))
            return true;
        if (errno != EWOULDBLOCK)
            return false;
    }
    return false;
}

/// \return false, with errno and \a problem
bool EventFile::openFile(const QByteArray &name, QString *problem)
{
    m_file = Descriptor(::openat(m_folder.number(), name.constData(),
                                 O_RDWR | O_APPEND | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC,
                                 S_IRUSR | S_IWUSR));
    if (!m_file.isOpen() && errno == ELOOP) {
        *problem = QStringLiteral("it is a symbolic link, which could lead anywhere");
        return false;
    }
    const bool isUsable = (m_file.isOpen() || refuse(problem)) && isOurs(m_file, problem);
    if (isUsable && ::flock(m_file.number(), LOCK_EX | LOCK_NB) == 0 && heal(problem)) {
        m_report->change([&](Report *report) {
            report->path = QFileInfo(m_place.path).path() + QLatin1Char('/') + QFile::decodeName(name);
        });
        return true;
    }
    const int error = isUsable && problem->isEmpty() ? errno : 0;
    if (error == EWOULDBLOCK)
        *problem = QStringLiteral("another master writes to it");
    m_file = Descriptor();
    errno = error;
    return false;
}

/// Removes a last line that is not complete: the computer lost its power while it was written.
bool EventFile::heal(QString *problem)
{
    m_size = ::lseek(m_file.number(), 0, SEEK_END);
    if (m_size <= 0)
        return m_size == 0 || refuse(problem);
    QByteArray tail(int(qMin(m_size, longestLine)), '\0');
    const ssize_t size = ::pread(m_file.number(), tail.data(), std::size_t(tail.size()), m_size - tail.size());
    char first = 0;
    const bool isRead = size == tail.size() && ::pread(m_file.number(), &first, 1, 0) == 1;
    const qint64 incomplete = tail.size() - 1 - tail.lastIndexOf('\n');
    if (!isRead)
        return refuse(problem);
    if (first != '{' || (incomplete == tail.size() && incomplete < m_size)) {
        *problem = QStringLiteral("it is not a file of events; name another one");
        return false;
    }
    if (incomplete == 0)
        return true;
    if (::ftruncate(m_file.number(), m_size - incomplete) != 0)
        return refuse(problem);
    m_size -= incomplete;
    m_report->change([incomplete](Report *report) { report->removed += incomplete; });
    return true;
}

}  // namespace qplc
