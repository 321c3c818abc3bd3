// SPDX-License-Identifier: Apache-2.0
#include "FlightView.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace awe {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double degreesPerRadian = 180.0 / pi;
constexpr double windTimeConstant = 20.0;  // of the direction that the window looks to [s]
constexpr int widest = 100;                // columns; more would only make the picture flat
constexpr int tallest = 30;                // rows
constexpr int axisWidth = 6;               // columns of " 90° ┤"
constexpr int textRows = 7;                // everything but the window

enum class Style { Plain, Axis, Title, TrailOld, TrailMiddle, TrailNew, Kite, Alarm };

const char *colourCode(Style style)
{
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

double angleBetween(double angle, double reference)
{
    return std::remainder(angle - reference, 2.0 * pi);
}

QString timeText(const FlightMoment &moment, double duration)
{
    const QString end = duration > 0.0 ? QStringLiteral(" / %1").arg(duration, 0, 'f', 0) : QString();
    return QStringLiteral("%1%2 s").arg(moment.time, 7, 'f', 1).arg(end);
}

QString phaseText(FlightPhase phase)
{
    return QString::fromLatin1(flightPhaseName(phase));
}

}  // namespace

/// Characters with a style each; what is put beyond the borders is not there.
class FlightView::Canvas
{
public:
    Canvas(int columns, int rows)
        : m_columns(std::clamp(columns, 0, widest))
        , m_rows(std::clamp(rows, 0, tallest))
        , m_cells(std::size_t(m_columns) * std::size_t(m_rows))
    {
    }

    int columns() const { return m_columns; }
    int rows() const { return m_rows; }

    void put(int column, int row, const QString &text, Style style = Style::Plain)
    {
        for (int i = 0; i < text.size(); ++i) {
            const int place = column + i;
            if (place >= 0 && place < m_columns && row >= 0 && row < m_rows)
                m_cells[std::size_t(row * m_columns + place)] = {text.at(i), style};
        }
    }

    QStringList lines() const
    {
        QStringList result;
        for (int row = 0; row < m_rows; ++row)
            result << line(row);
        return result;
    }

private:
    struct Cell
    {
        QChar character = QLatin1Char(' ');
        Style style = Style::Plain;
    };

    QString line(int row) const
    {
        QString text;
        Style style = Style::Plain;
        for (int column = 0; column < m_columns; ++column) {
            const Cell &cell = m_cells[std::size_t(row * m_columns + column)];
            if (cell.style != style)
                text += QLatin1String(colourCode(cell.style));
            style = cell.style;
            text += cell.character;
        }
        return style == Style::Plain ? text : text + QLatin1String(colourCode(Style::Plain));
    }

    int m_columns;
    int m_rows;
    std::vector<Cell> m_cells;
};

QString progressLine(const FlightMoment &moment, double duration)
{
    return QStringLiteral("%1  %2 %3 m high  %4 m tether  %5 W  %6 kJ")
        .arg(timeText(moment, duration))
        .arg(phaseText(moment.phase), -8)
        .arg(moment.position.z(), 5, 'f', 1)
        .arg(moment.tetherLength, 5, 'f', 1)
        .arg(moment.power, 6, 'f', 0)
        .arg(moment.energy * 1e-3, 7, 'f', 1);
}

void FlightView::add(const FlightMoment &moment)
{
    const double direction = std::atan2(moment.windVelocity.y(), moment.windVelocity.x());
    if (m_trail.empty() || moment.time < m_moment.time) {
        m_trail.clear();
        m_windDirection = direction;
    } else {
        const double share = 1.0 - std::exp(-(moment.time - m_moment.time) / windTimeConstant);
        m_windDirection += share * angleBetween(direction, m_windDirection);
    }
    m_moment = moment;
    const double azimuth = std::atan2(moment.position.y(), moment.position.x());
    const double elevation = std::atan2(moment.position.z(), moment.position.head<2>().norm());
    m_trail.push_back(
        {moment.time, angleBetween(azimuth, m_windDirection) * degreesPerRadian, elevation * degreesPerRadian});
    while (m_trail.front().time < moment.time - trailDuration)
        m_trail.pop_front();
}

QStringList FlightView::draw(int columns, int rows) const
{
    Canvas canvas(columns, rows);
    const int windowRows = canvas.rows() - textRows;
    drawTitle(canvas);
    if (windowRows >= 5)
        drawWindow(canvas, 2, windowRows);
    drawFigures(canvas, windowRows >= 5 ? windowRows + 4 : 1);
    return canvas.lines();
}

