// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "CanBench.h"
#include "hardware/can/CanLog.h"

#include <linux/can/error.h>

using namespace qplc;
using namespace std::chrono_literals;

namespace {

const QByteArray statusKeys = "frame.Status = 0x123, 4 bytes, every 10 ms\nsignal.Status.Speed = 0|16@1- (0.5,10)\n"
                              "signal.Status.Mode = 16|4@1+\n";

QString text(const char *name)
{
    return QString::fromLatin1(name);
}

}  // namespace

class tst_CanDriver : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void channelReturnsTheValueFromItsFrame();
    void newestFrameOfACycleCounts();
    void valueHasTheTimeOfItsFrame();
    void valueIsFreshForThreeCycleTimes();
    void messageTimeoutLimitsFreshness();
    void messageWithoutCycleTimeHasTheTimeoutOfTheDriver();
    void ageAndFrameCountIncrease();
    void multiplexedValueIsReadFromItsPage();
    void nestedMultiplexorIsFollowed();
    void framesOfOneIdAreToldApartByTheirMultiplexors();
    void groupOfJ1939ComesFromAnySource();
    void groupForOneNodeGoesToAnyDestination();
    void sourceSelectsTheSender();
    void messagesOfOneGroupAreToldApartByTheirSources();
    void frameWithAWrongChecksumIsIgnored();
    void frameWithTheSameAliveCounterIsIgnored();
    void otherMessagesChangeNoValue();
    void tooShortFramesAreCounted();
    void floodOfFramesIsReadInOrder();
    void firstCycleAfterAFloodReadsCurrentFrames();
    void lossesAreCounted();
    void stateFollowsTheController();
    void lastingBusOffEndsTheConnection();
    void valuesAreNotFreshAfterReopening();
    void logHasEverythingOnTheBus();
    void unwritableLogIsReportedAndTheBusOpens();
    void logOfAServiceIsInItsStateFolder();
    void missingInterfaceIsReportedWithARemedy();
};

void tst_CanDriver::channelReturnsTheValueFromItsFrame()
{
    CanBench bench(statusKeys);
    QCOMPARE(bench.driver.wireRead(text("Status.Speed")), QString());
    QCOMPARE(bench.driver.wireRead(text("Status.Mode")), QString());
    QVERIFY2(bench.open(), qPrintable(bench.driver.errorString()));
    QVERIFY(bench.cycle());
    QVERIFY(!bench.driver.isFresh(text("Status.Speed")));
    bench.send(0x123, "feff0500");
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("Status.Speed")), 9.0);
    QCOMPARE(bench.driver.value(text("Status.Mode")), 5.0);
}

void tst_CanDriver::newestFrameOfACycleCounts()
{
    CanBench bench(statusKeys);
    bench.driver.wireRead(text("Status.Mode"));
    bench.driver.wireRead(text("Status.@count"));
    QVERIFY(bench.open());
    for (const char *data : {"00000100", "00000200", "00000300"})
        bench.send(0x123, data);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("Status.Mode")), 3.0);
    QCOMPARE(bench.driver.value(text("Status.@count")), 3.0);
}

void tst_CanDriver::valueHasTheTimeOfItsFrame()
{
    CanBench bench(statusKeys);
    bench.driver.wireRead(text("Status.Mode"));
    QVERIFY(bench.open());
    bench.send(0x123, "00000100");
    const qint64 sent = bench.driver.now();
    QVERIFY(bench.cycle(7ms));
    QCOMPARE(bench.driver.time(text("Status.Mode")), sent);
}

void tst_CanDriver::valueIsFreshForThreeCycleTimes()
{
    CanBench bench(statusKeys);
    bench.driver.wireRead(text("Status.Mode"));
    QVERIFY(bench.open());
    bench.send(0x123, "00000100");
    QVERIFY(bench.cycle(30ms));
    QVERIFY(bench.driver.isFresh(text("Status.Mode")));
    QVERIFY(bench.cycle(1ns));
    QVERIFY(!bench.driver.isFresh(text("Status.Mode")));
    bench.send(0x123, "00000200");
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("Status.Mode")), 2.0);
}

