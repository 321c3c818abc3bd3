// SPDX-License-Identifier: Apache-2.0
#include "tools/TerminalText.h"

#include <QtTest/QtTest>

#include <pty.h>
#include <unistd.h>

using namespace tools;

namespace {

/// While it lives, the standard output is a terminal.
class Terminal
{
public:
    Terminal()
        : m_before(::dup(STDOUT_FILENO))
    {
        if (::openpty(&m_master, &m_slave, nullptr, nullptr, nullptr) == 0)
            ::dup2(m_slave, STDOUT_FILENO);
    }
    ~Terminal()
    {
        ::dup2(m_before, STDOUT_FILENO);
        for (const int descriptor : {m_before, m_master, m_slave})
            ::close(descriptor);
    }
    Terminal(const Terminal &) = delete;
    Terminal &operator=(const Terminal &) = delete;

private:
    int m_before;
    int m_master = -1;
    int m_slave = -1;
};

}  // namespace

class tst_TerminalText : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void coloursNeedATerminalThatSupportsThem_data();
    void coloursNeedATerminalThatSupportsThem();
    void aPipeHasNoColours();
    void statesAndQualitiesHaveTheirTones();
    void wideCharactersTakeTwoColumns_data();
    void wideCharactersTakeTwoColumns();
    void paddingCountsColumns();
    void aCutTextFitsAndKeepsItsElement_data();
    void aCutTextFitsAndKeepsItsElement();
    void textsAreBrokenAtBlanks();
    void columnsAreAlignedAlsoWithWideCharacters();
    void longCellsGetSeveralLinesWhereTheTerminalIsNarrow();
    void columnsThatDoNotFitBecomeAnotherTable();
    void aTableThatFitsIsNotBroken();
};

void tst_TerminalText::coloursNeedATerminalThatSupportsThem_data()
{
    QTest::addColumn<QByteArray>("term");
    QTest::addColumn<QByteArray>("noColor");
    QTest::addColumn<QString>("text");
    const QString coloured = QStringLiteral("\033[1;31mlost\033[0m");
    QTest::newRow("a terminal") << QByteArray("xterm") << QByteArray() << coloured;
    QTest::newRow("NO_COLOR") << QByteArray("xterm") << QByteArray("1") << "lost";
    QTest::newRow("an empty NO_COLOR says nothing") << QByteArray("xterm") << QByteArray("") << coloured;
    QTest::newRow("a terminal without colours") << QByteArray("dumb") << QByteArray() << "lost";
}

void tst_TerminalText::coloursNeedATerminalThatSupportsThem()
{
    QFETCH(QByteArray, term);
    QFETCH(QByteArray, noColor);
    QFETCH(QString, text);
    qputenv("TERM", term);
    if (noColor.isNull())
        qunsetenv("NO_COLOR");
    else
        qputenv("NO_COLOR", noColor);
    QString seen;
    {
        const Terminal terminal;
        seen = toned(QStringLiteral("lost"), Tone::Bad);
    }
    QCOMPARE(seen, text);
}

void tst_TerminalText::aPipeHasNoColours()
{
    qputenv("TERM", "xterm");
    qunsetenv("NO_COLOR");
    int ends[2];
    QCOMPARE(::pipe(ends), 0);
    const int before = ::dup(STDOUT_FILENO);
    ::dup2(ends[1], STDOUT_FILENO);
    const QString seen = toned(QStringLiteral("lost"), Tone::Bad);
    ::dup2(before, STDOUT_FILENO);
    for (const int descriptor : {before, ends[0], ends[1]})
        ::close(descriptor);
    QCOMPARE(seen, QStringLiteral("lost"));
}

void tst_TerminalText::statesAndQualitiesHaveTheirTones()
{
    using State = qplc::messages::MasterState;
    QCOMPARE(int(toneOfState(State::RealTime)), int(Tone::Good));
    QCOMPARE(int(toneOfState(State::WaitingForLateSlaves)), int(Tone::Caution));
    for (const State state : {State::SafeStop, State::Fault})
        QCOMPARE(int(toneOfState(state)), int(Tone::Bad));
    for (const State state : {State::Off, State::Initializing, State::Ready, State::Unknown})
        QCOMPARE(int(toneOfState(state)), int(Tone::Plain));
    QCOMPARE(int(toneOfQuality("good")), int(Tone::Plain));
    QCOMPARE(int(toneOfQuality("held 3")), int(Tone::Caution));
    QCOMPARE(int(toneOfQuality("invalid")), int(Tone::Caution));
    QCOMPARE(int(toneOfQuality("safe")), int(Tone::Bad));
}

void tst_TerminalText::wideCharactersTakeTwoColumns_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<int>("width");
    QTest::newRow("nothing") << "" << 0;
    QTest::newRow("letters") << "abc" << 3;
    QTest::newRow("degrees") << QStringLiteral("20 \u00b0C") << 5;
    QTest::newRow("Greek") << QStringLiteral("\u03a9") << 1;
    QTest::newRow("Chinese") << QStringLiteral("\u529b\u77e9") << 4;
    QTest::newRow("full width") << QStringLiteral("\uff21") << 2;
    QTest::newRow("Korean") << QStringLiteral("\ud798") << 2;
    QTest::newRow("a combining accent") << QStringLiteral("e\u0301") << 1;
    QTest::newRow("a picture") << QString::fromUtf8("\xf0\x9f\xaa\x81") << 2;
    QTest::newRow("a box") << QStringLiteral("\u2588\u2591") << 2;
    QTest::newRow("Braille") << QStringLiteral("\u28ff") << 1;
}

