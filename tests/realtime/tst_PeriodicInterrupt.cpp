// SPDX-License-Identifier: Apache-2.0
#include "realtime/PeriodicInterrupt.h"

#include <QtCore/QElapsedTimer>
#include <QtTest/QtTest>

#include <cerrno>
#include <csignal>
#include <thread>
#include <unistd.h>

using qplc::PeriodicInterrupt;

class tst_PeriodicInterrupt : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aWaitEndsEachPeriod();
    void onlyTheThreadThatWantsItIsInterrupted();
    void nothingComesAfterwards();
    void aHandlerOfTheProgramStays();

private:
    /// Waits for input that never comes. \return errno; 0 when the time was over before
    static int waitInVain(int milliseconds);
};

int tst_PeriodicInterrupt::waitInVain(int milliseconds)
{
    const timespec time{milliseconds / 1000, (milliseconds % 1000) * 1'000'000L};
    return ::clock_nanosleep(CLOCK_MONOTONIC, 0, &time, nullptr);
}

void tst_PeriodicInterrupt::aWaitEndsEachPeriod()
{
    const PeriodicInterrupt interrupt(2'000'000);
    for (int i = 0; i < 5; ++i)
        QCOMPARE(waitInVain(20'000), EINTR);
}

void tst_PeriodicInterrupt::onlyTheThreadThatWantsItIsInterrupted()
{
    const PeriodicInterrupt interrupt(1'000'000'000);
    int other = -1;
    std::thread thread([&] {
        const PeriodicInterrupt own(1'000'000);
        other = waitInVain(20'000);
    });
    QCOMPARE(waitInVain(20), 0);
    thread.join();
    QCOMPARE(other, EINTR);
}

void tst_PeriodicInterrupt::nothingComesAfterwards()
{
    {
        const PeriodicInterrupt interrupt(1'000'000);
    }
    waitInVain(3);  // one that was under way
    QCOMPARE(waitInVain(20), 0);
}

void tst_PeriodicInterrupt::aHandlerOfTheProgramStays()
{
    struct sigaction handler = {};
    ::sigaction(SIGURG, nullptr, &handler);
    QVERIFY(handler.sa_handler != SIG_DFL
            && handler.sa_handler != SIG_IGN);  // ours: an ignored signal interrupts nothing
    QVERIFY((handler.sa_flags & SA_RESTART) == 0);
}

QTEST_APPLESS_MAIN(tst_PeriodicInterrupt)
#include "tst_PeriodicInterrupt.moc"
