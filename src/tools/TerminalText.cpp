// SPDX-License-Identifier: Apache-2.0
#include "TerminalText.h"

#include "signals/MessageText.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <numeric>
#include <sys/ioctl.h>
#include <unistd.h>

namespace tools {

namespace {

constexpr int gap = 2;          // columns between two cells
constexpr int narrowest = 12;   // columns of a text in several lines
constexpr int shortIndent = 8;  // columns before its other lines, where its head is long

const char *codeOf(Tone tone)
{
    switch (tone) {
    case Tone::Title:
        return "1";
    case Tone::Good:
        return "32";
    case Tone::Caution:
        return "33";
    case Tone::Bad:
        return "1;31";
    case Tone::Plain:
        break;
    }
    return "0";
}

struct CharacterRange
{
    uint first, last;
};

// Wide and full-width characters of Unicode (UAX #11), and pictures.
constexpr CharacterRange wideCharacters[] = {
    {0x1100, 0x115f}, {0x2e80, 0x303e},   {0x3041, 0x33ff},   {0x3400, 0x4dbf},   {0x4e00, 0x9fff},
    {0xa000, 0xa4cf}, {0xac00, 0xd7a3},   {0xf900, 0xfaff},   {0xfe30, 0xfe6f},   {0xff00, 0xff60},
    {0xffe0, 0xffe6}, {0x1f300, 0x1f64f}, {0x1f900, 0x1f9ff}, {0x1fa70, 0x1faff}, {0x20000, 0x3fffd},
};

int widthOf(uint character)
{
    const QChar::Category category = QChar::category(character);
    if (category == QChar::Mark_NonSpacing || category == QChar::Mark_Enclosing || category == QChar::Other_Format)
        return 0;
    const bool isWide = std::any_of(std::begin(wideCharacters), std::end(wideCharacters), [=](CharacterRange range) {
        return character >= range.first && character <= range.last;
    });
    return isWide ? 2 : 1;
}

/// A number keeps the unit that follows it.
QStringList wordsOf(const QString &text)
{
    QStringList words;
    bool isNumber = false;
    for (const QString &word : text.split(QLatin1Char(' '))) {
        if (isNumber)
            words.last() += QLatin1Char(' ') + word;
        else
            words << word;
        word.toDouble(&isNumber);
    }
    return words;
}

}  // namespace

QString printable(const QString &text)
{
    return qplc::printable(text, [](uint character) {
        const QString form = character < 0x100 ? QStringLiteral("\\x%1") : QStringLiteral("\\u%1");
        return form.arg(character, character < 0x100 ? 2 : 4, 16, QLatin1Char('0'));
    });
}

bool isTerminal()
{
    return ::isatty(STDOUT_FILENO) != 0;
}

bool isScreen()
{
    return isTerminal() && qgetenv("TERM") != "dumb";
}

bool hasColors()
{
    return isScreen() && qEnvironmentVariableIsEmpty("NO_COLOR");
}

QString toned(const QString &text, Tone tone)
{
    if (tone == Tone::Plain || text.isEmpty() || !hasColors())
        return text;
    return QStringLiteral("\033[%1m%2\033[0m").arg(QLatin1String(codeOf(tone)), text);
}

Tone toneOfState(qplc::messages::MasterState state)
{
    using State = qplc::messages::MasterState;
    if (qplc::messages::isLatched(state))
        return Tone::Bad;
    return state == State::RealTime ? Tone::Good : state == State::WaitingForLateSlaves ? Tone::Caution : Tone::Plain;
}

Tone toneOfQuality(const QString &quality)
{
    if (quality.isEmpty() || quality == QLatin1String("good"))
        return Tone::Plain;
    return quality == QLatin1String("safe") ? Tone::Bad : Tone::Caution;
}

int displayWidth(const QString &text)
{
    const QVector<uint> characters = text.toUcs4();
    return std::accumulate(characters.begin(), characters.end(), 0,
                           [](int width, uint character) { return width + widthOf(character); });
}

QString padded(const QString &text, int width, Alignment alignment)
{
    const QString blanks(qMax(0, width - displayWidth(text)), QLatin1Char(' '));
    return alignment == Left ? text + blanks : blanks + text;
}

QString cut(const QString &text, int width)
{
    if (displayWidth(text) <= width)
        return text;
    QString end = text.endsWith(QLatin1Char(']')) ? text.mid(text.lastIndexOf(QLatin1Char('['))) : QString();
    if (displayWidth(end) + 1 >= width)
        end.clear();
    QString kept;
    int columns = 1 + displayWidth(end);  // 1: what stands for the rest
    const QVector<uint> characters = text.toUcs4();
    for (const uint character : characters) {
        columns += widthOf(character);
        if (columns > width)
            break;
        kept += QString::fromUcs4(&character, 1);
    }
    return kept + QChar(0x2026) + end;
}

QStringList wrapped(const QString &text, int width)
{
    if (displayWidth(text) <= width)
        return {text};
    QStringList lines{QString()};
    const QStringList words = wordsOf(text);
    for (const QString &word : words) {
        QString &line = lines.last();
        if (line.isEmpty())
            line = word;
        else if (displayWidth(line) + 1 + displayWidth(word) <= width)
            line += QLatin1Char(' ') + word;
        else
            lines << word;
    }
    return lines;
}

void printLine(const QString &line)
{
    printText(line + QLatin1Char('\n'));
}

void printWrapped(const QString &head, int headWidth, const QString &text)
{
    const int columns = terminalSize().columns;
    const int width = columns - headWidth;
    if (!isTerminal() || width < narrowest) {
        printLine(head + text);
        return;
    }
    const QString first = wrapped(text, width).constFirst();
    printLine(head + first);
    const int indent = width < columns / 2 ? shortIndent : headWidth;
    const QString rest = text.mid(first.size() + 1);
    for (const QString &line : rest.isEmpty() ? QStringList() : wrapped(rest, columns - indent))
        printLine(QString(indent, QLatin1Char(' ')) + line);
}

void printText(const QString &text)
{
    const QByteArray bytes = text.toUtf8();
    std::fwrite(bytes.constData(), 1, std::size_t(bytes.size()), stdout);
    std::fflush(stdout);
}

void printJson(const QJsonDocument &document)
{
    printLine(QString::fromUtf8(document.toJson(QJsonDocument::Compact)));
}

QString placeText(const QPlcUnderlyingProtocol &master)
{
    return master.toString().section(QStringLiteral("://"), -1);
}

TerminalSize terminalSize()
{
    winsize size{};
    if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 && size.ws_row > 0)
        return {size.ws_col, size.ws_row};
    const int columns = qEnvironmentVariableIntValue("COLUMNS");
    const int lines = qEnvironmentVariableIntValue("LINES");
    return {columns > 0 ? columns : 80, lines > 0 ? lines : 24};
}

