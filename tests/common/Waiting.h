// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QCoreApplication>
#include <QtCore/QDeadlineTimer>
#include <QtCore/QEventLoop>
#include <QtCore/QTimer>
#include <QtTest/QtTest>

/// Handles events until a test has what it waits for. Qt 5 sleeps 10 ms (QTest::qWaitFor()) or
/// 50 ms (QTRY_VERIFY()) between two looks, whatever happens meanwhile; a request, its way through
/// a master and the answer are a dozen events. Here each event is followed by a look.
class Waiting
{
public:
    explicit Waiting(int milliseconds)
        : m_deadline(milliseconds, Qt::PreciseTimer)
    {
        m_looks.setTimerType(Qt::PreciseTimer);
        m_looks.start(2);  // what other threads and processes do is no event
    }
    /// Whether there is time for another look; what happens next has happened then.
    bool goesOn()
    {
        if (m_deadline.hasExpired())
            return false;
        QCoreApplication::processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents);
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        return true;
    }

private:
    QDeadlineTimer m_deadline;
    QTimer m_looks;
};

/// Whether \a predicate becomes true within \a milliseconds.
template<typename Predicate>
bool waitUntil(Predicate predicate, int milliseconds = 5000)
{
    for (Waiting waiting(milliseconds); !predicate();) {
        if (!waiting.goesOn())
            return false;
    }
    return true;
}

// The last part of QTRY_VERIFY(), QTRY_COMPARE() and their relatives.
#undef QTRY_IMPL
#define QTRY_IMPL(expr, timeout)                                                                                       \
    for (Waiting waiting(timeout); !(expr);) {                                                                         \
        if (!waiting.goesOn())                                                                                         \
            break;                                                                                                     \
    }
