// SPDX-License-Identifier: Apache-2.0
// The program of hardware nodes, as a process.
#include "../common/Waiting.h"
#include "FakeDevices.h"
#include "NodeFixtures.h"
#include "canopen/CanOpenPeer.h"
#include "hardware/can/FakeCanBus.h"

#include <QtCore/QProcess>
#include <QtCore/QTemporaryDir>

class tst_qtplc_hardware : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void helpNamesItsOptions();
    void watchdogIsActiveUnlessDisabled_data();
    void watchdogIsActiveUnlessDisabled();
    void safeNamesWhatItCannotReachAndEnds();
    void safeWaitsForTheAnswerOfDrives();
    void safeSendsTheSyncThatDrivesWaitFor();
    void checkShowsWarnings();
    void invalidConfigurationEndsWithExitCodeTwo_data();
    void invalidConfigurationEndsWithExitCodeTwo();
    void aScanListsTheDevicesOfABus();

private:
    struct Run
    {
        int code = -1;
        QString output;
        QString errors;
    };
    static Run run(const QStringList &arguments);
};

tst_qtplc_hardware::Run tst_qtplc_hardware::run(const QStringList &arguments)
{
    QProcess process;
    process.start(QStringLiteral(QTPLC_HARDWARE_PROGRAM), arguments);
    if (!process.waitForFinished(20000))
        return {};
    return {process.exitCode(), QString::fromUtf8(process.readAllStandardOutput()),
            QString::fromUtf8(process.readAllStandardError())};
}

void tst_qtplc_hardware::helpNamesItsOptions()
{
    const Run help = run({"--help"});
    QCOMPARE(help.code, 0);
    for (const char *word :
         {"--check", "--monitor", "--safe", "--drivers", "--master", "configuration", "0.5 for nodes with devices"})
        QVERIFY2(help.output.simplified().contains(word), qPrintable(help.output));
    QCOMPARE(run({"--drivers"}).code, 0);
}

void tst_qtplc_hardware::watchdogIsActiveUnlessDisabled_data()
{
    QTest::addColumn<QStringList>("options");
    QTest::addColumn<bool>("barks");
    QTest::newRow("as it is") << QStringList() << true;
    QTest::newRow("off") << QStringList{"--watchdog", "0"} << false;
}

