// SPDX-License-Identifier: Apache-2.0
#include "CanBench.h"

#include <QtTest/QtTest>

namespace {

QString text(const char *latin1)
{
    return QString::fromLatin1(latin1);
}

}  // namespace

class tst_CanConfiguration : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void validKeysAreAccepted_data();
    void validKeysAreAccepted();
    void invalidKeysAreReported_data();
    void invalidKeysAreReported();
    void missingDeviceKeyIsRefused();
    void bitRateIsAcceptedOnlyForPlugins_data();
    void bitRateIsAcceptedOnlyForPlugins();
    void configurationReportsErrorsOfTheDbcFile();
    void unknownChannelsAreRefused_data();
    void unknownChannelsAreRefused();
    void unsupportedMessageIsRefusedWithTheReason();
    void signalsThatOverlapAreWarnedOf_data();
    void signalsThatOverlapAreWarnedOf();
    void channelMayBeWiredTwice();
};

void tst_CanConfiguration::validKeysAreAccepted_data()
{
    QTest::addColumn<QByteArray>("keys");
    for (const char *keys :
         {"frame.A = 0x123, 8 bytes", "frame.A = 291, 1 byte", "frame.A = 0x00000123, 8 bytes, every 0.5 s",
          "frame.A = 0x18FEDFFE, 64 bytes, fd, no bit rate switch", "frame.A = 5, 0 bytes, extended",
          "frame.A = 1, 8 bytes\nsignal.A.S = 0|16@1- (0.1,0)",
          "frame.A = 1, 8 bytes\nsignal.A.M = M 0|8@1+\nsignal.A.S = m1 8|16@0+",
          "frame.A = 1, 8 bytes\nsignal.A.M = M 0|8@1+\nsignal.A.S = m1 8|8@1+\nsignal.A.T = m2 8|16@1+",
          "frame.A = 1, 8 bytes\nsend.A = on change, every 100 ms, at most every 20 ms",
          "frame.A = 1, 8 bytes\nsignal.A.C = 8|4@1+\ncounter.A = C, up to 14",
          "frame.A = 1, 8 bytes\nsignal.A.C = 15|8@0+\nchecksum.A = C, crc8, polynomial 0x2F, prefix 0a 1b",
          "frame.A = 0x18FEF1FE, 8 bytes, j1939\nsource.A = 0x21", "frame.A = 0x100, 8 bytes, j1939",
          "frame.A = 1, 8 bytes\nsend.A = every cycle",
          "frame.A = 1, 8 bytes\nsend.A = every 10 ms, on change, on request",
          "frame.A = 1, 8 bytes\nsend.A = every 250us\ntimeout.A = 20 ms"})
        QTest::newRow(QByteArray(keys).replace("\n", " / ")) << QByteArray(keys) + '\n';
}

void tst_CanConfiguration::validKeysAreAccepted()
{
    QFETCH(QByteArray, keys);
    CanBench bench(keys);
    QCOMPARE(bench.driver.errors(), QString());
}

