// SPDX-License-Identifier: Apache-2.0
#include "CanBench.h"
#include "ThreadCosts.h"

#include <QtTest/QtTest>

class tst_CanAllocations : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void cyclesAllocateNothingAndLockNothing();
};

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

QTEST_GUILESS_MAIN(tst_CanAllocations)
#include "tst_CanAllocations.moc"
