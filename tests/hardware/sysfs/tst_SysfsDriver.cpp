// SPDX-License-Identifier: Apache-2.0
#include "../DriverBench.h"
#include "../FakeDevices.h"
#include "SysfsTree.h"
#include "hardware/sysfs/SysfsText.h"

#include <QtTest/QtTest>

#include <sys/stat.h>

using namespace qplc;
using namespace std::chrono_literals;

namespace {

/// What the kernel shows of a thermometer at 26.187 degC.
const QByteArray goodThermometer = "a3 01 4b 46 7f ff 0d 10 ce : crc=ce YES\na3 01 4b 46 7f ff 0d 10 ce t=26187\n";

struct Board
{
    explicit Board(const QByteArray &keys)
        : bench(QStringLiteral("sysfs"), "root = fake:sys\n" + keys)
    {
    }

    const FakeDevices devices;
    SysfsTree sys{QStringLiteral("fake:sys")};
    DriverBench bench;
};

/// A converter with two inputs.
struct Converter : Board
{
    explicit Converter(const QByteArray &keys = {})
        : Board("device = iio:ads1015\n" + keys)
    {
        plugIn();
    }
    void plugIn()
    {
        set("name", "ads1015\n");
        set("in_voltage0_raw", "1000\n");
        set("in_voltage0_scale", "0.125\n");
        set("in_voltage1_raw", "-8\n");
        set("in_voltage_scale", "2\n");
    }
    void set(const QString &file, const QByteArray &text) { sys.write(folder + file, text); }

    const QString folder = QStringLiteral("bus/iio/devices/iio:device3/");
};

/// A converter from digital to analog: 1 mV a step, from -10 V on.
struct AnalogOutput : Board
{
    explicit AnalogOutput(const QByteArray &keys = "range.voltage0 = -10, 10\n")
        : Board("device = iio:ad5761\n" + keys)
    {
        set("name", "ad5761\n");
        set("out_voltage0_raw", "10000\n");
        set("out_voltage_scale", "1\n");
        set("out_voltage_offset", "-10000\n");
        set("in_voltage0_raw", "5\n");
        bench.wireWrite("voltage0");
    }
    void set(const QString &file, const QByteArray &text) { sys.write(folder + file, text); }
    QByteArray get(const QString &file) const { return sys.read(folder + file).trimmed(); }

    const QString folder = QStringLiteral("bus/iio/devices/iio:device1/");
};

struct Pwm : Board
{
    explicit Pwm(const QByteArray &keys = "period = 20 ms\n")
        : Board("device = pwm:fe20c000.pwm\n" + keys)
    {
        sys.write("devices/fe20c000.pwm/pwm/pwmchip0/npwm", "2\n");
        sys.write("devices/fe20c000.pwm/pwm/pwmchip0/export", "");
        sys.link("devices/fe20c000.pwm/pwm/pwmchip0/device", "devices/fe20c000.pwm");
        sys.link("class/pwm/pwmchip0", "devices/fe20c000.pwm/pwm/pwmchip0");
    }
    /// As the kernel does after a number was written to `export`.
    void addChannel(const QByteArray &period = "0", const QByteArray &duty = "0", const QByteArray &enable = "0")
    {
        set("period", period);
        set("duty_cycle", duty);
        set("polarity", "normal\n");
        set("enable", enable);
    }
    void set(const QString &file, const QByteArray &text) { sys.write("class/pwm/pwmchip0/pwm0/" + file, text); }
    QByteArray get(const QString &file) const { return sys.read("class/pwm/pwmchip0/pwm0/" + file).trimmed(); }
};

}  // namespace

