// SPDX-License-Identifier: Apache-2.0
#include "RecorderThread.h"

#include "realtime/BlockedSignals.h"
#include "realtime/TimeSource.h"

#include <sched.h>
#include <system_error>

namespace qplc {

RecorderThread::RecorderThread(const RecorderLoop::Settings &settings, Disk &disk)
    : m_loop(settings, disk)
{
}

RecorderThread::~RecorderThread()
{
    QString error;
    stop(&error);
}

bool RecorderThread::start(QString *error)
{
    m_loop.setCallback([this](const RecorderLoop::FileNews &file) {
        const std::lock_guard<std::mutex> lock(m_mutex);
        m_news.push_back(file);
    });
    if (!m_loop.open(error))
        return false;
    const BlockedSignals blocked;
    try {
        m_thread = std::thread([this] { run(); });
    } catch (const std::system_error &failure) {
        *error = QStringLiteral("cannot start the thread of the recorder: %1").arg(QLatin1String(failure.what()));
        return false;
    }
    return true;
}

bool RecorderThread::stop(QString *error)
{
    if (!m_thread.joinable())
        return true;
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        m_isStopping = true;
        m_isDue.notify_all();
    }
    m_thread.join();
    takeRequests();
    m_loop.proceed(monotonicNow(), wallClockNow() / 1'000'000);  // a phase that has just begun has no file yet
    const bool isWritten = m_loop.end(wallClockNow() / 1'000'000, error);
    publish();
    return isWritten;
}

bool RecorderThread::add(const QByteArray &ringFile, QString *error)
{
    auto recorder = std::make_unique<PlantRecorder>();
    if (!recorder->attach(ringFile, error))
        return false;
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_new.push_back(std::move(recorder));
    ++m_status.phases;
    m_isDue.notify_all();
    return true;
}

bool RecorderThread::mark()
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_isMarking = true;
    m_isDue.notify_all();
    return m_status.phases > 0;
}

bool RecorderThread::waitForEnds(std::chrono::milliseconds timeout)
{
    std::unique_lock<std::mutex> lock(m_mutex);
    return m_isPublished.wait_for(lock, timeout, [this] { return m_new.empty() && m_status.phases == 0; });
}

RecorderLoop::Status RecorderThread::status() const
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    return m_status;
}

std::vector<RecorderLoop::FileNews> RecorderThread::takeNews()
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    return std::exchange(m_news, {});
}

void RecorderThread::takeRequests()
{
    std::vector<std::unique_ptr<PlantRecorder>> recorders;
    bool isMarking = false;
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        recorders.swap(m_new);
        isMarking = std::exchange(m_isMarking, false);
    }
    for (std::unique_ptr<PlantRecorder> &recorder : recorders)
        m_loop.add(std::move(recorder));
    if (isMarking)
        m_loop.mark(monotonicNow());
}

void RecorderThread::publish()
{
    bool isNews = false;
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        const RecorderLoop::Status former = std::exchange(m_status, m_loop.status());
        m_status.phases += int(m_new.size());
        isNews = !m_news.empty() || (former.phases > 0) != (m_status.phases > 0)
            || former.hasFailed != m_status.hasFailed || former.isStopped != m_status.isStopped;
        m_isPublished.notify_all();
    }
    if (isNews && m_changed)
        m_changed();
}

/// The program may have been started with another scheduling, by `chrt`.
void RecorderThread::run()
{
    const sched_param ordinary = {};
    pthread_setschedparam(pthread_self(), SCHED_OTHER, &ordinary);
    pthread_setname_np(pthread_self(), "qplc-record");
    std::unique_lock<std::mutex> lock(m_mutex);
    while (!m_isStopping) {
        lock.unlock();
        takeRequests();
        const std::int64_t pause = m_loop.proceed(monotonicNow(), wallClockNow() / 1'000'000);
        publish();
        lock.lock();
        if (pause > 0)
            m_isDue.wait_for(lock, std::chrono::nanoseconds(pause),
                             [this] { return m_isStopping || m_isMarking || !m_new.empty(); });
    }
}

}  // namespace qplc
