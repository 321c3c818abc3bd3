// SPDX-License-Identifier: Apache-2.0
// Files that are malformed, or contradict themselves: each is refused, or warned about, at its line
// and with a remedy.
#include "QPlcHardwareNode.h"

#include <QtTest/QtTest>

namespace {

enum Kind : quint8 { Malformed, Semantic };

struct Case
{
    const char *name;
    Kind kind;
    const char *text;
    const char *error;   // "line:column: " and how it begins
    const char *remedy;  // what it says to do
};

#define MODBUS "[d]\ndriver = modbus\ndevice = fake:d\n"
#define RTU    "[d]\ndriver = modbus\ndevice = rtu:/dev/ttyUSB0\n"
#define I2C    "[d]\ndriver = i2c-registers\ndevice = /dev/i2c-1\naddress = 0x40\n"
#define GPIO   "[d]\ndriver = gpio\ndevice = gpiochip0\n"
#define CAN    "[d]\ndriver = can\ndevice = fake:d\n"
#define SERIAL "[d]\ndriver = serial-lines\ndevice = fake:d\n"
#define FRAME  CAN "frame.F = 0x10, 8 bytes, every 100 ms\n"

const Case cases[] = {
    // ---- text ----
    {"nothing", Malformed, "", "there is no device", "begin a section"},
    {"no section", Malformed, "driver = modbus\n", "1:1: 'driver' stands before the first section",
     "begin with [node]"},
    {"open bracket", Malformed, "[drive\n", "1:", "]"},
    {"no equals sign", Malformed, MODBUS "register.a = coil 1\nregister\n", "5:", "="},
    {"no driver", Malformed, "[d]\ndevice = fake:d\n", "1: section 'd' has no driver",
     "add for example 'driver = can'"},
    {"unknown driver", Malformed, "[d]\ndriver = modbsu\n", "2:10: there is no driver 'modbsu'",
     "did you mean 'modbus'"},
    {"key twice", Malformed, MODBUS "register.a = coil 1\nregister.a = coil 2\n", "5:1: 'register.a' is there twice",
     "leave one of them out"},
    {"section twice", Malformed, MODBUS "register.a = coil 1\n[d.read]\n[d.read]\n",
     "6:2: section 'd.read' is there twice", "put its lines together"},
    {"unknown key", Malformed, MODBUS "register.a = coil 1\nretires = 3\n", "5:11: 'retires' is not a key",
     "did you mean 'retries'"},
    {"unknown part", Malformed, MODBUS "register.a = coil 1\n[d.reed]\n", "5:2: section 'd.reed' belongs to no device",
     "did you mean 'd.read'"},
    {"part without device", Malformed, MODBUS "register.a = coil 1\n[e.read]\n", "5:2: section 'e.read'",
     "did you mean 'd.read'"},
    {"no term", Malformed, MODBUS "register.a = coil 1\n[d.read]\nx = a *\n", "6:5: 'a *' is not a name",
     "write for example"},
    {"factor on the left", Malformed, MODBUS "register.a = coil 1\n[d.read]\nx * 2 = a\n", "6:9: factor and offset",
     "belong to the right side"},
    {"element of a channel", Malformed, MODBUS "register.a = coil 1\n[d.read]\nx = a[1]\n",
     "6:5: a channel has no elements", "leave the brackets out"},
    {"safe value in words", Malformed, MODBUS "register.a = coil 1\n[d.safe]\na = off\n", "6:5: 'off' is not a number",
     "write the safe value"},
    {"unknown key of the node", Malformed, "[node]\nsafestop = d.a\n" MODBUS "register.a = coil 1\n",
     "2:12: 'safestop' is not a key of [node]", "its keys are"},
    {"stop without a device", Malformed, "[node]\nsafeStop = a\n" MODBUS "register.a = coil 1\n",
     "2:12: 'a' is not a channel", "write for example 'buttons.emergencyStop'"},
    {"duration without unit", Malformed, MODBUS "register.a = coil 1\ninterval = 10\n", "5:12: interval = '10'",
     "write a number and its unit"},
    {"interval of nothing", Malformed, MODBUS "register.a = coil 1\ninterval = 0 ms\n", "5:12: interval = '0 ms'",
     "is not in the range of"},
    {"neither yes nor no", Malformed, MODBUS "register.a = coil 1\nwrite-single = perhaps\n", "5:16: write-single",
     "write 'yes' or 'no'"},
    {"unknown word", Malformed, MODBUS "register.a = coil 1\nword-order = middle\n", "5:14: word-order",
     "is not one of 'big', 'little'"},
    {"register without address", Malformed, MODBUS "register.a = holding\n", "4:14: 'holding' is not a place",
     "belong here, \"holding 100\" for example"},
    {"unknown attribute", Malformed, MODBUS "register.a = holding 1, int8\n", "4:14: 'int8' is not known",
     "factor, offset"},
    {"no number of a register", Malformed, I2C "register.a = int16\n", "5:14: 'int16' is not a register",
     "its number comes first"},
    {"unknown type", Malformed, I2C "register.a = 1, short\n", "5:14: 'short' is not an option", "use a type"},
    {"setup without value", Malformed, I2C "register.a = 1\nsetup = 0x20\n",
     "6:9: '0x20' is not a register with its value", "write '0x6b 0x00'"},
    {"no line", Malformed, GPIO "input.a = \n", "4:", "'17' or 'GPIO17'"},
    {"unknown option of an input", Malformed, GPIO "input.a = 3, pullup\n",
     "4:11: 'pullup' is not an option of an input", "use active-low, pull-up"},
    {"option of an input at an output", Malformed, GPIO "output.a = 3, pull-up\n",
     "4:12: 'pull-up' is not an option of an output", "use active-low, open-drain"},
    {"frame without size", Malformed, CAN "frame.F = 0x10\n", "4:11: '0x10' is not a frame",
     "write frame.F = 0x123, 8 bytes"},
    {"place of a signal", Malformed, FRAME "signal.F.a = 0-16\n", "5:14: '0-16' is not the place of a signal",
     "write signal.F.a = start|length@order"},
    {"rule to send", Malformed, FRAME "signal.F.a = 0|8@1+\nsend.F = sometimes\n",
     "6:10: 'sometimes' does not say when to send", "write every cycle"},
    {"device of no class", Malformed, "[d]\ndriver = sysfs\ndevice = ads1015\n[d.read]\nx = voltage0\n",
     "3:10: 'ads1015' is not a device of the kernel", "write for example iio:ads1015"},

    // ---- meaning: units and places ----
    {"number of a device", Semantic, "[d]\ndriver = sysfs\ndevice = hwmon:hwmon0\n",
     "3:10: 'hwmon0' is a number that can be another one", "write the name, label or place"},
    {"thermometer that is read too often", Semantic, "[d]\ndriver = sysfs\ndevice = w1:28-1\ninterval = 100 ms\n",
     "4:12: a thermometer on a 1-wire bus measures for 0.75 s", "write an interval of 1 s or more"},
    {"analog output without a range", Semantic, "[d]\ndriver = sysfs\ndevice = iio:a\n[d.write]\nvoltage0 = x\n",
     "5:12: the output 'voltage0' has no range", "'range.voltage0 = 0, 4.096'"},
    {"buffer of a device without", Semantic, "[d]\ndriver = sysfs\ndevice = hwmon:a\nbuffer = yes\n",
     "4:10: of these devices, only IIO has buffers", "leave 'buffer' out"},
    {"trigger without a buffer", Semantic, "[d]\ndriver = sysfs\ndevice = iio:a\ntrigger = t\n",
     "4:11: 'trigger' belongs to a buffer", "add 'buffer = yes'"},
    {"output beside a buffer", Semantic,
     "[d]\ndriver = sysfs\ndevice = iio:a\nbuffer = yes\nrange.voltage0 = 0, 5\n[d.write]\nvoltage0 = x\n",
     "4:10: a section with a buffer has no outputs", "write another section with the same 'device'"},
    {"buffer twice", Semantic,
     "[d]\ndriver = sysfs\ndevice = iio:a\nbuffer = yes\n[e]\ndriver = sysfs\ndevice = iio:a\nbuffer = yes\n",
     "8:10: buffer of iio:a is used twice, first in line 4", "use it once"},
    {"duty in percent", Semantic, "[d]\ndriver = sysfs\ndevice = pwm:a\nperiod = 1 ms\n[d.safe]\npwm0 = 50\n",
     "6:8: 50 is not in the range 0 to 1 of 'pwm0'", "write a value of this range"},
    {"unit 0 of a serial line", Semantic, RTU "register.a = coil 1, unit 0\n", "4:14: a serial line has no unit 0",
     "use a unit of 1 ... 247"},
    {"unit 255 of a serial line", Semantic, RTU "register.a = coil 1, unit 255\n",
     "4:14: a serial line has no unit 255", "use a unit of 1 ... 247"},
    {"unit 248 of a section", Semantic, RTU "unit = 248\nregister.a = coil 1\n", "4:8: unit = '248'",
     "is not a whole number from 1 to 247"},
    {"last register", Semantic, MODBUS "register.a = holding 65535, int32\n",
     "4:14: the value takes 2 registers from 65535", "the last one of a device is 65535"},
    {"type of a bit", Semantic, MODBUS "register.a = coil 1, int16\n",
     "4:14: 'int16': a coil or discrete input is a bit", "has no type"},
    {"reserved address", Semantic, "[d]\ndriver = i2c-registers\ndevice = /dev/i2c-1\naddress = 3\nregister.a = 1\n",
     "4:11: address = '3'", "is not a whole number from 8 to 119"},
    {"behind the last register", Semantic, I2C "register.a = 255, int16\n",
     "5:14: its last byte would be in register 256", "255 is the last one"},
    {"rate of a serial line", Semantic, "[d]\ndriver = nmea-wind\ndevice = /dev/ttyUSB0\nbaud = 4801\n",
     "4:8: 4801 is not a usual rate", "usual are 1200"},
    {"direction of a line without one", Semantic, RTU "register.a = coil 1\nrs485-after = 2 ms\n",
     "5:15: rs485-after needs a direction", "write 'rs485 = rts-on-send'"},
    {"no DBC file", Semantic, CAN "dbc = /nowhere/drive.dbc\n", "/nowhere/drive.dbc: cannot", "No such file"},
    {"bit rate of the kernel", Semantic, "[d]\ndriver = can\ndevice = can0\nbitrate = 500000\n",
     "4:11: root sets the bit rate of 'can0'", "remove the key bitrate"},
    {"bit rate of the kernel for a drive", Semantic,
     "[d]\ndriver = canopen\ndevice = can0\nbitrate = 500000\nnode = 5\ntpdo1 = 6041:00\n",
     "4:11: root sets the bit rate of 'can0'", "remove the key bitrate"},

    // ---- meaning: one thing twice ----
    {"line twice", Semantic, GPIO "input.a = 17\noutput.b = 17\n",
     "5:12: line 17 of gpiochip0 is used twice, first in line 4", "use it once"},
    {"line of two sections", Semantic, GPIO "input.a = 17\n[e]\ndriver = gpio\ndevice = /dev/gpiochip0\ninput.a = 17\n",
     "8:11: line 17 of gpiochip0 is used twice, first in line 4", "use it once"},
    {"serial line of two sections", Semantic,
     RTU "register.a = coil 1\n[e]\ndriver = nmea-wind\ndevice = /dev/ttyUSB0\n",
     "7:10: serial line /dev/ttyUSB0 is used twice, first in line 3", "use it once"},
    {"address of two sections", Semantic, I2C "register.a = 1\n[e]\ndriver = mpu6050\ndevice = i2c-1\naddress = 0x40\n",
     "9:11: address 0x40 of i2c-1 is used twice, first in line 4", "use it once"},
    {"chip of two sections", Semantic,
     "[d]\ndriver = mcp3208\ndevice = /dev/spidev0.0\n[e]\ndriver = mcp3208\ndevice = /dev/spidev0.0\n",
     "6:10: chip at /dev/spidev0.0 is used twice, first in line 3", "use it once"},
    {"sent line without a value", Semantic, SERIAL "send.a = {a} {b}\n[d.write]\na = x\n[d.safe]\na = 0\n",
     "4:10: the line is never sent, because 'b' gets no value", "remove it from the line"},
    {"safe value that makes a line too long", Semantic, SERIAL "send.a = {a:.1}\n[d.safe]\na = 1e308\n",
     "6:5: 1e+308 is not in the range -1e+15 to 1e+15 of 'a'", "write a value of this range"},
    {"two writers of a place", Semantic,
     MODBUS "register.a = holding 1, int32\nregister.b = holding 2\n[d.write]\na = x\nb = y\n",
     "8:5: 'b' and 'a' are the same place of the device", "write one of them"},
    {"two outputs of a register", Semantic, I2C "register.a = 1, int16, write\nregister.b = 2, write\n",
     "6:14: 'b' and 'a' write the same register", "write one of them"},
    {"signals with bits in common", Semantic, FRAME "signal.F.a = 0|16@1+\nsignal.F.b = 15|2@1+\n",
     "6:14: signals 'a' and 'b' of frame 'F' have bits in common", "correct start and length"},
    {"written signals with bits in common", Semantic,
     FRAME "signal.F.a = 0|16@1+\nsignal.F.b = 7|4@0+\n[d.write]\nF.a = x\nF.b = y\n",
     "9:7: signals 'a' and 'b' of message 'F' have bits in common", "write one of them"},
    {"one id twice", Semantic, FRAME "frame.G = 0x10, 8 bytes\n", "5:11: frame 'G' has the id of message 'F'",
     "give each its own"},
    {"one name twice", Semantic, FRAME "signal.F.a = M 0|8@1+\nsignal.F.b = M 8|8@1+\n",
     "6:14: frame 'F' has two multiplexors", "it can have one"},
    {"element twice", Semantic, MODBUS "register.a = coil 1\n[d.read]\nx[0] = a\nx[00] = a\n",
     "7:9: 'x' is wired twice", "wire each element once"},
    {"with brackets and without", Semantic, MODBUS "register.a = coil 1\n[d.read]\nx[0] = a\nx = a\n",
     "7:5: 'x' is wired twice", "wire each element once"},

    // ---- meaning: values ----
    {"safe value of an int16", Semantic, MODBUS "register.a = holding 1, int16, factor 0.1\n[d.safe]\na = 1e9\n",
     "6:5: 1000000000 is not in the range -3276.8 to 3276.7 of 'a'", "write a value of this range"},
    {"negative safe value", Semantic, MODBUS "register.a = holding 1\n[d.safe]\na = -1\n",
     "6:5: -1 is not in the range 0 to 65535", "write a value of this range"},
    {"safe value of a coil", Semantic, MODBUS "register.a = coil 1\n[d.safe]\na = 2\n",
     "6:5: 2 is not in the range 0 to 1", "write a value of this range"},
    {"safe value of a line", Semantic, GPIO "output.a = 3\n[d.safe]\na = 24\n", "6:5: 24 is not in the range 0 to 1",
     "write a value of this range"},
    {"safe value in a frame", Semantic, FRAME "signal.F.a = 0|8@1- (0.5,0)\n[d.safe]\nF.a = 64\n",
     "7:7: 64 is not in the range -64 to 63.5 of 'F.a'", "write a value of this range"},
    {"safe value of a byte", Semantic, I2C "register.a = 1, write\n[d.safe]\na = 256\n",
     "7:5: 256 is not in the range 0 to 255", "write a value of this range"},
    {"constant", Semantic, MODBUS "register.a = coil 1\n[d.write]\na = 1 * 5\n[d.safe]\na = 0\n",
     "6:5: 5 is not in the range 0 to 1", "write a value of this range"},
    {"constant without a safe value", Semantic, MODBUS "register.a = coil 1\n[d.write]\na = 1\n",
     "6:5: no signal gives 'a' a safe value", "add 'a = ...' to the section 'safe'"},
    {"factor 0 of a wire", Semantic, MODBUS "register.a = coil 1\n[d.read]\nx = a * 0\n", "6:5: with the factor '0'",
     "nothing is left of the value"},
    {"factor 0 of a register", Semantic, MODBUS "register.a = holding 1, factor 0\n", "4:14: 'factor 0' is not valid",
     "a number, not 0"},
    {"factor 0 of an I2C register", Semantic, I2C "register.a = 1, factor 0\n", "5:14: 'factor 0' is not an option",
     "use a type"},
    {"factor 0 of a signal", Semantic, FRAME "signal.F.a = 0|8@1+ (0,0)\n", "5:14: ", "the factor is 0"},
    {"hole in an array", Semantic, MODBUS "register.a = coil 1\n[d.read]\nx[1] = a\n",
     "no channel gives a value to x[0]", "add it to a section 'read'"},

    // ---- meaning: time ----
    {"fresh for less than an interval", Semantic, MODBUS "register.a = coil 1\ninterval = 20 ms\ntimeout = 10 ms\n",
     "6:11: timeout is shorter than interval (20 ms)", "write at least that"},
    {"fresh for less than a cycle time", Semantic, FRAME "signal.F.a = 0|8@1+\ntimeout.F = 50 ms\n",
     "6:13: 50 ms is shorter than the cycle time of 'F' (100 ms)", "write at least that"},
    {"requests of CAN FD", Semantic, CAN "frame.F = 0x10, 64 bytes\nsignal.F.a = 0|8@1+\nsend.F = on request\n",
     "6:10: message 'F' is one of CAN FD", "write another rule"},

    // ---- meaning: frames ----
    {"size of no frame", Semantic, CAN "frame.F = 0x10, 9 bytes\n", "4:11: no frame has 9 bytes", "it has 0 ... 8"},
    {"signal behind its frame", Semantic, FRAME "signal.F.a = 60|8@1+\n", "5:14: signal 'a' has 8 bits from bit 60",
     "message 'F' has only 8 bytes"},
    {"signal of no frame", Semantic, FRAME "signal.G.a = 0|8@1+\n", "5:14: there is no frame 'G'",
     "write a line frame.G = 0x123, 8 bytes"},
    {"page without multiplexor", Semantic, FRAME "signal.F.a = m1 0|8@1+\n[d.read]\nx = F.a\n",
     "7:5: message 'F' cannot be used", "no multiplexor (M)"},

    // ---- meaning: direction ----
    {"written input register", Semantic, MODBUS "register.a = input 1\n[d.write]\na = x\n", "6:5: 'a' can only be read",
     "it is of the input registers"},
    {"written bits of a register twice", Semantic,
     MODBUS "register.a = holding 1, bit 3\nregister.b = holding 1, bits 2-4\n[d.write]\na = x\nb = y\n",
     "8:5: 'b' and 'a' are the same place of the device", "write one of them"},
    {"output that is read", Semantic, GPIO "output.lamp = 1\ninput.door = 2, pull-up\n[d.read]\nx = lamp\n",
     "7:5: driver 'gpio' has no channel 'lamp' to read", "known are: door"},
    {"misspelt channel", Semantic, MODBUS "register.speed = holding 1\n[d.read]\nx = sped\n",
     "6:5: driver 'modbus' has no channel 'sped'", "did you mean 'speed'"},

    // ---- meaning: safety ----
    {"stop of no device", Semantic, "[node]\nsafeStop = e.a\n" MODBUS "register.a = coil 1\n",
     "2:12: there is no device 'e'", "did you mean 'd'"},
    {"stop by no channel", Semantic, "[node]\nsafeStop = d.b\n" MODBUS "register.a = coil 1\n",
     "2:12: driver 'modbus' has no channel 'b'", "did you mean 'a'"},
    {"torn wire that is not pressed", Semantic, "[node]\nsafeStop = d.stop\n" GPIO "input.stop = 17, pull-down\n",
     "2:12: 'd.stop' is 0 with a torn wire", "normally closed to ground, pull-up"},
    {"torn wire that is swapped", Semantic, "[node]\nsafeStop = d.stop\n" GPIO "input.stop = 17, pull-up, active-low\n",
     "2:12: 'd.stop' is 0 with a torn wire", "no active-low"},
    {"torn wire that floats", Semantic, "[node]\nsafeStop = d.stop\n" GPIO "input.stop = 17\n",
     "2:12: 'd.stop' has no resistor", "add pull-up, or no-pull if there is an external resistor"},
    {"safe while driven", Semantic, GPIO "output.brake = 22\n[d.safe]\nbrake = 1\n",
     "6:9: the safe value of 'brake' is 1, and without the program or its power it is 0",
     "wire the device so that 0 is safe"},
};

QVector<QPlcParseError> findingsOf(const QByteArray &text)
{
    QPlcHardwareNode node;
    node.configure(text, QStringLiteral("a.ini"));
    return node.configurationErrors().isEmpty() ? node.configurationWarnings() : node.configurationErrors();
}

}  // namespace

