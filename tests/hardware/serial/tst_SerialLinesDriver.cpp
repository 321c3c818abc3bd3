// SPDX-License-Identifier: Apache-2.0
#include "FarEnd.h"
#include "hardware/serial/LineTemplate.h"
#include "hardware/serial/LineText.h"

#include <QtTest/QtTest>

using namespace qplc;
using namespace std::chrono_literals;

namespace {

const QByteArray scalePattern = "pattern = ^(?:ST|US),GS,\\s*(?<weight>[-+0-9. ]+)kg$\n";

/// An instrument at the far end of a line.
struct Instrument : FarEnd
{
    explicit Instrument(const QByteArray &keys)
        : FarEnd("serial-lines", "fake:scale", keys)
    {
    }
};

}  // namespace

class tst_SerialLinesDriver : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aNumberIsTakenFromItsLine();
    void linesOfSeveralKindsHaveTheirPatterns();
    void linesMayComeInPieces();
    void otherBytesMayEndALine();
    void aNumberThatIsNoneIsCounted();
    void aLineThatIsTooLongIsThrownAway();
    void anInstrumentIsAsked();
    void valuesAreSentInLines();
    void linesMayBeSentWhenTheirValuesChange();
    void anInstrumentThatOnlyTakesLinesMayBeSilent();
    void aLineThatIsBusyGetsNoOldValues();
    void linesThatNeedMoreThanTheirIntervalAreAWarning();
    void numbersHaveTheFormOfTheirLine_data();
    void numbersHaveTheFormOfTheirLine();
    void aSilentInstrumentIsNamed();
    void linesThatDoNotMatchAreNamed();
    void aLineThatIsUnpluggedIsOpenedAgain();
    void textsMayHaveControlCharacters_data();
    void textsMayHaveControlCharacters();
    void invalidKeysAreRefused_data();
    void invalidKeysAreRefused();
};

void tst_SerialLinesDriver::aNumberIsTakenFromItsLine()
{
    Instrument scale(scalePattern);
    QCOMPARE(scale.bench.errors() + scale.bench.wireRead("weight"), QString());
    QVERIFY2(scale.bench.open(), qPrintable(scale.bench.errorString()));
    QVERIFY(scale.say("ST,GS,+  12.345kg\r\n"));
    QCOMPARE(scale.bench.value("weight"), 12.345);
    QVERIFY(scale.say("ST,GS,-   0.500kg\r\nUS,GS,-   0.750kg\r\n"));
    QCOMPARE(scale.bench.value("weight"), -0.75);
    scale.bench.advance(2500ms);
    QVERIFY(scale.bench.exchange());
    QVERIFY(scale.bench.isFresh("weight"));
    scale.bench.advance(1ns);
    QVERIFY(scale.bench.exchange());
    QVERIFY(!scale.bench.isFresh("weight"));
}

void tst_SerialLinesDriver::linesOfSeveralKindsHaveTheirPatterns()
{
    Instrument station("pattern.air = ^AIR (?<temperature>\\S+) (?<humidity>\\S+)$\n"
                       "pattern.sun = ^SUN (?<radiation>\\S+)$\n");
    QCOMPARE(station.bench.errors(), QString());
    for (const char *name : {"temperature", "humidity", "radiation"})
        QCOMPARE(station.bench.wireRead(name), QString());
    QVERIFY2(station.bench.open(), qPrintable(station.bench.errorString()));
    QVERIFY(station.say("AIR 21.5 45\nSUN 812\n"));
    QCOMPARE(station.bench.value("temperature"), 21.5);
    QCOMPARE(station.bench.value("humidity"), 45.0);
    QCOMPARE(station.bench.value("radiation"), 812.0);
    QVERIFY(station.bench.wireRead("rain").contains("known are"));
}