void tst_CanDriver::messageTimeoutLimitsFreshness()
{
    CanBench bench(statusKeys + "timeout.Status = 200 ms\n");
    bench.driver.wireRead(text("Status.Mode"));
    QVERIFY(bench.open());
    bench.send(0x123, "00000100");
    QVERIFY(bench.cycle(200ms));
    QVERIFY(bench.driver.isFresh(text("Status.Mode")));
    QVERIFY(bench.cycle(1ns));
    QVERIFY(!bench.driver.isFresh(text("Status.Mode")));
}

void tst_CanDriver::messageWithoutCycleTimeHasTheTimeoutOfTheDriver()
{
    CanBench bench("timeout = 50 ms\nframe.A = 1, 1 byte\nsignal.A.S = 0|8@1+\n");
    bench.driver.wireRead(text("A.S"));
    QVERIFY(bench.open());
    bench.send(1, "07");
    QVERIFY(bench.cycle(50ms));
    QVERIFY(bench.driver.isFresh(text("A.S")));
    QVERIFY(bench.cycle(1ns));
    QVERIFY(!bench.driver.isFresh(text("A.S")));
}

void tst_CanDriver::ageAndFrameCountIncrease()
{
    CanBench bench(statusKeys);
    bench.driver.wireRead(text("Status.@age"));
    bench.driver.wireRead(text("Status.@count"));
    QVERIFY(bench.open());
    QVERIFY(bench.cycle());
    QVERIFY(!bench.driver.isFresh(text("Status.@age")));
    QCOMPARE(bench.driver.value(text("Status.@count")), 0.0);
    bench.send(0x123, "00000000");
    QVERIFY(bench.cycle(250ms));
    QCOMPARE(bench.driver.value(text("Status.@age")), 0.25);
    QVERIFY(bench.cycle(1s));
    QCOMPARE(bench.driver.value(text("Status.@age")), 1.25);
    QCOMPARE(bench.driver.value(text("Status.@count")), 1.0);
}

void tst_CanDriver::multiplexedValueIsReadFromItsPage()
{
    CanBench bench(
        "frame.T = 5, 3 bytes\nsignal.T.Page = M 0|8@1+\nsignal.T.Motor = m0 8|16@1-\nsignal.T.Inverter = m1 8|16@1-\n"
        "signal.T.Always = 4|4@1+\n");
    for (const char *name : {"T.Page", "T.Motor", "T.Inverter"})
        QCOMPARE(bench.driver.wireRead(text(name)), QString());
    QVERIFY(bench.open());
    bench.send(5, "000700");
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("T.Motor")), 7.0);
    QVERIFY(!bench.driver.isFresh(text("T.Inverter")));
    bench.send(5, "010900");
    bench.send(5, "020b00");
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("T.Motor")), 7.0);
    QCOMPARE(bench.driver.value(text("T.Inverter")), 9.0);
    QCOMPARE(bench.driver.value(text("T.Page")), 2.0);
}

void tst_CanDriver::nestedMultiplexorIsFollowed()
{
    const QByteArray dbc = "BO_ 5 T: 3 X\n SG_ Page M : 0|8@1+ (1,0) [0|0] \"\" X\n"
                           " SG_ Sub m0M : 8|8@1+ (1,0) [0|0] \"\" X\n SG_ A m1 : 16|8@1+ (1,0) [0|0] \"\" X\n"
                           " SG_ B m1 : 16|8@1+ (1,0) [0|0] \"\" X\n"
                           "SG_MUL_VAL_ 5 Sub Page 0-0;\nSG_MUL_VAL_ 5 A Sub 1-3;\nSG_MUL_VAL_ 5 B Page 1-2;\n";
    CanBench bench("dbc = t.dbc\n", {{QStringLiteral("t.dbc"), dbc}});
    for (const char *name : {"T.Sub", "T.A", "T.B"})
        QCOMPARE(bench.driver.wireRead(text(name)), QString());
    QVERIFY2(bench.open(), qPrintable(bench.driver.errorString()));
    bench.send(5, "000207");
    bench.send(5, "000409");  // A is not there
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("T.A")), 7.0);
    QCOMPARE(bench.driver.value(text("T.Sub")), 4.0);
    QVERIFY(!bench.driver.isFresh(text("T.B")));
    bench.send(5, "02020b");
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("T.A")), 7.0);
    QCOMPARE(bench.driver.value(text("T.Sub")), 4.0);
    QCOMPARE(bench.driver.value(text("T.B")), 11.0);
}

