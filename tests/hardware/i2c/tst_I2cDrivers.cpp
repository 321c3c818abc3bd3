// SPDX-License-Identifier: Apache-2.0
#include "../DriverBench.h"
#include "../FakeDevices.h"
#include "hardware/DeviceFiles.h"
#include "hardware/DeviceRegister.h"
#include "hardware/i2c/FakeI2cBus.h"

#include <QtTest/QtTest>

#include <cerrno>

using namespace qplc;
using namespace std::chrono_literals;

namespace {

constexpr int Address = 0x68;

/// A bus with a device at Address.
struct Bus
{
    Bus(const QString &kind, const QByteArray &keys)
        : bench(kind, "device = fake:bus\n" + keys)
    {
        QString error;
        if (!memory.create(QStringLiteral("fake:bus"), FakeI2cBus::Size, &error))
            qFatal("%s", qPrintable(error));
        memory.at(Address) = 1;
    }
    void set(int first, const QByteArray &bytes)
    {
        for (int i = 0; i < bytes.size(); ++i)
            memory.at(FakeI2cBus::placeOf(Address, first + i)) = quint8(bytes.at(i));
    }
    QByteArray get(int first, int count) const
    {
        QByteArray bytes;
        for (int i = 0; i < count; ++i)
            bytes.append(char(memory.at(FakeI2cBus::placeOf(Address, first + i)).load()));
        return bytes;
    }

    const FakeDevices devices;
    FakeMemory memory;
    DriverBench bench;
};

struct Imu : Bus
{
    explicit Imu(const QByteArray &keys = {}, quint8 identity = 0x68)
        : Bus(QStringLiteral("mpu6050"), keys)
    {
        set(0x75, QByteArray(1, char(identity)));
    }
    /// One measurement: acceleration, temperature, rate.
    void measure(const QByteArray &hex) { set(0x3a, QByteArray::fromHex("01" + hex)); }
    void wire()
    {
        for (const char *name :
             {"accelerationX", "accelerationY", "accelerationZ", "rateX", "rateY", "rateZ", "temperature"})
            bench.wireRead(name);
    }
};

}  // namespace

class tst_I2cDrivers : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void registersEncodeNumbers_data();
    void registersEncodeNumbers();
    void numbersThatDoNotFitAreLimited();
    void invalidKeysAreReported_data();
    void invalidKeysAreReported();
    void registersAreReadAndWritten();
    void writtenBitsLeaveTheOthers();
    void registersMayHaveNumbersOf16Bits();
    void plainBytesHaveNoRegister();
    void neighboursAreReadInOneTransaction_data();
    void neighboursAreReadInOneTransaction();
    void outputIsWrittenInEveryCycle();
    void setupRegistersAreWrittenOnOpen();
    void deviceWithWrongIdentityIsRefused();
    void aDeviceThatIsSilentIsNamed();
    void aTransferThatFailsIsRepeated_data() { kinds(); }
    void aTransferThatFailsIsRepeated();
    void valuesAreHeldAfterBadTransfersUntilTheirTimeout_data() { kinds(); }
    void valuesAreHeldAfterBadTransfersUntilTheirTimeout();
    void aDeviceThatTakesNoValuesIsLost();
    void openConfiguresTheImu();
    void theImuMeasuresInSiUnits();
    void eachImuHasItsOwnTemperatureAndFilter_data();
    void eachImuHasItsOwnTemperatureAndFilter();
    void aSampleOfTheImuCountsOnce();
    void anImuThatForgotItsSettingsIsOpenedAnew();
    void imuDriverRefusesOtherChips();
    void missingBusPermissionIsReportedWithARemedy();
    void aRateThatTheImuCannotDoIsRefused();

private:
    static void kinds();
};

