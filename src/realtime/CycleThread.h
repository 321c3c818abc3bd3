// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Host.h"
#include "IdleLatency.h"
#include "QPlcRealTimeOptions.h"

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <pthread.h>

namespace qplc {

struct Scheduling;

/// The thread on which cycles run: a pthread of its own (not a QThread, whose priorities drop a
/// thread started by chrt back to ordinary scheduling).
///
/// All signals that a process may be sent are blocked on it: SIGINT, SIGTERM and their like go to
/// the main thread and never cut the sleep of a cycle short.
/// \threadsafe no: start() and join() from the owner
class CycleThread
{
public:
    CycleThread();
    /// Joins: whoever destroys a running thread has told the body to return.
    ~CycleThread();
    CycleThread(const CycleThread &) = delete;
    CycleThread &operator=(const CycleThread &) = delete;

    /// Starts \a body on the thread with \a options and returns when these have been applied. The
    /// reserve of the heap is taken by the caller, whose heap it is. What the system refused
    /// does not keep the thread from running: settings() tells.
    /// \param name  shown by ps and top, at most 15 bytes of UTF-8 count
    /// \param body must not throw: nobody is there to catch it, so an exception ends the program by
    ///         std::terminate(), which prints it. Whoever calls the code of a user catches before.
    /// \return false when the options cannot be meant or no thread could be made; errorString()
    ///         says why
    bool start(const QString &name, const QPlcRealTimeOptions &options, std::function<void()> body);
    /// From start() to join(), also when the body has returned meanwhile.
    bool isRunning() const { return m_running; }
    /// Ends a wait of the body that has made its waits interruptible. Nothing happens when the
    /// thread does not run.
    void interrupt();
    /// Waits until the body has returned. Nothing happens when the thread does not run. Not from
    /// the body itself.
    void join();

    /// Each wish of the options with what was obtained, read back from the kernel by the thread
    /// itself. Valid after start().
    const QVector<QPlcRealTimeSetting> &settings() const { return m_settings; }
    QString errorString() const { return m_errorString; }

private:
    static void *run(void *self) noexcept;
    QString refusal() const;  // why there is nothing to start
    int create();             // errno value
    bool setError(const QString &reason);
    void applyOptions();
    void waitUntilApplied();
    void joinThread();

    std::unique_ptr<Strand> m_strand;  // in place of the thread; null: there is a thread
    pthread_t m_thread{};
    bool m_running = false;
    QPlcRealTimeOptions m_options;
    QString m_name;
    std::function<void()> m_body;
    QVector<QPlcRealTimeSetting> m_settings;
    IdleLatency m_idleLatency;
    QString m_errorString;

    std::unique_ptr<Scheduling> m_inherited;  // of the thread that called start()
    std::mutex m_mutex;
    std::condition_variable m_appliedChanged;
    bool m_applied = false;  // guarded by m_mutex
};

/// Applies \a options to the calling thread and reads back what was obtained. \pre
/// options.errorString() is empty
QVector<QPlcRealTimeSetting> applyRealTimeOptions(const QPlcRealTimeOptions &options);

}  // namespace qplc