class tst_SysfsDriver : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void iioValuesAreInSiUnits_data();
    void iioValuesAreInSiUnits();
    void theFileOfTheChannelComesBeforeThatOfAllChannels();
    void aConvertedValueComesBeforeARawOne();
    void devicesAreFoundByNameLabelOrPlace_data();
    void devicesAreFoundByNameLabelOrPlace();
    void channelsAreFoundByTheirLabel();
    void twoDevicesOfOneNameAreRefusedWithTheirPlaces();
    void anUnknownDeviceIsNamedWithThoseThatAreThere();
    void anUnknownChannelIsNamedWithThoseThatAreThere();
    void whatIsNoNumberIsHeldUntilItsTimeout_data();
    void whatIsNoNumberIsHeldUntilItsTimeout();
    void aFileThatWouldBlockIsRefused();
    void anUnpluggedDeviceIsLostAtOnce();
    void valuesOfHwmonAreInSiUnits();
    void countersAreStartedAndRead();
    void countsHaveASignIfTheyHaveBits_data();
    void countsHaveASignIfTheyHaveBits();
    void aThermometerIsRead();
    void aWrongThermometerGivesNoTemperature_data();
    void aWrongThermometerGivesNoTemperature();
    void aThermometerWithAWrongChecksumIsNamedWhenItIsLost();
    void pwmIsLeftAloneUntilItHasAValue();
    void pwmIsSetUpInAnOrderThatTheKernelTakes();
    void aPwmThatRunsAlreadyHasNoGap();
    void aPwmIsAskedForWhenItIsNotThere();
    void channelsOfAPwmChipHaveTheirOwnPeriods();
    void dutyIsLimited_data();
    void dutyIsLimited();
    void aDutyThatSomebodyElseHasChangedIsSetAgain();
    void analogOutputsAreWrittenInSiUnits_data();
    void analogOutputsAreWrittenInSiUnits();
    void anAnalogOutputIsLeftAloneUntilItHasAValue();
    void anAnalogOutputIsSwitchedOnWithItsValue();
    void anAnalogOutputThatIsNotThereIsNamed();
    void invalidKeysAreReported_data();
    void invalidKeysAreReported();
    void invalidChannelsAreReported_data();
    void invalidChannelsAreReported();
};

void tst_SysfsDriver::iioValuesAreInSiUnits_data()
{
    QTest::addColumn<QString>("channel");
    QTest::addColumn<QStringList>("files");  // name and text in turn
    QTest::addColumn<double>("value");
    QTest::newRow("voltage in mV") << "voltage0"
                                   << QStringList{"in_voltage0_raw", "1000\n", "in_voltage0_scale", "0.125\n"} << 0.125;
    QTest::newRow("difference") << "voltage0-voltage1"
                                << QStringList{"in_voltage0-voltage1_raw", "-4", "in_voltage-voltage_scale", "500"}
                                << -2.0;
    QTest::newRow("offset before scale") << "temp" << QStringList{"in_temp_raw", "100",           "in_temp_offset",
                                                                  "-60",         "in_temp_scale", "500"}
                                         << 20.0;
    QTest::newRow("acceleration") << "accel_x"
                                  << QStringList{"in_accel_x_raw", "-16384", "in_accel_scale", "0.000598550"}
                                  << -16384 * 0.000598550;
    QTest::newRow("no scale") << "proximity" << QStringList{"in_proximity_raw", "7"} << 7.0;
    QTest::newRow("scale of the device") << "angl0" << QStringList{"in_angl0_raw", "2", "in_scale", "0.5"} << 1.0;
    QTest::newRow("converted") << "humidityrelative" << QStringList{"in_humidityrelative_input", "45000\n"} << 0.45;
    QTest::newRow("pressure in kPa") << "pressure" << QStringList{"in_pressure_input", "101.325"} << 101325.0;
    QTest::newRow("inclination in degrees") << "incli_x" << QStringList{"in_incli_x_raw", "180"} << M_PI;
}

void tst_SysfsDriver::iioValuesAreInSiUnits()
{
    QFETCH(QString, channel);
    QFETCH(QStringList, files);
    Board board("device = iio:chip\n");
    board.sys.write("bus/iio/devices/iio:device0/name", "chip\n");
    for (int i = 0; i < files.size(); i += 2)
        board.sys.write("bus/iio/devices/iio:device0/" + files[i], files[i + 1].toUtf8());
    QCOMPARE(board.bench.errors() + board.bench.wireRead(channel), QString());
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    QVERIFY(board.bench.exchange());
    QTEST(board.bench.value(channel), "value");
}

void tst_SysfsDriver::theFileOfTheChannelComesBeforeThatOfAllChannels()
{
    Converter converter;
    converter.bench.wireRead("voltage0");
    converter.bench.wireRead("voltage1");
    QVERIFY2(converter.bench.open(), qPrintable(converter.bench.errorString()));
    QVERIFY(converter.bench.exchange());
    QCOMPARE(converter.bench.value("voltage0"), 0.125);
    QCOMPARE(converter.bench.value("voltage1"), -0.016);
}