void tst_CanConfiguration::invalidKeysAreReported_data()
{
    QTest::addColumn<QByteArray>("keys");
    QTest::addColumn<QString>("error");
    const auto row = [](const QByteArray &keys, const char *error) {
        QTest::newRow(QByteArray(keys).replace("\n", " / ")) << keys + '\n' << QString::fromLatin1(error);
    };
    row("frame.A = 0x123", "'0x123' is not a frame; write frame.A = 0x123, 8 bytes");
    row("frame.A = 0x20000000, 8 bytes", "is not a frame");
    row("frame.A = x, 8 bytes", "is not a frame");
    row("frame.A = 1, eight bytes", "is not a frame");
    row("frame.A = 1, 8 bytes, soon", "is not a frame");
    row("frame.a b = 1, 8 bytes", "is not a frame");
    row("frame.A = 1, 9 bytes", "no frame has 9 bytes");
    row("frame.A = 1, 65 bytes", "no frame has 65 bytes");
    row("frame.A = 1, 8 bytes\nframe.B = 1, 4 bytes", "frame 'B' has the id of message 'A'");
    row("frame.A = 1, 8 bytes\nsignal.A.M = M 0|8@1+\nsignal.A.S = m1 8|8@1+\nframe.B = 1, 4 bytes",
        "frame 'B' has the id of message 'A'; give each its own, or a multiplexor (M)");
    row("frame.A = 0x18FEF101, 8 bytes, j1939\nframe.B = 0x0CFEF101, 4 bytes, j1939",
        "frame 'B' has the id of message 'A'");
    row("frame.A = 0x18FEF1FE, 39 bytes, j1939",
        "it has 39 bytes, which J1939 sends in several frames (transport protocol, TP)");
    row("frame.A = 0x18FEF1FE, 8 bytes\nsource.A = 1", "message 'A' is not one of J1939");
    row("frame.A = 0x18FEF1FE, 8 bytes, j1939\nsource.A = 254", "is not a whole number from 0 to 253");
    row("frame.A = 0x18FEF101, 8 bytes, j1939\nsend.A = on request", "which has no remote frames");
    row("frame.A = 1, 8 bytes\nsend.A = every 10 ms, at most every 20 ms",
        "at most every 20 ms is less often than every 10 ms");
    row("frame.A = 1, 8 bytes\nsend.A = at most 20 ms", "does not say when to send");
    const char *const protections[][2]{
        {"counter.A = T", "message 'A' has no signal 'T'"},
        {"counter.A = S, up to 16",
         "'S, up to 16' is not an alive counter; write the name of its signal, and 'up to 14' "
         "if it does not count to 15"},
        {"counter.A = S, up to 0", "is not an alive counter"},
        {"counter.A = M", "signal 'M' of message 'A' has to be unsigned, and in each frame"},
        {"checksum.A = S, crc8", "signal 'S' of message 'A' is not one whole byte"},
        {"checksum.A = B", "'B' is not a checksum; write SIGNAL, crc8 (or xor, or sum)"},
        {"checksum.A = B, crc16", "is not a checksum"},
        {"checksum.A = B, xor, polynomial 7", "is not a checksum"},
        {"checksum.A = B, crc8, initial 256", "is not a checksum"},
        {"checksum.A = B, crc8, prefix 1g", "is not a checksum"},
        {"counter.B = S", "there is no message 'B'"},
    };
    for (const auto &protection : protections)
        row(QByteArray("frame.A = 1, 8 bytes\nsignal.A.S = 0|4@1+\nsignal.A.M = M 8|8@1+\nsignal.A.B = 16|8@1+\n")
                + protection[0],
            protection[1]);
    row("source.A = 1", "there is no message 'A'");
    row("frame.A = 1, 8 bytes\nsignal.A.S = m1M 0|8@1+", "write a frame of the same id for each");
    row("signal.A.S = 0|8@1+", "there is no frame 'A'; write a line frame.A");
    row("frame.A = 1, 8 bytes\nsignal.A.S = 0|8",
        "'0|8' is not the place of a signal: the end of the file instead of '@'");
    row("frame.A = 1, 1 byte\nsignal.A.S = 0|16@1+", "ends in byte 1, but message 'A' has only 1 bytes");
    row("frame.A = 1, 8 bytes\nsignal.A.S = 0|16@1f", "signal 'S' has 16 bits; a float has 32 or 64");
    row("frame.A = 1, 8 bytes\nsignal.A.S = M 0|8@1+\nsignal.A.T = M 8|8@1+", "frame 'A' has two multiplexors");
    row("frame.Drive = 1, 8 bytes\nsend.Drife = on change", "there is no message 'Drife'; did you mean 'Drive'?");
    row("frame.A = 1, 8 bytes\nsend.A = sometimes", "'sometimes' does not say when to send; write every cycle");
    row("frame.A = 1, 8 bytes\nsend.A = every 10", "'every 10' does not say when to send");
    row("frame.A = 1, 8 bytes\nsend.A = every 0 ms", "'every 0 ms' does not say when to send");
    row("frame.A = 1, 64 bytes\nsend.A = on request", "is one of CAN FD, which has no requests");
    row("timeout.A = 10 ms", "there is no message 'A'");
    row("frame.A = 1, 8 bytes\ntimeout.A = soon", "'soon' is not a duration");
    row("dbc = nowhere.dbc", "nowhere.dbc: cannot read the DBC file");
    row("bitrate = 500000", "'fake:bench' has no bit rate; remove the key bitrate");
}

void tst_CanConfiguration::invalidKeysAreReported()
{
    QFETCH(QByteArray, keys);
    QFETCH(QString, error);
    CanBench bench(keys);
    QVERIFY2(bench.driver.errors().contains(error), qPrintable(bench.driver.errors()));
    QCOMPARE(bench.driver.errors().count(QLatin1Char('\n')), 0);
}