void tst_CanDriver::framesOfOneIdAreToldApartByTheirMultiplexors()
{
    CanBench bench("frame.A = 5, 3 bytes\nsignal.A.Page = M 0|8@1+\nsignal.A.S = m1 8|8@1+\n"
                   "frame.B = 5, 3 bytes\nsignal.B.Page = M 8|8@1+\nsignal.B.S = m7 16|8@1+\n");
    QCOMPARE(bench.driver.errors(), QString());
    for (const char *name : {"A.S", "A.@count", "B.S", "B.@count"})
        QCOMPARE(bench.driver.wireRead(text(name)), QString());
    QVERIFY(bench.open());
    bench.send(5, "010203");
    bench.send(5, "010400");
    bench.send(5, "000709");
    bench.send(5, "000000");  // of neither
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("A.S")), 4.0);
    QCOMPARE(bench.driver.value(text("A.@count")), 2.0);
    QCOMPARE(bench.driver.value(text("B.S")), 9.0);
    QCOMPARE(bench.driver.value(text("B.@count")), 1.0);
}

void tst_CanDriver::groupOfJ1939ComesFromAnySource()
{
    CanBench bench("frame.Speed = 0x18FEF1FE, 2 bytes, j1939\nsignal.Speed.S = 0|8@1+\n");
    QCOMPARE(bench.driver.errors(), QString());
    bench.driver.wireRead(text("Speed.S"));
    bench.driver.wireRead(text("Speed.@count"));
    QVERIFY(bench.open());
    bench.send(0x18FEF117, "0500", CanFrame::Extended);
    bench.send(0x0CFEF100, "0600", CanFrame::Extended);  // another priority
    bench.send(0x18FEF217, "0700", CanFrame::Extended);  // another group
    bench.send(0x19FEF117, "0800", CanFrame::Extended);  // of another data page
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("Speed.S")), 6.0);
    QCOMPARE(bench.driver.value(text("Speed.@count")), 2.0);
}

void tst_CanDriver::groupForOneNodeGoesToAnyDestination()
{
    CanBench bench("frame.Torque = 0x0C00FFFE, 1 byte, j1939\nsignal.Torque.S = 0|8@1+\n");
    bench.driver.wireRead(text("Torque.S"));
    bench.driver.wireRead(text("Torque.@count"));
    QVERIFY(bench.open());
    bench.send(0x0C000003, "01", CanFrame::Extended);
    bench.send(0x0C000F21, "02", CanFrame::Extended);
    bench.send(0x0C010003, "03", CanFrame::Extended);  // another group
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("Torque.S")), 2.0);
    QCOMPARE(bench.driver.value(text("Torque.@count")), 2.0);
}

void tst_CanDriver::sourceSelectsTheSender()
{
    CanBench bench("frame.Speed = 0x18FEF1FE, 1 byte, j1939\nsignal.Speed.S = 0|8@1+\nsource.Speed = 0x17\n");
    bench.driver.wireRead(text("Speed.S"));
    QVERIFY(bench.open());
    bench.send(0x18FEF117, "05", CanFrame::Extended);
    bench.send(0x18FEF118, "06", CanFrame::Extended);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("Speed.S")), 5.0);
}