void TextTable::addColumn(const QString &title, Alignment alignment)
{
    m_columns.append({title, alignment, displayWidth(title)});
}

void TextTable::addRow(const QStringList &cells)
{
    Q_ASSERT_X(cells.size() == m_columns.size(), "TextTable::addRow", "a cell for every column");
    QVector<Cell> row;
    for (int i = 0; i < m_columns.size(); ++i) {
        QString cell = printable(cells.at(i));
        if (cell.isEmpty())
            cell = QStringLiteral("-");
        m_columns[i].width = qMax(m_columns.at(i).width, displayWidth(cell));
        row.append({cell, Tone::Plain});
    }
    m_rows.append(row);
}

void TextTable::setTone(int column, Tone tone)
{
    m_rows.last()[column].tone = tone;
}

/// The widest columns give way, as far as their longest words let them.
QVector<int> TextTable::widthsFor(int width) const
{
    QVector<int> widths, least;
    for (int i = 0; i < m_columns.size(); ++i) {
        int longest = qMax(narrowest, displayWidth(m_columns.at(i).title));
        for (const QVector<Cell> &row : m_rows) {
            for (const QString &word : row.at(i).text.split(QLatin1Char(' ')))
                longest = qMax(longest, displayWidth(word));
        }
        widths.append(m_columns.at(i).width);
        least.append(qMin(longest, m_columns.at(i).width));
    }
    int excess = std::accumulate(widths.begin(), widths.end(), gap * (int(widths.size()) - 1)) - width;
    while (width > 0 && excess > 0) {
        int widest = -1;
        for (int i = 0; i < widths.size(); ++i) {
            if (widths.at(i) > least.at(i) && (widest < 0 || widths.at(i) > widths.at(widest)))
                widest = i;
        }
        if (widest < 0)
            break;
        const int less = qMin(excess, widths.at(widest) - least.at(widest));
        widths[widest] -= less;
        excess -= less;
    }
    return widths;
}

