// SPDX-License-Identifier: Apache-2.0
// The driver canopen against devices that were written from the standard alone.
#include "../../common/Waiting.h"
#include "CanOpenBench.h"
#include "QPlcHardwareNode.h"
#include "hardware/canopen/CanOpenClient.h"
#include "hardware/canopen/CanOpenScan.h"
#include "hardware/canopen/Cia402Axis.h"

#include <QtTest/QtTest>

#include <random>

using namespace std::chrono_literals;
using qplc::AxisState;

namespace {

const QByteArray sensor = "node = 5\nsync = every cycle\ntpdo1 = 6064:00, 606C:00\nrpdo1 = 6071:00, 6060:00\n";
const QByteArray axisKeys = "sync = every cycle\nprofile = 402\nlimit.velocity = 5000\n";

/// A drive, and who commands it.
struct DriveBench : CanOpenBench
{
    explicit DriveBench(const QByteArray &keys = axisKeys)
        : device(bus.addDevice(5))
        , driver(addDriver("node = 5\n" + keys))
    {
        device.makeDrive();
        for (const char *name : {"state", "velocity", "enabled", "faulty", "blocked", "@emergency", "@emergencies"})
            wiring += driver.wireRead(QLatin1String(name));
        for (const char *name : {"@state", "@heartbeatLost", "@missed", "@errorRegister"})
            wiring += driver.wireRead(QLatin1String(name));
        for (const char *name : {"enable", "velocity", "quickStop", "faultReset"}) {
            wiring += driver.wireWrite(QLatin1String(name));
            driver.set(QLatin1String(name), 0.0, true);
        }
    }
    void command(double enable, double velocity, double quickStop = 0.0, double faultReset = 0.0)
    {
        driver.set("enable", enable);
        driver.set("velocity", velocity);
        driver.set("quickStop", quickStop);
        driver.set("faultReset", faultReset);
    }
    void makeSafe()
    {
        for (const char *name : {"enable", "velocity", "quickStop", "faultReset"})
            driver.set(QLatin1String(name), 0.0, true);
    }
    /// What has happened since the last call.
    std::vector<QPlcDeviceEvent> events()
    {
        std::vector<QPlcDeviceEvent> taken;
        while (const auto event = driver.runner().takeEvent())
            taken.push_back(*event);
        return taken;
    }
    bool isRunning() const { return device.drive->state == peer::Drive::Enabled; }
    AxisState state() const { return AxisState(int(driver.value("state"))); }

    peer::Device &device;
    DriverBench &driver;
    QString wiring;
};

#define OPEN(bench)                                                                                                    \
    do {                                                                                                               \
        const QString error = (bench).open();                                                                          \
        QVERIFY2(error.isEmpty(), qPrintable(error));                                                                  \
    } while (false)

}  // namespace

class tst_CanOpenDriver : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    // Opening
    void theMappingOfKeysIsWrittenToTheDevice();
    void objectsOfADeviceAreReadAndWrittenInEachCycle();
    void aDeviceThatDoesNotAnswerIsNamed();
    void anotherDeviceIsRefused();
    void whatADeviceRefusesIsToldWithItsReason_data();
    void whatADeviceRefusesIsToldWithItsReason();
    void aHundredObjectsAreReadAndWritten();
    void aDeviceThatNeverStartsIsNotOpen();
    void theEndOfTheNodeDoesNotWaitForADeviceThatStarts();
    void aScanFindsAllDevicesAndChangesNothing();
    // Contradictions
    void contradictionsAreRefused_data();
    void contradictionsAreRefused();
    void idsOfOneBusDiffer();
    void onePlaceHasOneSection();
    void valuesOfASlowPdoAreFreshUntilTheNextOne();
    void valuesOnEventAreFreshWhileTheDeviceLives();
    void aDriveThatTellsItsStateSeldomIsEnabled();
    // Cycle
    void nothingIsSentBeforeItsValueIsKnown();
    void lossOfTheHeartbeatIsSeenAfterTwoOfThem();
    void aRestartedDeviceIsConfiguredAnew();
    void aDeviceThatLeavesOperationalIsLost();
    void emergenciesAreSignals();
    void emergenciesAreEventsFromTheirBeginToTheirEnd();
    void anErrorBeforeTheStartIsAnEvent();
    void ofTooManyEmergenciesTheNewestOneIsTold();
    void aMissedPdoIsCounted();
    void framesOfStrangersChangeNothing();
    // Drives
    void aDriveIsEnabledAndFollows();
    void theSafeStateBringsTheDriveToRestByItsRamp();
    void everyLossOfTheMasterBringsTheDriveToRestByItsRamp_data();
    void everyLossOfTheMasterBringsTheDriveToRestByItsRamp();
    void aFaultStopsTheDriveUntilItIsResetAndEnabledAnew();
    void eightDrivesMissNoPdo();
    void theLossOfOneDriveLeavesTheOthersRunning();
};

