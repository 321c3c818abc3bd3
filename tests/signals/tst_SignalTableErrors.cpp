// SPDX-License-Identifier: Apache-2.0
#include "QPlcSignalTable.h"

#include <QtTest/QtTest>

#include <random>

class tst_SignalTableErrors : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void badTextIsRefusedWithPlaceAndRemedy_data();
    void badTextIsRefusedWithPlaceAndRemedy();
    void allErrorsAreReportedInTheOrderOfTheFile();
    void oneMistakeIsOneError_data();
    void oneMistakeIsOneError();
    void errorsBehindTheHundredthAreCounted();
    void longestLineIsRead();
    void errorTextOmitsAnUnknownPosition();
    void everyReadableTableCanBeWritten();
};

namespace {

QVector<QPlcParseError> errorsOf(const QByteArray &text)
{
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromIni(text, &errors, QStringLiteral("t.ini"));
    return table.isEmpty() ? errors : QVector<QPlcParseError>();
}

}  // namespace

void tst_SignalTableErrors::badTextIsRefusedWithPlaceAndRemedy_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("error");  // how the first one begins
    const auto row = [](const char *name, const QByteArray &text, const char *error) {
        QTest::newRow(name) << text << QString::fromUtf8(error);
    };
    const QByteArray real = "[a]\ntype = Real\n";

    row("empty", "", "t.ini: the table has no signal; write at least");
    row("only comments", "; [a]\n; type = Real\n", "t.ini: the table has no signal");
    row("missing type", "[a]\nunit = m\n", "t.ini:1:2: the signal 'a' has no type; write 'type = Real'");
    row("empty type", "[a]\ntype =\n", "t.ini:2:7: unknown type ''");
    row("unknown type", "[a]\ntype = Reall\n", "t.ini:2:8: unknown type 'Reall'; did you mean 'Real'");
    row("type in wrong case", "[a]\ntype = real\n", "t.ini:2:8: unknown type 'real'; did you mean 'Real'?");
    row("type with blank", "[a]\ntype = real 32\n", "t.ini:2:8: unknown type 'real 32'; did you mean 'Real32'?");
    row("huge array", "[a]\ntype = Real64[181]\n", "t.ini:2:8: type 'Real64[181]' is too large");
    row("unknown key", real + "units = m\n", "t.ini:3:1: unknown key 'units'; did you mean 'unit'?");
    row("key in wrong case", real + " Unit = m\n", "t.ini:3:2: unknown key 'Unit'; did you mean 'unit'?");
    row("strange key", real + "colour = red\n", "t.ini:3:1: unknown key 'colour'; the keys are type, unit");
    row("duplicate signal", real + "[b]\ntype=Int\n[a]\ntype=Int\n",
        "t.ini:5:2: duplicate signal 'a' (first at line 1); rename or remove one");
    row("duplicate key", real + "type = Int\n", "t.ini:3:1: duplicate key 'type' (first at line 2); remove one");
    row("key before section", "type = Real\n" + real, "t.ini:1:1: the key 'type' stands before the first signal");
    row("no key", real + " = 5\n", "t.ini:3:2: the key before '=' is missing");
    row("no equals sign", real + "unit: m\n", "t.ini:3:1: 'unit: m' is neither [name] nor key = value");
    row("open bracket", "[a\ntype = Real\n", "t.ini:1:3: ']' is missing");
    row("stray characters", "[a] b ; c\ntype = Real\n", "t.ini:1:5: stray characters 'b ; c' behind ']'");
    row("two brackets", "[a]]\ntype = Real\n", "t.ini:1:4: stray characters ']'");
    row("no name", "[]\ntype = Real\n", "t.ini:1:2: the signal has no name");
    row("name with blanks", "[ a ]\ntype = Real\n", "t.ini:1:2: ' a ' is not a valid signal name");
    row("name with a digit first", "[1a]\ntype = Real\n", "t.ini:1:2: '1a' is not a valid signal name");
    row("name with a slash", "[a/b]\ntype = Real\n", "t.ini:1:2: 'a/b' is not a valid signal name");
    row("name with an umlaut", "[H\xC3\xB6he]\ntype = Real\n", "t.ini:1:2: 'Höhe' is not a valid signal name");
    row("name of 64", '[' + QByteArray(64, 'x') + "]\ntype = Real\n", "t.ini:1:2: the signal name 'xxx");
    row("bad min", real + "min = 1x\n", "t.ini:3:7: '1x' is not a number");
    row("empty max", real + "max =\n", "t.ini:3:6: '' is not a number");
    row("decimal comma", real + "max = 1,5\n", "t.ini:3:7: '1,5' holds 2 values, Real32 needs one; the decimal point");
    row("nan as limit", real + "max = nan\n", "t.ini:3:7: nan is not a limit");
    row("min above max", real + "min = 2\nmax = 1\ninitial = 1\n", "t.ini:4:7: min 2 is greater than max 1; swap them");
    row("initial below min", real + "min = 1\ninitial = 0.5\n",
        "t.ini:4:11: the initial value '0.5' is outside of min and max; give 'initial =' a value of at least 1");
    row("zero below min", real + "min = 1\nmax = 2\n", "t.ini:1:2: the initial value '0' is outside of min and max");
    row("nan between limits", real + "max = 1\ninitial = nan\n", "t.ini:4:11: the initial value 'nan' is outside");
    row("safe above max", "[a]\ntype=RealTriple\nmax = 1\nsafe = 0, 0, 2\n",
        "t.ini:4:8: the safe value '0, 0, 2' is outside");
    row("safe not finite", real + "safe = nan\n", "t.ini:3:8: the safe value 'nan' is not finite");
    row("unsigned limits", "[a]\ntype = UInt64\nmax = 18446744073709551614\nsafe = 18446744073709551615\n",
        "t.ini:4:8: the safe value '18446744073709551615' is outside");
    row("initial of another type", "[a]\ntype = Int8\ninitial = 1.5\n", "t.ini:3:11: '1.5' is not an integer");
    row("initial of another size", "[a]\ntype = RealTriple\ninitial = 1, 2\n", "t.ini:3:11: '1, 2' holds 2 values");
    row("text too long", "[a]\ntype = String(3)\ninitial = kite\n",
        "t.ini:3:11: 'kite' has 4 bytes of UTF-8, String(3)");
    row("min of a text", "[a]\ntype = String\nmin = a\n", "t.ini:3:7: String(64) cannot be limited by");
    row("min of a time", "[a]\ntype = DateTime\nmin = 2026-01-31T12:00:00Z\n",
        "t.ini:3:7: DateTime cannot be limited by");
    row("negative hold", real + "hold = -1\n", "t.ini:3:8: a value cannot be held for -1 cycles");
    row("hold in seconds", real + "hold = 0.1 s\n", "t.ini:3:8: '0.1 s' is not an integer");
    row("empty writer", real + "writer =\n", "t.ini:3:9: '' is not a valid node name; write 1 ... 64 characters");
    row("writer missing", real + "writer = A > > B\n", "t.ini:3:10: '' is not a valid node name");
    row("writer twice", real + "writer = A > B > A\n",
        "t.ini:3:10: the node 'A' is named twice; name each writer once");
    row("long writer", real + "writer = " + QByteArray(65, 'x') + '\n', "t.ini:3:10: 'xxx");
    row("nan forbidden", real + "nan = no\n", "t.ini:3:7: 'nan' cannot be 'no'; write 'nan = allowed'");
    row("nan of an integer", "[a]\ntype = Int\nnan = allowed\n", "t.ini:3:7: Int32 cannot be NaN; remove 'nan ='");
    row("slope without its unit", real + "slope = 5\n",
        "t.ini:3:9: '5' is not a slope; write a positive number, as in 'slope = 5 per second'");
    row("slope of zero", real + "slope = 0 per second\n", "t.ini:3:9: '0 per second' is not a slope");
    row("negative slope", real + "slope = -1 per second\n", "t.ini:3:9: '-1 per second' is not a slope");
    row("endless slope", real + "slope = inf per second\n", "t.ini:3:9: 'inf per second' is not a slope");
    row("volatile that is not yes", real + "volatile = no\n",
        "t.ini:3:12: 'volatile' cannot be 'no'; write 'volatile = yes', or remove the line");
    row("slope of an integer", "[a]\ntype = Int\nslope = 5 per second\n",
        "t.ini:3:9: Int32 cannot change gradually; remove 'slope ='");
    row("open quotation", real + "unit = \"m\n", "t.ini:3:8: the quotation is not closed");
    row("behind quotation", real + "unit = \"m\" s\n", "t.ini:3:12: stray characters 's' behind the quotation");
    row("wrong escape", real + "unit = \"\\m\"\n", "t.ini:3:9: '\\' must stand before n, r, t");
    row("line break in unit", real + "unit = \"\\n\"\n", "t.ini:3:8: control character 0x0a");
    row("Latin-1", real + "unit = \xB0\n", "t.ini:3:8: byte 0xB0 is not UTF-8; save the file as UTF-8");
    row("Latin-1 comment", "; H\xF6he\n" + real, "t.ini:1:4: byte 0xF6 is not UTF-8");
    row("UTF-16", QByteArray("\xFF\xFE[\0a\0", 6), "t.ini:1:1: the file is UTF-16; save it as UTF-8");
    row("zero byte", real + QByteArray("[b\0]\n", 5), "t.ini:3:3: byte 0x00: this is not text");
    row("control character", real + "unit = \x1B\n", "t.ini:3:8: control character 0x1B");
    row("carriage returns alone", "[a]\rtype = Real\r", "t.ini:1:4: a carriage return without line feed");
    row("long line", real + "; " + QByteArray(4095, 'x') + '\n',
        "t.ini:3:1: the line has 4097 bytes; shorten it to at most 4096");
    row("a megabyte", QByteArray(1 << 20, '['), "t.ini:1:1: the line has 1048576 bytes");
    row("long list",
        "[a]\ntype = Real[360]\ninitial = 1e9" + QByteArray(",1e9").repeated(359) + "\nsafe = 1e9"
            + QByteArray(",123456e9").repeated(359) + '\n',
        "t.ini:4:8: its line in the table has");
    row("program",
        QByteArray("\x7F"
                   "ELF\x02\x01\x01\0\0\0",
                   10),
        "t.ini:1:8: byte 0x00: this is not text");
}

