// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "CanBench.h"
#include "hardware/can/CanSender.h"

using namespace qplc;
using namespace std::chrono_literals;

namespace {

QString text(const char *name)
{
    return QString::fromLatin1(name);
}

const QString speed = QStringLiteral("Command.Speed");

// A message of two bytes with one wired signal, and when it is sent.
QByteArray commandSent(const QByteArray &rule)
{
    return "frame.Command = 0x200, 2 bytes\nsignal.Command.Speed = 0|8@1-\nsignal.Command.Other = 8|8@1+\n"
        + (rule.isEmpty() ? QByteArray() : "send.Command = " + rule + "\n");
}

const QString benchBus = QStringLiteral("bench");
const QString count = QStringLiteral("Counting.Count");

QByteArray countingMessage(const QByteArray &rule)
{
    return "frame.Counting = 0x300, 2 bytes\nsignal.Counting.Count = 0|16@1+\nsend.Counting = " + rule + '\n';
}

// Frames of countingMessage() with begin ... end - 1.
QByteArray countedFrames(int begin, int end)
{
    QByteArrayList frames;
    for (int i = begin; i < end; ++i)
        frames << "300#" + QByteArray(1, char(i)).toHex() + QByteArray(1, char(i >> 8)).toHex();
    return frames.join(' ');
}

// Cycles of 100 Hz with these values. Returns what the partner got.
QByteArray countIn(CanBench *bench, int begin, int end)
{
    for (int i = begin; i < end; ++i) {
        bench->driver.set(count, i);
        bench->cycle(10ms);
    }
    return bench->received();
}

}  // namespace

class tst_CanSending : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void withoutRuleEveryCycleSends();
    void withoutValueNothingIsSent();
    void cycleTimeOfTheMessageIsItsPeriod();
    void periodMayBeShorterThanAMillisecond();
    void periodIsKept();
    void cycleJitterDoesNotShiftThePeriod();
    void skippedSendTimesAreNotRepeated();
    void onChangeSendsWhenBytesChange();
    void onChangeAndPeriodCanBeCombined();
    void remoteRequestIsAnswered();
    void requestsForOtherMessagesAreIgnored();
    void safeValuesAreSentInTheSameCycle_data();
    void safeValuesAreSentInTheSameCycle();
    void unwiredSignalsHaveTheirStartValue();
    void multiplexedPagesAreAllSent();
    void wiredMultiplexorChoosesThePage();
    void multiplexorAloneIsSent();
    void saturationIsCounted();
    void messagesKeepTheOrderOfTheWires();
    void longMessageIsSentAsFdFrame();
    void openSendsSafeValues();
    void frameRefusedByTheBusIsSentAgain();
    void refusedSafeValuesAreSentAgainWithoutCycles();
    void afterAnOutageTheNewestValueFollowsTheFrameOfTheController();
    void afterAnOutageOfAOneShotControllerTheFirstFrameIsNew();
    void afterAnOutageTheSafeValueFollowsTheFrameOfTheController();
    void outageKeepsTheFramesOfOneCycle();
    void changesDuringAnOutageAreSentOnce();
    void heldBackFramesAreCounted();
};

void tst_CanSending::withoutRuleEveryCycleSends()
{
    CanBench bench(commandSent(""));
    QCOMPARE(bench.driver.wireWrite(speed), QString());
    QVERIFY2(bench.open(), qPrintable(bench.driver.errorString()));
    bench.driver.set(speed, -2.0);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.received(), QByteArray("200#fe00"));
    QCOMPARE(bench.framesIn(10), 10);
}

void tst_CanSending::withoutValueNothingIsSent()
{
    CanBench bench(commandSent(""));
    bench.driver.wireWrite(speed);
    bench.driver.wireWrite(text("Command.Other"));
    QVERIFY(bench.open());
    bench.driver.set(speed, 1.0);
    QCOMPARE(bench.framesIn(3), 0);
    bench.driver.set(text("Command.Other"), 2.0);
    QCOMPARE(bench.framesIn(3), 3);
}

void tst_CanSending::cycleTimeOfTheMessageIsItsPeriod()
{
    CanBench bench("frame.Command = 0x200, 2 bytes, every 5 ms\nsignal.Command.Speed = 0|8@1-\n");
    bench.driver.wireWrite(speed);
    QVERIFY(bench.open());
    bench.driver.set(speed, 1.0);
    QCOMPARE(bench.framesIn(50), 10);
}