void tst_I2cDrivers::registersEncodeNumbers_data()
{
    QTest::addColumn<QStringList>("words");
    QTest::addColumn<QByteArray>("hex");
    QTest::addColumn<double>("value");
    QTest::newRow("a byte") << QStringList{"0x10"} << QByteArray("fe") << 254.0;
    QTest::newRow("a signed byte") << QStringList{"0x10", "int8"} << QByteArray("fe") << -2.0;
    QTest::newRow("big-endian unless said") << QStringList{"16", "int16"} << QByteArray("fffe") << -2.0;
    QTest::newRow("little-endian") << QStringList{"16", "int16 little-endian"} << QByteArray("0180") << -32767.0;
    QTest::newRow("unsigned") << QStringList{"16", "UINT16  Big-Endian"} << QByteArray("8001") << 32769.0;
    QTest::newRow("24 bits") << QStringList{"16", "int24"} << QByteArray("800000") << -8388608.0;
    QTest::newRow("24 bits, positive") << QStringList{"16", "uint24 little-endian"} << QByteArray("010080")
                                       << 8388609.0;
    QTest::newRow("32 bits") << QStringList{"16", "int32"} << QByteArray("80000000") << -2147483648.0;
    QTest::newRow("32 bits, unsigned") << QStringList{"16", "uint32"} << QByteArray("ffffffff") << 4294967295.0;
    QTest::newRow("a real") << QStringList{"16", "real32"} << QByteArray("c0200000") << -2.5;
    QTest::newRow("some bits") << QStringList{"16", "bits 4-6"} << QByteArray("50") << 5.0;
    QTest::newRow("one bit") << QStringList{"16", "bit 3"} << QByteArray("08") << 1.0;
    QTest::newRow("signed bits at the left")
        << QStringList{"16", "int16", "bits 4-15", "factor 2"} << QByteArray("ffd0") << -6.0;
    QTest::newRow("bits of three bytes") << QStringList{"16", "uint24 little-endian", "bits 8-19"}
                                         << QByteArray("00340a") << 2612.0;
    QTest::newRow("factor and offset") << QStringList{"16", "int16", "factor 0.5", "offset -10"} << QByteArray("0003")
                                       << -8.5;
}

void tst_I2cDrivers::registersEncodeNumbers()
{
    QFETCH(QStringList, words);
    QFETCH(QByteArray, hex);
    DeviceRegister reg;
    QCOMPARE(DeviceRegister::read(words, &reg), QString());
    const QByteArray bytes = QByteArray::fromHex(hex);
    QCOMPARE(reg.first, 16);
    QCOMPARE(reg.size, bytes.size());
    QTEST(reg.valueOf(reinterpret_cast<const quint8 *>(bytes.constData())), "value");

    QByteArray written(DeviceRegister::MostBytes, '\0');
    QFETCH(double, value);
    reg.bytesOf(value, reinterpret_cast<quint8 *>(written.data()));
    QCOMPARE(written.left(reg.size).toHex(), hex);
}

void tst_I2cDrivers::numbersThatDoNotFitAreLimited()
{
    DeviceRegister reg;
    quint8 bytes[DeviceRegister::MostBytes] = {};
    QCOMPARE(DeviceRegister::read({"0", "int16", "factor 0.1"}, &reg), QString());
    for (const auto &[value, limited] :
         {std::pair{1e9, 3276.7}, {-1e9, -3276.8}, {0.26, 0.3}, {-0.26, -0.3}, {std::nan(""), 0.0}}) {
        reg.bytesOf(value, bytes);
        QCOMPARE(reg.valueOf(bytes), limited);
    }
    QCOMPARE(DeviceRegister::read({"0", "uint32"}, &reg), QString());
    reg.bytesOf(1e300, bytes);
    QCOMPARE(reg.valueOf(bytes), 4294967295.0);
    reg.bytesOf(-1.0, bytes);
    QCOMPARE(reg.valueOf(bytes), 0.0);
}