// ---- opening ----

void tst_CanOpenDriver::theMappingOfKeysIsWrittenToTheDevice()
{
    CanOpenBench bench;
    peer::Device &device = bench.bus.addDevice(5);
    device.makeDrive();
    device.set(0x1A00, 0, 1);
    device.set(0x1A00, 1, 0x10000020);
    bench.addDriver(sensor + "set.6085:00 = 3000\nheartbeat = 50 ms\n");
    OPEN(bench);
    QCOMPARE(device.value(0x1A00), qint64(2));
    QCOMPARE(device.value(0x1A00, 1), qint64(0x60640020));
    QCOMPARE(device.value(0x1A00, 2), qint64(0x606C0020));
    QCOMPARE(device.value(0x1800, 1), qint64(0x40000185));  // it was not to be asked for, and still is not
    QCOMPARE(device.value(0x1800, 2), qint64(1));
    QCOMPARE(device.value(0x1600, 1), qint64(0x60710010));
    QCOMPARE(device.value(0x1400, 1), qint64(0x205));
    QCOMPARE(device.value(0x1017), qint64(50));
    QCOMPARE(device.value(0x1016, 1), qint64(127 << 16 | 100));
    QCOMPARE(device.value(0x6085), qint64(3000));
    QCOMPARE(device.nmt, peer::Device::Operational);
}

void tst_CanOpenDriver::objectsOfADeviceAreReadAndWrittenInEachCycle()
{
    CanOpenBench bench;
    peer::Device &device = bench.bus.addDevice(5);
    device.makeDrive();
    device.drive.reset();
    DriverBench &driver = bench.addDriver(sensor);
    QCOMPARE(driver.wireRead("6064:00"), QString());
    QCOMPARE(driver.wireRead("VelocityActualValue"), QString());
    QCOMPARE(driver.wireWrite("TargetTorque"), QString());
    QCOMPARE(driver.wireWrite("6060:00"), QString());
    QVERIFY(driver.wireRead("6077:00").contains("no channel"));
    OPEN(bench);
    device.set(0x6064, 0, -123456);
    device.set(0x606C, 0, 789);
    driver.set("TargetTorque", -250.0);
    driver.set("6060:00", 4.0);
    QVERIFY(bench.cycles(3));
    QCOMPARE(driver.value("6064:00"), -123456.0);
    QCOMPARE(driver.value("VelocityActualValue"), 789.0);
    QCOMPARE(device.value(0x6071, 0, true), qint64(-250));
    QCOMPARE(device.value(0x6060), qint64(4));
}

void tst_CanOpenDriver::aDeviceThatDoesNotAnswerIsNamed()
{
    CanOpenBench bench;
    bench.bus.addDevice(6);
    bench.addDriver(sensor + "sdo-timeout = 20 ms\n");
    const QString error = bench.open();
    QVERIFY2(error.contains("node 5 at fake:bench does not answer (SDO, object 1018:01); is it switched on"),
             qPrintable(error));
}

void tst_CanOpenDriver::anotherDeviceIsRefused()
{
    CanOpenBench bench;
    bench.bus.addDevice(5).makeDrive();
    bench.addDriver(sensor + "vendor = 0x11110005\nproduct = 0x99\n");
    const QString error = bench.open();
    QVERIFY2(error.contains("is another device: its product is 0x22220005, and the configuration wants 0x00000099; "),
             qPrintable(error));
}

void tst_CanOpenDriver::whatADeviceRefusesIsToldWithItsReason_data()
{
    QTest::addColumn<QByteArray>("keys");
    QTest::addColumn<QString>("error");
    QTest::newRow("setting") << sensor + "set.6099:01 = 5\n"
                             << "refuses to write object 6099:01: the object does not exist (abort code 0x06020000); ";
    QTest::newRow("mapping") << QByteArray("node = 5\ntpdo1 = 60FD:00\n")
                             << "refuses to write object 1A00:01: the object does not exist";
    QTest::newRow("not writable") << QByteArray("node = 5\ntpdo1 = 6064:00\nrpdo1 = 606C:00\n")
                                  << "refuses to write object 1600:01: the object cannot be part of a PDO";
    QTest::newRow("PDO") << QByteArray("node = 5\ntpdo9 = id 0x2A5, 6064:00\n")
                         << "refuses to read object 1808:01: the object does not exist";
}

void tst_CanOpenDriver::whatADeviceRefusesIsToldWithItsReason()
{
    QFETCH(QByteArray, keys);
    QFETCH(QString, error);
    CanOpenBench bench;
    bench.bus.addDevice(5).makeDrive();
    bench.addDriver(keys);
    const QString told = bench.open();
    QVERIFY2(told.contains(error), qPrintable(told));
    QVERIFY2(told.startsWith("node 5 at fake:bench"), qPrintable(told));
    QVERIFY(!bench.drivers.front()->isOnline());
}