void tst_CanDriver::messagesOfOneGroupAreToldApartByTheirSources()
{
    CanBench bench("frame.Left = 0x18FEF101, 1 byte, j1939\nsignal.Left.S = 0|8@1+\n"
                   "frame.Right = 0x18FEF102, 1 byte, j1939\nsignal.Right.S = 0|8@1+\n");
    QCOMPARE(bench.driver.errors(), QString());
    bench.driver.wireRead(text("Left.S"));
    bench.driver.wireRead(text("Right.S"));
    QVERIFY(bench.open());
    bench.send(0x18FEF101, "05", CanFrame::Extended);
    bench.send(0x18FEF102, "06", CanFrame::Extended);
    bench.send(0x18FEF103, "07", CanFrame::Extended);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("Left.S")), 5.0);
    QCOMPARE(bench.driver.value(text("Right.S")), 6.0);
}

void tst_CanDriver::frameWithAWrongChecksumIsIgnored()
{
    CanBench bench("frame.S = 5, 3 bytes\nsignal.S.V = 0|8@1+\nsignal.S.Check = 16|8@1+\nchecksum.S = Check, xor\n");
    QCOMPARE(bench.driver.errors(), QString());
    for (const char *name : {"S.V", "S.@count", "@corrupt"})
        bench.driver.wireRead(text(name));
    QVERIFY(bench.open());
    bench.send(5, "0a0309");
    bench.send(5, "0b0309");
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("S.V")), 10.0);
    QCOMPARE(bench.driver.value(text("S.@count")), 1.0);
    QCOMPARE(bench.driver.value(text("@corrupt")), 1.0);
}

// A sender that hangs while its controller goes on: the value is not fresh for ever.
void tst_CanDriver::frameWithTheSameAliveCounterIsIgnored()
{
    CanBench bench("frame.S = 5, 2 bytes, every 10 ms\nsignal.S.V = 0|8@1+\nsignal.S.Alive = 8|4@1+\n"
                   "counter.S = Alive\n");
    QCOMPARE(bench.driver.errors(), QString());
    for (const char *name : {"S.V", "@corrupt"})
        bench.driver.wireRead(text(name));
    QVERIFY(bench.open());
    bench.send(5, "0a0f");
    bench.send(5, "0b00");
    bench.send(5, "0c05");  // frames were lost: the value counts
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("S.V")), 12.0);
    for (int i = 0; i < 4; ++i) {
        bench.send(5, "0d05");
        QVERIFY(bench.cycle(10ms));
    }
    QVERIFY(!bench.driver.isFresh(text("S.V")));
    QCOMPARE(bench.driver.value(text("@corrupt")), 4.0);
}

void tst_CanDriver::otherMessagesChangeNoValue()
{
    CanBench bench(statusKeys + "frame.Other = 0x00000123, 4 bytes\nsignal.Other.S = 0|8@1+\n");
    bench.driver.wireRead(text("Status.Mode"));
    bench.driver.wireRead(text("Other.S"));
    bench.driver.wireRead(text("@received"));
    QVERIFY(bench.open());
    bench.send(0x124, "00000100");
    bench.send(0x123, "00000100", CanFrame::Remote);
    bench.send(0x123, "00000100", CanFrame::Extended);
    QVERIFY(bench.cycle());
    QVERIFY(!bench.driver.isFresh(text("Status.Mode")));
    QVERIFY(bench.driver.isFresh(text("Other.S")));
    QCOMPARE(bench.driver.value(text("@received")), 2.0);
}

void tst_CanDriver::tooShortFramesAreCounted()
{
    CanBench bench(statusKeys);
    bench.driver.wireRead(text("Status.Mode"));
    bench.driver.wireRead(text("@tooShort"));
    QVERIFY(bench.open());
    bench.send(0x123, "000001");
    QVERIFY(bench.cycle());
    QVERIFY(!bench.driver.isFresh(text("Status.Mode")));
    QCOMPARE(bench.driver.value(text("@tooShort")), 1.0);
}