void tst_I2cDrivers::invalidKeysAreReported_data()
{
    QTest::addColumn<QByteArray>("keys");
    QTest::addColumn<QString>("part");
    QTest::newRow("no address") << QByteArray("register.a = 1\n") << "address = 0x68";
    QTest::newRow("reserved address") << QByteArray("address = 3\nregister.a = 1\n") << "from 8 to 119";
    QTest::newRow("no register") << QByteArray("address = 0x68\n") << "register.NAME";
    QTest::newRow("a register that is none")
        << QByteArray("address = 0x68\nregister.a = int16\n") << "'int16' is not a register";
    QTest::newRow("too high") << QByteArray("address = 0x68\nregister.a = 256\n") << "'256' is not a register";
    QTest::newRow("ends too high") << QByteArray("address = 0x68\nregister.a = 0xff, int16\n") << "in register 256";
    QTest::newRow("a type that is none") << QByteArray("address = 0x68\nregister.a = 1, short\n")
                                         << "'short' is not an option of a register";
    QTest::newRow("an order that is none")
        << QByteArray("address = 0x68\nregister.a = 1, int16 middle\n") << "'int16 middle'";
    QTest::newRow("factor zero") << QByteArray("address = 0x68\nregister.a = 1, factor 0\n") << "'factor 0'";
    QTest::newRow("wide register") << QByteArray("address = 0x68\nregister.a = 0x1234\n")
                                   << "write 'register-numbers = 16 bits'";
    QTest::newRow("too wide register") << QByteArray(
        "address = 0x68\nregister-numbers = 16 bits\nregister.a = 0x10000\n")
                                       << "0 ... 65535 or 0x00 ... 0xffff";
    QTest::newRow("bit behind the last") << QByteArray("address = 0x68\nregister.a = 1, bits 4-8\n")
                                         << "bit 8 is not one of its 8 bits; use a longer type";
    QTest::newRow("bits in the wrong order")
        << QByteArray("address = 0x68\nregister.a = 1, bits 6-4\n") << "'bits 6-4' is not an option";
    QTest::newRow("bits of a real") << QByteArray("address = 0x68\nregister.a = 1, real32, bits 0-7\n")
                                    << "some bits of a real32 are no number";
    QTest::newRow("plain bits that are written")
        << QByteArray("address = 0x68\nregister.a = plain, bit 1, write\n") << "write all of them, without 'bits'";
    QTest::newRow("bits that are written twice")
        << QByteArray("address = 0x68\nregister.a = 1, bits 0-3, write\nregister.b = 1, bits 3-4, write\n")
        << "'b' and 'a' write the same register";
    QTest::newRow("set up without value")
        << QByteArray("address = 0x68\nregister.a = 1\nsetup = 0x6b\n") << "'0x6b' is not a register with its value";
}

void tst_I2cDrivers::invalidKeysAreReported()
{
    QFETCH(QByteArray, keys);
    QFETCH(QString, part);
    const DriverBench bench(QStringLiteral("i2c-registers"), "device = fake:bus\n" + keys);
    QVERIFY2(bench.errors().contains(part), qPrintable(bench.errors()));
}

void tst_I2cDrivers::registersAreReadAndWritten()
{
    Bus bus("i2c-registers",
            "address = 0x68\nregister.current = 0x20, int16, factor 0.01\nregister.limit = 0x30, uint16 little-endian, "
            "write\n");
    QCOMPARE(bus.bench.errors(), QString());
    QCOMPARE(bus.bench.wireRead("current") + bus.bench.wireWrite("limit"), QString());
    QVERIFY(bus.bench.wireRead("limit").contains("no channel 'limit' to read"));
    bus.set(0x20, QByteArray::fromHex("ff9c"));
    QVERIFY2(bus.bench.open(), qPrintable(bus.bench.errorString()));
    QVERIFY(bus.bench.exchange());
    QCOMPARE(bus.bench.value("current"), -1.0);
    QCOMPARE(bus.get(0x30, 2), QByteArray(2, '\0'));  // no value yet
    bus.bench.set("limit", 513.0);
    QVERIFY(bus.bench.exchange());
    QCOMPARE(bus.get(0x30, 2), QByteArray("\x01\x02"));
}

void tst_I2cDrivers::writtenBitsLeaveTheOthers()
{
    Bus bus("i2c-registers",
            "address = 0x68\nregister.gain = 0x20, bits 4-6, write\nregister.mode = 0x20, bits 0-1, write\n");
    QCOMPARE(bus.bench.errors() + bus.bench.wireWrite("gain") + bus.bench.wireWrite("mode"), QString());
    bus.set(0x20, "\xfc");
    QVERIFY2(bus.bench.open(), qPrintable(bus.bench.errorString()));
    bus.bench.set("gain", 2.0);
    bus.bench.set("mode", 9.0);  // as many as there are
    QVERIFY(bus.bench.exchange());
    QCOMPARE(bus.get(0x20, 1).toHex(), QByteArray("af"));
}

