// SPDX-License-Identifier: Apache-2.0
#include "QPlcSignalTable.h"

#include <QtTest/QtTest>

class tst_QPlcValueNames : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void namesAreFoundByValueAndValuesByName();
    void textIsReadBackAsTheSameNames();
    void wrongTextIsRefusedWithARemedy_data();
    void wrongTextIsRefusedWithARemedy();
    void tableRefusesNamesThatNoValueCanHave_data();
    void tableRefusesNamesThatNoValueCanHave();
    void tableKeepsNamesWhenItIsWrittenAndRead();
    void unknownFieldsOfANewerTableAreIgnored();
    void valuesOfASignalAreWrittenAndReadByName();
    void valuesWithoutANameAreNumbers();
};

namespace {

QPlcSignalDefinition phaseSignal()
{
    return QPlcSignalTable::fromIni("[phase]\ntype = Int8\nvalues = 0: Off, 1: Reel out, 2: ReelIn\n").at(0);
}

}  // namespace

void tst_QPlcValueNames::namesAreFoundByValueAndValuesByName()
{
    QString error = QStringLiteral("old");
    const QPlcValueNames names
        = QPlcValueNames::fromText(QStringLiteral(" 2 : ReelIn,0:Off , -9223372036854775808: Least"), &error);
    QCOMPARE(error, QString());
    QCOMPARE(names.size(), 3);
    QCOMPARE(names.begin()->name, QStringLiteral("Least"));
    QCOMPARE(names.nameOf(2), QStringLiteral("ReelIn"));
    QCOMPARE(names.nameOf(1), QString());
    QCOMPARE(names.valueOf(QStringLiteral("Off")).value_or(-1), 0);
    QCOMPARE(names.valueOf(QStringLiteral("reelin")).value_or(-1), 2);
    QVERIFY(!names.valueOf(QStringLiteral("Reel")));
    QVERIFY(QPlcValueNames().isEmpty());
    QCOMPARE(QPlcValueNames().nameOf(0), QString());
    const QPlcValueNames cases = QPlcValueNames::fromText(QStringLiteral("0: on, 1: On"));
    QCOMPARE(cases.valueOf(QStringLiteral("On")).value_or(-1), 1);
}

void tst_QPlcValueNames::textIsReadBackAsTheSameNames()
{
    const QPlcValueNames names = QPlcValueNames::fromText(QStringLiteral("1:Reel out ,0: Off"));
    QCOMPARE(names.toText(), QStringLiteral("0: Off, 1: Reel out"));
    QVERIFY(QPlcValueNames::fromText(names.toText()) == names);
    QVERIFY(names != QPlcValueNames());
}

void tst_QPlcValueNames::wrongTextIsRefusedWithARemedy_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("error");
    const auto row = [](const char *name, const char *text, const char *error) {
        QTest::newRow(name) << QString::fromUtf8(text) << QString::fromUtf8(error);
    };
    row("empty", "", "'' does not name a value; write names as '0: Off, 1: On'");
    row("no value", "0: Off, On", "'On' does not name a value");
    row("comma at the end", "0: Off,", "'' does not name a value");
    row("fraction", "0.5: Half", "'0.5' is not an integer; only integers have names");
    row("words", "true: Yes", "'true' is not an integer");
    row("too large", "9223372036854775808: Most", "'9223372036854775808' is not an integer");
    row("no name", "0: , 1: On", "the name '' has 0 characters; give it 1 ... 63");
    row("two colons", "0: Off 1: On", "a name cannot contain ':' as in 'Off 1: On'; write ','");
    row("number as name", "0: 1", "the name '1' is a number; give it a letter");
    row("value twice", "0: Off, 0: On", "the value 0 has two names, 'Off' and 'On'; remove one");
    row("name twice", "0: Off, 1: Off", "the name 'Off' stands for 0 and for 1; rename one");
    row("long name", "0: xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx", "the name 'xxx");
}

void tst_QPlcValueNames::wrongTextIsRefusedWithARemedy()
{
    QFETCH(QString, text);
    QFETCH(QString, error);
    QString told;
    QVERIFY(QPlcValueNames::fromText(text, &told).isEmpty());
    QVERIFY2(told.startsWith(error), qPrintable(told));
    QVector<QPlcParseError> errors;
    const QByteArray table = "[a]\ntype = Int8\nvalues = " + text.toUtf8() + '\n';
    QVERIFY(QPlcSignalTable::fromIni(table, &errors, QStringLiteral("t.ini")).isEmpty());
    QCOMPARE(errors.size(), 1);
    QVERIFY2(errors.constFirst().toString().startsWith(QStringLiteral("t.ini:3:")),
             qPrintable(errors.constFirst().toString()));
    QCOMPARE(errors.constFirst().message, told);
}