void tst_CanDriver::floodOfFramesIsReadInOrder()
{
    CanBench bench("frame.A = 1, 2 bytes\nsignal.A.S = 0|16@1+\n");
    bench.driver.wireRead(text("A.S"));
    bench.driver.wireRead(text("A.@count"));
    QVERIFY(bench.open());
    for (int i = 0; i < 500; ++i) {
        const char bytes[] = {char(i), char(i >> 8)};
        bench.send(1, QByteArray(bytes, 2).toHex());
    }
    for (int i = 0; i < 60 && bench.driver.value(text("A.@count")) != 500.0; ++i) {
        QVERIFY(bench.cycle());
        bench.received();  // what has waited for room is given on
    }
    QCOMPARE(bench.driver.value(text("A.@count")), 500.0);
    QCOMPARE(bench.driver.value(text("A.S")), 499.0);
}

void tst_CanDriver::firstCycleAfterAFloodReadsCurrentFrames()
{
    CanBench bench(statusKeys);
    bench.driver.wireRead(text("Status.Mode"));
    bench.driver.wireRead(text("Status.@count"));
    QVERIFY(bench.open());
    bench.driver.runner().start([](const QString &) {});
    constexpr int frames = 100;
    for (int i = 0; i < frames; ++i) {
        bench.driver.advance(1ms);
        bench.send(0x123, "00000100");
    }
    const auto hasReadAll = [&] {
        bench.received();  // what waits for room goes on
        bench.driver.runner().read(bench.driver.now());
        return bench.driver.value(text("Status.@count")) == frames;
    };
    QTRY_VERIFY(hasReadAll());
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("Status.Mode")), 1.0);
    bench.driver.runner().stop();
}

void tst_CanDriver::lossesAreCounted()
{
    CanBench bench("frame.A = 1, 2 bytes\nsignal.A.S = 0|16@1+\n");
    bench.driver.wireRead(text("A.@count"));
    bench.driver.wireRead(text("@lost"));
    QVERIFY(bench.open());
    for (int i = 0; i < 10000; ++i)
        bench.send(1, "0000");
    for (int i = 0; i < 60; ++i) {
        QVERIFY(bench.cycle());
        bench.received();
    }
    QVERIFY(bench.driver.value(text("@lost")) > 0.0);
    QCOMPARE(bench.driver.value(text("A.@count")) + bench.driver.value(text("@lost")), 10000.0);
}

void tst_CanDriver::stateFollowsTheController()
{
    CanBench bench(statusKeys);
    for (const char *name : {"@state", "@errors", "@busOffs"})
        bench.driver.wireRead(text(name));
    QVERIFY(bench.open());
    bench.send(CAN_ERR_CRTL, "0010000000000000", CanFrame::Error);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("@state")), 2.0);
    bench.send(CAN_ERR_BUSOFF, "0000000000000000", CanFrame::Error);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("@state")), 3.0);
    bench.send(CAN_ERR_RESTARTED, "0000000000000000", CanFrame::Error);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("@state")), 0.0);
    QCOMPARE(bench.driver.value(text("@errors")), 3.0);
    QCOMPARE(bench.driver.value(text("@busOffs")), 1.0);
}

void tst_CanDriver::lastingBusOffEndsTheConnection()
{
    CanBench bench(statusKeys);
    bench.driver.wireRead(text("Status.Mode"));
    QVERIFY(bench.open());
    bench.send(CAN_ERR_BUSOFF, "0000000000000000", CanFrame::Error);
    QVERIFY(bench.cycle());
    QVERIFY(bench.cycle(999ms));
    QVERIFY(!bench.cycle(1ms));
    QVERIFY2(bench.driver.errorString().startsWith(
                 QLatin1String("receive from fake:bench: Network is down; the interface is down or bus-off")),
             qPrintable(bench.driver.errorString()));
}

void tst_CanDriver::valuesAreNotFreshAfterReopening()
{
    CanBench bench(statusKeys);
    for (const char *name : {"Status.Mode", "Status.@age", "@state"})
        bench.driver.wireRead(text(name));
    QVERIFY(bench.open());
    bench.send(0x123, "00000100");
    bench.send(CAN_ERR_BUSOFF, "0000000000000000", CanFrame::Error);
    QVERIFY(bench.cycle());
    QVERIFY(!bench.cycle(1s));
    bench.driver.close();
    QVERIFY(bench.driver.open());
    QVERIFY(bench.cycle());
    QVERIFY(!bench.driver.isFresh(text("Status.Mode")));
    QVERIFY(!bench.driver.isFresh(text("Status.@age")));
    QCOMPARE(bench.driver.value(text("@state")), 0.0);
}