void tst_SysfsDriver::aConvertedValueComesBeforeARawOne()
{
    Converter converter;
    converter.set("in_voltage0_input", "330\n");
    converter.bench.wireRead("voltage0");
    QVERIFY2(converter.bench.open(), qPrintable(converter.bench.errorString()));
    QVERIFY(converter.bench.exchange());
    QCOMPARE(converter.bench.value("voltage0"), 0.33);
}

void tst_SysfsDriver::devicesAreFoundByNameLabelOrPlace_data()
{
    QTest::addColumn<QString>("device");
    QTest::newRow("name") << "ads1015";
    QTest::newRow("label") << "winch-adc";
    QTest::newRow("place") << "1-0048";
}

void tst_SysfsDriver::devicesAreFoundByNameLabelOrPlace()
{
    QFETCH(QString, device);
    Board board("device = iio:" + device.toUtf8() + "\n");
    board.sys.write("devices/i2c-1/1-0048/iio:device5/name", "ads1015\n");
    board.sys.write("devices/i2c-1/1-0048/iio:device5/label", "winch-adc\n");
    board.sys.write("devices/i2c-1/1-0048/iio:device5/in_voltage0_raw", "1000\n");
    board.sys.write("devices/i2c-1/1-0050/iio:device1/name", "mcp3421\n");
    board.sys.link("bus/iio/devices/iio:device1", "devices/i2c-1/1-0050/iio:device1");
    board.sys.link("bus/iio/devices/iio:device5", "devices/i2c-1/1-0048/iio:device5");
    board.bench.wireRead("voltage0");
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.bench.value("voltage0"), 1.0);
}

void tst_SysfsDriver::channelsAreFoundByTheirLabel()
{
    Converter converter;
    converter.set("in_voltage0_label", "tether-force\n");
    QCOMPARE(converter.bench.wireRead("tether-force"), QString());
    QVERIFY2(converter.bench.open(), qPrintable(converter.bench.errorString()));
    QVERIFY(converter.bench.exchange());
    QCOMPARE(converter.bench.value("tether-force"), 0.125);
}

void tst_SysfsDriver::twoDevicesOfOneNameAreRefusedWithTheirPlaces()
{
    Board board("device = iio:ads1015\n");
    for (const char *place : {"1-0048", "1-0049"}) {
        const QString folder = QStringLiteral("devices/%1/iio:device%2").arg(place, QString(place).right(1));
        board.sys.write(folder + "/name", "ads1015\n");
        board.sys.link("bus/iio/devices/" + folder.section('/', -1), folder);
    }
    QVERIFY(!board.bench.open());
    QCOMPARE(board.bench.errorString(),
             QString("2 IIO devices are called 'ads1015'; name one by its place: iio:1-0048, iio:1-0049"));
}

void tst_SysfsDriver::anUnknownDeviceIsNamedWithThoseThatAreThere()
{
    Board board("device = iio:ads1115\n");
    QVERIFY(!board.bench.open());
    QVERIFY2(board.bench.errorString().contains("there is no IIO device 'iio:ads1115': the kernel has none")
                 && board.bench.errorString().contains("; load the driver of the chip"),
             qPrintable(board.bench.errorString()));
    board.sys.write("bus/iio/devices/iio:device0/name", "ads1015\n");
    QVERIFY(!board.bench.open());
    QCOMPARE(board.bench.errorString(), QString("there is no IIO device 'iio:ads1115'; known are: iio:ads1015"));
}

void tst_SysfsDriver::anUnknownChannelIsNamedWithThoseThatAreThere()
{
    Converter converter;
    QCOMPARE(converter.bench.wireRead("voltage9"), QString());
    QVERIFY(!converter.bench.open());
    QCOMPARE(converter.bench.errorString(),
             QString("iio:ads1015 has no channel 'voltage9'; known are: voltage0, voltage1"));
}

void tst_SysfsDriver::whatIsNoNumberIsHeldUntilItsTimeout_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::newRow("nothing") << QByteArray();
    QTest::newRow("a word") << QByteArray("busy\n");
    QTest::newRow("not a number") << QByteArray("nan\n");
    QTest::newRow("infinite") << QByteArray("inf\n");
    QTest::newRow("two numbers") << QByteArray("0.1 0.2\n");
    QTest::newRow("bytes") << QByteArray("\0\xff\x80", 3);
    QTest::newRow("huge") << QByteArray(1 << 20, '1');
}