void tst_CanConfiguration::missingDeviceKeyIsRefused()
{
    const DriverBench bench("can", "frame.A = 1, 8 bytes\n");
    QVERIFY2(bench.errors().contains(QLatin1String("device")), qPrintable(bench.errors()));
    const DriverBench other("can", "device = fake:\n");
    QVERIFY2(other.errors().contains(QLatin1String("'fake:' does not name a fake bus")), qPrintable(other.errors()));
}

void tst_CanConfiguration::bitRateIsAcceptedOnlyForPlugins_data()
{
    QTest::addColumn<QByteArray>("keys");
    QTest::addColumn<QString>("error");
    const auto row = [](const char *keys, const char *error) {
        QTest::newRow(QByteArray(keys).replace("\n", " / ")) << QByteArray(keys) + '\n' << QString::fromLatin1(error);
    };
    row("device = qtcan:peakcan:usb0\nbitrate = 250000", "");
    row("device = qtcan:peakcan:usb0\nbitrate = 1000000\ndata-bitrate = 8000000", "");
    row("device = qtcan:peakcan:usb0\nbitrate = 4999", "bitrate = '4999' is not a whole number from 5000 to 1000000");
    row("device = qtcan:peakcan:usb0\nbitrate = 1000001", "is not a whole number from 5000 to 1000000");
    row("device = qtcan:peakcan:usb0\nbitrate = 500k", "bitrate = '500k' is not a whole number from 5000 to 1000000");
    row("device = qtcan:peakcan:usb0\ndata-bitrate = 20000000", "is not a whole number from 5000 to 12000000");
    row("device = can0\nbitrate = 250000",
        "root sets the bit rate of 'can0' for all its programs (ip link set can0 up type can bitrate 500000 restart-ms "
        "100); remove the key bitrate");
    row("device = qtcan:socketcan:can1\ndata-bitrate = 2000000", "(ip link set can1 up type can bitrate");
}

void tst_CanConfiguration::bitRateIsAcceptedOnlyForPlugins()
{
    QFETCH(QByteArray, keys);
    QFETCH(QString, error);
    const DriverBench bench(QStringLiteral("can"), keys);
    if (keys.contains("peakcan") && bench.errors().contains(QLatin1String("no Qt Serial Bus")))
        QSKIP("this build has no Qt Serial Bus (libqt5serialbus5-dev)");
    QCOMPARE(bench.errors().isEmpty(), error.isEmpty());
    QVERIFY2(bench.errors().contains(error), qPrintable(bench.errors()));
}

void tst_CanConfiguration::configurationReportsErrorsOfTheDbcFile()
{
    const QTemporaryDir folder;
    QFile file(folder.filePath(QStringLiteral("a.dbc")));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("BO_ 1 A: 8 X\n SG_ S : 60|8@1+ (1,0) [0|0] \"\" X\n");
    file.close();
    CanBench bench("dbc = " + file.fileName().toUtf8() + "\n");
    QVERIFY2(bench.driver.errors().startsWith(file.fileName() + QStringLiteral(":2:6: signal 'S' has 8 bits")),
             qPrintable(bench.driver.errors()));
}

void tst_CanConfiguration::unknownChannelsAreRefused_data()
{
    QTest::addColumn<bool>("isRead");
    QTest::addColumn<QString>("error");
    const auto row = [](const char *channel, bool isRead, const char *error) {
        QTest::newRow(channel) << isRead << QString::fromLatin1(error);
    };
    row("Status.Sped", true, "driver 'can' has no channel 'Status.Sped' to read; did you mean 'Status.Speed'?");
    row("Status.@ages", true, "'Status.@ages' to read; did you mean 'Status.@age'?");
    row("Nothing", true, "driver 'can' has no channel 'Nothing' to read");
    row("@lots", true, "'@lots' to read; did you mean '@lost'?");
    row("Status.@count", false, "driver 'can' has no channel 'Status.@count' to write");
    row("@lost", false, "driver 'can' has no channel '@lost' to write");
}

void tst_CanConfiguration::unknownChannelsAreRefused()
{
    QFETCH(bool, isRead);
    QFETCH(QString, error);
    CanBench bench("frame.Status = 1, 8 bytes\nsignal.Status.Speed = 0|8@1+\n");
    const QString channel = QString::fromLatin1(QTest::currentDataTag());
    const QString message = isRead ? bench.driver.wireRead(channel) : bench.driver.wireWrite(channel);
    QVERIFY2(message.contains(error), qPrintable(message));
}

