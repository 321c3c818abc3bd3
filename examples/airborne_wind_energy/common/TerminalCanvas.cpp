// SPDX-License-Identifier: Apache-2.0
#include "TerminalCanvas.h"

#include <algorithm>
#include <cmath>

namespace awe {

namespace {

constexpr ushort braille = 0x2800;  // the character without dots
// Bit of each dot of a character, row by row.
constexpr ushort dotBits[TerminalCanvas::DotRows][TerminalCanvas::DotColumns]
    = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};

const char *colourCode(TerminalCanvas::Style style)
{
    using Style = TerminalCanvas::Style;
    switch (style) {
    case Style::Plain:
        return "\033[0m";
    case Style::Axis:
        return "\033[0;38;5;244m";
    case Style::Title:
        return "\033[0;1m";
    case Style::TrailOld:
        return "\033[0;38;5;239m";
    case Style::TrailMiddle:
        return "\033[0;38;5;31m";
    case Style::TrailNew:
        return "\033[0;38;5;51m";
    case Style::Kite:
        return "\033[0;1;38;5;220m";
    case Style::Alarm:
        return "\033[0;1;31m";
    }
    return "";
}

}  // namespace

TerminalCanvas::TerminalCanvas(int columns, int rows)
    : m_columns(std::max(columns, 0))
    , m_rows(std::max(rows, 0))
    , m_cells(std::size_t(m_columns) * std::size_t(m_rows))
{
}

TerminalCanvas::Cell *TerminalCanvas::cellAt(int column, int row)
{
    const bool isInside = column >= 0 && column < m_columns && row >= 0 && row < m_rows;
    return isInside ? &m_cells[std::size_t(row * m_columns + column)] : nullptr;
}

void TerminalCanvas::put(int column, int row, const QString &text, Style style)
{
    for (int i = 0; i < text.size(); ++i) {
        if (Cell *cell = cellAt(column + i, row))
            *cell = {text.at(i), 0, style};
    }
}

void TerminalCanvas::dot(int x, int y, Style style)
{
    if (x < 0 || y < 0)
        return;
    Cell *cell = cellAt(x / DotColumns, y / DotRows);
    if (!cell || cell->character != QLatin1Char(' '))
        return;
    cell->dots |= dotBits[y % DotRows][x % DotColumns];
    cell->style = style;
}

void TerminalCanvas::stroke(int x0, int y0, int x1, int y1, Style style)
{
    const int steps = std::max({std::abs(x1 - x0), std::abs(y1 - y0), 1});
    for (int i = 0; i <= steps; ++i) {
        const double share = double(i) / steps;
        dot(int(std::lround(x0 + share * (x1 - x0))), int(std::lround(y0 + share * (y1 - y0))), style);
    }
}

QStringList TerminalCanvas::lines(bool hasColours) const
{
    QStringList result;
    for (int row = 0; row < m_rows; ++row)
        result << line(row, hasColours);
    return result;
}

QString TerminalCanvas::line(int row, bool hasColours) const
{
    QString text;
    Style style = Style::Plain;
    for (int column = 0; column < m_columns; ++column) {
        const Cell &cell = m_cells[std::size_t(row * m_columns + column)];
        if (cell.style != style && hasColours)
            text += QLatin1String(colourCode(cell.style));
        style = cell.style;
        text += cell.dots == 0 ? cell.character : QChar(ushort(braille + cell.dots));
    }
    return style == Style::Plain || !hasColours ? text : text + QLatin1String(colourCode(Style::Plain));
}

}  // namespace awe