void tst_I2cDrivers::registersMayHaveNumbersOf16Bits()
{
    Bus bus("i2c-registers",
            "address = 0x68\nregister-numbers = 16 bits\nidentity = 0x010f 0xea\nsetup = 0x0200 7\n"
            "register.range = 0x1234, uint16\nregister.limit = 0x1000, uint16, write\n");
    QCOMPARE(bus.bench.errors() + bus.bench.wireRead("range") + bus.bench.wireWrite("limit"), QString());
    bus.set(0x010f, "\xea");
    bus.set(0x1234, "\x01\x02");
    QVERIFY2(bus.bench.open(), qPrintable(bus.bench.errorString()));
    bus.bench.set("limit", 772.0);
    QVERIFY(bus.bench.exchange());
    QCOMPARE(bus.bench.value("range"), 258.0);
    QCOMPARE(bus.get(0x0200, 1), QByteArray("\x07"));
    QCOMPARE(bus.get(0x1000, 2), QByteArray("\x03\x04"));
}

void tst_I2cDrivers::plainBytesHaveNoRegister()
{
    Bus bus("i2c-registers", "address = 0x68\nregister.pins = plain, write\nregister.state = plain, bits 4-7\n");
    QCOMPARE(bus.bench.errors() + bus.bench.wireRead("state") + bus.bench.wireWrite("pins"), QString());
    QVERIFY2(bus.bench.open(), qPrintable(bus.bench.errorString()));
    bus.bench.set("pins", 0xa5);
    QVERIFY(bus.bench.exchange());
    QCOMPARE(bus.get(0, 1).toHex(), QByteArray("a5"));
    QCOMPARE(bus.bench.value("state"), 10.0);
    bus.memory.at(Address) = 0;
    bus.bench.advance(1s);
    QVERIFY(bus.bench.exchange());
    bus.bench.advance(1s);
    QVERIFY(!bus.bench.exchange());
    QVERIFY2(bus.bench.errorString().contains("cannot write plain bytes of the device at 0x68"),
             qPrintable(bus.bench.errorString()));
}

void tst_I2cDrivers::neighboursAreReadInOneTransaction_data()
{
    QTest::addColumn<QByteArray>("keys");
    QTest::addColumn<int>("transactions");
    const QByteArray axes = "register.x = 0x20, int16\nregister.y = 0x22, int16\nregister.z = 0x24, int16\n";
    QTest::newRow("no burst") << axes << 3;
    QTest::newRow("burst") << "burst = yes\n" + axes << 1;
    QTest::newRow("gap") << "burst = yes\n" + axes + "register.t = 0x27\n" << 2;
    QTest::newRow("one register in another") << "burst = yes\n" + axes + "register.flags = 0x21, bits 0-3\n" << 1;
    QTest::newRow("plain bytes") << "burst = yes\n" + axes + "register.plain = plain\n" << 2;
    QByteArray many = "burst = yes\n";
    for (int i = 0; i < 33; ++i)
        many += "register.r" + QByteArray::number(i) + " = " + QByteArray::number(0x20 + i) + "\n";
    QTest::newRow("more than one transaction takes") << many << 2;
}

void tst_I2cDrivers::neighboursAreReadInOneTransaction()
{
    QFETCH(QByteArray, keys);
    QFETCH(int, transactions);
    Bus bus("i2c-registers", "address = 0x68\n" + keys);
    QCOMPARE(bus.bench.errors(), QString());
    QStringList names;
    for (const QByteArray &line : keys.split('\n')) {
        if (line.startsWith("register."))
            names << line.mid(9, line.indexOf(' ') - 9);
    }
    for (const QString &name : names)
        QCOMPARE(bus.bench.wireRead(name), QString());
    for (int i = 0; i < 64; ++i)
        bus.set(0x20 + i, QByteArray(1, char(i)));
    QVERIFY2(bus.bench.open(), qPrintable(bus.bench.errorString()));
    const int before = bus.memory.at(0);
    QVERIFY(bus.bench.exchange());
    QCOMPARE(quint8(bus.memory.at(0) - before), quint8(transactions));
    if (names.contains("z"))
        QCOMPARE(bus.bench.value("z"), 0x0405);
    else
        QCOMPARE(bus.bench.value("r32"), 32.0);
    QVERIFY(std::all_of(names.begin(), names.end(), [&](const QString &name) { return bus.bench.isFresh(name); }));
}

void tst_I2cDrivers::outputIsWrittenInEveryCycle()
{
    Bus bus("i2c-registers", "address = 0x68\nregister.limit = 0x30, write\n");
    bus.bench.wireWrite("limit");
    QVERIFY2(bus.bench.open(), qPrintable(bus.bench.errorString()));
    bus.bench.set("limit", 5.0);
    QVERIFY(bus.bench.exchange());
    bus.set(0x30, QByteArray(1, '\0'));  // the device was reset
    QVERIFY(bus.bench.exchange());
    QCOMPARE(bus.get(0x30, 1), QByteArray("\x05"));
}

