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

// Root selects Sub and C, and Sub selects A and B.
QByteArray nestedMessage()
{
    const auto signal = [](const char *name, const char *place) {
        return QByteArray(" SG_ ") + name + " : " + place + "|8@1+ (1,0) [0|0] \"\" X\n";
    };
    return "BO_ 768 P: 3 X\n" + signal("B m2", "16") + signal("A m1", "16") + signal("Sub m0M", "8")
        + signal("Root M", "0") + signal("C m1", "8")
        + "SG_MUL_VAL_ 768 A Sub 1-1;\nSG_MUL_VAL_ 768 B Sub 2-2;\nSG_MUL_VAL_ 768 Sub Root 0-0;\n"
          "SG_MUL_VAL_ 768 C Root 1-1;\n";
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
    void changesKeepTheSmallestGap();
    void gapIsThatOfTheDbcFile();
    void safeValuesKeepNoGap();
    void aliveCounterCountsFramesThatAreSent();
    void aliveCounterBeginsAgain();
    void checksumIsThatOfTheBytes_data();
    void checksumIsThatOfTheBytes();
    void protectedSignalsAreNotWritten();
    void remoteRequestIsAnswered();
    void requestsForOtherMessagesAreIgnored();
    void safeValuesAreSentInTheSameCycle_data();
    void safeValuesAreSentInTheSameCycle();
    void unwiredSignalsHaveTheirStartValue();
    void multiplexedPagesAreAllSent();
    void wiredMultiplexorChoosesThePage();
    void multiplexorAloneIsSent();
    void rangeIsSentOnThePageOfTheOthers_data();
    void rangeIsSentOnThePageOfTheOthers();
    void nestedPagesAreAllSent();
    void wiredNestedMultiplexorChoosesThePage();
    void framesOfOneIdAreAllSent();
    void j1939IsSentWithTheSourceOfTheKey();
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

void tst_CanSending::changesKeepTheSmallestGap()
{
    CanBench bench(commandSent("on change, at most every 20 ms"));
    QCOMPARE(bench.driver.errors(), QString());
    bench.driver.wireWrite(speed);
    QVERIFY(bench.open());
    QByteArrayList sent;
    for (int i = 1; i <= 50; ++i) {
        bench.driver.set(speed, i);
        bench.cycle();
        const QByteArray received = bench.received();
        if (!received.isEmpty())
            sent << received;
    }
    QCOMPARE(sent.join(' '), QByteArray("200#0100 200#1500 200#2900"));  // 1, 21 and 41
    QCOMPARE(bench.framesIn(30), 1);                                     // the last change is not lost
    QCOMPARE(bench.framesIn(30), 0);
    bench.driver.set(speed, 7.0);
    QCOMPARE(bench.framesIn(1), 1);
}

void tst_CanSending::gapIsThatOfTheDbcFile()
{
    CanBench bench("dbc = a.dbc\nsend.Command = on change\n",
                   {{text("a.dbc"),
                     "BO_ 512 Command: 2 X\n SG_ Speed : 0|8@1- (1,0) [0|0] \"\" X\n"
                     "BA_DEF_DEF_ \"GenMsgDelayTime\" 0;\nBA_ \"GenMsgDelayTime\" BO_ 512 5;\n"}});
    QCOMPARE(bench.driver.errors(), QString());
    bench.driver.wireWrite(speed);
    QVERIFY(bench.open());
    int frames = 0;
    for (int i = 0; i < 50; ++i) {
        bench.driver.set(speed, i);
        frames += bench.framesIn(1);
    }
    QCOMPARE(frames, 10);
}

void tst_CanSending::safeValuesKeepNoGap()
{
    CanBench bench(commandSent("on change, at most every 1 s"));
    bench.driver.wireWrite(speed);
    QVERIFY(bench.open());
    bench.driver.set(speed, 1.0);
    QCOMPARE(bench.framesIn(1), 1);
    bench.driver.set(speed, 0.0, true);
    bench.cycle();
    QCOMPARE(bench.received(), QByteArray("200#0000"));
}

void tst_CanSending::aliveCounterCountsFramesThatAreSent()
{
    CanBench bench(commandSent("every 10 ms") + "counter.Command = Other\n");
    QCOMPARE(bench.driver.errors(), QString());
    bench.driver.wireWrite(speed);
    QVERIFY(bench.open());
    bench.driver.set(speed, 1.0);
    for (int i = 0; i < 30; ++i)
        bench.cycle();
    QCOMPARE(bench.received(), QByteArray("200#0100 200#0101 200#0102"));
    QVERIFY(FakeCanBus::setAcknowledged(benchBus, false));
    for (int i = 0; i < 50; ++i)
        bench.cycle();
    QVERIFY(FakeCanBus::setAcknowledged(benchBus, true));
    for (int i = 0; i < 10; ++i)
        bench.cycle();
    QVERIFY2(bench.received().startsWith("200#0103 200#0104"), "frames that were held back do not count");
}

void tst_CanSending::aliveCounterBeginsAgain()
{
    CanBench bench("frame.C = 1, 1 byte\nsignal.C.Alive = 4|4@1+\nsignal.C.S = 0|4@1+\ncounter.C = Alive, up to 2\n"
                   "send.C = on change\n");
    QCOMPARE(bench.driver.errors(), QString());
    bench.driver.wireWrite(text("C.S"));
    QVERIFY(bench.open());
    for (int i = 0; i < 5; ++i) {
        bench.driver.set(text("C.S"), i);
        bench.cycle();
        bench.cycle();  // the counter alone is no change
    }
    QCOMPARE(bench.received(), QByteArray("1#00 1#11 1#22 1#03 1#14"));
}

void tst_CanSending::checksumIsThatOfTheBytes_data()
{
    QTest::addColumn<QByteArray>("method");
    QTest::addColumn<QByteArray>("frame");
    // The check values of the catalogue of CRCs, of "123456789": the first two bytes are a prefix.
    const auto row = [](const char *method, const char *checksum) {
        QTest::newRow(method) << QByteArray(method) << QByteArray("1#") + checksum + "33343536373839";
    };
    row("crc8, prefix 31 32", "4b");                                         // SAE J1850
    row("crc8, polynomial 0x2F, prefix 31 32", "df");                        // AUTOSAR, 0x2F
    row("crc8, polynomial 0x07, initial 0, final 0, prefix 3132", "f4");     // SMBus
    row("crc8, polynomial 0x07, initial 0, final 0x55, prefix 3132", "a1");  // ITU
    row("sum, prefix 31 32", "dd");
    row("xor, prefix 31 32", "31");
    row("xor", "32");
}

void tst_CanSending::checksumIsThatOfTheBytes()
{
    QFETCH(QByteArray, method);
    QFETCH(QByteArray, frame);
    CanBench bench("frame.C = 1, 8 bytes\nsignal.C.Check = 0|8@1+\nsignal.C.A = 15|24@0+\nsignal.C.B = 39|32@0+\n"
                   "checksum.C = Check, "
                   + method + "\n");
    QCOMPARE(bench.driver.errors(), QString());
    bench.driver.wireWrite(text("C.A"));
    bench.driver.wireWrite(text("C.B"));
    QVERIFY(bench.open());
    bench.driver.set(text("C.A"), 0x333435);
    bench.driver.set(text("C.B"), 0x36373839);
    bench.cycle();
    QCOMPARE(bench.received(), frame);
}

void tst_CanSending::protectedSignalsAreNotWritten()
{
    CanBench bench(commandSent("every cycle") + "counter.Command = Other\n");
    QVERIFY(bench.driver.wireWrite(text("Command.Other")).startsWith(text("the driver writes signal 'Other'")));
    QCOMPARE(bench.driver.wireRead(text("Command.Other")), QString());
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

void tst_CanSending::rangeIsSentOnThePageOfTheOthers_data()
{
    QTest::addColumn<QByteArrayList>("wired");
    QTest::addColumn<QByteArray>("sent");
    QTest::newRow("alone") << QByteArrayList{"P.Range"} << QByteArray("300#030009");
    QTest::newRow("with one of its pages") << QByteArrayList{"P.Range", "P.Five"} << QByteArray("300#050909");
    QTest::newRow("with two") << QByteArrayList{"P.Five", "P.Range", "P.Four"} << QByteArray("300#040909 300#050909");
    QTest::newRow("with another one") << QByteArrayList{"P.Range", "P.One"} << QByteArray("300#010900 300#030009");
}

void tst_CanSending::rangeIsSentOnThePageOfTheOthers()
{
    QFETCH(QByteArrayList, wired);
    QFETCH(QByteArray, sent);
    const auto signal = [](const char *name, const char *place) {
        return QByteArray(" SG_ ") + name + " : " + place + "|8@1+ (1,0) [0|0] \"\" X\n";
    };
    CanBench bench("dbc = p.dbc\n",
                   {{text("p.dbc"),
                     "BO_ 768 P: 3 X\n" + signal("Page M", "0") + signal("One m1", "8") + signal("Four m4", "8")
                         + signal("Five m5", "8") + signal("Range m3", "16") + "SG_MUL_VAL_ 768 Range Page 3-6;\n"}});
    QCOMPARE(bench.driver.errors(), QString());
    for (const QByteArray &name : qAsConst(wired))
        QCOMPARE(bench.driver.wireWrite(QString::fromLatin1(name)), QString());
    QVERIFY(bench.open());
    for (const QByteArray &name : qAsConst(wired))
        bench.driver.set(QString::fromLatin1(name), 9.0);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.received(), sent);
}

void tst_CanSending::nestedPagesAreAllSent()
{
    CanBench bench("dbc = p.dbc\n", {{text("p.dbc"), nestedMessage()}});
    for (const char *name : {"P.C", "P.B", "P.A"})
        QCOMPARE(bench.driver.wireWrite(text(name)), QString());
    QVERIFY(bench.open());
    bench.driver.set(text("P.A"), 1.0);
    bench.driver.set(text("P.B"), 2.0);
    bench.driver.set(text("P.C"), 3.0);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.received(), QByteArray("300#000101 300#000202 300#010300"));
}