void tst_SerialLinesDriver::linesMayComeInPieces()
{
    Instrument scale(scalePattern);
    scale.bench.wireRead("weight");
    QVERIFY2(scale.bench.open(), qPrintable(scale.bench.errorString()));
    for (const char byte : QByteArray("ST,GS,+  12.345kg\r"))
        QVERIFY(scale.say(QByteArray(1, byte)));
    QCOMPARE(scale.bench.value("weight"), 12.345);
}

void tst_SerialLinesDriver::otherBytesMayEndALine()
{
    Instrument scale("end = \\x03\npattern = ^\\x02(?<weight>[0-9]+)$\n");
    QCOMPARE(scale.bench.errors() + scale.bench.wireRead("weight"), QString());
    QVERIFY2(scale.bench.open(), qPrintable(scale.bench.errorString()));
    QVERIFY(scale.say("\x02"
                      "125"
                      "\x03\x02"
                      "12"));
    QCOMPARE(scale.bench.value("weight"), 125.0);
}

void tst_SerialLinesDriver::aNumberThatIsNoneIsCounted()
{
    Instrument scale("pattern = ^W (?<weight>.*)$\n");
    scale.bench.wireRead("weight");
    scale.bench.wireRead("@errors");
    QVERIFY2(scale.bench.open(), qPrintable(scale.bench.errorString()));
    QVERIFY(scale.say("W 5\nW 1.2.3\nW nan\nW 1e999\nW \nX 6\n"));
    QCOMPARE(scale.bench.value("weight"), 5.0);
    QCOMPARE(scale.bench.value("@errors"), 5.0);
}

void tst_SerialLinesDriver::aLineThatIsTooLongIsThrownAway()
{
    Instrument scale("pattern = (?<weight>[0-9]+)$\n");
    scale.bench.wireRead("weight");
    scale.bench.wireRead("@errors");
    QVERIFY2(scale.bench.open(), qPrintable(scale.bench.errorString()));
    QVERIFY(scale.say(QByteArray(LineStream::MaximumLength + 1, '1') + "\n"));
    QVERIFY(!scale.bench.isFresh("weight"));
    QCOMPARE(scale.bench.value("@errors"), 1.0);
    QVERIFY(scale.say("7\n"));
    QCOMPARE(scale.bench.value("weight"), 7.0);
}

void tst_SerialLinesDriver::anInstrumentIsAsked()
{
    Instrument scale("ask = W?\\r\\n\ninterval = 100 ms\npattern = ^(?<weight>[0-9]+)$\n");
    QCOMPARE(scale.bench.errors() + scale.bench.wireRead("weight"), QString());
    QVERIFY2(scale.bench.open(), qPrintable(scale.bench.errorString()));
    QCOMPARE(scale.far.receive(), QByteArray("W?\r\n"));
    QVERIFY(scale.say("42\r\n"));
    QCOMPARE(scale.bench.value("weight"), 42.0);
    QCOMPARE(scale.far.receive(), QByteArray("W?\r\n"));
}

void tst_SerialLinesDriver::valuesAreSentInLines()
{
    Instrument supply("interval = 100 ms\nsend.set = SET {voltage:.2},{current:.3}\\r\nsend.on = OUT {on}\\r\n"
                      "ask = MEAS?\\r\npattern = ^(?<voltage>\\S+)$\n");
    DriverBench &bench = supply.bench;
    QCOMPARE(bench.errors(), QString());
    for (const char *name : {"voltage", "current", "on"})
        QCOMPARE(bench.wireWrite(name), QString());
    QCOMPARE(bench.wireRead("voltage"), QString());
    bench.set("on", 1.0);
    bench.exchange();
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));
    QCOMPARE(supply.far.receive(), QByteArray("OUT 1\rMEAS?\r"));  // the other one has no values yet
    QVERIFY(!bench.runner().isDelivered());
    bench.set("voltage", 12.3456);
    bench.set("current", -0.0001);
    QVERIFY2(bench.exchange(), qPrintable(bench.errorString()));
    QCOMPARE(supply.far.receive(), QByteArray("SET 12.35,0.000\rOUT 1\rMEAS?\r"));
    QVERIFY(bench.runner().isDelivered());
    QVERIFY(supply.say("12.31\r"));
    QCOMPARE(bench.value("voltage"), 12.31);
}