void tst_I2cDrivers::setupRegistersAreWrittenOnOpen()
{
    Bus bus("i2c-registers", "address = 0x68\nsetup = 0x6b 0x01, 0x1a 3, 0x6b 2\nregister.a = 0x6b\n");
    QCOMPARE(bus.bench.errors(), QString());
    bus.bench.wireRead("a");
    QVERIFY2(bus.bench.open(), qPrintable(bus.bench.errorString()));
    QCOMPARE(bus.get(0x6b, 1), QByteArray("\x02"));
    QCOMPARE(bus.get(0x1a, 1), QByteArray("\x03"));
}

void tst_I2cDrivers::deviceWithWrongIdentityIsRefused()
{
    Bus bus("i2c-registers", "address = 0x68\nidentity = 0x0f 0x33\nsetup = 0x20 1\nregister.a = 1\n");
    bus.set(0x0f, "\x32");
    QVERIFY(!bus.bench.open());
    QVERIFY2(bus.bench.errorString().contains("register 0x0f of the device at 0x68 of fake:bus is 0x32, and not 0x33"),
             qPrintable(bus.bench.errorString()));
    QCOMPARE(bus.get(0x20, 1), QByteArray(1, '\0'));
    bus.set(0x0f, "\x33");
    QVERIFY2(bus.bench.open(), qPrintable(bus.bench.errorString()));
}

void tst_I2cDrivers::aDeviceThatIsSilentIsNamed()
{
    Bus bus("i2c-registers", "address = 0x68\nregister.a = 1\n");
    bus.bench.wireRead("a");
    QVERIFY2(bus.bench.open(), qPrintable(bus.bench.errorString()));
    QVERIFY(bus.bench.exchange());
    bus.memory.at(Address) = 0;
    bus.bench.advance(10ms);
    QVERIFY(bus.bench.exchange());
    bus.bench.advance(21ms);
    QVERIFY(!bus.bench.exchange());
    QVERIFY2(bus.bench.errorString().contains("at 0x68 of fake:bus") && bus.bench.errorString().contains("i2cdetect"),
             qPrintable(bus.bench.errorString()));
    QVERIFY(!bus.bench.isFresh("a"));
}

void tst_I2cDrivers::kinds()
{
    QTest::addColumn<QString>("kind");
    QTest::addColumn<QByteArray>("keys");
    QTest::addColumn<QString>("channel");
    QTest::newRow("registers") << "i2c-registers" << QByteArray("address = 0x68\nregister.a = 0x10\n") << "a";
    QTest::newRow("IMU") << "mpu6050" << QByteArray() << "temperature";
}

void tst_I2cDrivers::aTransferThatFailsIsRepeated()
{
    QFETCH(QString, kind);
    QFETCH(QByteArray, keys);
    QFETCH(QString, channel);
    Bus bus(kind, keys);
    bus.set(0x75, "\x68");
    bus.set(0x3a, "\x01");
    for (const QString &name : {channel, QStringLiteral("@errors"), QStringLiteral("@failures")})
        QCOMPARE(bus.bench.wireRead(name), QString());
    QVERIFY2(bus.bench.open(), qPrintable(bus.bench.errorString()));
    bus.memory.at(Address) = FakeI2cBus::SilentTwice;
    bus.bench.advance(10ms);
    QVERIFY2(bus.bench.exchange(), qPrintable(bus.bench.errorString()));
    QVERIFY(bus.bench.isFresh(channel));
    QCOMPARE(bus.bench.time(channel), bus.bench.now());
    QCOMPARE(bus.bench.value("@errors"), 2.0);
    QCOMPARE(bus.bench.value("@failures"), 0.0);
}