class tst_RefusedConfigurations : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void eachIsToldWithItsLineAndARemedy_data();
    void eachIsToldWithItsLineAndARemedy();
    void thereAreManyOfEachKind();
    void allAreToldAtOnce();
    void aWarningRefusesNothing();
};

void tst_RefusedConfigurations::eachIsToldWithItsLineAndARemedy_data()
{
    QTest::addColumn<int>("index");
    for (int i = 0; i < int(std::size(cases)); ++i)
        QTest::newRow(cases[i].name) << i;
}

void tst_RefusedConfigurations::eachIsToldWithItsLineAndARemedy()
{
    QFETCH(int, index);
    const Case &row = cases[index];
    const QVector<QPlcParseError> findings = findingsOf(row.text);
    const QString told = QPlcParseError::toString(findings);
    const QString first = QPlcParseError::toString({findings.value(0)});
    QCOMPARE(findings.size(), 1);
    const QString own = QStringLiteral("a.ini:") + row.error;
    const QString ofFile = QStringLiteral("a.ini: ") + row.error;
    QVERIFY2(told.startsWith(own) || told.startsWith(ofFile) || told.startsWith(row.error), qPrintable(told));
    QVERIFY2(told.contains(row.remedy), qPrintable(told));
}

void tst_RefusedConfigurations::thereAreManyOfEachKind()
{
    const auto count = [](Kind kind) {
        return std::count_if(std::begin(cases), std::end(cases), [kind](const Case &one) { return one.kind == kind; });
    };
    QVERIFY(std::size(cases) >= 60);
    QVERIFY(count(Semantic) >= 30);
    QVERIFY(count(Malformed) >= 30);
}