void tst_CanSending::periodMayBeShorterThanAMillisecond()
{
    CanBench bench("frame.Command = 0x200, 2 bytes, every 0.5 ms\nsignal.Command.Speed = 0|8@1-\n");
    bench.driver.wireWrite(speed);
    QVERIFY(bench.open());
    bench.driver.set(speed, 1.0);
    int sent = 0;
    for (int i = 0; i < 100; ++i) {
        bench.cycle(100us);
        sent += bench.received().isEmpty() ? 0 : 1;
    }
    QCOMPARE(sent, 20);
}

void tst_CanSending::periodIsKept()
{
    CanBench bench(commandSent("every 10 ms"));
    bench.driver.wireWrite(speed);
    QVERIFY(bench.open());
    bench.driver.set(speed, 1.0);
    QCOMPARE(bench.framesIn(1), 1);
    QCOMPARE(bench.framesIn(9), 0);
    QCOMPARE(bench.framesIn(1), 1);
    QCOMPARE(bench.framesIn(100), 10);
}

void tst_CanSending::cycleJitterDoesNotShiftThePeriod()
{
    CanBench bench(commandSent("every 10 ms"));
    bench.driver.wireWrite(speed);
    QVERIFY(bench.open());
    bench.driver.set(speed, 1.0);
    bench.cycle();
    bench.received();
    for (int period = 0; period < 20; ++period) {
        for (int i = 0; i < 9; ++i)
            bench.cycle();
        QCOMPARE(bench.received(), QByteArray());
        bench.cycle(period % 2 ? 1200us : 800us);
        QCOMPARE(bench.received(), QByteArray("200#0100"));
    }
}

void tst_CanSending::skippedSendTimesAreNotRepeated()
{
    CanBench bench(commandSent("every 10 ms"));
    bench.driver.wireWrite(speed);
    QVERIFY(bench.open());
    bench.driver.set(speed, 1.0);
    bench.cycle();
    bench.cycle(1s);
    QCOMPARE(bench.received(), QByteArray("200#0100 200#0100"));
    QCOMPARE(bench.framesIn(20), 2);
}

void tst_CanSending::onChangeSendsWhenBytesChange()
{
    CanBench bench(commandSent("on change"));
    bench.driver.wireWrite(speed);
    QVERIFY(bench.open());
    bench.driver.set(speed, 1.0);
    QCOMPARE(bench.framesIn(5), 1);
    bench.driver.set(speed, 1.4);  // the same raw value
    QCOMPARE(bench.framesIn(5), 0);
    bench.driver.set(speed, 2.0);
    QCOMPARE(bench.framesIn(5), 1);
    bench.driver.set(speed, 1.0);
    QCOMPARE(bench.framesIn(5), 1);
}

void tst_CanSending::onChangeAndPeriodCanBeCombined()
{
    CanBench bench(commandSent("on change, every 100 ms"));
    bench.driver.wireWrite(speed);
    QVERIFY(bench.open());
    bench.driver.set(speed, 1.0);
    QCOMPARE(bench.framesIn(100), 1);
    QCOMPARE(bench.framesIn(10), 1);
    bench.driver.set(speed, 2.0);
    QCOMPARE(bench.framesIn(10), 1);
}

void tst_CanSending::remoteRequestIsAnswered()
{
    CanBench bench(commandSent("on request"));
    bench.driver.wireWrite(speed);
    QVERIFY(bench.open());
    bench.driver.set(speed, 1.0);
    QCOMPARE(bench.framesIn(5), 0);
    bench.send(0x200, "", CanFrame::Remote);
    QCOMPARE(bench.framesIn(5), 1);
    bench.send(0x200, "", CanFrame::Remote);
    bench.send(0x200, "", CanFrame::Remote);
    QCOMPARE(bench.framesIn(5), 1);
}

void tst_CanSending::requestsForOtherMessagesAreIgnored()
{
    CanBench bench(commandSent("on request"));
    bench.driver.wireWrite(speed);
    QVERIFY(bench.open());
    bench.driver.set(speed, 1.0);
    bench.send(0x201, "", CanFrame::Remote);
    bench.send(0x200, "", CanFrame::Remote | CanFrame::Extended);
    bench.send(0x200, "0000");
    QCOMPARE(bench.framesIn(5), 0);
}

void tst_CanSending::safeValuesAreSentInTheSameCycle_data()
{
    QTest::addColumn<QByteArray>("rule");
    for (const char *rule : {"every cycle", "every 100 ms", "on change", "on request"})
        QTest::newRow(rule) << QByteArray(rule);
}