void tst_CanDriver::logHasEverythingOnTheBus()
{
    CanBench bench(statusKeys + "frame.Out = 0x200, 1 byte\nsignal.Out.S = 0|8@1+\nlog = drive.log\n");
    bench.driver.wireRead(text("Status.Mode"));
    bench.driver.wireRead(text("@logDropped"));
    bench.driver.wireWrite(text("Out.S"));
    QVERIFY2(bench.open(), qPrintable(bench.driver.errorString()));
    bench.send(0x123, "00000100");
    bench.send(0x7ab, "", CanFrame::Remote);
    bench.driver.set(text("Out.S"), 9.0);
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(text("@logDropped")), 0.0);
    bench.driver.close();
    QFile file(bench.filePath(QStringLiteral("drive.log")));
    QVERIFY(file.open(QIODevice::ReadOnly));
    QVector<QPlcParseError> errors;
    const auto lines = CanLog::read(file.readAll(), file.fileName(), &errors);
    QVERIFY2(errors.isEmpty(), qPrintable(QPlcParseError::toString(errors)));
    QCOMPARE(lines.size(), 3);
    QCOMPARE(lines.at(0).frame.id, 0x200U);
    QCOMPARE(lines.at(0).frame.data[0], quint8(9));
    QCOMPARE(lines.at(1).frame.id, 0x123U);
    QVERIFY(lines.at(2).frame.has(CanFrame::Remote));
    QCOMPARE(lines.at(2).interface, QStringLiteral("fake:bench"));
}

void tst_CanDriver::unwritableLogIsReportedAndTheBusOpens()
{
    CanBench bench(statusKeys + "log = no/such/folder/drive.log\n");
    bench.driver.wireRead(text("Status.Mode"));
    bench.driver.wireRead(text("@logDropped"));
    const QString name = bench.filePath(QStringLiteral("no/such/folder/drive.log"));
    QTest::ignoreMessage(QtWarningMsg,
                         QRegularExpression(QStringLiteral("^bench goes on without a log: cannot write the log %1: ")
                                                .arg(QRegularExpression::escape(name))));
    QVERIFY2(bench.open(), qPrintable(bench.driver.errorString()));
    bench.send(0x123, "00000100");
    bench.send(0x7ab, "");
    QVERIFY(bench.cycle());
    QVERIFY(bench.driver.isFresh(text("Status.Mode")));
    QCOMPARE(bench.driver.value(text("@logDropped")), 2.0);
}

// systemd lets a service write into its state folder, and not beside its configuration.
void tst_CanDriver::logOfAServiceIsInItsStateFolder()
{
    const QTemporaryDir folder;
    qputenv("STATE_DIRECTORY", folder.path().toLocal8Bit() + ":/another/one");
    CanBench bench(statusKeys + "log = drive.log\n");
    qunsetenv("STATE_DIRECTORY");
    QVERIFY2(bench.open(), qPrintable(bench.driver.errorString()));
    QVERIFY(QFile::exists(folder.filePath(QStringLiteral("drive.log"))));
    QVERIFY(!QFile::exists(bench.filePath(QStringLiteral("drive.log"))));
}

void tst_CanDriver::missingInterfaceIsReportedWithARemedy()
{
    DriverBench bench("can", "device = nocan7\nframe.A = 1, 8 bytes\n");
    QCOMPARE(bench.errors(), QString());
    QVERIFY(!bench.open());
    QVERIFY2(bench.errorString().contains(QLatin1String("modprobe can_raw"))
                 || bench.errorString().contains(QLatin1String("'ip link' lists what there is")),
             qPrintable(bench.errorString()));
}

QTEST_GUILESS_MAIN(tst_CanDriver)
#include "tst_CanDriver.moc"