void tst_I2cDrivers::valuesAreHeldAfterBadTransfersUntilTheirTimeout()
{
    QFETCH(QString, kind);
    QFETCH(QByteArray, keys);
    QFETCH(QString, channel);
    Bus bus(kind, keys + "timeout = 30 ms\nretries = 0\n");
    bus.set(0x75, "\x68");
    bus.set(0x3a, "\x01");
    bus.bench.wireRead(channel);
    bus.bench.wireRead("@errors");
    QVERIFY2(bus.bench.open(), qPrintable(bus.bench.errorString()));
    bus.memory.at(Address) = 0;
    for (int i = 1; i <= 3; ++i) {
        bus.bench.advance(10ms);
        QVERIFY2(bus.bench.exchange(), qPrintable(bus.bench.errorString()));
        QVERIFY(bus.bench.isFresh(channel));
        QCOMPARE(bus.bench.value("@errors"), double(i));
    }
    bus.bench.advance(1ms);
    QVERIFY(!bus.bench.exchange());
    QVERIFY(!bus.bench.isFresh(channel));
    bus.memory.at(Address) = 1;
    QVERIFY2(bus.bench.open(), qPrintable(bus.bench.errorString()));
    QVERIFY(bus.bench.exchange());
    QVERIFY(bus.bench.isFresh(channel));
}

void tst_I2cDrivers::aDeviceThatTakesNoValuesIsLost()
{
    Bus bus("i2c-registers", "address = 0x68\ntimeout = 30 ms\nregister.limit = 0x30, write\n");
    bus.bench.wireWrite("limit");
    QVERIFY2(bus.bench.open(), qPrintable(bus.bench.errorString()));
    bus.bench.set("limit", 5.0);
    QVERIFY(bus.bench.exchange());
    bus.memory.at(Address) = 0;
    bus.bench.advance(10ms);
    QVERIFY(bus.bench.exchange());
    bus.bench.advance(21ms);
    QVERIFY(!bus.bench.exchange());
    QVERIFY2(bus.bench.errorString().contains("cannot write register 0x30"), qPrintable(bus.bench.errorString()));
}

void tst_I2cDrivers::openConfiguresTheImu()
{
    Imu imu("accelerationRange = 8 g\nrateRange = 2000 deg/s\nsampleRate = 100\nbandwidth = 20 Hz\n");
    QCOMPARE(imu.bench.errors(), QString());
    QVERIFY2(imu.bench.open(), qPrintable(imu.bench.errorString()));
    QCOMPARE(imu.get(0x6b, 1).toHex(), QByteArray("01"));        // awake, clock of the gyroscope
    QCOMPARE(imu.get(0x19, 4).toHex(), QByteArray("09041810"));  // 1000 Hz / 10, filter 4, 2000 deg/s, 8 g
    QCOMPARE(imu.get(0x38, 1).toHex(), QByteArray("01"));        // samples are announced
}

void tst_I2cDrivers::theImuMeasuresInSiUnits()
{
    Imu imu("accelerationRange = 2 g\nrateRange = 250 deg/s\n");
    imu.wire();
    QVERIFY2(imu.bench.open(), qPrintable(imu.bench.errorString()));
    imu.measure("4000"
                "c000"
                "0000"
                "0154"
                "2ffc"
                "d004"
                "0000");  // 1 g, -1 g, 0; 340 counts; 12284, -12284 counts, 0
    QVERIFY(imu.bench.exchange());
    QCOMPARE(imu.bench.value("accelerationX"), 9.80665);
    QCOMPARE(imu.bench.value("accelerationY"), -9.80665);
    QCOMPARE(imu.bench.value("accelerationZ"), 0.0);
    QCOMPARE(imu.bench.value("temperature"), 37.53);
    const double rate = 12284.0 / 131.0 * M_PI / 180.0;
    QVERIFY(std::abs(imu.bench.value("rateX") - rate) < 1e-9);
    QVERIFY(std::abs(imu.bench.value("rateY") + rate) < 1e-9);
    QCOMPARE(imu.bench.value("rateZ"), 0.0);
}

void tst_I2cDrivers::eachImuHasItsOwnTemperatureAndFilter_data()
{
    QTest::addColumn<int>("identity");
    QTest::addColumn<double>("temperature");  // of 3339 counts [degC]
    QTest::addColumn<QByteArray>("filter");   // of the acceleration
    // Register 0x1d of an MPU-6050 is another one.
    QTest::newRow("MPU-6050") << 0x68 << 3339.0 / 340.0 + 36.53 << QByteArray("ee");
    QTest::newRow("MPU-6500") << 0x70 << 3339.0 / 333.87 + 21.0 << QByteArray("05");
    QTest::newRow("MPU-9250") << 0x71 << 3339.0 / 333.87 + 21.0 << QByteArray("05");
    QTest::newRow("MPU-9255") << 0x73 << 3339.0 / 333.87 + 21.0 << QByteArray("05");
}