void tst_CanSending::wiredNestedMultiplexorChoosesThePage()
{
    CanBench bench("dbc = p.dbc\n", {{text("p.dbc"), nestedMessage()}});
    for (const char *name : {"P.A", "P.Sub", "P.B", "P.Root", "P.C"})
        QCOMPARE(bench.driver.wireWrite(text(name)), QString());
    QVERIFY(bench.open());
    for (const char *name : {"P.A", "P.B", "P.C"})
        bench.driver.set(text(name), name[2] - 'A' + 1);
    const auto sentWith = [&bench](double root, double sub) {
        bench.driver.set(text("P.Root"), root);
        bench.driver.set(text("P.Sub"), sub);
        bench.cycle();
        return bench.received();
    };
    QCOMPARE(sentWith(0.0, 1.0), QByteArray("300#000101"));
    QCOMPARE(sentWith(0.0, 2.0), QByteArray("300#000202"));
    QCOMPARE(sentWith(0.0, 3.0), QByteArray());  // there is no such page
    QCOMPARE(sentWith(1.0, 2.0), QByteArray("300#010300"));
}

void tst_CanSending::framesOfOneIdAreAllSent()
{
    CanBench bench("frame.A = 5, 2 bytes\nsignal.A.Page = M 0|8@1+\nsignal.A.S = m1 8|8@1+\n"
                   "frame.B = 5, 3 bytes\nsignal.B.Page = M 0|8@1+\nsignal.B.S = m2 8|16@1+\n");
    QCOMPARE(bench.driver.wireWrite(text("A.S")), QString());
    QCOMPARE(bench.driver.wireWrite(text("B.S")), QString());
    QVERIFY(bench.open());
    bench.driver.set(text("A.S"), 3.0);
    bench.driver.set(text("B.S"), 4.0);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.received(), QByteArray("5#0103 5#020400"));
}

void tst_CanSending::j1939IsSentWithTheSourceOfTheKey()
{
    const QByteArray keys = "frame.Torque = 0x0C0003FE, 1 byte, j1939\nsignal.Torque.S = 0|8@1+\n";
    CanBench nameless(keys);
    QCOMPARE(nameless.driver.wireWrite(text("Torque.S")),
             QStringLiteral("message 'Torque' has no source address (the last byte of its id is 0xfe); write "
                            "source.Torque = address of this node, 0 ... 253"));
    CanBench bench(keys + "source.Torque = 0x21\n");
    QCOMPARE(bench.driver.wireWrite(text("Torque.S")), QString());
    QVERIFY(bench.open());
    bench.driver.set(text("Torque.S"), 3.0);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.received(), QByteArray("c000321#03"));
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