void tst_SerialLinesDriver::linesMayBeSentWhenTheirValuesChange()
{
    Instrument heater("send.a = A{a}\\n\nsend.b = B{b}\\n\nwrite = on-change\n");
    DriverBench &bench = heater.bench;
    QCOMPARE(bench.errors() + bench.wireWrite("a") + bench.wireWrite("b"), QString());
    bench.set("a", 1.0);
    bench.set("b", 2.0);
    bench.exchange();
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));
    QCOMPARE(heater.far.receive(), QByteArray("A1\nB2\n"));
    QVERIFY(bench.exchange());
    bench.set("b", 3.0);
    QVERIFY(bench.exchange());
    QCOMPARE(heater.far.receive(), QByteArray("B3\n"));
    bench.close();
    QVERIFY(bench.open());  // it may have been switched off meanwhile
    QCOMPARE(heater.far.receive(), QByteArray("A1\nB3\n"));
}

void tst_SerialLinesDriver::anInstrumentThatOnlyTakesLinesMayBeSilent()
{
    Instrument lamp("send.level = L{level}\\n\n");
    QCOMPARE(lamp.bench.errors() + lamp.bench.wireWrite("level"), QString());
    lamp.bench.set("level", 1.0);
    QVERIFY2(lamp.bench.open(), qPrintable(lamp.bench.errorString()));
    lamp.bench.advance(1min);
    QVERIFY2(lamp.bench.exchange(), qPrintable(lamp.bench.errorString()));
}

/// Nobody takes them, as behind a slow line: what is old waits no longer than the rest of a line.
void tst_SerialLinesDriver::aLineThatIsBusyGetsNoOldValues()
{
    Instrument lamp("send.level = {level:90}\\n\n");
    DriverBench &bench = lamp.bench;
    QCOMPARE(bench.errors() + bench.wireWrite("level") + bench.wireRead("@unsent"), QString());
    bench.set("level", 0.0);
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));
    int cycles = 0;
    for (; cycles < 100000 && !(bench.value("@unsent") >= 10.0); ++cycles) {
        bench.set("level", double(cycles));
        QVERIFY2(bench.exchange(), qPrintable(bench.errorString()));
    }
    QVERIFY(bench.value("@unsent") >= 10.0);
    QVERIFY(!bench.runner().isDelivered());
    bench.set("level", -1.0, true);
    QVERIFY(bench.exchange() && bench.exchange());
    QByteArray all;
    const QByteArray safe = QByteArray(88, ' ') + "-1\n";
    while (!all.endsWith(safe)) {
        const QByteArray more = lamp.far.receive();
        QVERIFY(!more.isEmpty());
        all += more;
        QVERIFY(bench.exchange());
    }
    const QList<QByteArray> lines = all.split('\n');
    for (int i = 0; i + 1 < lines.size(); ++i)
        QCOMPARE(lines.at(i).size(), 90);  // each of them is whole
    bench.advance(6s);
    for (cycles = 0; cycles < 100000 && bench.exchange(); ++cycles)
        bench.advance(1ms);
    QVERIFY2(bench.errorString().contains("takes no bytes; look at its adapter"), qPrintable(bench.errorString()));
}

void tst_SerialLinesDriver::linesThatNeedMoreThanTheirIntervalAreAWarning()
{
    const QByteArray keys = "baud = 1200\nsend.a = SETPOINT {a:.3}\\r\\n\n";
    const Instrument slow(keys + "interval = 50 ms\n");
    QCOMPARE(slow.bench.warnings().size(), 1);
    const QString warning = QPlcParseError::toString(slow.bench.warnings());
    QVERIFY2(warning.contains("take 100.0 ms at 1200 baud, so some are left out; make the interval longer"),
             qPrintable(warning));
    QVERIFY(Instrument(keys + "interval = 150 ms\n").bench.warnings().isEmpty());
    QVERIFY(Instrument(keys + "interval = 50 ms\nwrite = on-change\n").bench.warnings().isEmpty());
}