void tst_CanOpenDriver::aHundredObjectsAreReadAndWritten()
{
    CanOpenBench bench;
    peer::Device &device = bench.bus.addDevice(5);
    std::mt19937 random(5);
    std::vector<QByteArray> values;
    for (int i = 0; i < 100; ++i) {
        peer::Object &object = device.add(0x3000 + i / 10, i % 10, 0, i);
        object.hasAnySize = true;
        QByteArray value;
        for (int byte = 0; byte < i; ++byte)
            value.append(char(random()));
        values.push_back(value);
    }
    QVERIFY(bench.bus.open());
    QString error;
    const auto master = qplc::CanBus::make("fake:bench", &error);
    qplc::CanBus::Options options;
    options.keys = {0x585};
    QVERIFY(master->open(options));
    bench.bus.start();
    for (int i = 0; i < 100; ++i) {
        qplc::CanOpenClient client(*master, "fake:bench", 5, 1s);
        const qplc::ObjectAddress address{quint16(0x3000 + i / 10), quint8(i % 10)};
        QByteArray read;
        QVERIFY2(client.write(address, values[std::size_t(i)]), qPrintable(client.errorString()));
        QVERIFY2(client.read(address, &read), qPrintable(client.errorString()));
        QCOMPARE(read, values[std::size_t(i)]);
    }
    bench.bus.stop();
}

void tst_CanOpenDriver::aDeviceThatNeverStartsIsNotOpen()
{
    CanOpenBench bench;
    peer::Device &device = bench.bus.addDevice(5);
    device.makeDrive();
    device.ignoresStart = true;
    bench.addDriver(sensor + "heartbeat = 20 ms\n");
    const QString error = bench.open();
    QVERIFY2(error.contains("does not become Operational (it is Pre-operational); look at its error"),
             qPrintable(error));
}

/// It may take three heartbeats: a minute and a half.
void tst_CanOpenDriver::theEndOfTheNodeDoesNotWaitForADeviceThatStarts()
{
    CanOpenBench bench;
    peer::Device &device = bench.bus.addDevice(5);
    device.makeDrive();
    device.ignoresStart = true;
    qplc::DriverRunner &runner = bench.addDriver(sensor + "heartbeat = 30 s\n").runner();
    QVERIFY(bench.bus.open());
    bench.bus.start();
    runner.start([](const QString &) {});
    const auto isConfigured = [&] {
        const std::lock_guard lock(bench.bus.mutex);
        return device.value(0x1017) == 30000;
    };
    QTRY_VERIFY(isConfigured());
    QElapsedTimer timer;
    timer.start();
    runner.stop();
    QVERIFY2(timer.elapsed() < 30000, qPrintable(QString::number(timer.elapsed())));
    bench.bus.stop();
}

void tst_CanOpenDriver::aScanFindsAllDevicesAndChangesNothing()
{
    CanOpenBench bench;
    bench.bus.addDevice(1);
    bench.bus.addDevice(5).makeDrive();
    peer::Device &last = bench.bus.addDevice(127);
    last.isSilentToSdo = true;
    last.set(0x1017, 0, 20);
    bench.bus.devices[1]->set(0x1017, 0, 20);
    const QByteArray name("Servo \x1b[2J\0", 11);
    bench.bus.devices[1]->add(0x1008, 0, 0, 4).value = name;
    QVERIFY(bench.bus.open());
    bench.bus.start();
    QVector<qplc::CanOpenScan::Device> found;
    QString error;
    QVERIFY2(qplc::CanOpenScan::run("fake:bench", 500ms, &found, &error), qPrintable(error));
    bench.bus.stop();
    QCOMPARE(found.size(), 3);
    QCOMPARE(found[0].node, 1);
    QCOMPARE(found[0].state, qplc::NmtState::Unknown);
    QCOMPARE(found[1].vendor, 0x11110005U);
    QCOMPARE(found[1].serial, 0x44440005U);
    QCOMPARE(found[1].state, qplc::NmtState::PreOperational);
    QCOMPARE(found[1].name, QString("Servo ?[2J"));
    QCOMPARE(qplc::CanOpenScan::profileText(found[1].type), QString("drive (402)"));
    QCOMPARE(found[2].node, 127);
    QVERIFY(!found[2].hasAnswered);
    for (const auto &device : bench.bus.devices)
        QCOMPARE(device->nmt, peer::Device::PreOperational);
    QVERIFY(!qplc::CanOpenScan::run("fake:", 500ms, &found, &error));
    QVERIFY(!error.isEmpty());
}

// ---- contradictions ----

