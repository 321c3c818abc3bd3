// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "RecorderLoop.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace qplc {

/// Runs a RecorderLoop. A disk that stalls delays nobody but stop(), and what waits for it.
///
/// \threadsafe yes, but for start() and stop()
class RecorderThread
{
public:
    RecorderThread(const RecorderLoop::Settings &settings, Disk &disk);
    ~RecorderThread();

    /// Called on the thread, when there is something to look at. Before start().
    void setCallback(std::function<void()> changed) { m_changed = std::move(changed); }
    bool start(QString *error);
    /// See RecorderLoop::end(). Waits for it.
    bool stop(QString *error);
    /// Becomes the recorder of a ring at once. \return false when that is not possible
    bool add(const QByteArray &ringFile, QString *error);
    bool mark();
    /// Waits until no phase is being recorded any more. \return false: \a timeout is over
    bool waitForEnds(std::chrono::milliseconds timeout);
    RecorderLoop::Status status() const;
    std::vector<RecorderLoop::FileNews> takeNews();

private:
    void run();
    void takeRequests();
    void publish();

    RecorderLoop m_loop;  // of the thread, between start() and stop()
    std::function<void()> m_changed;
    std::thread m_thread;
    mutable std::mutex m_mutex;  // of what follows; never held while files are written
    std::condition_variable m_isDue;
    std::condition_variable m_isPublished;
    std::vector<std::unique_ptr<PlantRecorder>> m_new;
    std::vector<RecorderLoop::FileNews> m_news;
    RecorderLoop::Status m_status;
    bool m_isMarking = false;
    bool m_isStopping = false;
};

}  // namespace qplc
