// SPDX-License-Identifier: Apache-2.0
#include "tools/WatchTable.h"

#include <QtTest/QtTest>

using tools::WatchTable;

class tst_WatchTable : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void signalsWithoutUpdateShowNoValue();
    void extremesAreThoseOfAllValues();
    void extremesCanBeForgotten();
    void ageIsTheTimeSinceTheChange();
    void qualityReplacesTheAgeOfAValueThatIsNotGood();
    void ageHasAReadableUnit_data();
    void ageHasAReadableUnit();
    void elementsOfAnArrayHaveRows();
    void textsHaveNoExtremes();
    void notANumberDoesNotChangeTheExtremes();
    void rowsAreScrolledAndLimited();
    void linesFitTheTerminal_data();
    void linesFitTheTerminal();
    void namesStayReadableInANarrowTerminal();
    void controlCharactersAreEscaped();

private:
    static QVector<QPlcSignalDefinition> definitions(const char *ini)
    {
        const QPlcSignalTable table = QPlcSignalTable::fromIni(QByteArray(ini));
        QVector<QPlcSignalDefinition> all;
        for (const QPlcSignalDefinition &definition : table)
            all << definition;
        return all;
    }
    static QStringList words(const WatchTable &table, int row, double now = 0.0)
    {
        return table.lines(0, 100, 50, now).value(row + 1).simplified().split(QLatin1Char(' '));
    }
    const char *const real = "[a]\ntype = Real64\nunit = m\n";
};

void tst_WatchTable::signalsWithoutUpdateShowNoValue()
{
    const WatchTable table(definitions(real));
    QCOMPARE(table.rowCount(), 1);
    QCOMPARE(words(table, 0), (QStringList{"a", "m", "-", "-", "-"}));
}

void tst_WatchTable::extremesAreThoseOfAllValues()
{
    WatchTable table(definitions(real));
    for (const double value : {1.0, -2.5, 7.0, 3.0})
        table.update({value}, 0.0);
    QCOMPARE(words(table, 0).mid(0, 5), (QStringList{"a", "3", "m", "-2.5", "7"}));
}

void tst_WatchTable::extremesCanBeForgotten()
{
    WatchTable table(definitions(real));
    table.update({9.0}, 0.0);
    table.forgetExtremes();
    QCOMPARE(words(table, 0).mid(3, 2), (QStringList{"-", "-"}));
    table.update({3.0}, 0.0);
    QCOMPARE(words(table, 0).mid(3, 2), (QStringList{"3", "3"}));
}

void tst_WatchTable::ageIsTheTimeSinceTheChange()
{
    WatchTable table(definitions(real));
    table.update({1.0}, 100.0);
    table.update({1.0}, 101.0);
    QCOMPARE(words(table, 0, 102.5).mid(5), (QStringList{"2.5", "s"}));
    table.update({2.0}, 103.0);
    QCOMPARE(words(table, 0, 103.0).mid(5), (QStringList{"0.0", "s"}));
}

void tst_WatchTable::qualityReplacesTheAgeOfAValueThatIsNotGood()
{
    WatchTable table(definitions("[v]\ntype = Real64[2]\n[b]\ntype = Int\n"));
    table.update({QPlcValue({1.0, 2.0}), 3}, 0.0, {QPlcQuality::held(12), QPlcQuality::Good});
    QCOMPARE(words(table, 0).mid(4), (QStringList{"held", "12"}));
    QCOMPARE(words(table, 1).mid(4), (QStringList{"held", "12"}));
    QCOMPARE(words(table, 2).mid(4), (QStringList{"0.0", "s"}));
    table.update({QPlcValue({1.0, 2.0}), 3}, 1.0, {QPlcQuality::Safe, QPlcQuality::Invalid});
    QCOMPARE(words(table, 1).mid(4), QStringList{"safe"});
    QCOMPARE(words(table, 2).mid(4), QStringList{"invalid"});
}

void tst_WatchTable::ageHasAReadableUnit_data()
{
    QTest::addColumn<double>("age");
    QTest::addColumn<QString>("text");
    QTest::newRow("tenths") << 9.9 << "9.9 s";
    QTest::newRow("seconds") << 119.9 << "119 s";
    QTest::newRow("minutes") << 120.0 << "2 min";
    QTest::newRow("hours") << 7200.0 << "2 h";
}

void tst_WatchTable::ageHasAReadableUnit()
{
    QFETCH(double, age);
    QFETCH(QString, text);
    WatchTable table(definitions(real));
    table.update({1.0}, 0.0);
    QCOMPARE(words(table, 0, age).mid(5).join(QLatin1Char(' ')), text);
}