// A line that cannot be read hides no other error, and an error makes no echoes.
void tst_RefusedConfigurations::allAreToldAtOnce()
{
    QPlcHardwareNode node;
    node.configure("[node]\nsafeStop = buttons.stop\nmistake\n[drive]\ndriver = modbus\ndevice = rtu:/dev/ttyUSB0\n"
                   "retries = many\nregister.speed = holding 1, int7\nregister.limit = holding 2, unit 255\n"
                   "register.torque = holding 3, int16\n[drive.read]\nspeed = speed\nx = sped\n[drive.safe]\n"
                   "torque = 1e9\n[buttons]\ndriver = gpio\ndevice = gpiochip0\ninput.stop = 17, pull-down\n"
                   "output.lamp = 17\n",
                   "a.ini");
    const QString told = QPlcParseError::toString(node.configurationErrors() + node.configurationWarnings());
    for (const char *part :
         {"a.ini:3:", "a.ini:7:11: retries", "a.ini:8:18: 'int7'", "a.ini:9:18: a serial line has no unit 255",
          "a.ini:13:5: driver 'modbus' has no channel 'sped'", "a.ini:15:10: 1000000000 is not in the range",
          "a.ini:20:15: line 17 of gpiochip0 is used twice", "a.ini:2:12: 'buttons.stop' is 0 with a torn wire"})
        QVERIFY2(told.contains(QLatin1String(part)), qPrintable(told));
    QVERIFY2(told.count('\n') == 7, qPrintable(told));
}

void tst_RefusedConfigurations::aWarningRefusesNothing()
{
    QPlcHardwareNode node;
    QVERIFY(node.configure("[node]\nsafeStop = d.stop\n" GPIO "input.stop = 17, pull-down\n", "a.ini"));
    QCOMPARE(node.configurationWarnings().size(), 1);
    QPlcHardwareNode right;
    QVERIFY(right.configure("[node]\nsafeStop = d.stop\n" GPIO "input.stop = 17, pull-up\noutput.brakeRelease = 22\n"
                            "[d.safe]\nbrakeRelease = 0\n",
                            "a.ini"));
    QVERIFY(right.configurationWarnings().isEmpty());
}

QTEST_GUILESS_MAIN(tst_RefusedConfigurations)
#include "tst_RefusedConfigurations.moc"