void tst_CanConfiguration::unsupportedMessageIsRefusedWithTheReason()
{
    CanBench bench("frame.A = 1, 8 bytes\nsignal.A.S = m1 0|8@1+\n");
    QCOMPARE(bench.driver.errors(), QString());
    QCOMPARE(bench.driver.wireRead(QStringLiteral("A.S")),
             QStringLiteral("message 'A' cannot be used: it has multiplexed signals and no multiplexor (M)"));
}

void tst_CanConfiguration::signalsThatOverlapAreWarnedOf_data()
{
    QTest::addColumn<QByteArray>("keys");
    QTest::addColumn<QStringList>("warnings");
    const auto row = [](const QByteArray &keys, const QStringList &warnings) {
        QTest::newRow(QByteArray(keys).replace("\n", " / ")) << keys + '\n' << warnings;
    };
    const QByteArray frame = "frame.A = 1, 8 bytes\n";
    row(frame + "signal.A.S = 0|16@1+\nsignal.A.T = 15|2@1+\nsignal.A.U = 12|1@1+",
        {text("signals 'S' and 'T' of frame 'A'"), text("signals 'S' and 'U' of frame 'A'")});
    row(frame + "signal.A.S = m1 8|16@1+\nsignal.A.M = M 0|8@1+\nsignal.A.T = m2 8|16@1+", {});
    row(frame + "signal.A.S = m1 8|16@1+\nsignal.A.M = M 0|8@1+\nsignal.A.T = m1 16|16@1+",
        {text("signals 'S' and 'T' of frame 'A'")});
    row(frame + "signal.A.S = m1 0|16@1+\nsignal.A.M = M 0|8@1+", {text("signals 'S' and 'M' of frame 'A'")});
    row("dbc = a.dbc", {});
    row("dbc = a.dbc\n[bench.read]\nx = Same.U\ny = Pages.S", {text("signals 'S' and 'T' of message 'Same'")});
    row("dbc = a.dbc\n[bench.write]\nPages.S = x\n[bench.safe]\nSame.T = 0",
        {text("signals 'S' and 'T' of message 'Same'")});
}

// In a DBC file each used message once, and pages apart.
void tst_CanConfiguration::signalsThatOverlapAreWarnedOf()
{
    QFETCH(QByteArray, keys);
    QFETCH(QStringList, warnings);
    const auto signal = [](const char *name, const char *place) {
        return QByteArray(" SG_ ") + name + " : " + place + "@1+ (1,0) [0|0] \"\" X\n";
    };
    const QByteArray dbc = "BO_ 5 Same: 8 X\n" + signal("S", "0|8") + signal("T", "4|8") + signal("U", "4|2")
        + "BO_ 6 Pages: 8 X\n" + signal("M M", "0|8") + signal("S m1", "8|8") + signal("T m2", "8|8")
        + signal("N m3M", "8|8") + signal("V m0", "16|8") + signal("W m1", "16|8")
        + "SG_MUL_VAL_ 6 S M 1-1;\nSG_MUL_VAL_ 6 T M 2-2;\nSG_MUL_VAL_ 6 V N 0-4;\nSG_MUL_VAL_ 6 W N 5-9;\n";
    CanBench bench(keys, {{text("a.dbc"), dbc}});
    QCOMPARE(bench.driver.errors(), QString());
    const QVector<QPlcParseError> told = bench.driver.warnings();
    QCOMPARE(told.size(), warnings.size());
    for (int i = 0; i < told.size(); ++i)
        QVERIFY2(told.at(i).message.startsWith(warnings.at(i)), qPrintable(told.at(i).message));
}

void tst_CanConfiguration::channelMayBeWiredTwice()
{
    CanBench bench("frame.A = 1, 8 bytes\nsignal.A.S = 0|8@1+\n");
    bench.driver.wireRead(QStringLiteral("A.S"));
    bench.driver.wireRead(QStringLiteral("A.S"));
    bench.driver.wireRead(QStringLiteral("@lost"));
    bench.driver.wireRead(QStringLiteral("@lost"));
    QVERIFY(bench.open());
    bench.send(1, "07");
    bench.send(1, "0700000000000000");
    QVERIFY(bench.cycle());
    QCOMPARE(bench.driver.value(QStringLiteral("A.S")), 7.0);
}

QTEST_GUILESS_MAIN(tst_CanConfiguration)
#include "tst_CanConfiguration.moc"