void tst_WatchTable::elementsOfAnArrayHaveRows()
{
    WatchTable table(definitions("[v]\ntype = Real64[3]\n[b]\ntype = Int32\n"));
    QCOMPARE(table.rowCount(), 4);
    table.update({QPlcValue({1.0, 2.0, 3.0}), 4}, 0.0);
    table.update({QPlcValue({1.0, 0.5, 3.0}), 5}, 0.0);
    QCOMPARE(words(table, 1).mid(0, 4), (QStringList{"v[1]", "0.5", "0.5", "2"}));
    QCOMPARE(words(table, 3).mid(0, 4), (QStringList{"b", "5", "4", "5"}));
}

void tst_WatchTable::textsHaveNoExtremes()
{
    WatchTable table(definitions("[s]\ntype = String\n"));
    table.update({QPlcValue("1, 2")}, 0.0);
    QCOMPARE(table.rowCount(), 1);
    QCOMPARE(words(table, 0).mid(0, 5), (QStringList{"s", "1,", "2", "-", "-"}));
}

void tst_WatchTable::notANumberDoesNotChangeTheExtremes()
{
    WatchTable table(definitions(real));
    table.update({std::numeric_limits<double>::quiet_NaN()}, 0.0);
    QCOMPARE(words(table, 0).mid(3, 2), (QStringList{"-", "-"}));
    table.update({2.0}, 0.0);
    QCOMPARE(words(table, 0).mid(3, 2), (QStringList{"2", "2"}));
}

void tst_WatchTable::rowsAreScrolledAndLimited()
{
    WatchTable table(definitions("[v]\ntype = Int32[50]\n"));
    const QStringList lines = table.lines(10, 80, 6, 0.0);
    QCOMPARE(lines.size(), 6);
    QVERIFY(lines.at(1).startsWith(QLatin1String("v[10] ")));
    QVERIFY(lines.at(5).startsWith(QLatin1String("v[14] ")));
    QCOMPARE(table.lines(49, 80, 6, 0.0).size(), 2);
    QCOMPARE(table.lines(0, 80, 0, 0.0).size(), 1);
}

void tst_WatchTable::linesFitTheTerminal_data()
{
    QTest::addColumn<int>("width");
    for (const int width : {44, 60, 80, 100, 120, 200})
        QTest::addRow("%d", width) << width;
}

void tst_WatchTable::linesFitTheTerminal()
{
    QFETCH(int, width);
    WatchTable table(definitions("[aVeryLongNameOfASignalThatNobodyWouldWantToType]\ntype = Real64\nunit = kg.m2/s2\n"
                                 "[t]\ntype = String(200)\n"));
    table.update({-1.2345678901234567e-300, QPlcValue(QString(150, QLatin1Char('x')))}, 0.0);
    for (const QString &line : table.lines(0, width, 10, 1e7))
        QVERIFY2(line.size() <= width, qPrintable(line));
}

/// Smallest and largest values give way to names.
void tst_WatchTable::namesStayReadableInANarrowTerminal()
{
    WatchTable table(definitions("[bodyControlYawSpeed]\ntype = Real32\nunit = deg/s\n[bodyControlPitchSpeed]\n"
                                 "type = Real32\nunit = deg/s\n[masterTime]\ntype = DateTime\n"));
    table.update({1.5f, 2.5f, QPlcValue(QDateTime::fromMSecsSinceEpoch(0))}, 0.0);
    const QString narrow = table.lines(0, 60, 10, 3.0).join(QLatin1Char('\n'));
    QVERIFY2(narrow.contains(QStringLiteral("bodyControlYawSpeed ")), qPrintable(narrow));
    QVERIFY2(narrow.contains(QStringLiteral("bodyControlPitchSpeed ")), qPrintable(narrow));
    QVERIFY(!narrow.contains(QStringLiteral("min")));
    QVERIFY(narrow.contains(QStringLiteral("3.0 s")));
    QVERIFY(table.lines(0, 80, 10, 3.0).constFirst().contains(QStringLiteral("min")));
}

void tst_WatchTable::controlCharactersAreEscaped()
{
    WatchTable table(definitions("[s]\ntype = String\n"));
    table.update({QPlcValue("\033[2J")}, 0.0);
    QVERIFY(!table.lines(0, 80, 10, 0.0).join(QString()).contains(QLatin1Char('\033')));
    table.update({QPlcValue(QString(QChar(0x202E)) + QStringLiteral("etik"))}, 0.0);
    QVERIFY(table.lines(0, 80, 10, 0.0).join(QString()).contains(QStringLiteral("\\u202eetik")));
}

QTEST_APPLESS_MAIN(tst_WatchTable)
#include "tst_WatchTable.moc"