void tst_CanSending::safeValuesAreSentInTheSameCycle()
{
    QFETCH(QByteArray, rule);
    CanBench bench(commandSent(rule));
    bench.driver.wireWrite(speed);
    QVERIFY(bench.open());
    bench.driver.set(speed, 1.0);
    bench.framesIn(3);
    bench.driver.set(speed, 0.0, true);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.received(), QByteArray("200#0000"));
    if (rule != "every cycle")
        QCOMPARE(bench.framesIn(10), 0);
    bench.driver.set(speed, 1.0);
    bench.framesIn(1);
    bench.driver.set(speed, 0.0, true);
    QCOMPARE(bench.framesIn(1), 1);
}

void tst_CanSending::unwiredSignalsHaveTheirStartValue()
{
    const QTemporaryDir folder;
    QFile file(folder.filePath(QStringLiteral("a.dbc")));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("BO_ 512 Command: 3 X\n SG_ Speed : 0|8@1- (1,0) [0|0] \"\" X\n SG_ Other : 8|8@1+ (1,0) [0|0] \"\" X\n"
               " SG_ Third : 16|8@1+ (1,0) [0|0] \"\" X\nBA_ \"GenSigStartValue\" SG_ 512 Other 7;\n");
    file.close();
    CanBench bench("dbc = " + file.fileName().toUtf8() + "\n");
    QCOMPARE(bench.driver.wireWrite(speed), QString());
    QVERIFY(bench.open());
    bench.driver.set(speed, 1.0);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.received(), QByteArray("200#010700"));
}

void tst_CanSending::multiplexedPagesAreAllSent()
{
    CanBench bench(
        "frame.P = 0x300, 3 bytes\nsignal.P.Page = M 0|8@1+\nsignal.P.A = m0 8|8@1+\nsignal.P.B = m5 8|8@1+\n"
        "signal.P.C = m7 8|8@1+\nsignal.P.All = 16|8@1+\nsend.P = on change\n");
    for (const char *name : {"P.B", "P.A", "P.All"})
        QCOMPARE(bench.driver.wireWrite(text(name)), QString());
    QVERIFY(bench.open());
    bench.driver.set(text("P.A"), 1.0);
    bench.driver.set(text("P.B"), 2.0);
    bench.driver.set(text("P.All"), 3.0);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.received(), QByteArray("300#000103 300#050203"));
    QCOMPARE(bench.framesIn(3), 0);
}

void tst_CanSending::wiredMultiplexorChoosesThePage()
{
    CanBench bench(
        "frame.P = 0x300, 2 bytes\nsignal.P.Page = M 0|8@1+\nsignal.P.A = m0 8|8@1+\nsignal.P.B = m5 8|8@1+\n");
    for (const char *name : {"P.A", "P.B", "P.Page"})
        QCOMPARE(bench.driver.wireWrite(text(name)), QString());
    QVERIFY(bench.open());
    bench.driver.set(text("P.A"), 1.0);
    bench.driver.set(text("P.B"), 2.0);
    bench.driver.set(text("P.Page"), 5.0);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.received(), QByteArray("300#0502"));
    bench.driver.set(text("P.Page"), 0.0);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.received(), QByteArray("300#0001"));
    bench.driver.set(text("P.Page"), 3.0);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.received(), QByteArray());  // there is no such page
}

void tst_CanSending::multiplexorAloneIsSent()
{
    CanBench bench("frame.P = 0x300, 2 bytes\nsignal.P.Page = M 0|8@1+\nsignal.P.A = m0 8|8@1+\n");
    bench.driver.wireWrite(text("P.Page"));
    QVERIFY(bench.open());
    bench.driver.set(text("P.Page"), 4.0);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.received(), QByteArray("300#0400"));
}

void tst_CanSending::saturationIsCounted()
{
    CanBench bench(commandSent(""));
    bench.driver.wireWrite(speed);
    bench.driver.wireRead(text("@saturated"));
    QVERIFY(bench.open());
    bench.driver.set(speed, 500.0);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.received(), QByteArray("200#7f00"));
    QCOMPARE(bench.driver.value(text("@saturated")), 1.0);
    bench.driver.set(speed, 5.0);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("@saturated")), 1.0);
}

