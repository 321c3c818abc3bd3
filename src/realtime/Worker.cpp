// SPDX-License-Identifier: Apache-2.0
#include "Worker.h"

#include "BlockedSignals.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <sched.h>
#include <system_error>
#include <thread>
#include <utility>

namespace qplc {

struct Worker::State
{
    struct Job
    {
        Call work;
        Call done;
    };
    void run();

    WakeUp wakeUp;
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<Job> waiting;
    std::deque<Call> ended;
    bool isEnding = false;
    std::thread thread;
};

/// The program may have been started with another scheduling, by `chrt`.
void Worker::State::run()
{
    const sched_param ordinary = {};
    pthread_setschedparam(pthread_self(), SCHED_OTHER, &ordinary);
    pthread_setname_np(pthread_self(), "qplc-work");
    for (std::unique_lock<std::mutex> lock(mutex);;) {
        changed.wait(lock, [this] { return isEnding || !waiting.empty(); });
        if (isEnding)
            return;
        Job job = std::move(waiting.front());
        waiting.pop_front();
        lock.unlock();
        job.work();
        job.work = nullptr;
        lock.lock();
        if (!job.done)
            continue;
        ended.push_back(std::move(job.done));
        wakeUp.notify();
    }
}

Worker::Worker() = default;

Worker::~Worker()
{
    if (!d)
        return;
    {
        const std::lock_guard<std::mutex> lock(d->mutex);
        d->isEnding = true;
        d->changed.notify_all();
    }
    d->thread.join();
}

bool Worker::hasThread()
{
    m_isAlone = m_isAlone || !Host::current().hasThreads();
    if (d || m_isAlone)
        return !m_isAlone;
    auto state = std::make_unique<State>();
    m_isAlone = !state->wakeUp.isValid();
    if (m_isAlone)
        return false;
    state->wakeUp.arm();
    const BlockedSignals blocked;
    try {
        state->thread = std::thread([&state = *state] { state.run(); });
        d = std::move(state);
    } catch (const std::system_error &) {
        m_isAlone = true;
    }
    return !m_isAlone;
}

void Worker::begin(Call work, Call done)
{
    if (!hasThread()) {
        work();
        if (done)
            done();
        return;
    }
    const std::lock_guard<std::mutex> lock(d->mutex);
    d->waiting.push_back({std::move(work), std::move(done)});
    d->changed.notify_all();
}

void Worker::collect()
{
    if (!d)
        return;
    d->wakeUp.consume();
    for (bool isEmpty = false; !isEmpty;) {
        std::deque<Call> ended;
        {
            const std::lock_guard<std::mutex> lock(d->mutex);
            ended.swap(d->ended);
        }
        for (const Call &done : ended)
            done();
        d->wakeUp.arm();
        const std::lock_guard<std::mutex> lock(d->mutex);
        isEmpty = d->ended.empty();
    }
}

int Worker::descriptor() const noexcept
{
    return d ? d->wakeUp.descriptor() : -1;
}

}  // namespace qplc