void FlightView::drawTitle(Canvas &canvas) const
{
    const QString text = QStringLiteral("%1   %2").arg(timeText(m_moment, m_duration), phaseText(m_moment.phase));
    canvas.put(0, 0, text, Style::Title);
    if (m_moment.crashed)
        canvas.put(text.size() + 3, 0, QStringLiteral("CRASHED"), Style::Alarm);
}

/// Elevation 0 ... 90 deg over `height` rows, azimuth -60 ... 60 deg from downwind over the rest of the width; beyond it the kite stands at the border.
void FlightView::drawWindow(Canvas &canvas, int top, int height) const
{
    const int width = canvas.columns() - axisWidth - 1;
    const auto column = [width](double azimuth) {
        return axisWidth + int(std::lround(std::clamp(0.5 - azimuth / 120.0, 0.0, 1.0) * (width - 1)));
    };
    const auto row = [top, height](double elevation) {
        return top + int(std::lround(std::clamp(1.0 - elevation / 90.0, 0.0, 1.0) * (height - 1)));
    };

    for (int y = top; y < top + height; ++y)
        canvas.put(axisWidth - 1, y, QStringLiteral("│"), Style::Axis);
    canvas.put(axisWidth - 1, top + height, QStringLiteral("└") + QString(width, QChar(0x2500)),
               Style::Axis);  // a row below 0: the kite may be on the ground
    for (const int elevation : {90, 60, 30, 0})
        canvas.put(0, row(elevation), QStringLiteral("%1° ┤").arg(elevation, 3), Style::Axis);
    for (const int azimuth : {60, 30, 0, -30, -60}) {
        const QString label = azimuth == 0 ? QStringLiteral("downwind") : QStringLiteral("%1°").arg(std::abs(azimuth));
        const int place = std::min(column(azimuth) - label.size() / 2, canvas.columns() - label.size());
        canvas.put(column(azimuth), top + height, QStringLiteral("┴"), Style::Axis);
        canvas.put(place, top + height + 1, label, Style::Axis);
    }

    for (const TrailPoint &point : m_trail) {
        const double age = (m_moment.time - point.time) / trailDuration;
        const Style style = age > 0.6 ? Style::TrailOld : age > 0.25 ? Style::TrailMiddle : Style::TrailNew;
        const QString mark = age > 0.6 ? QStringLiteral("·") : QStringLiteral("•");
        canvas.put(column(point.azimuth), row(point.elevation), mark, style);
    }
    if (!m_trail.empty())
        canvas.put(column(m_trail.back().azimuth), row(m_trail.back().elevation), QStringLiteral("◆"),
                   m_moment.crashed ? Style::Alarm : Style::Kite);
}

void FlightView::drawFigures(Canvas &canvas, int top) const
{
    constexpr double shortest = 100.0, longest = 200.0;  // of the tether [m]
    constexpr int barWidth = 30;
    const double share = std::clamp((m_moment.tetherLength - shortest) / (longest - shortest), 0.0, 1.0);
    const int filled = int(std::lround(share * barWidth));
    const double meanPower = m_moment.time > 0.0 ? m_moment.energy / m_moment.time : 0.0;
    const auto figure = [](const char *label, double value, int precision, const char *unit) {
        return QStringLiteral("%1 %2 %3")
            .arg(QString::fromLatin1(label), -8)
            .arg(value, 8, 'f', precision)
            .arg(QString::fromLatin1(unit), -4);
    };
    canvas.put(1, top, figure("tether", m_moment.tetherLength, 1, "m"));
    canvas.put(
        25, top,
        QStringLiteral("100 %1%2 200 m").arg(QString(filled, QChar(0x2588)), QString(barWidth - filled, QChar(0x2591))),
        Style::Axis);
    canvas.put(29, top, QString(filled, QChar(0x2588)), Style::TrailNew);
    canvas.put(1, top + 1, figure("power", m_moment.power, 0, "W"));
    canvas.put(25, top + 1, figure("mean", meanPower, 0, "W"));
    canvas.put(49, top + 1, figure("energy", m_moment.energy * 1e-3, 1, "kJ"));
    canvas.put(1, top + 2, figure("altitude", m_moment.position.z(), 1, "m"));
    canvas.put(25, top + 2, figure("force", m_moment.tetherForce, 0, "N"));
    canvas.put(49, top + 2, figure("wind", m_moment.windVelocity.norm(), 1, "m/s"));
}

}  // namespace awe
