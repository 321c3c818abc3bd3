// SPDX-License-Identifier: Apache-2.0
#include "signals/IniParser.h"
#include "signals/Utf8.h"

#include <QtTest/QtTest>

using qplc::IniItem;
using qplc::IniParser;

class tst_IniParser : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void positionsCountFromOneInCharacters();
    void blankLinesAndCommentsAreIgnored_data();
    void blankLinesAndCommentsAreIgnored();
    void valueEndsAtTheComment_data();
    void valueEndsAtTheComment();
    void valueTextIsReadBack_data();
    void valueTextIsReadBack();
    void wellFormedUtf8IsTheShortestForm_data();
    void wellFormedUtf8IsTheShortestForm();
};

void tst_IniParser::positionsCountFromOneInCharacters()
{
    IniParser parser("\xEF\xBB\xBF[wind]\r\n\r\n  description\t=  H\xC3\xB6he ; m\r\n h\xC3\xB6 = x\n");
    IniItem item = parser.next();
    QCOMPARE(item.kind, IniItem::Section);
    QCOMPARE(item.name, QStringLiteral("wind"));
    QCOMPARE(item.line, 1);
    QCOMPARE(item.column, 2);
    item = parser.next();
    QCOMPARE(item.kind, IniItem::Entry);
    QCOMPARE(item.name, QStringLiteral("description"));
    QCOMPARE(item.value, QString::fromUtf8("H\xC3\xB6he"));
    QCOMPARE(item.line, 3);
    QCOMPARE(item.column, 3);
    QCOMPARE(item.valueColumn, 18);
    item = parser.next();
    QCOMPARE(item.line, 4);
    QCOMPARE(item.valueColumn, 7);
    QCOMPARE(parser.next().kind, IniItem::End);
    QCOMPARE(parser.next().kind, IniItem::End);
}

void tst_IniParser::blankLinesAndCommentsAreIgnored_data()
{
    QTest::addColumn<QByteArray>("text");
    for (const char *text : {"", "\n", "\r\n", " \t ", "; [a]", "# a = b", "  ; c\n\n  # d\r\n", "\xEF\xBB\xBF", ";"})
        QTest::newRow(text) << QByteArray(text);
}

void tst_IniParser::blankLinesAndCommentsAreIgnored()
{
    QFETCH(QByteArray, text);
    QCOMPARE(IniParser(text).next().kind, IniItem::End);
}

void tst_IniParser::valueEndsAtTheComment_data()
{
    QTest::addColumn<QString>("value");
    const auto row = [](const char *line, const char *value) { QTest::newRow(line) << QString::fromLatin1(value); };
    row("a = 1", "1");
    row("a=1", "1");
    row("a = 1 ; one", "1");
    row("a = 1\t; one", "1");
    row("a = 1;2", "1;2");
    row("a = 1;2 ;3", "1;2");
    row("a = b # c", "b # c");
    row("a = b = c", "b = c");
    row("a = [b]", "[b]");
    row("a =", "");
    row("a = ; nothing", "");
    row("a =; nothing", "");
    row("a = \"1 ; one\"", "1 ; one");
    row("a = \" b \" ; c", " b ");
    row("a = \"\"", "");
    row("a = \"\\n\\r\\t\\\"\\\\\"", "\n\r\t\"\\");
    row("a = b\"c\"", "b\"c\"");
    row("a = b\\n", "b\\n");
}

void tst_IniParser::valueEndsAtTheComment()
{
    QFETCH(QString, value);
    const IniItem item = IniParser(QTest::currentDataTag()).next();
    QCOMPARE(item.kind, IniItem::Entry);
    QCOMPARE(item.error, QString());
    QCOMPARE(item.name, QStringLiteral("a"));
    QCOMPARE(item.value, value);
}

void tst_IniParser::valueTextIsReadBack_data()
{
    QTest::addColumn<QString>("value");
    for (const char *value :
         {"",      "1",    "a b",  " a",    "a ", "\ta", ";",        ";a", "a;b", "a ;b", "a\t;b",      "\"",
          "\"a\"", "a\"b", "a\nb", "a\r\n", "\\", "\\n", "a ; \\\"", "#",  "[a]", "=",    "H\xC3\xB6he"})
        QTest::newRow(value) << QString::fromUtf8(value);
}

void tst_IniParser::valueTextIsReadBack()
{
    QFETCH(QString, value);
    const IniItem item = IniParser("a = " + IniParser::valueText(value).toUtf8()).next();
    QCOMPARE(item.error, QString());
    QCOMPARE(item.value, value);
}

void tst_IniParser::wellFormedUtf8IsTheShortestForm_data()
{
    QTest::addColumn<int>("invalid");
    const auto row = [](const char *hex, int invalid) { QTest::newRow(hex) << invalid; };
    row("", -1);
    row("41c3a4e282acf09f9a80", -1);
    row("7fc280dfbf", -1);
    row("e0a080ed9fbfee8080efbfbf", -1);
    row("f0908080f48fbfbf", -1);
    row("4180", 1);    // continues nothing
    row("41c3", 1);    // ends too early
    row("41c328", 1);  // does not continue
    row("e28241", 0);
    row("c080", 0);  // overlong
    row("c1bf", 0);
    row("e09fbf", 0);
    row("f08fbfbf", 0);
    row("eda080", 0);    // surrogate
    row("f4908080", 0);  // above U+10FFFF
    row("f5808080", 0);
    row("ff", 0);
}

void tst_IniParser::wellFormedUtf8IsTheShortestForm()
{
    QFETCH(int, invalid);
    const QByteArray bytes = QByteArray::fromHex(QTest::currentDataTag());
    QCOMPARE(qplc::firstInvalidUtf8(bytes.constData(), bytes.size()), invalid);
}

QTEST_APPLESS_MAIN(tst_IniParser)
#include "tst_IniParser.moc"
