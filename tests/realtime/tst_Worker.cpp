// SPDX-License-Identifier: Apache-2.0
#include "realtime/Worker.h"

#include <QtTest/QtTest>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <poll.h>
#include <thread>
#include <vector>

using qplc::Worker;

namespace {

/// Holds a thread until it is opened.
class Barrier
{
public:
    void wait()
    {
        std::unique_lock<std::mutex> lock(m_mutex);
        m_changed.wait(lock, [this] { return m_isOpen; });
    }
    void open()
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        m_isOpen = true;
        m_changed.notify_all();
    }

private:
    std::mutex m_mutex;
    std::condition_variable m_changed;
    bool m_isOpen = false;
};

/// Knows on which thread its life has ended.
struct Mortal
{
    explicit Mortal(std::thread::id *place)
        : end(place)
    {
    }
    ~Mortal() { *end = std::this_thread::get_id(); }
    std::thread::id *end;
};

bool becomesReadable(const Worker &worker)
{
    pollfd one = {worker.descriptor(), POLLIN, 0};
    return ::poll(&one, 1, 10000) == 1;
}

/// Collects until \a isDone.
template<typename Predicate>
bool collectUntil(Worker &worker, Predicate isDone)
{
    while (!isDone()) {
        if (!becomesReadable(worker))
            return false;
        worker.collect();
    }
    return true;
}

/// A computer on which no program makes a thread.
class HostWithoutThreads : public qplc::Host
{
public:
    HostWithoutThreads() { enter(this); }
    ~HostWithoutThreads() override { enter(nullptr); }
    std::int64_t now() noexcept override { return 0; }
    std::int64_t slept() noexcept override { return 0; }
    bool sleepUntil(std::int64_t) noexcept override { return true; }
    std::int64_t wallClock() noexcept override { return 0; }
    bool hasKernelTimers() const noexcept override { return false; }
    bool hasThreads() const noexcept override { return false; }
    std::uint64_t random() override { return 0; }
    int openWakeUp(int *) noexcept override { return -1; }
    void closeWakeUp(int) noexcept override {}
    void wake(int) noexcept override {}
    bool consumeWakeUp(int) noexcept override { return false; }
};

}  // namespace

// Work beside an event loop.
class tst_Worker : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void jobsAreDoneInOrderOnOneOtherThread();
    void whatIsDueIsCalledByCollectOnly();
    void aJobEndsItsLifeWhereItWasDone();
    void theEndWaitsForTheJobAtHandAndForgetsTheOthers();
    void hostWithoutThreadsWorksAtOnce();
};

void tst_Worker::jobsAreDoneInOrderOnOneOtherThread()
{
    Worker worker;
    QCOMPARE(worker.descriptor(), -1);  // no thread without work
    std::vector<std::thread::id> threads;
    std::vector<int> order;
    for (int i = 0; i < 100; ++i)
        worker.begin([&threads] { threads.push_back(std::this_thread::get_id()); },
                     [&order, i] { order.push_back(i); });
    QVERIFY(collectUntil(worker, [&] { return order.size() == 100; }));
    for (int i = 0; i < 100; ++i) {
        QCOMPARE(order[std::size_t(i)], i);
        QVERIFY(threads[std::size_t(i)] == threads.front());
    }
    QVERIFY(threads.front() != std::this_thread::get_id());
}

void tst_Worker::whatIsDueIsCalledByCollectOnly()
{
    Worker worker;
    Barrier barrier;
    std::vector<std::thread::id> called;
    worker.begin([&barrier] { barrier.wait(); }, [&called] { called.push_back(std::this_thread::get_id()); });
    worker.collect();
    QVERIFY(called.empty());
    barrier.open();
    QVERIFY(becomesReadable(worker));
    QVERIFY(called.empty());
    worker.collect();
    QCOMPARE(called.size(), std::size_t(1));
    QVERIFY(called.front() == std::this_thread::get_id());
    worker.begin([] {}, [&called] { called.push_back({}); });  // it wakes more than once
    QVERIFY(collectUntil(worker, [&] { return called.size() == 2; }));
}

void tst_Worker::aJobEndsItsLifeWhereItWasDone()
{
    Worker worker;
    std::thread::id end;
    bool isDone = false;
    worker.begin([mortal = std::make_shared<Mortal>(&end)] {}, [&isDone] { isDone = true; });
    QVERIFY(collectUntil(worker, [&] { return isDone; }));
    QVERIFY(end != std::thread::id());
    QVERIFY(end != std::this_thread::get_id());
}

void tst_Worker::theEndWaitsForTheJobAtHandAndForgetsTheOthers()
{
    Barrier begun;
    Barrier barrier;
    std::atomic<int> done{0};
    std::thread opener;
    {
        Worker worker;
        worker.begin([&] {
            begun.open();
            barrier.wait();
            ++done;
        });
        worker.begin([&done] { done += 100; });
        begun.wait();
        opener = std::thread([&barrier] { barrier.open(); });
    }
    opener.join();
    QVERIFY(done == 1 || done == 101);  // the second one may have begun before the end
}

void tst_Worker::hostWithoutThreadsWorksAtOnce()
{
    const HostWithoutThreads host;
    Worker worker;
    QByteArray order;
    worker.begin([&order] { order += "work "; }, [&order] { order += "done "; });
    worker.begin([&order] { order += "work"; });
    QCOMPARE(order, QByteArray("work done work"));
    QCOMPARE(worker.descriptor(), -1);
    worker.collect();
}

QTEST_APPLESS_MAIN(tst_Worker)
#include "tst_Worker.moc"
