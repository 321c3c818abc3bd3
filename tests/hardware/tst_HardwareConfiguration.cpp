// SPDX-License-Identifier: Apache-2.0
// The file of a hardware node: what it may say, and what is told about what it may not.
#include "BenchDriver.h"
#include "QPlcHardwareNode.h"
#include "hardware/HardwareConfiguration.h"
#include "signals/MessageText.h"

#include <QtCore/QDir>
#include <QtTest/QtTest>

using namespace qplc;
using namespace std::chrono_literals;

namespace {

QString errorsOf(const QByteArray &text, const QString &fileName = QStringLiteral("winch.ini"))
{
    QPlcHardwareNode node;
    node.configure(text, fileName);
    return QPlcParseError::toString(node.configurationErrors());
}

}  // namespace

class tst_HardwareConfiguration : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        QPlcHardwareNode::addDriverKind("bench", "memory of a test", [] {
            return std::make_unique<BenchDriver>(std::make_shared<BenchDevice>(), QPlcDriver::EveryCycle);
        });
    }
    void termsAreNamesWithFactorAndOffset_data();
    void termsAreNamesWithFactorAndOffset();
    void aWholeFileIsUnderstood_data();
    void aWholeFileIsUnderstood();
    void errorsAreReportedWithTheirPosition_data();
    void errorsAreReportedWithTheirPosition();
    void valuesThatADeviceCannotTakeAreRefused_data();
    void valuesThatADeviceCannotTakeAreRefused();
    void aMissingFileIsNamed();
    void refusedConfigurationLeavesNoWires();
    void settingsReturnTheRequestedType();
    void invalidSettingsAreReported_data();
    void invalidSettingsAreReported();
    void examplesOfThePagesAreAccepted_data();
    void examplesOfThePagesAreAccepted();
};

void tst_HardwareConfiguration::termsAreNamesWithFactorAndOffset_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("meaning");
    QTest::newRow("name") << "speed"
                          << "speed -1 1 0";
    QTest::newRow("with dots") << "DriveStatus.Speed"
                               << "DriveStatus.Speed -1 1 0";
    QTest::newRow("with a dash") << "wind-speed"
                                 << "wind-speed -1 1 0";
    QTest::newRow("element") << "acceleration[2]"
                             << "acceleration 2 1 0";
    QTest::newRow("factor") << "speed * 0.5"
                            << "speed -1 0.5 0";
    QTest::newRow("no spaces") << "speed*-2e-3"
                               << "speed -1 -0.002 0";
    QTest::newRow("offset") << "speed + 3"
                            << "speed -1 1 3";
    QTest::newRow("all") << "position[0] * 1e3 - 5.5"
                         << "position 0 1000 -5.5";
    for (const char *bad : {"", "a b", "speed *", "speed * x", "speed + ", "speed * nan", "speed * inf", "a[", "a[x]",
                            "a[1] [2]", "* 3", "speed + 3 + 4", "speed * 1e999"})
        QTest::addRow("bad: %s", bad) << QString(bad) << QString();
}

void tst_HardwareConfiguration::termsAreNamesWithFactorAndOffset()
{
    QFETCH(QString, text);
    QFETCH(QString, meaning);
    ConfigurationTerm term;
    QString error;
    const bool isGood = ConfigurationTerm::fromText(text, &term, &error);
    QCOMPARE(isGood, !meaning.isEmpty());
    QCOMPARE(isGood, error.isEmpty());
    if (isGood)
        QCOMPARE(QStringLiteral("%1 %2 %3 %4").arg(term.name).arg(term.element).arg(term.factor).arg(term.offset),
                 meaning);
}

void tst_HardwareConfiguration::aWholeFileIsUnderstood_data()
{
    QTest::addColumn<QString>("fileName");
    QTest::addColumn<QByteArray>("text");
    QTest::newRow("INI") << "a.ini" << QByteArray(R"(; a comment
[node]
name = Winch
safeStop = drive.speed, drive.@online
[drive]
driver = bench
device = bench0   ; the first one
[drive.read]
winchSpeed = speed * 0.5 + 1
[drive.write]
torque = setpoint[1]
[drive.safe]
brake = 1
)");
    QTest::newRow("JSON") << "a.json"
                          << QByteArray(R"({"node": {"name": "Winch", "safeStop": "drive.speed, drive.@online"},
        "drive": {"driver": "bench", "device": "bench0", "read": {"winchSpeed": "speed * 0.5 + 1"},
                  "write": {"torque": "setpoint[1]"}, "safe": {"brake": 1}}})");
}