void tst_CanOpenDriver::contradictionsAreRefused_data()
{
    QTest::addColumn<QByteArray>("keys");
    QTest::addColumn<QByteArray>("file");
    QTest::addColumn<QString>("error");
    const QByteArray id = "[1400]\nSubNumber=2\n[1400sub1]\nParameterName=Id\nDataType=7\nDefaultValue=";
    const QByteArray rest = "\n[1600]\nSubNumber=2\n[1600sub0]\nParameterName=Count\nDataType=5\nDefaultValue=1\n"
                            "[1600sub1]\nParameterName=Entry\nDataType=7\nDefaultValue=0x60710010\n";
    QTest::newRow("PDO of a file that commands the bus")
        << QByteArray("node = 5\neds = drive.eds\n") << id + "0x000" + rest
        << "RPDO 1 of the file has the id 0x0, which is not one of a PDO (0x181 to 0x57F); correct the file";
    QTest::newRow("PDO of a file that is SYNC")
        << QByteArray("node = 5\neds = drive.eds\n") << id + "0x080" + rest << "has the id 0x80, which is not one";
    QTest::newRow("PDO of a file without the node")
        << QByteArray("node = 5\neds = drive.eds\n") << id + "0x600" + rest << "has the id 0x600, which is not one";
    QTest::newRow("one object in two PDOs")
        << QByteArray("node = 5\nrpdo1 = 6071:00\nrpdo2 = 6060:00, 6071:00\n") << QByteArray()
        << "object 6071:00 is in RPDO 1, too; write it in one of them";
    QTest::newRow("a PDO twice") << QByteArray("node = 5\ntpdo1 = 6064:00\ntpdo01 = id 0x285, 606C:00\n")
                                 << QByteArray() << "'tpdo01' is no PDO; write tpdo with a number from 1 to 64";
    QTest::newRow("timeout below the time of a PDO")
        << QByteArray("node = 5\ntimeout = 50 ms\ntpdo1 = every 200 ms, 6064:00\n") << QByteArray()
        << "timeout is shorter than the time of TPDO 1 (200 ms), so its values would be invalid";
}

void tst_CanOpenDriver::contradictionsAreRefused()
{
    QFETCH(QByteArray, keys);
    QFETCH(QByteArray, file);
    QFETCH(QString, error);
    CanOpenBench bench;
    QFile eds(bench.filePath("drive.eds"));
    QVERIFY(eds.open(QIODevice::WriteOnly) && eds.write(file) == file.size());
    eds.close();
    const QString told = bench.addDriver(keys).errors();
    QVERIFY2(told.contains(error), qPrintable(told));
}

void tst_CanOpenDriver::idsOfOneBusDiffer()
{
    const auto errorsOf = [](const QByteArray &first, const QByteArray &second) {
        QPlcHardwareNode node;
        node.configure("[a]\ndriver = canopen\ndevice = fake:x\n" + first + "[b]\ndriver = canopen\ndevice = fake:x\n"
                           + second,
                       "a.ini");
        return QPlcParseError::toString(node.configurationErrors());
    };
    const QByteArray five = "node = 5\ntpdo1 = 6064:00\n";
    QString errors = errorsOf(five, "node = 6\ntpdo2 = id 0x185, 6064:00\n");
    QVERIFY2(errors.contains("a.ini:10:9: the PDO id 0x185 of fake:x is used twice, first in line 5; use it once"),
             qPrintable(errors));
    errors = errorsOf(five, "node = 127\nmaster = 0\ntpdo1 = 6064:00\n");  // the master's in section a, by default
    QVERIFY2(errors.contains("a.ini:9:8: node 127 of fake:x is used twice, first in line 2"), qPrintable(errors));
    errors = errorsOf(five, "node = 6\nmaster = 5\ntpdo1 = 6064:00\n");
    QVERIFY2(errors.contains("a.ini:10:10: node 5 of fake:x is used twice, first in line 4"), qPrintable(errors));
    errors = errorsOf("master = 1\n" + five, "master = 1\nnode = 127\ntpdo1 = 6064:00\n");
    QVERIFY2(!errors.contains("twice"), qPrintable(errors));
}

void tst_CanOpenDriver::onePlaceHasOneSection()
{
    QPlcHardwareNode node;
    QVERIFY(!node.configure("[a]\ndriver = canopen\ndevice = fake:x\nnode = 5\nsync = every cycle\ntpdo1 = 6064:00\n"
                            "[b]\ndriver = canopen\ndevice = fake:x\nnode = 5\nsync = every cycle\ntpdo1 = 6064:00\n"
                            "[c]\ndriver = canopen\ndevice = fake:y\nnode = 5\nsync = every cycle\ntpdo1 = 6064:00\n",
                            "a.ini"));
    const QString errors = QPlcParseError::toString(node.configurationErrors());
    QVERIFY2(errors.contains("node 5 of fake:x is used twice, first in line 4"), qPrintable(errors));
    QVERIFY2(errors.contains("sending the SYNC of fake:x is used twice, first in line 5"), qPrintable(errors));
    QVERIFY2(!errors.contains("fake:y"), qPrintable(errors));
}

