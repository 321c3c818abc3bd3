// SPDX-License-Identifier: Apache-2.0
#include "TerminalText.h"

#include "signals/MessageText.h"

#include <cstdio>
#include <sys/ioctl.h>
#include <unistd.h>

namespace tools {

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

QString bold(const QString &text)
{
    if (!isTerminal() || qEnvironmentVariableIsSet("NO_COLOR"))
        return text;
    return QStringLiteral("\033[1m%1\033[0m").arg(text);
}

void printLine(const QString &line)
{
    printText(line + QLatin1Char('\n'));
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
    m_columns.append({title, alignment, title.size()});
}

void TextTable::addRow(const QStringList &cells)
{
    Q_ASSERT_X(cells.size() == m_columns.size(), "TextTable::addRow", "a cell for every column");
    QStringList row;
    for (int i = 0; i < m_columns.size(); ++i) {
        QString cell = printable(cells.at(i));
        if (cell.isEmpty())
            cell = QStringLiteral("-");
        m_columns[i].width = qMax(m_columns.at(i).width, cell.size());
        row << cell;
    }
    m_rows.append(row);
}

QString TextTable::toLine(const QStringList &cells) const
{
    QStringList padded;
    for (int i = 0; i < m_columns.size(); ++i) {
        const Column &column = m_columns.at(i);
        padded << (column.alignment == Left ? cells.at(i).leftJustified(column.width)
                                            : cells.at(i).rightJustified(column.width));
    }
    QString line = padded.join(QStringLiteral("  "));
    while (line.endsWith(QLatin1Char(' ')))
        line.chop(1);
    return line;
}

void TextTable::print() const
{
    QStringList titles;
    for (const Column &column : m_columns)
        titles << column.title;
    printLine(bold(toLine(titles)));
    for (const QStringList &row : m_rows)
        printLine(toLine(row));
}

}  // namespace tools