void tst_SysfsDriver::whatIsNoNumberIsHeldUntilItsTimeout()
{
    QFETCH(QByteArray, text);
    Converter converter("timeout = 30 ms\nretries = 1\n");
    converter.bench.wireRead("voltage0");
    converter.bench.wireRead("@errors");
    QVERIFY2(converter.bench.open(), qPrintable(converter.bench.errorString()));
    converter.set("in_voltage0_raw", text);
    converter.bench.advance(10ms);
    QVERIFY(converter.bench.exchange());
    QCOMPARE(converter.bench.value("voltage0"), 0.125);
    QCOMPARE(converter.bench.value("@errors"), 2.0);
    converter.bench.advance(21ms);
    QVERIFY(!converter.bench.exchange());
    QVERIFY(!converter.bench.isFresh("voltage0"));
    QVERIFY2(converter.bench.errorString().contains("'in_voltage0_raw' of iio:ads1015")
                 && converter.bench.errorString().contains("; "),
             qPrintable(converter.bench.errorString()));
}

// A pipe without a writer holds everybody who opens it, and one with a writer everybody who reads.
void tst_SysfsDriver::aFileThatWouldBlockIsRefused()
{
    Converter converter;
    converter.bench.wireRead("voltage0");
    const QByteArray file = converter.sys.path(converter.folder + "in_voltage0_raw").toLocal8Bit();
    QVERIFY(QFile::remove(file));
    QCOMPARE(::mkfifo(file.constData(), 0600), 0);
    QVERIFY(!converter.bench.open());
    QVERIFY2(converter.bench.errorString().contains("this is not a regular file of sysfs"),
             qPrintable(converter.bench.errorString()));
}

void tst_SysfsDriver::anUnpluggedDeviceIsLostAtOnce()
{
    Converter converter("timeout = 10 s\n");
    converter.bench.wireRead("voltage0");
    QVERIFY2(converter.bench.open(), qPrintable(converter.bench.errorString()));
    QVERIFY(converter.sys.remove());
    QVERIFY(!converter.bench.exchange());
    QVERIFY2(converter.bench.errorString().contains("plug it in again"), qPrintable(converter.bench.errorString()));
    converter.plugIn();
    QVERIFY2(converter.bench.open(), qPrintable(converter.bench.errorString()));
    QVERIFY(converter.bench.exchange());
    QVERIFY(converter.bench.isFresh("voltage0"));
}

void tst_SysfsDriver::valuesOfHwmonAreInSiUnits()
{
    Board board("device = hwmon:ina219\n");
    const QString folder = "class/hwmon/hwmon2/";
    for (const auto &[file, text] : {std::pair{"name", "ina219\n"},
                                     {"in1_input", "12040\n"},
                                     {"curr1_input", "-1500"},
                                     {"power1_input", "18000000"},
                                     {"temp1_input", "41500"},
                                     {"fan1_input", "1200"},
                                     {"curr1_label", "battery\n"}})
        board.sys.write(folder + file, text);
    for (const char *channel : {"in1", "battery", "power1", "temp1", "fan1"})
        QCOMPARE(board.bench.wireRead(channel), QString());
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.bench.value("in1"), 12.04);
    QCOMPARE(board.bench.value("battery"), -1.5);
    QCOMPARE(board.bench.value("power1"), 18.0);
    QCOMPARE(board.bench.value("temp1"), 41.5);
    QCOMPARE(board.bench.value("fan1"), 1200.0);
}

void tst_SysfsDriver::countersAreStartedAndRead()
{
    Board board("device = counter:104-quad-8\nfunction = quadrature x4\n");
    const QString folder = "bus/counter/devices/counter1/";
    board.sys.write(folder + "name", "104-quad-8\n");
    board.sys.write(folder + "count0/count", "4711\n");
    board.sys.write(folder + "count0/function", "pulse-direction\n");
    board.sys.write(folder + "count0/enable", "0\n");
    board.sys.write(folder + "count1/count", "18446744073709551615\n");
    board.sys.write(folder + "count1/name", "drum\n");
    board.sys.write(folder + "count1/function", "quadrature x4\n");
    QCOMPARE(board.bench.errors() + board.bench.wireRead("count0") + board.bench.wireRead("drum"), QString());
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.sys.read(folder + "count0/function"), QByteArray("quadrature x4"));
    QCOMPARE(board.sys.read(folder + "count0/enable"), QByteArray("1"));
    QCOMPARE(board.bench.value("count0"), 4711.0);
    QCOMPARE(board.bench.value("drum"), 18446744073709551615.0);
}

