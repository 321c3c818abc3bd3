// SPDX-License-Identifier: Apache-2.0
#include "hardware/can/DbcFile.h"

#include <QtTest/QtTest>

using namespace qplc;

class tst_DbcErrors : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void errorNamesPlaceAndRemedy_data();
    void errorNamesPlaceAndRemedy();
    void everyErrorIsReported();
    void numberOfReportedErrorsIsLimited();
    void missingFileIsNamed();
    void tooLargeFileIsRefused();
    void truncatedTextGivesErrorsOrMessages();
};

void tst_DbcErrors::errorNamesPlaceAndRemedy_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("error");  // as it begins
    const auto row = [](const char *name, const QByteArray &text, const char *error) {
        QTest::newRow(name) << text << QStringLiteral("a.dbc") + QString::fromUtf8(error);
    };
    const QByteArray head = "BO_ 1 A: 8 X\n";
    row("empty", "", ": there is no message (BO_)");
    row("only comments", "VERSION \"\"\nBS_:\nBU_: X\n", ": there is no message (BO_)");
    row("zero byte", QByteArray("BO_\0", 4), ": byte 0x00: this is not a text");
    row("another format", "<?xml version=\"1.0\"?>\n", ":1:1: '<' does not begin a statement of a DBC file");
    row("unknown word", "BO 1 A: 8 X\n", ":1:1: 'BO' does not begin a statement");
    row("no id", "BO_ A: 8 X\n", ":1:5: 'A' instead of the id of the message");
    row("id of 12 bits", "BO_ 2048 A: 8 X\n", ":1:5: the id 2048 is not valid on a CAN bus; use 0 ... 2047");
    row("id of 30 bits", "BO_ 2684354560 A: 8 X\n", ":1:5: the id 2684354560 is not valid on a CAN bus");
    row("negative id", "BO_ -1 A: 8 X\n", ":1:5: '-1' instead of the id");
    row("no name", "BO_ 1 : 8 X\n", ":1:7: ':' instead of the name of the message");
    row("no colon", "BO_ 1 A 8 X\n", ":1:9: '8' instead of ':' behind the name of the message");
    row("no size", "BO_ 1 A: X\n", ":1:10: 'X' instead of the size of the message");
    row("size too large", "BO_ 1 A: 70000 X\n",
        ":1:10: the size of the message in bytes is 70000; it has to be 0 ... 65535");
    row("no sender", "BO_ 1 A: 8\n", ":2:1: the end of the file instead of the sender");
    row("same id", head + "BO_ 1 B: 8 X\n", ":2:5: message 'B' has the id 0x1 of message 'A'");
    row("same name", head + "BO_ 2 A: 8 X\n", ":2:5: there are two messages 'A'");
    row("signal without message", "SG_ S : 0|8@1+ (1,0) [0|0] \"\" X\n", ":1:5: SG_ 'S' belongs to no message");
    row("no name of signal", head + " SG_ : 0|8@1+ (1,0) [0|0] \"\" X\n",
        ":2:6: ':' instead of the name of the signal");
    row("strange role", head + " SG_ S n1 : 0|8@1+ (1,0) [0|0] \"\" X\n", ":2:8: 'n1' behind the name of signal 'S'");
    row("role without number", head + " SG_ S m : 0|8@1+ (1,0) [0|0] \"\" X\n",
        ":2:8: 'm' behind the name of signal 'S'");
    row("start too large", head + " SG_ S : 14280|8@1+ (1,0) [0|0] \"\" X\n",
        ":2:10: the start bit of the signal is 14280; it has to be 0 ... 14279");
    row("range of a signal that is no multiplexor",
        head + " SG_ S : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ T m0 : 8|8@1+ (1,0) [0|0] \"\" X\nSG_MUL_VAL_ 1 T S 0-0;\n",
        ":4:17: signal 'S' of message 'A' is not a multiplexor (M)");
    row("range backwards",
        head + " SG_ S M : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ T m0 : 8|8@1+ (1,0) [0|0] \"\" X\nSG_MUL_VAL_ 1 T S 3-2;\n",
        ":4:19: the range 3-2 is empty");
    row("range without an end",
        head + " SG_ S M : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ T m0 : 8|8@1+ (1,0) [0|0] \"\" X\nSG_MUL_VAL_ 1 T S 3;\n",
        ":4:20: ';' instead of the last value of the range");
    row("range of no multiplexor", head + " SG_ T m0 : 8|8@1+ (1,0) [0|0] \"\" X\nSG_MUL_VAL_ 1 T S 3-3;\n",
        ":3:17: message 'A' has no signal 'S'");
    row("length 0", head + " SG_ S : 0|0@1+ (1,0) [0|0] \"\" X\n",
        ":2:12: the length of the signal in bits is 0; it has to be 1 ... 64");
    row("length 65", head + " SG_ S : 0|65@1+ (1,0) [0|0] \"\" X\n", ":2:12: the length of the signal in bits is 65");
    row("no bar", head + " SG_ S : 0 8@1+ (1,0) [0|0] \"\" X\n", ":2:12: '8' instead of '|' behind the start bit");
    row("byte order 2", head + " SG_ S : 0|8@2+ (1,0) [0|0] \"\" X\n", ":2:14: the byte order (1: little endian");
    row("no sign", head + " SG_ S : 0|8@1 (1,0) [0|0] \"\" X\n", ":2:16: '(' instead of '+' (without sign) or '-'");
    row("factor 0", head + " SG_ S : 0|8@1+ (0,0) [0|0] \"\" X\n", ":2:18: the factor is 0");
    row("factor no number", head + " SG_ S : 0|8@1+ (x,0) [0|0] \"\" X\n", ":2:18: 'x' instead of the factor");
    row("factor too large", head + " SG_ S : 0|8@1+ (1e999,0) [0|0] \"\" X\n", ":2:18: '1e999' instead of the factor");
    row("no offset", head + " SG_ S : 0|8@1+ (1) [0|0] \"\" X\n",
        ":2:19: ')' instead of ',' between factor and offset");
    row("range not closed", head + " SG_ S : 0|8@1+ (1,0) [0|0 \"\" X\n",
        ":2:28: the text \"\" instead of ']' behind the maximum");
    row("beyond the message", head + " SG_ S : 60|8@1+ (1,0) [0|0] \"\" X\n",
        ":2:6: signal 'S' has 8 bits from bit 60 on (Intel) and ends in byte 8, but message 'A' has only 8 bytes");
    row("beyond, Motorola", head + " SG_ S : 59|8@0+ (1,0) [0|0] \"\" X\n",
        ":2:6: signal 'S' has 8 bits from bit 59 on (Motorola) and ends in byte 8");
    row("two signals", head + " SG_ S : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ S : 8|8@1+ (1,0) [0|0] \"\" X\n",
        ":3:6: message 'A' has two signals 'S'");
    row("text without end", head + "CM_ \"what\n\nis this;\n", ":2:5: a text without a closing '\"' instead of ';'");
    row("no semicolon", head + "CM_ \"what\"\n",
        ":3:1: the end of the file instead of ';' at the end of the statement");
    row("float of 16 bits", head + " SG_ S : 0|16@1+ (1,0) [0|0] \"\" X\nSIG_VALTYPE_ 1 S : 1;\n",
        ":3:16: signal 'S' has 16 bits; a float has 32");
    row("values of nobody", head + "VAL_ 2 S 0 \"off\" ;\n", ":2:6: there is no message with the id 2");
    row("values of no signal", head + "VAL_ 1 S 0 \"off\" ;\n", ":2:8: message 'A' has no signal 'S'");
    row("value without name", head + " SG_ S : 0|8@1+ (1,0) [0|0] \"\" X\nVAL_ 1 S 0 1 \"on\";\n",
        ":3:12: '1' instead of the name of the value");
    row("cycle time", head + "BA_ \"GenMsgCycleTime\" BO_ 1 -5;\n", ":2:29: the cycle time '-5' of message 'A'");
    row("umlauts count as one", head + "CM_ \"\xC3\xA4\xC3\xB6\" x\n", ":3:1: the end of the file instead of ';'");
}

