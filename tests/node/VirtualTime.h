// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "test_support/SimulatedHost.h"
#include "test_support/SimulatedTransport.h"

#include <QtCore/QCoreApplication>
#include <QtTest/QTest>

#include <functional>

/// Runs \a code on a simulated computer, 127.0.0.1: it waits in virtual time, and the same happens
/// in each run.
inline void runInVirtualTime(const std::function<void()> &code)
{
    qplc::SimulatedTransport::install();
    qplc::Simulator::run(1, [&](qplc::Simulator &simulator) {
        qplc::SimulatedHost host(simulator, QStringLiteral("machine"), QHostAddress(QHostAddress::LocalHost));
        host.call(code);
    });
}

/// While it lives, the thread is on the machine, for sockets and addresses of the kernel. Timers of
/// Qt stay in virtual time; clocks do not, and nobody is told that a socket is readable.
class OnTheMachine
{
public:
    OnTheMachine() = default;
    ~OnTheMachine() { qplc::Host::enter(m_before); }
    OnTheMachine(const OnTheMachine &) = delete;
    OnTheMachine &operator=(const OnTheMachine &) = delete;

private:
    qplc::Host *const m_before = qplc::Host::enter(nullptr);
};

/// In place of QTEST_GUILESS_MAIN: all functions of \a Test run in virtual time.
#define QTPLC_VIRTUAL_TIME_MAIN(Test)                                                                                  \
    int main(int argc, char **argv)                                                                                    \
    {                                                                                                                  \
        const QCoreApplication application(argc, argv);                                                                \
        int failures = 1;                                                                                              \
        runInVirtualTime([&] {                                                                                         \
            Test test;                                                                                                 \
            failures = QTest::qExec(&test, argc, argv);                                                                \
        });                                                                                                            \
        return failures;                                                                                               \
    }