void tst_SysfsDriver::countsHaveASignIfTheyHaveBits_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<int>("bits");
    QTest::addColumn<double>("value");
    QTest::newRow("16, positive") << QByteArray("32767\n") << 16 << 32767.0;
    QTest::newRow("16, negative") << QByteArray("65535\n") << 16 << -1.0;
    QTest::newRow("24, lowest") << QByteArray("8388608\n") << 24 << -8388608.0;
    QTest::newRow("64, negative") << QByteArray("18446744073709551614\n") << 64 << -2.0;
}

void tst_SysfsDriver::countsHaveASignIfTheyHaveBits()
{
    QFETCH(QByteArray, text);
    QFETCH(int, bits);
    const std::optional<double> count = SysfsText::count(text, bits, true);
    QVERIFY(count.has_value());
    QTEST(*count, "value");
    QVERIFY(!SysfsText::count("-1", bits, true).has_value());
    QVERIFY(!SysfsText::count("1.5", bits, true).has_value());
    QVERIFY(!SysfsText::count("18446744073709551616", bits, true).has_value());
}

void tst_SysfsDriver::aThermometerIsRead()
{
    Board board("device = w1:28-00000a1b2c3d\ninterval = 2 s\n");
    board.sys.write("bus/w1/devices/28-00000a1b2c3d/w1_slave", goodThermometer);
    QCOMPARE(board.bench.errors() + board.bench.wireRead("temperature"), QString());
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.bench.value("temperature"), 26.187);
}

void tst_SysfsDriver::aWrongThermometerGivesNoTemperature_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QByteArray>("problem");
    QTest::newRow("nothing") << QByteArray() << QByteArray("does not contain a temperature");
    QTest::newRow("one line") << goodThermometer.left(goodThermometer.indexOf('\n') + 1)
                              << QByteArray("does not contain a temperature");
    QTest::newRow("cut off") << goodThermometer.left(goodThermometer.size() - 6)
                             << QByteArray("does not contain a temperature");
    QTest::newRow("wrong checksum") << QByteArray(goodThermometer).replace("YES", "NO") << QByteArray("checksum");
    QTest::newRow("line held low") << QByteArray(
        "00 00 00 00 00 00 00 00 00 : crc=00 YES\n00 00 00 00 00 00 00 00 00 t=0\n")
                                   << QByteArray("short circuit");
    QTest::newRow("power has failed") << QByteArray(
        "50 05 4b 46 7f ff 0c 10 1c : crc=1c YES\n50 05 4b 46 7f ff 0c 10 1c t=85000\n")
                                      << QByteArray("its power has failed");
    QTest::newRow("too hot") << QByteArray("d1 07 4b 46 7f ff 0f 10 ce : crc=ce YES\n.. t=125063\n")
                             << QByteArray("-55 to 125 degC");
    QTest::newRow("another device") << QByteArray("ff\n") << QByteArray("does not contain a temperature");
}

void tst_SysfsDriver::aWrongThermometerGivesNoTemperature()
{
    QFETCH(QByteArray, text);
    QFETCH(QByteArray, problem);
    const SysfsText::Thermometer reading = SysfsText::thermometer(text);
    QVERIFY2(QByteArray(reading.problem).contains(problem), reading.problem);
    QVERIFY(QByteArray(reading.problem).contains("; "));
    const SysfsText::Thermometer hot
        = SysfsText::thermometer("50 05 4b 46 7f ff 10 10 1c : crc=1c YES\n50 05 4b 46 7f ff 10 10 1c t=85000\n");
    QVERIFY2(!hot.problem, hot.problem);  // it was measured
    QCOMPARE(hot.temperature, 85.0);
}

void tst_SysfsDriver::aThermometerWithAWrongChecksumIsNamedWhenItIsLost()
{
    Board board("device = w1:28-00000a1b2c3d\ninterval = 2 s\ntimeout = 5 s\n");
    const QString file = "bus/w1/devices/28-00000a1b2c3d/w1_slave";
    board.sys.write(file, goodThermometer);
    board.bench.wireRead("temperature");
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    board.sys.write(file, QByteArray(goodThermometer).replace("YES", "NO"));
    board.bench.advance(2s);
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.bench.value("temperature"), 26.187);
    board.bench.advance(4s);
    QVERIFY(!board.bench.exchange());
    QVERIFY(!board.bench.isFresh("temperature"));
    QVERIFY2(board.bench.errorString().contains("its checksum is wrong; look at the wires"),
             qPrintable(board.bench.errorString()));
}