void tst_I2cDrivers::eachImuHasItsOwnTemperatureAndFilter()
{
    QFETCH(int, identity);
    QFETCH(double, temperature);
    QFETCH(QByteArray, filter);
    Imu imu("bandwidth = 10 Hz\n", quint8(identity));
    imu.set(0x1d, "\xee");
    imu.wire();
    QVERIFY2(imu.bench.open(), qPrintable(imu.bench.errorString()));
    QCOMPARE(imu.get(0x1a, 1).toHex(), QByteArray("05"));
    QCOMPARE(imu.get(0x1d, 1).toHex(), filter);
    imu.measure("0000"
                "0000"
                "0000"
                "0d0b"
                "0000"
                "0000"
                "0000");
    QVERIFY(imu.bench.exchange());
    QCOMPARE(imu.bench.value("temperature"), temperature);
}

void tst_I2cDrivers::aSampleOfTheImuCountsOnce()
{
    Imu imu("timeout = 30 ms\n");
    imu.wire();
    QVERIFY2(imu.bench.open(), qPrintable(imu.bench.errorString()));
    imu.measure("4000000000000000000000000000");
    QVERIFY(imu.bench.exchange());
    QVERIFY(imu.bench.isFresh("accelerationX"));
    imu.set(0x3a, QByteArray(1, '\0'));  // as the device does when it is read
    imu.bench.advance(30ms);
    QVERIFY(imu.bench.exchange());
    QVERIFY(imu.bench.isFresh("accelerationX"));
    imu.bench.advance(1ms);
    QVERIFY(imu.bench.exchange());
    QVERIFY(!imu.bench.isFresh("accelerationX"));
}

void tst_I2cDrivers::anImuThatForgotItsSettingsIsOpenedAnew()
{
    Imu imu("timeout = 30 ms\n");
    imu.wire();
    QVERIFY2(imu.bench.open(), qPrintable(imu.bench.errorString()));
    QVERIFY(imu.bench.exchange());
    imu.bench.advance(1030ms);
    QVERIFY(imu.bench.exchange());
    imu.bench.advance(1ms);
    QVERIFY(!imu.bench.exchange());
    QVERIFY2(imu.bench.errorString().contains("gives no samples any more")
                 && imu.bench.errorString().contains("supply"),
             qPrintable(imu.bench.errorString()));
    imu.set(0x6b, "\x40");  // asleep, as after switching on
    imu.bench.close();
    QVERIFY2(imu.bench.open(), qPrintable(imu.bench.errorString()));
    QCOMPARE(imu.get(0x6b, 1).toHex(), QByteArray("01"));
}

void tst_I2cDrivers::imuDriverRefusesOtherChips()
{
    Imu imu({}, 0x58);
    QVERIFY(!imu.bench.open());
    QVERIFY2(imu.bench.errorString().contains("at 0x68 of fake:bus is not an MPU-6050")
                 && imu.bench.errorString().contains("is 0x58") && imu.bench.errorString().contains("AD0"),
             qPrintable(imu.bench.errorString()));
}

// The user may not (EACCES), or systemd does not let the service (EPERM).
void tst_I2cDrivers::missingBusPermissionIsReportedWithARemedy()
{
    const DeviceFiles files{QStringLiteral("the I2C bus"), QStringLiteral("i2c-*"), QStringLiteral("i2c"), {}};
    QCOMPARE(files.errorText(QStringLiteral("i2c-1"), EACCES),
             QStringLiteral("cannot open the I2C bus 'i2c-1': Permission denied; add the user to the group of the "
                            "device: 'sudo usermod -aG i2c USER', and log in again"));
    QCOMPARE(files.errorText(QStringLiteral("i2c-1"), EPERM),
             QStringLiteral("cannot open the I2C bus 'i2c-1': Operation not permitted; a service may open only kinds "
                            "of devices that the kernel knew when it was started: 'sudo systemctl restart "
                            "qtplc-hardware@NAME'; if that does not help, DeviceAllow= of its unit lacks them"));
}

void tst_I2cDrivers::aRateThatTheImuCannotDoIsRefused()
{
    const Imu imu("sampleRate = 300\n");
    QVERIFY2(imu.bench.errors().contains("near are 250 Hz and 333.333 Hz"), qPrintable(imu.bench.errors()));
}

QTEST_GUILESS_MAIN(tst_I2cDrivers)
#include "tst_I2cDrivers.moc"