void tst_CanOpenDriver::valuesOfASlowPdoAreFreshUntilTheNextOne()
{
    CanOpenBench bench;
    peer::Device &device = bench.bus.addDevice(5);
    device.makeDrive();
    DriverBench &driver = bench.addDriver("node = 5\ntpdo1 = every 200 ms, 6064:00\n");
    QCOMPARE(driver.wireRead("6064:00"), QString());
    OPEN(bench);
    QVERIFY(bench.cycles(250));
    for (int i = 0; i < 1000; ++i) {
        QVERIFY2(bench.cycle(), qPrintable(driver.errorString()));
        QVERIFY(driver.isFresh("6064:00"));
    }
}

void tst_CanOpenDriver::valuesOnEventAreFreshWhileTheDeviceLives()
{
    CanOpenBench bench;
    peer::Device &device = bench.bus.addDevice(5);
    device.makeDrive();
    DriverBench &driver = bench.addDriver("node = 5\ntpdo1 = every 10 ms, 606C:00\ntpdo2 = on event, 6064:00\n");
    QCOMPARE(driver.wireRead("6064:00") + driver.wireRead("606C:00"), QString());
    OPEN(bench);
    QVERIFY(!driver.isFresh("6064:00"));
    bench.bus.send(qplc::CanOpenIds::pdo(2, true, 5), QByteArray(4, '\1'));
    QVERIFY(bench.cycles(2000));
    QVERIFY(driver.isFresh("6064:00"));
    device.isAlive = false;
    int cycles = 0;
    while (cycles < 1000 && bench.cycle())
        ++cycles;
    QVERIFY(!driver.isFresh("6064:00"));
}

void tst_CanOpenDriver::aDriveThatTellsItsStateSeldomIsEnabled()
{
    DriveBench bench("sync = every cycle\nprofile = 402\ntpdo1 = every 150 ms, 6041:00, 6061:00, 606C:00\n"
                     "rpdo1 = 6040:00, 6060:00, 60FF:00\n");
    OPEN(bench);
    bench.command(1.0, 100.0);
    QVERIFY(bench.cycles(2000));
    QVERIFY(bench.isRunning());
    QCOMPARE(bench.driver.value("enabled"), 1.0);
}

// ---- cycle ----

void tst_CanOpenDriver::nothingIsSentBeforeItsValueIsKnown()
{
    CanOpenBench bench;
    peer::Device &device = bench.bus.addDevice(5);
    device.makeDrive();
    DriverBench &driver = bench.addDriver(sensor);
    driver.wireWrite("6071:00");
    driver.wireWrite("6060:00");
    OPEN(bench);
    driver.set("6071:00", 1.0);
    QVERIFY(bench.cycles(20));
    QCOMPARE(device.takenPdos, quint64(0));
    driver.set("6060:00", 1.0, true);
    QVERIFY(bench.cycles(20));
    QVERIFY(device.takenPdos > 0);
}

void tst_CanOpenDriver::lossOfTheHeartbeatIsSeenAfterTwoOfThem()
{
    DriveBench bench(axisKeys + "heartbeat = 20 ms\n");
    OPEN(bench);
    QVERIFY2(bench.cycles(100), qPrintable(bench.driver.errorString()));
    bench.device.isAlive = false;
    int cycles = 0;
    while (cycles < 1000 && bench.cycle())
        ++cycles;
    QVERIFY2(cycles <= 40, qPrintable(QString::number(cycles)));
    QVERIFY2(cycles >= 20, qPrintable(QString::number(cycles)));
    QVERIFY2(bench.driver.errorString().startsWith("heartbeat of node 5 at fake:bench"),
             qPrintable(bench.driver.errorString()));
    QVERIFY(bench.driver.errorString().contains("; it was switched off"));
}

void tst_CanOpenDriver::aRestartedDeviceIsConfiguredAnew()
{
    DriveBench bench;
    OPEN(bench);
    QVERIFY(bench.cycles(10));
    bench.bus.boot(bench.device);
    bench.device.set(0x1A00, 0, 0);
    while (bench.cycle()) {}
    QVERIFY2(bench.driver.errorString().contains("; it has restarted by itself"),
             qPrintable(bench.driver.errorString()));
    bench.driver.close();
    bench.bus.start();
    QVERIFY2(bench.driver.open(), qPrintable(bench.driver.errorString()));
    bench.bus.stop();
    QCOMPARE(bench.device.value(0x1A00), qint64(3));
}

void tst_CanOpenDriver::aDeviceThatLeavesOperationalIsLost()
{
    DriveBench bench;
    OPEN(bench);
    QVERIFY(bench.cycles(10));
    bench.device.nmt = peer::Device::Stopped;
    int cycles = 0;
    while (cycles < 1000 && bench.cycle())
        ++cycles;
    QVERIFY(cycles <= 101);
    QVERIFY2(bench.driver.errorString().contains("; it has left Operational"), qPrintable(bench.driver.errorString()));
}