void tst_SysfsDriver::pwmIsLeftAloneUntilItHasAValue()
{
    Pwm pwm;
    pwm.addChannel("1000", "250", "1");
    pwm.bench.wireWrite("pwm0");
    pwm.bench.wireRead("pwm0");
    QVERIFY2(pwm.bench.open(), qPrintable(pwm.bench.errorString()));
    QVERIFY(pwm.bench.exchange());
    QVERIFY(pwm.bench.exchange());
    QCOMPARE(pwm.bench.value("pwm0"), 0.25);
    QCOMPARE(pwm.get("period"), QByteArray("1000"));
    pwm.set("enable", "0");
    QVERIFY(pwm.bench.exchange());
    QCOMPARE(pwm.bench.value("pwm0"), 0.0);
}

void tst_SysfsDriver::pwmIsSetUpInAnOrderThatTheKernelTakes()
{
    Pwm pwm("period = 1 ms\npolarity = inversed\n");
    pwm.addChannel("20000000", "5000000", "1");
    pwm.bench.wireWrite("pwm0");
    QVERIFY2(pwm.bench.open(), qPrintable(pwm.bench.errorString()));
    pwm.bench.set("pwm0", 0.3);
    QVERIFY2(pwm.bench.exchange(), qPrintable(pwm.bench.errorString()));
    QCOMPARE(pwm.get("period"), QByteArray("1000000"));
    QCOMPARE(pwm.get("duty_cycle"), QByteArray("300000"));
    QCOMPARE(pwm.get("polarity"), QByteArray("inversed"));
    QCOMPARE(pwm.get("enable"), QByteArray("1"));
}

// Files that are not written keep the time of their last change.
void tst_SysfsDriver::aPwmThatRunsAlreadyHasNoGap()
{
    Pwm pwm;
    pwm.addChannel("20000000", "1500000", "1");
    const QDateTime past(QDate(2020, 1, 1), QTime(0, 0));
    for (const char *file : {"period", "duty_cycle", "polarity", "enable"}) {
        QFile changed(pwm.sys.path(QStringLiteral("class/pwm/pwmchip0/pwm0/") + file));
        QVERIFY(changed.open(QIODevice::ReadWrite) && changed.setFileTime(past, QFileDevice::FileModificationTime));
    }
    pwm.bench.wireWrite("pwm0");
    QVERIFY2(pwm.bench.open(), qPrintable(pwm.bench.errorString()));
    pwm.bench.set("pwm0", 0.075, true);
    QVERIFY2(pwm.bench.exchange(), qPrintable(pwm.bench.errorString()));
    for (const char *file : {"period", "duty_cycle", "polarity", "enable"})
        QCOMPARE(QFileInfo(pwm.sys.path(QStringLiteral("class/pwm/pwmchip0/pwm0/") + file)).lastModified(), past);
}

void tst_SysfsDriver::aPwmIsAskedForWhenItIsNotThere()
{
    Pwm pwm;
    pwm.bench.wireWrite("pwm0");
    QVERIFY(!pwm.bench.open());
    QCOMPARE(pwm.sys.read("class/pwm/pwmchip0/export"), QByteArray("0"));
    QVERIFY2(pwm.bench.errorString().contains("'pwm0' of pwm:fe20c000.pwm"), qPrintable(pwm.bench.errorString()));
    pwm.addChannel();
    QVERIFY2(pwm.bench.open(), qPrintable(pwm.bench.errorString()));
    pwm.bench.set("pwm0", 0.5);
    QVERIFY2(pwm.bench.exchange(), qPrintable(pwm.bench.errorString()));
    QCOMPARE(pwm.get("duty_cycle"), QByteArray("10000000"));
    QCOMPARE(pwm.get("enable"), QByteArray("1"));
}