void tst_SignalTableErrors::badTextIsRefusedWithPlaceAndRemedy()
{
    QFETCH(QByteArray, text);
    QFETCH(QString, error);
    const QVector<QPlcParseError> errors = errorsOf(text);
    QVERIFY(!errors.isEmpty());
    QVERIFY2(errors.first().toString().startsWith(error), qPrintable(QPlcParseError::toString(errors)));
    QVERIFY(QPlcSignalTable::fromIni(text).isEmpty());
}

void tst_SignalTableErrors::allErrorsAreReportedInTheOrderOfTheFile()
{
    const QVector<QPlcParseError> errors
        = errorsOf("unit = m\n[a]\nunits = m\n[b]\nmin = 3\ntype = Real\nmax = x\n[b\n[c]\ntype = Rael\n"
                   "nonsense\n[a]\ntype = Int8\nsafe = 200\n");
    QStringList places;
    for (const QPlcParseError &error : errors)
        places << QStringLiteral("%1:%2").arg(error.line).arg(error.column);
    QCOMPARE(places.join(QLatin1Char(' ')), QStringLiteral("1:1 2:2 3:1 4:2 7:7 8:3 10:8 11:1 12:2 14:8"));
}

void tst_SignalTableErrors::oneMistakeIsOneError_data()
{
    QTest::addColumn<QByteArray>("text");
    for (const char *text :
         {"[a]\ntyp = Real\n", "[a]\ntype: Real\n", "[a\ntype = Real\n", "[a\n", "[1]\ntype = Real\nmin = 0\n",
          "[a]\ntype = \"Real\nmin = 2\n", "[a]\ntype = Rael\ninitial = x\nhold = -1x\n",
          "[a]\ntype = Real\nmin = 1\ninitial = 2x\n", "[a]\ntype = Real\nmin = x\nmax = 1\n", "[]\ntype = Int\n"})
        QTest::newRow(text) << QByteArray(text);
}