void tst_HardwareConfiguration::aWholeFileIsUnderstood()
{
    QFETCH(QString, fileName);
    QFETCH(QByteArray, text);
    const HardwareConfiguration configuration(text, fileName);
    QCOMPARE(QPlcParseError::toString(configuration.errors()), QString());
    QCOMPARE(configuration.nodeName(), QString("Winch"));
    QCOMPARE(configuration.safeStops().size(), 2);
    QCOMPARE(configuration.safeStops().at(1).channel, QString("@online"));
    QCOMPARE(configuration.drivers().size(), 1);
    const HardwareConfiguration::Driver &drive = configuration.drivers().first();
    QCOMPARE(drive.kind, QString("bench"));
    QCOMPARE(drive.wires.size(), 2);
    QCOMPARE(drive.wires.at(0).target.name, QString("winchSpeed"));
    QCOMPARE(drive.wires.at(0).source.factor, 0.5);
    QCOMPARE(drive.wires.at(0).source.offset, 1.0);
    QCOMPARE(drive.wires.at(1).source.element, 1);
    QCOMPARE(drive.safeValues.at(0).value, 1.0);
    QPlcHardwareNode node;
    QVERIFY2(node.configure(text, fileName), qPrintable(QPlcParseError::toString(node.configurationErrors())));
    QCOMPARE(node.name(), QString("Winch"));
    QCOMPARE(node.wires().size(), 2);
}

void tst_HardwareConfiguration::errorsAreReportedWithTheirPosition_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("error");
    const QByteArray drive = "[drive]\ndriver = bench\ndevice = b\n";
    const auto add = [](const char *name, const QByteArray &text, const QString &error) {
        QTest::newRow(name) << text << QStringLiteral("winch.ini:") + error;
    };
    QStringList kinds;
    for (const auto &kind : QPlcHardwareNode::driverKinds())
        kinds << kind.first;
    QTest::newRow("empty")
        << QByteArray()
        << "winch.ini: there is no device; begin a section for each of them: [drive], driver = can, ...";
    add("no section", "driver = bench\n",
        "1:1: 'driver' stands before the first section; begin with [node] or the name of a device in brackets");
    add("no kind", "[drive]\ndevice = b\n", "1: section 'drive' has no driver; add for example 'driver = can'");
    add("unknown kind", "[drive]\ndriver = bensh\n",
        "2:10: there is no driver 'bensh'; did you mean 'bench'?" + qplc::knownAre(kinds));
    add("unknown key", drive + "gian = 3\n", "4:8: 'gian' is not a key of this driver; did you mean 'gain'?");
    add("missing key", "[drive]\ndriver = bench\n",
        "2:10: section 'drive' needs the key 'device', for example 'device = bench0'");
    add("bad number", drive + "gain = 101\n", "4:8: gain = '101' is not a number from 0 to 100");
    add("unknown part", drive + "[drive.reed]\n",
        "4:2: section 'drive.reed' belongs to no device, or is not one of its parts read, write and safe; did you mean "
        "'drive.read'?");
    add("part without device", drive + "[drvie.read]\n",
        "4:2: section 'drvie.read' belongs to no device, or is not one of its parts read, write and safe; did you mean "
        "'drive.read'?");
    add("unknown channel", drive + "[drive.read]\nspeed = sped\n",
        "5:9: driver 'bench' has no channel 'sped' to read; did you mean 'speed'?");
    add("bad term", drive + "[drive.read]\nspeed = speed *\n",
        "5:9: 'speed *' is not a name with a factor and an offset; write for example 'speed', 'speed * 0.1' or "
        "'position[2] * 0.001 - 5'");
    add("factor on the left", drive + "[drive.read]\nspeed * 2 = speed\n",
        "5:13: factor and offset of 'speed * 2' belong to the right side of '='");
    add("element of a channel", drive + "[drive.read]\nspeed = speed[1]\n",
        "5:9: a channel has no elements: leave the brackets out");
    add("element twice", drive + "[drive.read]\na[0] = speed\na[00] = speed\n",
        "6:9: 'a' is wired twice, or with brackets and without; wire each element once");
    add("with and without brackets", drive + "[drive.read]\na[0] = speed\na = speed\n",
        "6:5: 'a' is wired twice, or with brackets and without; wire each element once");
    add("constant without a safe value", drive + "[drive.write]\nbrake = 1\n",
        "5:9: no signal gives 'brake' a safe value; add 'brake = ...' to the section 'safe' of the device");
    add("key twice", drive + "device = c\n", "4:1: 'device' is there twice, first in line 3; leave one of them out");
    add("section twice", drive + "[drive]\ndriver = bench\ndevice = c\n",
        "4:2: section 'drive' is there twice; put its lines together");
    add("bad safe value", drive + "[drive.safe]\nbrake = closed\n",
        "5:9: 'closed' is not a number; write the safe value of 'brake' in the unit of the device");
    add("unknown safe channel", drive + "[drive.safe]\nbrak = 1\n",
        "5:8: driver 'bench' has no channel 'brak' to write; did you mean 'brake'?");
    add("unknown key of the node", "[node]\nnmae = x\n" + drive,
        "2:8: 'nmae' is not a key of [node]; its keys are 'name' and 'safeStop'");
    add("no channel", "[node]\nsafeStop = button\n" + drive,
        "2:12: 'button' is not a channel of a device; write for example 'buttons.emergencyStop'");
    add("unknown device", "[node]\nsafeStop = drvie.speed\n" + drive,
        "2:12: there is no device 'drvie'; did you mean 'drive'?");
    QTest::newRow("hole in an array")
        << drive + "[drive.read]\na[2] = speed\n"
        << "winch.ini: no channel gives a value to a[0], a[1]; add it to a section 'read'";
}