void tst_DbcErrors::errorNamesPlaceAndRemedy()
{
    QFETCH(QByteArray, text);
    QFETCH(QString, error);
    QVector<QPlcParseError> errors;
    QVERIFY(DbcFile::fromText(text, QStringLiteral("a.dbc"), &errors).isEmpty());
    QVERIFY(!errors.isEmpty());
    QVERIFY2(errors.constFirst().toString().startsWith(error), qPrintable(errors.constFirst().toString()));
    QCOMPARE(errors.size(), 1);
}

void tst_DbcErrors::everyErrorIsReported()
{
    QVector<QPlcParseError> errors;
    DbcFile::fromText("BO_ x\nBO_ 1 A: 8 X\n SG_ S 0\n SG_ T : 0|8@1+ (1,0) [0|0] \"\" X\nBO_ 1 B: 8 X\n", QString(),
                      &errors);
    QCOMPARE(errors.size(), 3);
    QCOMPARE(errors.at(0).line, 1);
    QCOMPARE(errors.at(1).line, 3);
    QCOMPARE(errors.at(2).line, 5);
}

void tst_DbcErrors::numberOfReportedErrorsIsLimited()
{
    QVector<QPlcParseError> errors;
    DbcFile::fromText(QByteArray("BO_ x\n").repeated(1000), QString(), &errors);
    QCOMPARE(errors.size(), DbcFile::MaximumErrors);
}

void tst_DbcErrors::missingFileIsNamed()
{
    QVector<QPlcParseError> errors;
    DbcFile::fromFile(QStringLiteral("/no/such/drive.dbc"), &errors);
    QCOMPARE(errors.size(), 1);
    QVERIFY(errors.at(0).toString().startsWith(QLatin1String("/no/such/drive.dbc: cannot read the DBC file")));
}

void tst_DbcErrors::tooLargeFileIsRefused()
{
    QVector<QPlcParseError> errors;
    DbcFile::fromText(QByteArray(DbcFile::MaximumSize + 1, ' '), QString(), &errors);
    QCOMPARE(errors.size(), 1);
    QVERIFY(errors.at(0).message.contains(QLatin1String("33554433 bytes")));
}

void tst_DbcErrors::truncatedTextGivesErrorsOrMessages()
{
    const QByteArray text
        = "VERSION \"\"\nNS_ :\n CM_\nBS_:\nBU_: X\nBO_ 1 A: 8 X\n SG_ P M : 0|8@1+ (1,0) [0|0] \"\" X\n"
          " SG_ Q m2 : 8|32@1- (0.5,-1) [0|1] \"m\" X\nCM_ \"c\";\nBA_ \"GenMsgCycleTime\" BO_ 1 10;\n"
          "VAL_ 1 P 1 \"a\" 2 \"b\";\nSIG_VALTYPE_ 1 Q : 1;\nSG_MUL_VAL_ 1 Q P 2-2;\n";
    for (int size = 0; size <= text.size(); ++size) {
        QVector<QPlcParseError> errors;
        const DbcFile file = DbcFile::fromText(text.left(size), QString(), &errors);
        QCOMPARE(file.isEmpty(), !errors.isEmpty());
    }
}

QTEST_APPLESS_MAIN(tst_DbcErrors)
#include "tst_DbcErrors.moc"