void tst_SignalTableErrors::oneMistakeIsOneError()
{
    QFETCH(QByteArray, text);
    const QVector<QPlcParseError> errors = errorsOf(text);
    QVERIFY2(errors.size() == 1, qPrintable(QPlcParseError::toString(errors)));
}

void tst_SignalTableErrors::errorsBehindTheHundredthAreCounted()
{
    QByteArray text;
    for (int i = 0; i < 50000; ++i)
        text += "[signal" + QByteArray::number(i) + "]\ntyep = Real\n";
    const QVector<QPlcParseError> errors = errorsOf(text);
    QCOMPARE(errors.size(), 101);
    QCOMPARE(errors.at(99).toString(), QStringLiteral("t.ini:200:1: unknown key 'tyep'; did you mean 'type'?"));
    QCOMPARE(errors.at(100).toString(), QStringLiteral("t.ini: and 49900 more errors"));
    QCOMPARE(errorsOf(text.left(text.indexOf("[signal100]"))).size(), 100);
}

void tst_SignalTableErrors::longestLineIsRead()
{
    const QByteArray line = "description = " + QByteArray(4096 - 14, 'x');
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromIni("[a]\ntype = Real\n" + line + "\r\n", &errors);
    QVERIFY2(errors.isEmpty(), qPrintable(QPlcParseError::toString(errors)));
    QVERIFY(table.toIni().endsWith(line + '\n'));
}