void tst_QPlcValueNames::tableRefusesNamesThatNoValueCanHave_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("error");
    QTest::newRow("real") << QByteArray("type = Real\nvalues = 0: Off")
                          << QStringLiteral("t.ini:3:10: values of Real32 have no names; take an integer type");
    QTest::newRow("text") << QByteArray("type = String\nvalues = 0: Off")
                          << QStringLiteral("t.ini:3:10: values of String(64) have no names");
    QTest::newRow("too large") << QByteArray("type = UInt8\nvalues = 0: Off, 256: On")
                               << QStringLiteral("t.ini:3:10: the value 256 ('On') does not fit into UInt8; remove");
    QTest::newRow("above max") << QByteArray("type = Int8\nmax = 1\nvalues = 2: On")
                               << QStringLiteral("t.ini:4:10: the value 2 ('On') is outside of min and max; remove");
    QTest::newRow("twice") << QByteArray("type = Int8\nvalues = 0: Off\nvalues = 1: On")
                           << QStringLiteral("t.ini:4:1: duplicate key 'values' (first at line 3)");
    QTest::newRow("misspelt") << QByteArray("type = Int8\nvalue = 0: Off")
                              << QStringLiteral("t.ini:3:1: unknown key 'value'; did you mean 'values'?");
    QTest::newRow("long line") << "type = Int32\nvalues = 0: Off" + [] {
        QByteArray names;
        for (int i = 1; i < 120; ++i)
            names += ',' + QByteArray::number(i) + ":a name of thirty characters " + QByteArray::number(i);
        return names;
    }() << QStringLiteral("t.ini:3:10: its line in the table has");
}

void tst_QPlcValueNames::tableRefusesNamesThatNoValueCanHave()
{
    QFETCH(QByteArray, text);
    QFETCH(QString, error);
    QVector<QPlcParseError> errors;
    QVERIFY(QPlcSignalTable::fromIni("[a]\n" + text + '\n', &errors, QStringLiteral("t.ini")).isEmpty());
    QCOMPARE(errors.size(), 1);
    QVERIFY2(errors.constFirst().toString().startsWith(error), qPrintable(errors.constFirst().toString()));
}

void tst_QPlcValueNames::tableKeepsNamesWhenItIsWrittenAndRead()
{
    const QByteArray text = "[a]\ntype = Bool\nvalues = \"0: Off ; really, 1: On\"\n";
    const QPlcSignalTable table = QPlcSignalTable::fromIni(text);
    QCOMPARE(table.at(0).valueNames.nameOf(0), QStringLiteral("Off ; really"));
    QCOMPARE(table.toIni(), text);
    QPlcSignalTable copy;
    QVERIFY(copy.append(table.at(0)));
    QCOMPARE(copy.toIni(), text);
    QCOMPARE(table.hash(), QPlcSignalTable::fromIni("[a]\ntype = Bool\n").hash());
}

void tst_QPlcValueNames::unknownFieldsOfANewerTableAreIgnored()
{
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table
        = QPlcSignalTable::fromMaster("[a]\ntype = Bool\ncolour = 7 x\nvalues = 0: Off\n", &errors);
    QVERIFY(errors.isEmpty());
    QCOMPARE(table.at(0).valueNames.nameOf(0), QStringLiteral("Off"));
    QVERIFY(QPlcSignalTable::fromMaster("[a]\ntype = Colour\n", &errors).isEmpty());
    QVERIFY(errors.constFirst().toString().startsWith(QStringLiteral("table of the master:2:8: unknown type")));
}

void tst_QPlcValueNames::valuesOfASignalAreWrittenAndReadByName()
{
    const QPlcSignalDefinition phase = phaseSignal();
    QCOMPARE(phase.textOf(phase.valueFromText(QStringLiteral("reel OUT"))), QStringLiteral("Reel out"));
    QCOMPARE(phase.valueFromText(QStringLiteral("ReelIn")).toString(), QStringLiteral("2"));
    QCOMPARE(phase.valueFromText(QStringLiteral("7")).toString(), QStringLiteral("7"));
    QPlcSignalDefinition three = phase;
    three.type = QPlcSignalType::fromName(QStringLiteral("Int8[3]"));
    const QPlcValue value = three.valueFromText(QStringLiteral("Off, 9, ReelIn"));
    QCOMPARE(value.toString(), QStringLiteral("0, 9, 2"));
    QCOMPARE(three.textOf(value), QStringLiteral("Off, 9, ReelIn"));
    QString error;
    QVERIFY(!phase.valueFromText(QStringLiteral("Reel"), &error).isValid());
    QCOMPARE(error.section(QStringLiteral("; "), -1), QStringLiteral("its names are 0: Off, 1: Reel out, 2: ReelIn"));
}

void tst_QPlcValueNames::valuesWithoutANameAreNumbers()
{
    const QPlcSignalDefinition phase = phaseSignal();
    QCOMPARE(phase.textOf(phase.valueFromText(QStringLiteral("3"))), QStringLiteral("3"));
    const QPlcSignalDefinition speed = QPlcSignalTable::fromIni("[v]\ntype = Real\n").at(0);
    QCOMPARE(speed.textOf(speed.valueFromText(QStringLiteral("1.5"))), QStringLiteral("1.5"));
    QString error;
    QVERIFY(!speed.valueFromText(QStringLiteral("Off"), &error).isValid());
    QVERIFY(!error.contains(QStringLiteral("names")));
}

QTEST_APPLESS_MAIN(tst_QPlcValueNames)
#include "tst_QPlcValueNames.moc"