void tst_HardwareConfiguration::errorsAreReportedWithTheirPosition()
{
    QFETCH(QByteArray, text);
    QFETCH(QString, error);
    QCOMPARE(errorsOf(text), error);
}

void tst_HardwareConfiguration::valuesThatADeviceCannotTakeAreRefused_data()
{
    QTest::addColumn<QByteArray>("keys");
    QTest::addColumn<double>("lowest");
    QTest::addColumn<double>("highest");
    const QByteArray modbus = "driver = modbus\ndevice = fake:d\nregister.out = ";
    QTest::newRow("int16") << modbus + "holding 1, int16, factor 0.1" << -3276.8 << 3276.7;
    QTest::newRow("negative factor") << modbus + "holding 1, int16, factor -0.01, offset 5" << -322.67 << 332.68;
    QTest::newRow("uint32") << modbus + "holding 1, uint32" << 0.0 << 4294967295.0;
    QTest::newRow("coil") << modbus + "coil 1" << 0.0 << 1.0;
    const QByteArray i2c = "driver = i2c-registers\ndevice = fake:d\naddress = 0x20\nregister.out = 1, write, ";
    QTest::newRow("int24") << i2c + "int24" << -8388608.0 << 8388607.0;
    QTest::newRow("uint8") << i2c + "uint8, factor 0.5, offset -10" << -10.0 << 117.5;
    QTest::newRow("line") << QByteArray("driver = gpio\ndevice = fake:d\noutput.out = 3") << 0.0 << 1.0;
    const QByteArray can = "driver = can\ndevice = fake:d\nframe.F = 1, 8 bytes\nsignal.F.out = ";
    QTest::newRow("CAN") << can + "0|12@1- (0.5,100)" << -924.0 << 1123.5;
    QTest::newRow("CAN, all bits") << can + "0|64@1+" << 0.0 << 18446744073709551615.0;
    QTest::newRow("CAN, float") << can + "0|32@1f" << -3.4028234e38 << 3.4028234e38;
}