void tst_SignalTableErrors::errorTextOmitsAnUnknownPosition()
{
    QPlcParseError error;
    error.message = QStringLiteral("wrong");
    QCOMPARE(error.toString(), QStringLiteral("wrong"));
    error.column = 7;
    QCOMPARE(error.toString(), QStringLiteral("wrong"));
    error.line = 3;
    QCOMPARE(error.toString(), QStringLiteral("3:7: wrong"));
    error.file = QStringLiteral("a.ini");
    QCOMPARE(error.toString(), QStringLiteral("a.ini:3:7: wrong"));
    error.column = 0;
    QCOMPARE(error.toString(), QStringLiteral("a.ini:3: wrong"));
    QCOMPARE(QPlcParseError::toString({error, error}), QStringLiteral("a.ini:3: wrong\na.ini:3: wrong"));
    QCOMPARE(QPlcParseError::toString(QVector<QPlcParseError>()), QString());
}

// Random pieces of tables and garbage: never a crash, and what is read can be written and read
// again.
void tst_SignalTableErrors::everyReadableTableCanBeWritten()
{
    const QByteArray pieces[] = {"[a]\n",
                                 "[b.c]\r\n",
                                 "type = Real\n",
                                 "type = String(4)\n",
                                 "type = Int8[2]\n",
                                 "min = -1\n",
                                 "max=2\n",
                                 "initial = 1\n",
                                 "safe = 1, 2\n",
                                 "hold = 2\n",
                                 "unit = \"",
                                 "description = \\",
                                 "\n",
                                 "\"",
                                 ";",
                                 "]",
                                 "[",
                                 "=",
                                 " ",
                                 "\xC3\xA4",
                                 "\xC3",
                                 QByteArray(1, '\0'),
                                 "\xEF\xBB\xBF",
                                 "1e9",
                                 "\\n\"\n"};
    std::mt19937 random(7);
    int tables = 0;
    for (int run = 0; run < 20000; ++run) {
        QByteArray text = run % 2 == 0 ? QByteArray("[z]\ntype = Real\n") : QByteArray();
        for (int length = int(random() % 6); length > 0; --length)
            text += pieces[random() % std::size(pieces)];
        QVector<QPlcParseError> errors;
        const QPlcSignalTable table = QPlcSignalTable::fromIni(text, &errors);
        QCOMPARE(table.isEmpty(), !errors.isEmpty());
        if (table.isEmpty())
            continue;
        ++tables;
        const QPlcSignalTable again = QPlcSignalTable::fromIni(table.toIni(), &errors);
        QVERIFY2(errors.isEmpty(), text.constData());
        QCOMPARE(again.toIni(), table.toIni());
    }
    QVERIFY(tables > 100);
}

QTEST_APPLESS_MAIN(tst_SignalTableErrors)
#include "tst_SignalTableErrors.moc"
