// SPDX-License-Identifier: Apache-2.0
#include "CanBench.h"
#include "ThreadCosts.h"
#include "canopen/CanOpenBench.h"

#include <QtTest/QtTest>

using namespace std::chrono_literals;

class tst_CanAllocations : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void cyclesAllocateNothingAndLockNothing();
    void cyclesOfACanOpenDriveAllocateNothingAndLockNothing();
};

namespace {

/// What the cycles of a driver cost; its devices, which take part in the same thread, do not count.
struct CycleCosts
{
    void cycle(DriverBench &driver, double velocity)
    {
        driver.advance(1ms);
        const ThreadCosts before = ThreadCosts::ofThisThread();
        driver.runner().setValue(0, 1.0, false);
        driver.runner().setValue(1, velocity, false);
        driver.runner().write(driver.now());
        driver.runner().read(driver.now());
        const ThreadCosts one = ThreadCosts::ofThisThread() - before;
        allocations += one.allocations;
        locks += one.locks;
    }

    std::uint64_t allocations = 0;
    std::uint64_t locks = 0;
};

}  // namespace

void tst_CanAllocations::cyclesAllocateNothingAndLockNothing()
{
    if (!ThreadCosts::areCounted())
        QSKIP("a sanitizer owns the functions of the C library");
    CanBench bench(
        "frame.In = 0x100, 8 bytes\nsignal.In.S = 0|32@1f\nframe.Out = 0x200, 8 bytes\nsignal.Out.S = 0|32@1f\n"
        "send.Out = on change, on request, every 10 ms\nlog = bench.log\n");
    for (const char *name : {"In.S", "In.@age", "In.@count", "@lost", "@saturated"})
        bench.driver.wireRead(QString::fromLatin1(name));
    const QString out = QStringLiteral("Out.S");
    bench.driver.wireWrite(out);
    QVERIFY(bench.open());
    qplc::CanFrame frames[20];
    for (qplc::CanFrame &frame : frames) {
        frame.id = 0x100;
        frame.size = 8;
    }
    frames[7].id = 0x200;
    frames[7].flags = qplc::CanFrame::Remote;
    bench.driver.set(out, 0.0);
    bench.partner().send(frames, 20);
    bench.cycle();
    qplc::DriverRunner &runner = bench.driver.runner();
    const ThreadCosts before = ThreadCosts::ofThisThread();
    for (int i = 0; i < 1000; ++i) {
        bench.partner().send(frames, 20);
        runner.setValue(0, double(i), false);
        runner.write(bench.driver.now() + i * 1'000'000LL);
        runner.read(bench.driver.now() + i * 1'000'000LL);
        qplc::CanFrame frame;
        while (bench.partner().receive(&frame, 1) == 1) {}
    }
    const ThreadCosts costs = ThreadCosts::ofThisThread() - before;
    QCOMPARE(costs.allocations, std::uint64_t(0));
    QCOMPARE(costs.locks, std::uint64_t(0));
    QCOMPARE(runner.sample(2, bench.driver.now()).value, 19.0 * 1001);
    QCOMPARE(runner.sample(3, bench.driver.now()).value, 0.0);
}

/// With emergencies, a fault, values that do not fit, and the loss of the device.
void tst_CanAllocations::cyclesOfACanOpenDriveAllocateNothingAndLockNothing()
{
    if (!ThreadCosts::areCounted())
        QSKIP("a sanitizer owns the functions of the C library");
    CanOpenBench bench;
    peer::Device &device = bench.bus.addDevice(5);
    device.makeDrive();
    DriverBench &driver = bench.addDriver("node = 5\nsync = every cycle\nprofile = 402\n");
    for (const char *name : {"enable", "velocity"}) {
        QCOMPARE(driver.wireWrite(QString::fromLatin1(name)), QString());
        driver.set(QString::fromLatin1(name), 0.0, true);
    }
    for (const char *name : {"state", "enabled", "velocity", "position", "@state", "@emergency", "@emergencyBytes",
                             "@emergencies", "@missed", "@saturated", "@heartbeatLost", "@busState"})
        QCOMPARE(driver.wireRead(QString::fromLatin1(name)), QString());
    const QString error = bench.open();
    QVERIFY2(error.isEmpty(), qPrintable(error));
    CycleCosts costs;
    for (int i = 0; i < 1000; ++i) {
        if (i % 10 == 5)
            bench.bus.tellEmergency(device, i % 20 == 5 ? 0x2310 : 0x0000, 0x00);  // more than there is room for
        if (i == 400)
            QVERIFY(device.drive->state == peer::Drive::Enabled);
        if (i == 500)
            device.drive->fail();
        costs.cycle(driver, i < 400 && i % 2 == 0 ? 1e12 : 0.0);
        bench.passTime(1ms);
    }
    QVERIFY(driver.isOnline());
    QCOMPARE(driver.value("@emergencies"), 50.0);
    QVERIFY(driver.value("@saturated") > 0.0);
    QCOMPARE(driver.value("state"), 7.0);
    for (int i = 0; i < 300; ++i)
        costs.cycle(driver, 0.0);  // nobody is there any more
    QVERIFY(!driver.isOnline());
    QCOMPARE(costs.allocations, std::uint64_t(0));
    QCOMPARE(costs.locks, std::uint64_t(0));
}

QTEST_GUILESS_MAIN(tst_CanAllocations)
#include "tst_CanAllocations.moc"