/// Its link is cut; the control connection stays.
void tst_qtplc_hardware::watchdogIsActiveUnlessDisabled()
{
    QFETCH(QStringList, options);
    QFETCH(bool, barks);
    QTemporaryDir folder;
    QFile file(folder.filePath("board.ini"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("[node]\nname = Board\n[adc]\ndriver = mcp3208\ndevice = fake:none\n[adc.read]\nfree = @online\n");
    file.close();
    TestMaster master(QPlcClock::realTime());
    QVERIFY(master.listen());
    QSignalSpy lost(&master, &QPlcMasterNode::nodeLost);
    QProcess board;
    board.setProcessChannelMode(QProcess::MergedChannels);
    board.start(QStringLiteral(QTPLC_HARDWARE_PROGRAM),
                QStringList{file.fileName(), "--master", master.protocol("udp").toString(), "--enable-fault-injection",
                            "--faults", "cut=50ms"}
                    + options);
    QTRY_COMPARE(master.nodes().size(), 1);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(5));
    QCOMPARE(waitUntil([&] { return !lost.isEmpty(); }, barks ? 5000 : 1000), barks);
    master.stop();
    board.terminate();
    QVERIFY(board.waitForFinished(10000));
    QCOMPARE(board.readAll().contains("safe state"), barks);
}

void tst_qtplc_hardware::safeNamesWhatItCannotReachAndEnds()
{
    QTemporaryDir folder;
    qputenv("QTPLC_FAKE_DEVICES", folder.path().toLocal8Bit());
    const QString fileName = folder.filePath("a.ini");
    QFile file(fileName);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("[node]\nname = A\n[board]\ndriver = gpio\ndevice = fake:none\noutput.brake = 1\noutput.lamp = 2\n"
               "[board.write]\nlamp = lampOn\n[board.safe]\nbrake = 0\n"
               "[drive]\ndriver = modbus\ndevice = fake:drive\nregister.a = coil 1\n[drive.safe]\na = 1\n"
               "[winch]\ndriver = can\ndevice = fake:silent\nframe.F = 1, 1 byte\nsignal.F.a = 0|8@1+\n"
               "[winch.safe]\nF.a = 1\n"
               "[wheel]\ndriver = can\ndevice = fake:awake\nframe.F = 1, 1 byte\nsignal.F.a = 0|8@1+\n"
               "[wheel.safe]\nF.a = 1\n");
    file.close();
    QVERIFY(qplc::FakeCanBus::setAcknowledged(QStringLiteral("silent"), false));
    const Run safe = run({fileName, "--safe"});
    QCOMPARE(safe.code, 1);
    QVERIFY2(safe.errors.contains("device 'board' was not reached: ") && safe.errors.contains("fake:none"),
             qPrintable(safe.errors));
    QVERIFY2(safe.errors.contains("board.lamp has no safe value in the configuration; add it to the section "
                                  "'board.safe'"),
             qPrintable(safe.errors));
    QVERIFY2(safe.errors.contains("device 'winch' has not taken its safe values: nobody on its bus acknowledges them"),
             qPrintable(safe.errors));
    for (const char *told : {"'drive' was not", "'drive' has not", "'wheel' was not", "'wheel' has not"})
        QVERIFY2(!safe.errors.contains(QLatin1String(told)), qPrintable(safe.errors));
    qunsetenv("QTPLC_FAKE_DEVICES");
}

/// Their program was killed while they turned.
void tst_qtplc_hardware::safeWaitsForTheAnswerOfDrives()
{
    const FakeDevices folder;
    peer::Bus bus(QStringLiteral("safe"));
    for (const int node : {5, 6}) {
        peer::Device &device = bus.addDevice(node);
        device.makeDrive();
        device.nmt = peer::Device::Operational;
        device.drive->state = peer::Drive::Enabled;
        device.drive->isStubborn = node == 6;
    }
    QVERIFY(bus.open());
    bus.start();
    QByteArray text("[node]\nname = A\n");
    for (const char *node : {"5", "6", "7"})
        text += QByteArray("[drive") + node + "]\ndriver = canopen\ndevice = fake:safe\nprofile = 402\nnode = " + node
            + "\nsync = " + (*node == '5' ? "every cycle" : "from others") + "\n"
            + (*node == '7' ? "sdo-timeout = 50 ms\n" : "") + "[drive" + node + ".safe]\nenable = 0\nvelocity = 0\n";
    QFile file(folder.path("a.ini"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(text);
    file.close();
    const Run safe = run({file.fileName(), "--safe"});
    bus.stop();
    QCOMPARE(safe.code, 1);
    for (const char *told : {"'drive5' was not", "'drive5' has not"})
        QVERIFY2(!safe.errors.contains(QLatin1String(told)), qPrintable(safe.errors));
    QVERIFY(bus.devices.at(0)->drive->state != peer::Drive::Enabled);
    QVERIFY2(safe.errors.contains("device 'drive6' has not taken its safe values: it still tells the state Operation "
                                  "enabled, in spite of the quick stop"),
             qPrintable(safe.errors));
    QVERIFY2(safe.errors.contains("device 'drive7' was not reached: node 7 at fake:safe does not answer"),
             qPrintable(safe.errors));
}

/// The section that sends it has no outputs.
void tst_qtplc_hardware::safeSendsTheSyncThatDrivesWaitFor()
{
    const FakeDevices folder;
    peer::Bus bus(QStringLiteral("sync"));
    peer::Device &device = bus.addDevice(5);
    device.makeDrive();
    device.nmt = peer::Device::Operational;
    device.drive->state = peer::Drive::Enabled;
    QVERIFY(bus.open());
    bus.start();
    QFile file(folder.path("a.ini"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("[node]\nname = A\n[drive]\ndriver = canopen\ndevice = fake:sync\nnode = 5\nsync = from others\n"
               "profile = 402\n[drive.safe]\nenable = 0\nvelocity = 0\n"
               "[clock]\ndriver = canopen\ndevice = fake:sync\nsync = every cycle\n");
    file.close();
    const Run safe = run({file.fileName(), "--safe"});
    bus.stop();
    QVERIFY2(safe.code == 0, qPrintable(safe.errors));
    QVERIFY(device.drive->state != peer::Drive::Enabled);
}

void tst_qtplc_hardware::checkShowsWarnings()
{
    QTemporaryDir folder;
    const QString fileName = folder.filePath("a.ini");
    QFile file(fileName);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("[node]\nname = A\nsafeStop = b.stop\n[b]\ndriver = gpio\ndevice = fake:b\ninput.stop = 1, pull-down\n");
    file.close();
    const Run check = run({fileName, "--check"});
    QCOMPARE(check.code, 0);
    QVERIFY2(check.errors.contains("warning: " + fileName + ":3:12: 'b.stop' is 0 with a torn wire"),
             qPrintable(check.errors));
}

void tst_qtplc_hardware::invalidConfigurationEndsWithExitCodeTwo_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("error");
    QTest::newRow("unknown driver") << QByteArray("[node]\nname = A\n[x]\ndriver = nonsense\n")
                                    << "4:10: there is no driver 'nonsense'";
    QTest::newRow("missing") << QByteArray() << "cannot open: No such file or directory";
}

void tst_qtplc_hardware::invalidConfigurationEndsWithExitCodeTwo()
{
    QFETCH(QByteArray, text);
    QFETCH(QString, error);
    QTemporaryDir folder;
    const QString fileName = folder.filePath("a.ini");
    if (!text.isEmpty()) {
        QFile file(fileName);
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write(text);
    }
    const Run refused = run({fileName});
    QCOMPARE(refused.code, 2);
    QVERIFY2(refused.errors.contains(error), qPrintable(refused.errors));
    QCOMPARE(run({}).code, 2);
    QCOMPARE(run({"a", "b"}).code, 2);
}

void tst_qtplc_hardware::aScanListsTheDevicesOfABus()
{
    const FakeDevices folder;
    const Run nobody = run({"scan", "fake:scan"});
    QCOMPARE(nobody.code, 1);
    QVERIFY2(nobody.errors.contains("no CANopen device answers at fake:scan; check"), qPrintable(nobody.errors));
    peer::Bus bus(QStringLiteral("scan"));
    bus.addDevice(5).makeDrive();
    QVERIFY(bus.open());
    bus.start();
    const Run scan = run({"scan", "fake:scan"});
    bus.stop();
    QCOMPARE(scan.code, 0);
    QVERIFY2(scan.output.startsWith("node   5") && scan.output.contains("drive (402)")
                 && scan.output.contains("vendor 0x11110005"),
             qPrintable(scan.output));
    QCOMPARE(scan.output.count('\n'), 1);
    QCOMPARE(run({"scan"}).code, 2);
}

QTEST_GUILESS_MAIN(tst_qtplc_hardware)
#include "tst_qtplc_hardware.moc"