void tst_CanOpenDriver::emergenciesAreSignals()
{
    DriveBench bench;
    OPEN(bench);
    QVERIFY(bench.cycles(2));
    QCOMPARE(bench.driver.value("@emergencies"), 0.0);
    bench.bus.tellEmergency(bench.device, 0x2310, 0x03);
    QVERIFY(bench.cycles(2));
    QCOMPARE(bench.driver.value("@emergency"), double(0x2310));
    QCOMPARE(bench.driver.value("@errorRegister"), 3.0);
    QCOMPARE(bench.driver.value("@emergencies"), 1.0);
    bench.bus.tellEmergency(bench.device, 0x0000, 0x00);
    QVERIFY(bench.cycles(2));
    QCOMPARE(bench.driver.value("@emergency"), 0.0);
    QCOMPARE(bench.driver.value("@emergencies"), 1.0);
}

void tst_CanOpenDriver::emergenciesAreEventsFromTheirBeginToTheirEnd()
{
    DriveBench bench;
    OPEN(bench);
    bench.events();
    bench.bus.tellEmergency(bench.device, 0x2310, 0x03);
    bench.bus.tellEmergency(bench.device, 0x7305, 0x23);
    bench.bus.tellEmergency(bench.device, 0x0000, 0x03);
    bench.bus.tellEmergency(bench.device, 0x0000, 0x00);
    QVERIFY(bench.cycles(2));
    const std::vector<QPlcDeviceEvent> events = bench.events();
    QCOMPARE(events.size(), std::size_t(4));
    QCOMPARE(events[0].text,
             QString("device 'bench' (node 5 at fake:bench): emergency 2310 (continuous over-current, at the output "
                     "side), error register 03 (generic, current), bytes of the manufacturer 00 00 00 00 00"));
    QCOMPARE(events[0].data & 0xFFFFFF, Q_UINT64_C(0x032310));
    QVERIFY(events[1].text.contains("emergency 7305 (incremental encoder 1)"));
    QVERIFY(events[2].text.contains("an error is gone, and others remain: emergency 0000"));
    QVERIFY(events[3].text.endsWith("no error any more"));
    for (std::size_t i = 0; i < events.size(); ++i) {
        QCOMPARE(events[i].alarm, QString("emergency of bench"));
        QCOMPARE(events[i].isActive, i < 3);
    }
    QCOMPARE(events[0].severity, QPlcSlaveNode::ErrorEvent);
    QCOMPARE(events[2].severity, QPlcSlaveNode::WarningEvent);
    QCOMPARE(events[3].severity, QPlcSlaveNode::InfoEvent);
}

/// It was told before the program was there.
void tst_CanOpenDriver::anErrorBeforeTheStartIsAnEvent()
{
    DriveBench bench;
    bench.device.set(0x1001, 0, 0x09);
    bench.device.add(0x1003, 1, 0x00454210, 4, false);
    QVERIFY(bench.wiring.isEmpty());
    OPEN(bench);
    QVERIFY(bench.cycles(2));
    const std::vector<QPlcDeviceEvent> events = bench.events();
    QCOMPARE(events.size(), std::size_t(1));
    QVERIFY2(events[0].text.contains("emergency 4210 (temperature of the device too high), error register 09 (generic, "
                                     "temperature), bytes of the manufacturer 45 00 00 00 00"),
             qPrintable(events[0].text));
    QVERIFY(events[0].isActive);
    QCOMPARE(bench.driver.value("@emergency"), double(0x4210));
    QCOMPARE(bench.driver.value("@emergencies"), 0.0);  // no message has come
}

void tst_CanOpenDriver::ofTooManyEmergenciesTheNewestOneIsTold()
{
    DriveBench bench;
    OPEN(bench);
    bench.events();
    for (int i = 0; i < 100; ++i)
        bench.bus.tellEmergency(bench.device, quint16(0x2300 + i), 0x03);
    bench.bus.tellEmergency(bench.device, 0x0000, 0x00);
    for (int i = 0; i < 500 && bench.driver.value("@emergencies") < 100.0; ++i)
        QVERIFY(bench.cycle());
    QVERIFY(bench.cycles(10));
    QCOMPARE(bench.driver.value("@emergencies"), 100.0);
    QCOMPARE(bench.driver.value("@emergency"), 0.0);
    const std::vector<QPlcDeviceEvent> events = bench.events();
    QVERIFY(events.back().isActive);
    QVERIFY(bench.cycles(1));
    const std::vector<QPlcDeviceEvent> later = bench.events();
    QCOMPARE(later.size(), std::size_t(1));
    QVERIFY(!later.front().isActive);
    QVERIFY(bench.cycles(1));
    QVERIFY(bench.events().empty());
}