void tst_SysfsDriver::channelsOfAPwmChipHaveTheirOwnPeriods()
{
    Pwm pwm("period = 20 ms\nperiod.pwm0 = 40 us\npolarity.pwm0 = inversed\n");
    pwm.addChannel();
    QCOMPARE(pwm.bench.errors() + pwm.bench.wireWrite("pwm0"), QString());
    QVERIFY2(pwm.bench.open(), qPrintable(pwm.bench.errorString()));
    pwm.bench.set("pwm0", 0.25);
    QVERIFY2(pwm.bench.exchange(), qPrintable(pwm.bench.errorString()));
    QCOMPARE(pwm.get("period"), QByteArray("40000"));
    QCOMPARE(pwm.get("duty_cycle"), QByteArray("10000"));
    QCOMPARE(pwm.get("polarity"), QByteArray("inversed"));
}

void tst_SysfsDriver::dutyIsLimited_data()
{
    QTest::addColumn<double>("value");
    QTest::addColumn<QByteArray>("duty");
    QTest::newRow("too much") << 1e9 << QByteArray("20000000");
    QTest::newRow("negative") << -1.0 << QByteArray("0");
    QTest::newRow("no number") << std::nan("") << QByteArray("0");
}

void tst_SysfsDriver::dutyIsLimited()
{
    QFETCH(double, value);
    Pwm pwm;
    pwm.addChannel();
    pwm.bench.wireWrite("pwm0");
    QVERIFY2(pwm.bench.open(), qPrintable(pwm.bench.errorString()));
    pwm.bench.set("pwm0", value);
    QVERIFY2(pwm.bench.exchange(), qPrintable(pwm.bench.errorString()));
    QTEST(pwm.get("duty_cycle"), "duty");
}

void tst_SysfsDriver::aDutyThatSomebodyElseHasChangedIsSetAgain()
{
    Pwm pwm;
    pwm.addChannel();
    pwm.bench.wireWrite("pwm0");
    QVERIFY2(pwm.bench.open(), qPrintable(pwm.bench.errorString()));
    pwm.bench.set("pwm0", 0.5);
    QVERIFY(pwm.bench.exchange());
    pwm.set("enable", "0");
    pwm.set("duty_cycle", "3");
    QVERIFY(pwm.bench.exchange());
    QCOMPARE(pwm.get("duty_cycle"), QByteArray("10000000"));
    QCOMPARE(pwm.get("enable"), QByteArray("1"));
}

void tst_SysfsDriver::analogOutputsAreWrittenInSiUnits_data()
{
    QTest::addColumn<double>("value");
    QTest::addColumn<QByteArray>("number");
    QTest::newRow("nothing") << 0.0 << QByteArray("10000");
    QTest::newRow("positive") << 2.5 << QByteArray("12500");
    QTest::newRow("negative, rounded") << -2.50049 << QByteArray("7500");
    QTest::newRow("too much") << 1e9 << QByteArray("20000");
    QTest::newRow("too little") << -1e300 << QByteArray("0");
    QTest::newRow("no number leaves it") << std::nan("") << QByteArray("10000");
}

void tst_SysfsDriver::analogOutputsAreWrittenInSiUnits()
{
    QFETCH(double, value);
    AnalogOutput output;
    QCOMPARE(output.bench.errors(), QString());
    QVERIFY2(output.bench.open(), qPrintable(output.bench.errorString()));
    output.bench.set("voltage0", value);
    QVERIFY2(output.bench.exchange(), qPrintable(output.bench.errorString()));
    QTEST(output.get("out_voltage0_raw"), "number");
    output.set("out_voltage0_raw", "1\n");  // somebody else
    QVERIFY(output.bench.exchange());
    if (!std::isnan(value))
        QTEST(output.get("out_voltage0_raw"), "number");
    QCOMPARE(output.get("in_voltage0_raw"), QByteArray("5"));
}

void tst_SysfsDriver::anAnalogOutputIsLeftAloneUntilItHasAValue()
{
    AnalogOutput output;
    output.set("out_voltage0_raw", "17\n");
    QVERIFY2(output.bench.open(), qPrintable(output.bench.errorString()));
    QVERIFY(output.bench.exchange());
    QCOMPARE(output.get("out_voltage0_raw"), QByteArray("17"));
}