void tst_SerialLinesDriver::numbersHaveTheFormOfTheirLine_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<double>("value");
    QTest::addColumn<QByteArray>("line");
    QTest::newRow("as it is") << QByteArray("{a}") << 0.1 << QByteArray("0.1");
    QTest::newRow("large") << QByteArray("{a}") << -1.5e30 << QByteArray("-1.5e+30");
    QTest::newRow("whole") << QByteArray("V{a:.0};") << 2.6 << QByteArray("V3;");
    QTest::newRow("zeros") << QByteArray("{a:07.2}") << -3.14159 << QByteArray("-003.14");
    QTest::newRow("blanks") << QByteArray("{a:7.1}|") << 3.14159 << QByteArray("    3.1|");
    QTest::newRow("wider") << QByteArray("{a:03.0}") << 12345.0 << QByteArray("12345");
    QTest::newRow("nothing below zero") << QByteArray("{a:.2}") << -0.001 << QByteArray("0.00");
    QTest::newRow("braces") << QByteArray("{{{a}}}") << 5.0 << QByteArray("{5}");
    QTest::newRow("twice") << QByteArray("{a},{a:.1}") << 5.0 << QByteArray("5,5.0");
    QTest::newRow("no number") << QByteArray("{a}") << qQNaN() << QByteArray();
    QTest::newRow("endless") << QByteArray("{a}") << qInf() << QByteArray();
    QTest::newRow("too long") << QByteArray("{a:.1}") << 1e300 << QByteArray();
}

void tst_SerialLinesDriver::numbersHaveTheFormOfTheirLine()
{
    QFETCH(QByteArray, text);
    QFETCH(double, value);
    QFETCH(QByteArray, line);
    LineTemplate sent;
    QCOMPARE(LineTemplate::parse(text, &sent), QString());
    QCOMPARE(sent.names(), QStringList{"a"});
    QCOMPARE(sent.text({value}), line);
}

void tst_SerialLinesDriver::aSilentInstrumentIsNamed()
{
    Instrument scale(scalePattern);
    scale.bench.wireRead("weight");
    QVERIFY2(scale.bench.open(), qPrintable(scale.bench.errorString()));
    QVERIFY(scale.bench.exchange());
    scale.bench.advance(5001ms);
    QVERIFY(!scale.bench.exchange());
    QVERIFY2(scale.bench.errorString().contains("nothing comes from 'fake:scale'; look at the power"),
             qPrintable(scale.bench.errorString()));
}

void tst_SerialLinesDriver::linesThatDoNotMatchAreNamed()
{
    Instrument scale(scalePattern);
    scale.bench.wireRead("weight");
    QVERIFY2(scale.bench.open(), qPrintable(scale.bench.errorString()));
    for (int i = 0; i < 6; ++i) {
        QVERIFY(scale.say("ST,NT,+ 1.0lb\r\n"));
        scale.bench.advance(1s);
    }
    QVERIFY(!scale.bench.exchange());
    QVERIFY2(scale.bench.errorString().contains("for example 'ST,NT,+ 1.0lb'; look at 'baud'"),
             qPrintable(scale.bench.errorString()));
}

void tst_SerialLinesDriver::aLineThatIsUnpluggedIsOpenedAgain()
{
    Instrument scale(scalePattern);
    scale.bench.wireRead("weight");
    QVERIFY2(scale.bench.open(), qPrintable(scale.bench.errorString()));
    QVERIFY(scale.say("ST,GS,+  1kg\r\n"));
    scale.far.unplug();
    QVERIFY(!scale.bench.exchange());
    QVERIFY(!scale.bench.isFresh("weight"));
    QVERIFY(scale.far.plugIn("fake:scale"));
    QVERIFY2(scale.bench.open(), qPrintable(scale.bench.errorString()));
    QVERIFY(scale.say("ST,GS,+  2kg\r\n"));
    QCOMPARE(scale.bench.value("weight"), 2.0);
}