void tst_CanOpenDriver::aMissedPdoIsCounted()
{
    DriveBench bench;
    OPEN(bench);
    QVERIFY(bench.cycles(1));
    const double before = bench.driver.value("@missed");
    QVERIFY(bench.cycles(50));
    QCOMPARE(bench.driver.value("@missed"), before);
    bench.device.set(0x1800, 1, 0xC0000185);  // it does not send its first PDO any more
    QVERIFY(bench.cycles(3));
    const double missed = bench.driver.value("@missed");
    QVERIFY(bench.cycles(10));
    QCOMPARE(bench.driver.value("@missed"), missed + 10.0);
}

void tst_CanOpenDriver::framesOfStrangersChangeNothing()
{
    DriveBench bench;
    OPEN(bench);
    bench.command(1, 100);
    QVERIFY(bench.cycles(20));
    qplc::FakeCanBus stranger("bench");
    QVERIFY(stranger.open({}));
    std::mt19937 random(7);
    for (int i = 0; i < 3000; ++i) {
        qplc::CanFrame frame;
        frame.id = random() & 0x7FF;
        const bool isOfDrive = frame.id == 0x705 || frame.id == 0x185 || frame.id == 0x285 || frame.id == 0x205;
        if (frame.id == 0 || frame.id == 0x80 || frame.id == 0x605 || isOfDrive)
            frame.flags = qplc::CanFrame::Extended;
        frame.size = quint8(random() % 9);
        for (quint8 &byte : frame.data)
            byte = quint8(random());
        frame.time = qplc::monotonicNow();
        stranger.send(&frame, 1);
        if (i % 10 == 0)
            QVERIFY2(bench.cycle(), qPrintable(bench.driver.errorString()));
    }
    QVERIFY(bench.isRunning());
    QCOMPARE(bench.driver.value("velocity"), 100.0);
}

// ---- drives ----

void tst_CanOpenDriver::aDriveIsEnabledAndFollows()
{
    DriveBench bench;
    QCOMPARE(bench.wiring, QString());
    OPEN(bench);
    QVERIFY(bench.cycles(20));
    QVERIFY(!bench.isRunning());
    bench.command(1, 1234);
    QVERIFY(bench.cycles(20));
    QVERIFY(bench.isRunning());
    QCOMPARE(bench.state(), AxisState::OperationEnabled);
    QCOMPARE(bench.driver.value("velocity"), 1234.0);
    bench.command(1, 99999);
    QVERIFY(bench.cycles(5));
    QCOMPARE(bench.driver.value("velocity"), 5000.0);
    bench.command(0, 0);
    QVERIFY(bench.cycles(20));
    QCOMPARE(bench.device.drive->state, peer::Drive::Ready);
}

void tst_CanOpenDriver::theSafeStateBringsTheDriveToRestByItsRamp()
{
    DriveBench bench(axisKeys + "set.6085:00 = 1000\n");
    OPEN(bench);
    bench.command(1, 100);
    QVERIFY(bench.cycles(20));
    QCOMPARE(bench.device.drive->velocity, 100.0);
    bench.makeSafe();
    QVERIFY(bench.cycles(50));
    QVERIFY(bench.device.drive->velocity > 0.0);  // a ramp, and no free run
    QCOMPARE(bench.device.drive->state, peer::Drive::QuickStop);
    QVERIFY(bench.cycles(60));
    QCOMPARE(bench.device.drive->velocity, 0.0);
    QCOMPARE(bench.device.drive->state, peer::Drive::SwitchOnDisabled);
    // The plant starts again.
    bench.command(1, 50);
    QVERIFY(bench.cycles(20));
    QCOMPARE(bench.device.drive->velocity, 50.0);
}

void tst_CanOpenDriver::everyLossOfTheMasterBringsTheDriveToRestByItsRamp_data()
{
    QTest::addColumn<QString>("way");
    QTest::addColumn<int>("noticed");  // after so many milliseconds at most
    QTest::newRow("the node enters its safe state") << "safe" << 3;
    QTest::newRow("the driver closes the device") << "close" << 3;
    QTest::newRow("the program is killed, or the bus is cut") << "cut" << 203;
}

void tst_CanOpenDriver::everyLossOfTheMasterBringsTheDriveToRestByItsRamp()
{
    QFETCH(QString, way);
    QFETCH(int, noticed);
    DriveBench bench(axisKeys + "set.6085:00 = 1000\nheartbeat = 100 ms\n");
    OPEN(bench);
    bench.command(1, 100);
    QVERIFY(bench.cycles(120));
    QCOMPARE(bench.device.drive->velocity, 100.0);
    if (way == "safe")
        bench.makeSafe();
    else if (way == "close")
        bench.driver.close();
    const bool isCut = way == "cut";
    int cycles = 0;
    for (; cycles < 2000 && bench.device.drive->velocity != 0.0; ++cycles) {
        if (isCut)
            bench.passTime(1ms);  // nobody sends any more
        else
            bench.cycle();
    }
    QVERIFY2(cycles <= noticed + 101, qPrintable(QString::number(cycles)));
    QVERIFY2(cycles >= 99, qPrintable(QString::number(cycles)));  // the ramp, and no jump
    QCOMPARE(bench.device.drive->state, peer::Drive::SwitchOnDisabled);
    QCOMPARE(bench.device.masterLosses, quint64(isCut ? 1 : 0));
}