void tst_TerminalText::wideCharactersTakeTwoColumns()
{
    QFETCH(QString, text);
    QTEST(displayWidth(text), "width");
}

void tst_TerminalText::paddingCountsColumns()
{
    QCOMPARE(padded(QStringLiteral("\u529b"), 5), QStringLiteral("\u529b   "));
    QCOMPARE(padded(QStringLiteral("\u529b"), 5, Right), QStringLiteral("   \u529b"));
    QCOMPARE(padded(QStringLiteral("longer"), 3), QStringLiteral("longer"));
}

void tst_TerminalText::aCutTextFitsAndKeepsItsElement_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<int>("width");
    QTest::addColumn<QString>("result");
    QTest::newRow("fits") << "position[2]" << 11 << "position[2]";
    QTest::newRow("element") << "position[2]" << 8 << QStringLiteral("posi\u2026[2]");
    QTest::newRow("no room for the element") << "position[2]" << 4 << QStringLiteral("pos\u2026");
    QTest::newRow("no element") << "position" << 5 << QStringLiteral("posi\u2026");
    QTest::newRow("wide") << QStringLiteral("\u529b\u529b\u529b") << 4 << QStringLiteral("\u529b\u2026");
}

void tst_TerminalText::aCutTextFitsAndKeepsItsElement()
{
    QFETCH(QString, text);
    QFETCH(int, width);
    QTEST(cut(text, width), "result");
    QVERIFY(displayWidth(cut(text, width)) <= width);
}

void tst_TerminalText::textsAreBrokenAtBlanks()
{
    QCOMPARE(wrapped("one two three", 7), (QStringList{"one two", "three"}));
    QCOMPARE(wrapped("incomprehensible", 5), QStringList{"incomprehensible"});
    QCOMPARE(wrapped("  as it is  ", 12), QStringList{"  as it is  "});
    QCOMPARE(wrapped("ask 12.5 us, finish 3 ms", 10), (QStringList{"ask", "12.5 us,", "finish", "3 ms"}));
    QCOMPARE(wrapped("10.5, -3, 33.25", 6), (QStringList{"10.5,", "-3,", "33.25"}));
    QCOMPARE(wrapped("", 5), QStringList{QString()});
}

void tst_TerminalText::columnsAreAlignedAlsoWithWideCharacters()
{
    TextTable table;
    table.addColumn("name");
    table.addColumn("value", Right);
    table.addColumn("unit");
    table.addRow({QStringLiteral("\u529b"), "12.5", "N"});
    table.addRow({"tetherSpeed", "-3", ""});
    QCOMPARE(table.lines(0),
             (QStringList{"name         value  unit", QStringLiteral("\u529b            12.5  N"),
                          "tetherSpeed     -3  -"}));
}

void tst_TerminalText::longCellsGetSeveralLinesWhereTheTerminalIsNarrow()
{
    TextTable table;
    table.addColumn("name");
    table.addColumn("value", Right);
    table.addColumn("unit");
    table.addRow({"force", "-504.90152, -340.1438, -603.3564", "N"});
    table.addRow({"speed", "1", "m/s"});
    const QStringList lines = table.lines(25);
    QVERIFY2(lines.join('\n').contains("-504.90152,"), qPrintable(lines.join('\n')));
    for (const QString &line : lines)
        QVERIFY2(displayWidth(line) <= 25, qPrintable(line));
    QCOMPARE(lines.size(), 5);
    const int unit = lines.constFirst().indexOf("unit");
    QCOMPARE(lines.at(1).mid(unit), QString("N"));
    QCOMPARE(lines.at(4).mid(unit), QString("m/s"));
}

void tst_TerminalText::columnsThatDoNotFitBecomeAnotherTable()
{
    TextTable table;
    for (const char *title : {"node", "transport", "state", "description"})
        table.addColumn(title);
    table.addRow({"Model", "udp", "Registered", "flies a kite"});
    QCOMPARE(table.lines(30),
             (QStringList{"node   transport  state", "Model  udp        Registered", "", "node   description",
                          "Model  flies a kite"}));
    // A screen that is narrower than any column: nothing is lost.
    const QStringList narrow = table.lines(3);
    for (const char *text : {"Model", "udp", "Registered", "flies"})
        QVERIFY(narrow.join(QLatin1Char(' ')).contains(QLatin1String(text)));
}

void tst_TerminalText::aTableThatFitsIsNotBroken()
{
    TextTable table;
    table.addColumn("name");
    table.addRow({"one two three"});
    QCOMPARE(table.lines(13).size(), 2);
    QCOMPARE(table.lines(0).size(), 2);
}

QTEST_APPLESS_MAIN(tst_TerminalText)
#include "tst_TerminalText.moc"