void tst_SerialLinesDriver::textsMayHaveControlCharacters_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<bool>("isRight");
    QTest::addColumn<QByteArray>("hex");
    QTest::newRow("plain") << "W?" << true << QByteArray("573f");
    QTest::newRow("ends") << "W\\r\\n\\t\\\\" << true << QByteArray("570d0a095c");
    QTest::newRow("a number") << "\\x02W\\xfF" << true << QByteArray("0257ff");
    QTest::newRow("cut off") << "W\\" << false << QByteArray();
    QTest::newRow("half a number") << "\\x2" << false << QByteArray();
    QTest::newRow("no number") << "\\xgg" << false << QByteArray();
    QTest::newRow("unknown") << "\\q" << false << QByteArray();
}

void tst_SerialLinesDriver::textsMayHaveControlCharacters()
{
    QFETCH(QString, text);
    QFETCH(bool, isRight);
    QByteArray bytes;
    QCOMPARE(bytesOfText(text, &bytes), isRight);
    if (isRight)
        QTEST(bytes.toHex(), "hex");
}

void tst_SerialLinesDriver::invalidKeysAreRefused_data()
{
    QTest::addColumn<QByteArray>("keys");
    QTest::addColumn<QString>("part");
    QTest::newRow("no pattern") << QByteArray() << "needs the key 'pattern'";
    QTest::newRow("no expression") << QByteArray("pattern = (?<a>[0-9]\n") << "is not a regular expression: missing";
    QTest::newRow("no name") << QByteArray("pattern = ([0-9]+)\n") << "give the group of each number a name";
    QTest::newRow("ask of nothing") << QByteArray("pattern = (?<a>.)\nask = \\z\ninterval = 1 s\n")
                                    << "has an unknown character behind";
    QTest::newRow("ask without a pace") << QByteArray("pattern = (?<a>.)\nask = W\n") << "add for example 'interval";
    QTest::newRow("too long a question") << "pattern = (?<a>.)\ninterval = 1 s\nask = " + QByteArray(257, 'a') + '\n'
                                         << "write at most 256";
    QTest::newRow("sent line without a value") << QByteArray("send.a = ON\\r\n") << "give each number a name";
    QTest::newRow("empty line") << QByteArray("send.a =\n") << "give each number a name";
    QTest::newRow("brace without a partner") << QByteArray("send.a = {a\n") << "a brace at byte 1 has no partner";
    QTest::newRow("closing brace") << QByteArray("send.a = {a}}\n") << "a brace at byte 4 has no partner";
    QTest::newRow("form of a number") << QByteArray("send.a = {a:x}\n") << "'a:x' is not a number of a line";
    QTest::newRow("too long a line") << "send.a = {a}" + QByteArray(256, 'x') + '\n' << "more than 256 bytes";
    QTest::newRow("escape") << QByteArray("send.a = {a}\\q\n") << "has an unknown character behind";
    QTest::newRow("when to write") << QByteArray("send.a = {a}\nwrite = never\n") << "never";
    QTest::newRow("format") << QByteArray("pattern = (?<a>.)\nformat = 8X1\n") << "'8X1' is not a format";
}

void tst_SerialLinesDriver::invalidKeysAreRefused()
{
    QFETCH(QByteArray, keys);
    QFETCH(QString, part);
    const Instrument instrument(keys);
    QVERIFY2(instrument.bench.errors().contains(part), qPrintable(instrument.bench.errors()));
    QCOMPARE(instrument.bench.errors().count('\n'), 0);
}

QTEST_GUILESS_MAIN(tst_SerialLinesDriver)
#include "tst_SerialLinesDriver.moc"
