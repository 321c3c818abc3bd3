// SPDX-License-Identifier: Apache-2.0
#include "FarEnd.h"
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