void tst_CanSending::messagesKeepTheOrderOfTheWires()
{
    CanBench bench("frame.B = 2, 1 byte\nsignal.B.S = 0|8@1+\nframe.A = 1, 1 byte\nsignal.A.S = 0|8@1+\n");
    bench.driver.wireWrite(text("A.S"));
    bench.driver.wireWrite(text("B.S"));
    QVERIFY(bench.open());
    bench.driver.set(text("A.S"), 1.0);
    bench.driver.set(text("B.S"), 2.0);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.received(), QByteArray("1#01 2#02"));
}

void tst_CanSending::longMessageIsSentAsFdFrame()
{
    CanBench bench("frame.F = 0x18FEDFFE, 12 bytes\nsignal.F.S = 88|8@1+\n");
    bench.driver.wireWrite(text("F.S"));
    QVERIFY(bench.open());
    bench.driver.set(text("F.S"), 1.0);
    QVERIFY(bench.cycle());
    CanFrame frame;
    QCOMPARE(bench.partner().receive(&frame, 1), 1);
    QCOMPARE(int(frame.flags), int(CanFrame::Extended | CanFrame::Fd | CanFrame::BitRateSwitch));
    QCOMPARE(frame.id, 0x18FEDFFEU);
    QCOMPARE(frame.size, quint8(12));
    QCOMPARE(frame.data[11], quint8(1));
}

void tst_CanSending::openSendsSafeValues()
{
    CanBench bench(commandSent("every 100 ms"));
    bench.driver.wireWrite(speed);
    QVERIFY(bench.open());
    bench.driver.set(speed, 3.0, true);
    QVERIFY(bench.cycle());
    bench.received();
    bench.driver.close();
    QVERIFY(bench.driver.open());
    QCOMPARE(bench.received(), QByteArray("200#0300"));
}

// A bus that is full now and then: seen from the sender alone.
void tst_CanSending::frameRefusedByTheBusIsSentAgain()
{
    CanBench bench(commandSent("on change"));
    CanMessage message;
    message.rule.onChange = true;
    message.description.size = 2;
    DbcSignal signal;
    signal.name = QStringLiteral("Speed");
    signal.length = 8;
    message.description.content = {signal};
    CanSender sender(&bench.driver.runner().driver(), message);
    sender.prepare();
    CanFrame frame;
    QCOMPARE(sender.collect(0, &frame), 1);
    sender.sent(false);
    QCOMPARE(sender.collect(1, &frame), 1);
    sender.sent(true);
    QCOMPARE(sender.collect(2, &frame), 0);
}

void tst_CanSending::refusedSafeValuesAreSentAgainWithoutCycles()
{
    CanBench bench(commandSent("on change"));
    bench.driver.wireWrite(speed);
    QVERIFY(bench.open());
    DriverRunner &runner = bench.driver.runner();
    runner.start([](const QString &) {});
    bench.driver.set(speed, 5.0);
    QByteArray received;
    const auto hasReceived = [&](const QByteArray &frame) { return (received += bench.received()).contains(frame); };
    const auto sendsInCycle = [&](const QByteArray &frame) {
        runner.write(monotonicNow());
        return hasReceived(frame);
    };
    QTRY_VERIFY(sendsInCycle("200#0500"));
    QVERIFY(FakeCanBus::setAcknowledged(benchBus, false));
    bench.driver.set(speed, 6.0);
    runner.write(monotonicNow());  // the controller has this one now
    bench.driver.set(speed, 0.0, true);
    runner.leave(monotonicNow());
    QCOMPARE(bench.received(), QByteArray());
    QVERIFY(FakeCanBus::setAcknowledged(benchBus, true));
    QTRY_VERIFY(hasReceived("200#0000"));
    QVERIFY2(received.contains("200#0600"), received.constData());
    runner.stop();
}

// ---- an outage: nobody acknowledges for 5 s, at 100 Hz ----

void tst_CanSending::afterAnOutageTheNewestValueFollowsTheFrameOfTheController()
{
    CanBench bench(countingMessage("every cycle"));
    bench.driver.wireWrite(count);
    QVERIFY(bench.open());
    QCOMPARE(countIn(&bench, 0, 10), countedFrames(0, 10));
    QVERIFY(FakeCanBus::setAcknowledged(benchBus, false));
    QCOMPARE(countIn(&bench, 10, 510), QByteArray());
    QVERIFY(FakeCanBus::setAcknowledged(benchBus, true));
    QCOMPARE(countIn(&bench, 510, 515), countedFrames(10, 11) + ' ' + countedFrames(510, 515));
}

