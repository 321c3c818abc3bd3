// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "test_support/SimulatedHost.h"
#include "test_support/SimulatedTransport.h"

#include <QtCore/QCoreApplication>
#include <QtTest/QTest>

/// Runs all functions of \a Test on one simulated computer, 127.0.0.1: they wait in virtual time,
/// and the same happens in each run.
template<typename Test>
int runInVirtualTime(int argc, char **argv)
{
    QCoreApplication application(argc, argv);
    qplc::SimulatedTransport::install();
    int failures = 1;
    qplc::Simulator::run(1, [&](qplc::Simulator &simulator) {
        qplc::SimulatedHost host(simulator, QStringLiteral("machine"), QHostAddress(QHostAddress::LocalHost));
        host.call([&] {
            Test test;
            failures = QTest::qExec(&test, argc, argv);
        });
    });
    return failures;
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

/// In place of QTEST_GUILESS_MAIN.
#define QTPLC_VIRTUAL_TIME_MAIN(Test)                                                                                  \
    int main(int argc, char **argv)                                                                                    \
    {                                                                                                                  \
        return runInVirtualTime<Test>(argc, argv);                                                                     \
    }
