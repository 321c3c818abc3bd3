// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QStringList>

#include <vector>

namespace awe {

/// A picture of characters and Braille dots, with a colour each. What is put beyond its borders is
/// not there.
///
/// A character has two by four dots: dot (2 x, 4 y) is the upper left one of column x and row y. A
/// text hides the dots below it.
class TerminalCanvas
{
public:
    static constexpr int DotColumns = 2;  // of a character
    static constexpr int DotRows = 4;

    enum class Style { Plain, Axis, Title, TrailOld, TrailMiddle, TrailNew, Kite, Alarm };

    TerminalCanvas(int columns, int rows);

    int columns() const { return m_columns; }
    int rows() const { return m_rows; }

    void put(int column, int row, const QString &text, Style style = Style::Plain);
    void dot(int x, int y, Style style);
    /// Dots from one point to another one, both included.
    void stroke(int x0, int y0, int x1, int y1, Style style);

    QStringList lines(bool hasColours) const;

private:
    struct Cell
    {
        QChar character = QLatin1Char(' ');
        ushort dots = 0;  // bits of the Braille character
        Style style = Style::Plain;
    };
    Cell *cellAt(int column, int row);
    QString line(int row, bool hasColours) const;

    int m_columns;
    int m_rows;
    std::vector<Cell> m_cells;
};

}  // namespace awe