void tst_CanOpenDriver::aFaultStopsTheDriveUntilItIsResetAndEnabledAnew()
{
    DriveBench bench;
    OPEN(bench);
    bench.command(1, 100);
    QVERIFY(bench.cycles(20));
    bench.device.drive->fail();
    bench.bus.tellEmergency(bench.device, 0x2310, 0x03);
    QVERIFY(bench.cycles(300));
    QCOMPARE(bench.device.drive->state, peer::Drive::Fault);
    QCOMPARE(bench.driver.value("faulty"), 1.0);
    bench.command(1, 100, 0, 1);
    QVERIFY(bench.cycles(20));
    QVERIFY(bench.device.drive->state != peer::Drive::Fault);
    QVERIFY(!bench.isRunning());
    QCOMPARE(bench.driver.value("blocked"), 1.0);
    bench.command(0, 100);
    QVERIFY(bench.cycles(5));
    bench.command(1, 100);
    QVERIFY(bench.cycles(20));
    QVERIFY(bench.isRunning());
}

namespace {

/// Eight drives at one bus, whose SYNC is sent by a section of its own.
struct EightDrives : CanOpenBench
{
    EightDrives()
    {
        for (int node = 1; node <= 8; ++node) {
            bus.addDevice(node).makeDrive();
            DriverBench &driver = addDriver("node = " + QByteArray::number(node)
                                            + "\nsync = from others\nprofile = 402\nheartbeat = 20 ms\n");
            driver.wireRead("velocity");
            driver.wireRead("@missed");
            driver.wireWrite("enable");
            driver.wireWrite("velocity");
            driver.set("enable", 1.0);
            driver.set("velocity", 100.0 * node);
        }
        addDriver("sync = every cycle\n");
    }
    /// Cycles in which a drive got no PDO, or the master none of a drive.
    quint64 missed() const
    {
        quint64 sum = 0;
        for (std::size_t i = 0; i < 8; ++i)
            sum += bus.devices[i]->missedPdos + quint64(drivers[i]->value("@missed"));
        return sum;
    }
};

}  // namespace

void tst_CanOpenDriver::eightDrivesMissNoPdo()
{
    const int count = qEnvironmentVariableIntValue("QTPLC_CANOPEN_CYCLES") > 0
        ? qEnvironmentVariableIntValue("QTPLC_CANOPEN_CYCLES")
        : 1000;
    EightDrives bench;
    OPEN(bench);
    QVERIFY(bench.cycles(20));
    const quint64 missed = bench.missed();  // while it was opened, without cycles
    const quint64 syncs = bench.bus.devices.front()->syncs;
    const quint64 taken = bench.bus.devices.front()->takenPdos;
    for (int i = 0; i < count; ++i) {
        for (std::size_t drive = 0; drive < 8; ++drive)
            bench.drivers[drive]->set("velocity", double(i % 1000) + double(drive));
        QVERIFY(bench.cycle());
    }
    QCOMPARE(bench.missed(), missed);
    QCOMPARE(bench.bus.devices.front()->syncs - syncs, quint64(count));
    QCOMPARE(bench.bus.devices.front()->takenPdos - taken, quint64(count));
    QVERIFY(bench.cycle());
    for (std::size_t drive = 0; drive < 8; ++drive)
        QCOMPARE(bench.drivers[drive]->value("velocity"), double((count - 1) % 1000) + double(drive));
}

void tst_CanOpenDriver::theLossOfOneDriveLeavesTheOthersRunning()
{
    EightDrives bench;
    OPEN(bench);
    QVERIFY(bench.cycles(100));
    bench.bus.devices[2]->isAlive = false;
    int cycles = 0;
    while (cycles < 1000 && bench.cycle())
        ++cycles;
    QVERIFY(cycles <= 40);
    for (int i = 0; i < 100; ++i)
        bench.cycle();
    for (std::size_t drive = 0; drive < 8; ++drive) {
        QCOMPARE(bench.drivers[drive]->isOnline(), drive != 2);
        if (drive != 2)
            QCOMPARE(bench.drivers[drive]->value("velocity"), 100.0 * double(drive + 1));
    }
}

QTEST_GUILESS_MAIN(tst_CanOpenDriver)
#include "tst_CanOpenDriver.moc"