void tst_CanSending::afterAnOutageOfAOneShotControllerTheFirstFrameIsNew()
{
    CanBench bench(countingMessage("every cycle"));
    bench.driver.wireWrite(count);
    QVERIFY(FakeCanBus::setOneShot(benchBus, true));
    QVERIFY(bench.open());
    countIn(&bench, 0, 10);
    QVERIFY(FakeCanBus::setAcknowledged(benchBus, false));
    QCOMPARE(countIn(&bench, 10, 510), QByteArray());
    QVERIFY(FakeCanBus::setAcknowledged(benchBus, true));
    QCOMPARE(countIn(&bench, 510, 515), countedFrames(510, 515));
}

void tst_CanSending::afterAnOutageTheSafeValueFollowsTheFrameOfTheController()
{
    CanBench bench(countingMessage("every 50 ms"));
    bench.driver.wireWrite(count);
    QVERIFY(bench.open());
    countIn(&bench, 1, 11);
    QVERIFY(FakeCanBus::setAcknowledged(benchBus, false));
    QCOMPARE(countIn(&bench, 11, 261), QByteArray());
    bench.driver.set(count, 0.0, true);
    for (int i = 0; i < 250; ++i)
        QVERIFY(bench.cycle(10ms));
    QVERIFY(FakeCanBus::setAcknowledged(benchBus, true));
    QVERIFY(bench.cycle(10ms));
    const QByteArray received = bench.received();
    QCOMPARE(received.count(' '), 1);
    QVERIFY2(received.startsWith("300#0b00") && received.endsWith("300#0000"), received.constData());
}

void tst_CanSending::outageKeepsTheFramesOfOneCycle()
{
    CanBench bench("frame.A = 1, 1 byte\nsignal.A.S = 0|8@1+\nframe.B = 2, 1 byte\nsignal.B.S = 0|8@1+\n");
    for (const char *name : {"A.S", "B.S"})
        bench.driver.wireWrite(text(name));
    QVERIFY(bench.open());
    const auto cycleWith = [&bench](double value) {
        bench.driver.set(text("A.S"), value);
        bench.driver.set(text("B.S"), value);
        bench.cycle(10ms);
        return bench.received();
    };
    cycleWith(1.0);
    QVERIFY(FakeCanBus::setAcknowledged(benchBus, false));
    for (int i = 2; i < 100; ++i)
        QCOMPARE(cycleWith(i), QByteArray());
    QVERIFY(FakeCanBus::setAcknowledged(benchBus, true));
    QCOMPARE(cycleWith(100.0), QByteArray("1#02 2#02 1#64 2#64"));
}

void tst_CanSending::changesDuringAnOutageAreSentOnce()
{
    CanBench bench(countingMessage("on change"));
    bench.driver.wireWrite(count);
    QVERIFY(bench.open());
    QCOMPARE(countIn(&bench, 0, 3), countedFrames(0, 3));
    QVERIFY(FakeCanBus::setAcknowledged(benchBus, false));
    QCOMPARE(countIn(&bench, 3, 50), QByteArray());
    QVERIFY(FakeCanBus::setAcknowledged(benchBus, true));
    for (int i = 0; i < 5; ++i)
        bench.cycle(10ms);
    QCOMPARE(bench.received(), countedFrames(3, 4) + ' ' + countedFrames(49, 50));
}

void tst_CanSending::heldBackFramesAreCounted()
{
    CanBench bench(countingMessage("every cycle"));
    bench.driver.wireWrite(count);
    for (const char *name : {"@sent", "@unsent", "@unconfirmed", "@state"})
        bench.driver.wireRead(text(name));
    const auto values = [&bench] {
        QVector<double> all;
        for (const char *name : {"@sent", "@unsent", "@unconfirmed", "@state"})
            all.append(bench.driver.value(text(name)));
        return all;
    };
    QVERIFY(bench.open());
    countIn(&bench, 0, 10);
    QCOMPARE(values(), (QVector<double>{10.0, 0.0, 0.0, 0.0}));
    QVERIFY(FakeCanBus::setAcknowledged(benchBus, false));
    countIn(&bench, 10, 20);
    QCOMPARE(values(), (QVector<double>{11.0, 9.0, 1.0, 2.0}));
    QVERIFY(FakeCanBus::setAcknowledged(benchBus, true));
    countIn(&bench, 20, 21);
    QCOMPARE(values(), (QVector<double>{12.0, 9.0, 0.0, 0.0}));
}

QTEST_GUILESS_MAIN(tst_CanSending)
#include "tst_CanSending.moc"
