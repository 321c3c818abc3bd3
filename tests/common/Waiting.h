// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QCoreApplication>
#include <QtCore/QEventLoop>
#include <QtCore/QTimer>
#include <QtTest/QtTest>

#include <chrono>

constexpr int patience = 20000;  // [ms] for what happens at once: far more than a loaded machine needs

/// Handles events until a test has what it waits for. Qt 5 sleeps 10 ms (QTest::qWaitFor()) or
/// 50 ms (QTRY_VERIFY()) between two looks, whatever happens meanwhile; a request, its way through
/// a master and the answer are a dozen events. Here each event is followed by a look. Time is that
/// of timers: virtual time in a simulator.
class Waiting
{
public:
    explicit Waiting(int milliseconds)
    {
        m_end.setTimerType(Qt::PreciseTimer);
        m_end.setSingleShot(true);
        m_end.start(milliseconds);
        m_looks.setTimerType(Qt::PreciseTimer);
        m_looks.start(2);  // what other threads and processes do is no event
    }
    /// Whether there is time for another look; what happens next has happened then.
    bool goesOn()
    {
        if (!m_end.isActive())
            return false;
        QCoreApplication::processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents);
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        return true;
    }

private:
    QTimer m_end;
    QTimer m_looks;
};

/// Whether \a predicate becomes true within \a milliseconds. Where a test does not say how long, it
/// has patience; so have QTRY_VERIFY() and QTRY_COMPARE() here.
template<typename Predicate>
bool waitUntil(Predicate predicate, int milliseconds = patience)
{
    for (Waiting waiting(milliseconds); !predicate();) {
        if (!waiting.goesOn())
            return false;
    }
    return true;
}

template<typename Predicate>
bool waitUntil(Predicate predicate, std::chrono::milliseconds longest)
{
    return waitUntil(predicate, int(longest.count()));
}
/// Handles events while \a duration passes.
inline void pass(std::chrono::milliseconds duration)
{
    (void)waitUntil([] { return false; }, duration);
}

// The last part of QTRY_VERIFY(), QTRY_COMPARE() and their relatives.
#undef QTRY_IMPL
#define QTRY_IMPL(expr, timeout)                                                                                       \
    for (Waiting waiting(timeout); !(expr);) {                                                                         \
        if (!waiting.goesOn())                                                                                         \
            break;                                                                                                     \
    }

// Those of Qt fail after 5 s.
#undef QTRY_VERIFY
#define QTRY_VERIFY(expr) QTRY_VERIFY_WITH_TIMEOUT((expr), ::patience)
#undef QTRY_VERIFY2
#define QTRY_VERIFY2(expr, messageExpression) QTRY_VERIFY2_WITH_TIMEOUT((expr), (messageExpression), ::patience)
#undef QTRY_COMPARE
#define QTRY_COMPARE(expr, expected) QTRY_COMPARE_WITH_TIMEOUT((expr), expected, ::patience)