QString TextTable::toLine(const QVector<Cell> &cells, const QVector<int> &widths) const
{
    QString line;
    int missing = 0;  // blanks before the next cell: there are none behind the last one
    for (int i = 0; i < cells.size(); ++i) {
        const int blanks = widths.at(i) - displayWidth(cells.at(i).text);
        const bool isRight = m_columns.at(i).alignment == Right;
        if (cells.at(i).text.isEmpty()) {
            missing += widths.at(i) + gap;
            continue;
        }
        line += QString(missing + (isRight ? blanks : 0), QLatin1Char(' '));
        line += toned(cells.at(i).text, cells.at(i).tone);
        missing = gap + (isRight ? 0 : blanks);
    }
    return line;
}

QStringList TextTable::toLines(const QVector<Cell> &cells, const QVector<int> &widths) const
{
    QVector<QStringList> texts;
    int count = 1;
    for (int i = 0; i < cells.size(); ++i) {
        texts.append(wrapped(cells.at(i).text, widths.at(i)));
        count = qMax(count, int(texts.last().size()));
    }
    QStringList lines;
    for (int line = 0; line < count; ++line) {
        QVector<Cell> parts;
        for (int i = 0; i < cells.size(); ++i)
            parts.append({texts.at(i).value(line), cells.at(i).tone});
        lines << toLine(parts, widths);
    }
    return lines;
}

TextTable TextTable::part(const QVector<int> &columns) const
{
    TextTable table;
    for (const int column : columns)
        table.m_columns.append(m_columns.at(column));
    for (const QVector<Cell> &row : m_rows) {
        QVector<Cell> cells;
        for (const int column : columns)
            cells.append(row.at(column));
        table.m_rows.append(cells);
    }
    return table;
}

/// Several tables, one below the other, that all begin with the first column.
QStringList TextTable::linesOfParts(int width) const
{
    QVector<QVector<int>> parts{QVector<int>{0}};
    int used = m_columns.constFirst().width;
    for (int i = 1; i < m_columns.size(); ++i) {
        if (parts.constLast().size() > 1 && used + gap + m_columns.at(i).width > width) {
            parts.append(QVector<int>{0});
            used = m_columns.constFirst().width;
        }
        parts.last().append(i);
        used += gap + m_columns.at(i).width;
    }
    QStringList all;
    for (const QVector<int> &columns : qAsConst(parts))
        all << (all.isEmpty() ? QStringList() : QStringList{QString()}) << part(columns).lines(width);
    return all;
}

QStringList TextTable::lines(int width) const
{
    const QVector<int> widths = widthsFor(width);
    const int total = std::accumulate(widths.begin(), widths.end(), gap * (int(widths.size()) - 1));
    if (width > 0 && total > width && m_columns.size() > 2)
        return linesOfParts(width);
    QVector<Cell> titles;
    for (const Column &column : m_columns)
        titles.append({column.title, Tone::Title});
    QStringList all{toLine(titles, widths)};
    for (const QVector<Cell> &row : m_rows)
        all += toLines(row, widths);
    return all;
}

void TextTable::print() const
{
    const QStringList all = lines(isTerminal() ? terminalSize().columns : 0);
    for (const QString &line : all)
        printLine(line);
}

}  // namespace tools