void tst_HardwareConfiguration::valuesThatADeviceCannotTakeAreRefused()
{
    QFETCH(QByteArray, keys);
    QFETCH(double, lowest);
    QFETCH(double, highest);
    const QByteArray channel = keys.contains("can") ? "F.out" : "out";
    const auto textOf = [&](double safe, double constant) {
        return "[d]\n" + keys + "\n[d.safe]\n" + channel + " = " + QByteArray::number(safe, 'g', 17) + "\n[d.write]\n"
            + channel + " = " + QByteArray::number(constant, 'f', 9) + "\n";
    };
    QCOMPARE(errorsOf(textOf(lowest, highest)), QString());
    QCOMPARE(errorsOf(textOf(highest, lowest)), QString());
    const double step = std::max(0.6, 1e-4 * std::abs(highest));
    const QString error = errorsOf(textOf(highest + step, lowest - step));
    const QRegularExpression sentence(
        QStringLiteral(R"(^winch.ini:\d+:\d+: \S+ is not in the range \S+ to \S+ of '%1'; write a value of this range)")
            .arg(QString::fromLatin1(channel)),
        QRegularExpression::MultilineOption);
    auto found = sentence.globalMatch(error);
    int count = 0;
    for (; found.hasNext(); ++count)
        found.next();
    QVERIFY2(count == 2, qPrintable(error));
    QCOMPARE(error.count('\n'), 1);
}

void tst_HardwareConfiguration::aMissingFileIsNamed()
{
    QPlcHardwareNode node;
    QVERIFY(!node.configureFromFile("/nowhere/winch.ini"));
    QCOMPARE(QPlcParseError::toString(node.configurationErrors()),
             QString("/nowhere/winch.ini: cannot open: No such file or directory; give the path of the configuration "
                     "of a hardware node"));
    QVERIFY(!node.configureFromFile("/dev/zero"));
    QCOMPARE(QPlcParseError::toString(node.configurationErrors()),
             QString("/dev/zero: has more than 1048576 bytes; give the configuration of a hardware node, which has "
                     "fewer"));
    QCOMPARE(errorsOf("{\"drive\": 3,\n \"x\" }", "a.json"),
             QString("a.json:2:6: this is not JSON: missing name separator"));
    QCOMPARE(
        errorsOf("{\"drive\": 3}", "a.json"),
        QString("a.json: 'drive' is not an object; write \"drive\": {\"driver\": ...}\na.json: there is no device; "
                "begin a section for each of them: [drive], driver = can, ...")
            .section('\n', 0, 0));
}

void tst_HardwareConfiguration::refusedConfigurationLeavesNoWires()
{
    QPlcHardwareNode node;
    QVERIFY(!node.configure("[drive]\ndriver = bench\ndevice = b\n[drive.read]\nspeed = speed\nother = nonsense\n",
                            "a.ini"));
    QVERIFY(node.wires().isEmpty());
    QVERIFY(node.drivers().isEmpty());
}

void tst_HardwareConfiguration::settingsReturnTheRequestedType()
{
    HardwareConfiguration configuration("[d]\ndriver = x\ntext = a b\nreal = 2.5\nwhole = -3\nhex = 0x7F\nyes = on\nno "
                                        "= 0\ntime = 2.5 ms\nword = b\nwords = a, b ,c\n"
                                        "file = sub/x.dbc\nabsolute = /x.dbc\nline.a = 1\nline.b = 2\n",
                                        "/etc/plant/a.ini");
    const auto settings = configuration.settings(configuration.drivers().first());
    QCOMPARE(settings->name(), QString("d"));
    QCOMPARE(settings->text("text"), QString("a b"));
    QCOMPARE(settings->text("missing", "default"), QString("default"));
    QCOMPARE(settings->number("real", 0.0, -5.0, 5.0), 2.5);
    QCOMPARE(settings->integer("whole", 0, -5, 5), qint64(-3));
    QCOMPARE(settings->integer("hex", 0, 0, 255), qint64(127));
    QCOMPARE(settings->truth("yes", false), true);
    QCOMPARE(settings->truth("no", true), false);
    QCOMPARE(settings->truth("missing", true), true);
    QCOMPARE(settings->duration("time", 1s, 1ns, 1h), std::chrono::nanoseconds(2500us));
    QCOMPARE(settings->choice("word", {"a", "b"}), 1);
    QCOMPARE(settings->list("words"), (QStringList{"a", "b", "c"}));
    QCOMPARE(settings->fileName("file"), QString("/etc/plant/sub/x.dbc"));
    QCOMPARE(settings->fileName("absolute"), QString("/x.dbc"));
    QCOMPARE(settings->namesBehind("line."), (QStringList{"a", "b"}));
    QVERIFY(settings->has("text") && !settings->has("missing"));
    QVERIFY(configuration.errors().isEmpty());
    configuration.checkUse(*settings);
    QCOMPARE(configuration.errors().size(), 2);  // the lines
}