void tst_SysfsDriver::anAnalogOutputIsSwitchedOnWithItsValue()
{
    AnalogOutput output;
    output.set("out_voltage0_powerdown", "1\n");
    QVERIFY2(output.bench.open(), qPrintable(output.bench.errorString()));
    QVERIFY(output.bench.exchange());
    QCOMPARE(output.get("out_voltage0_powerdown"), QByteArray("1"));
    output.bench.set("voltage0", 1.0, true);
    QVERIFY(output.bench.exchange());
    QCOMPARE(output.get("out_voltage0_raw"), QByteArray("11000"));
    QCOMPARE(output.get("out_voltage0_powerdown"), QByteArray("0"));
}

void tst_SysfsDriver::anAnalogOutputThatIsNotThereIsNamed()
{
    AnalogOutput output("range.voltage0 = 0, 5\nrange.voltage3 = 0, 5\n");
    QCOMPARE(output.bench.wireWrite("voltage3"), QString());
    QVERIFY(!output.bench.open());
    QVERIFY2(output.bench.errorString().contains("'out_voltage3_raw' of iio:ad5761"),
             qPrintable(output.bench.errorString()));
}

void tst_SysfsDriver::invalidKeysAreReported_data()
{
    QTest::addColumn<QByteArray>("keys");
    QTest::addColumn<QString>("part");
    QTest::newRow("no device") << QByteArray() << "device = iio:ads1015";
    QTest::newRow("no class") << QByteArray("device = ads1015\n") << "'ads1015' is not a device of the kernel; write";
    QTest::newRow("no name") << QByteArray("device = iio:\n") << "'iio:' is not a device of the kernel";
    QTest::newRow("a number") << QByteArray("device = iio:iio:device0\n") << "'iio:device0' is a number";
    QTest::newRow("a number of a chip") << QByteArray("device = pwm:pwmchip0\nperiod = 1 ms\n")
                                        << "'pwmchip0' is a number";
    QTest::newRow("no period") << QByteArray("device = pwm:fe20c000.pwm\n") << "period = 20 ms";
    QTest::newRow("too fast") << QByteArray("device = w1:28-00000a1b2c3d\n") << "interval = 2 s";
    QTest::newRow("bits") << QByteArray("device = counter:a\nbits = 65\n") << "from 8 to 64";
    for (const char *range : {"4", "4, 4", "5, 0", "0, inf", "0, much", "0, 1, 2"})
        QTest::newRow(range) << QByteArray("device = iio:a\nrange.voltage0 = ") + range + '\n'
                             << "is not a range; write the lowest and the highest value";
    QTest::newRow("key of another class") << QByteArray("device = iio:a\nperiod = 1 ms\n") << "'period' is not a key";
}

void tst_SysfsDriver::invalidKeysAreReported()
{
    QFETCH(QByteArray, keys);
    QFETCH(QString, part);
    const DriverBench bench(QStringLiteral("sysfs"), keys);
    QVERIFY2(bench.errors().contains(part), qPrintable(bench.errors()));
    QCOMPARE(bench.errors().count('\n'), 0);
}

void tst_SysfsDriver::invalidChannelsAreReported_data()
{
    QTest::addColumn<QByteArray>("device");
    QTest::addColumn<QString>("channel");
    QTest::addColumn<bool>("isWritten");
    QTest::addColumn<QString>("part");
    QTest::newRow("way out of the folder") << QByteArray("iio:a") << "../../power" << false << "voltage0, accel_x";
    QTest::newRow("thermometer") << QByteArray("w1:28-1") << "temp" << false << "its channel is 'temperature'";
    QTest::newRow("PWM") << QByteArray("pwm:a") << "0" << true << "they are pwm0, pwm1";
    QTest::newRow("output without a range")
        << QByteArray("iio:a") << "voltage0" << true << "add what the device behind it can take, for example 'range.";
    QTest::newRow("output of a counter") << QByteArray("counter:a") << "count0" << true << "can only be read";
}

void tst_SysfsDriver::invalidChannelsAreReported()
{
    QFETCH(QByteArray, device);
    QFETCH(QString, channel);
    QFETCH(bool, isWritten);
    QFETCH(QString, part);
    DriverBench bench(QStringLiteral("sysfs"),
                      "device = " + device + "\ninterval = 2 s\n"
                          + (device.startsWith("pwm") ? "period = 1 ms\n" : ""));
    QCOMPARE(bench.errors(), QString());
    const QString error = isWritten ? bench.wireWrite(channel) : bench.wireRead(channel);
    QVERIFY2(error.contains(part), qPrintable(error));
}

QTEST_GUILESS_MAIN(tst_SysfsDriver)
#include "tst_SysfsDriver.moc"