void tst_HardwareConfiguration::invalidSettingsAreReported_data()
{
    QTest::addColumn<QByteArray>("line");
    QTest::addColumn<QString>("error");
    QTest::newRow("real") << QByteArray("real = x") << "real = 'x' is not a number from -5 to 5";
    QTest::newRow("nan") << QByteArray("real = nan") << "real = 'nan' is not a number from -5 to 5";
    QTest::newRow("whole") << QByteArray("whole = 2.5") << "whole = '2.5' is not a whole number from -5 to 5";
    QTest::newRow("truth") << QByteArray("truth = maybe")
                           << "truth = 'maybe' is not a truth value; write 'yes' or 'no'";
    QTest::newRow("no unit") << QByteArray("time = 10")
                             << "time = '10' is not a duration; write a number and its unit: '10 ms', '250 us', '2 s'";
    QTest::newRow("long") << QByteArray("time = 2 h") << "time = '2 h' is not in the range of 1 ms to 3600 s";
    QTest::newRow("word") << QByteArray("word = c") << "word = 'c' is not one of 'a', 'b'";
}

void tst_HardwareConfiguration::invalidSettingsAreReported()
{
    QFETCH(QByteArray, line);
    QFETCH(QString, error);
    HardwareConfiguration configuration("[d]\ndriver = x\n" + line + '\n', "a.ini");
    const auto settings = configuration.settings(configuration.drivers().first());
    QCOMPARE(settings->number("real", 1.5, -5.0, 5.0), 1.5);
    QCOMPARE(settings->integer("whole", 4, -5, 5), qint64(4));
    QCOMPARE(settings->truth("truth", true), true);
    QCOMPARE(settings->duration("time", 1s, 1ms, 1h), std::chrono::nanoseconds(1s));
    QCOMPARE(settings->choice("word", {"a", "b"}, 1), 1);
    QCOMPARE(configuration.errors().size(), 1);
    QCOMPARE(configuration.errors().first().message, error);
    QCOMPARE(configuration.errors().first().line, 3);
}

/// Each block of a page that has a driver. The files that they name are those of the example.
void tst_HardwareConfiguration::examplesOfThePagesAreAccepted_data()
{
    QTest::addColumn<QByteArray>("text");
    const QDir pages(QStringLiteral(QTPLC_SOURCES "/docs/hardware"));
    for (const QString &name : pages.entryList({QStringLiteral("*.md")})) {
        QFile page(pages.filePath(name));
        QVERIFY2(page.open(QIODevice::ReadOnly), qPrintable(page.errorString()));
        const QList<QByteArray> parts = page.readAll().replace("```ini\n", "\f").replace("```", "\f").split('\f');
        for (int i = 1; i < parts.size(); i += 2) {
            if (parts[i].contains("\ndriver = "))
                QTest::newRow(qPrintable(QStringLiteral("%1, block %2").arg(name).arg(i / 2 + 1))) << parts[i];
        }
    }
}

void tst_HardwareConfiguration::examplesOfThePagesAreAccepted()
{
    QFETCH(QByteArray, text);
    QPlcHardwareNode node;
    node.configure(text, QStringLiteral(QTPLC_SOURCES "/examples/airborne_wind_energy/hardware/page.ini"));
    QCOMPARE(QPlcParseError::toString(node.configurationErrors()), QString());
}

QTEST_GUILESS_MAIN(tst_HardwareConfiguration)
#include "tst_HardwareConfiguration.moc"
