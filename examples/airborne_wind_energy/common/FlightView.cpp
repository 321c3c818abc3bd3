// SPDX-License-Identifier: Apache-2.0
#include "FlightView.h"

#include "AngleMath.h"

#include <algorithm>
#include <cmath>

namespace awe {

namespace {

constexpr double windTimeConstant = 20.0;  // of the direction that the window looks to [s]
constexpr int widest = 100;                // columns; more would only make the picture flat
constexpr int tallest = 44;                // rows
constexpr int axisWidth = 6;               // columns of "  90 ┤"
constexpr int narrowBelow = 76;            // columns: then figures stand closer
constexpr int textRows = 7;                // everything but the window and the plot
constexpr int plotRows = 7;                // of the plot, with its label
constexpr int fewestRows = 22;             // of a terminal that has room for the plot
constexpr double longestGap = 0.5;         // between two points that a line connects [s]

using Style = TerminalCanvas::Style;

/// The smallest of 1, 2, 5, 10, 20 ... that is at least \a value.
double niceLimit(double value)
{
    const double decade = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (value <= step * decade * (1.0 + 1e-9))
            return step * decade;
    }
    return 10.0 * decade;
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
        m_powers.clear();
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
    m_powers.push_back({moment.time, moment.power});
    while (m_powers.front().time < moment.time - plotDuration)
        m_powers.pop_front();
}

QStringList FlightView::draw(int columns, int rows) const
{
    TerminalCanvas canvas(std::min(columns, widest), std::min(rows, tallest));
    const int plot = canvas.rows() >= fewestRows ? plotRows : 0;
    const int window = canvas.rows() - textRows - plot;
    drawTitle(canvas);
    if (window >= 5)
        drawWindow(canvas, 2, window);
    if (plot > 0)
        drawPlot(canvas, window + 4, plot);
    drawFigures(canvas, window >= 5 ? window + 4 + plot : 1);
    return canvas.lines(m_hasColours);
}

void FlightView::drawTitle(TerminalCanvas &canvas) const
{
    const QString text = QStringLiteral("%1   %2").arg(timeText(m_moment, m_duration), phaseText(m_moment.phase));
    canvas.put(0, 0, text, Style::Title);
    if (m_moment.crashed)
        canvas.put(text.size() + 3, 0, QStringLiteral("CRASHED"), Style::Alarm);
}

/// Elevation 0 ... 90 deg over `height` rows, azimuth -60 ... 60 deg from downwind over the rest of
/// the width; beyond it the kite stands at the border.
void FlightView::drawWindow(TerminalCanvas &canvas, int top, int height) const
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
    canvas.put(0, top - 1, QStringLiteral("[deg]"), Style::Axis);
    for (const int elevation : {90, 60, 30, 0})
        canvas.put(0, row(elevation), QStringLiteral("%1 ┤").arg(elevation, 4), Style::Axis);
    for (const int azimuth : {60, 30, 0, -30, -60}) {
        const QString label
            = azimuth == 0 ? QStringLiteral("downwind") : QStringLiteral("%1 deg").arg(std::abs(azimuth));
        const int place = std::min(column(azimuth) - label.size() / 2, canvas.columns() - label.size());
        canvas.put(column(azimuth), top + height, QStringLiteral("┴"), Style::Axis);
        canvas.put(place, top + height + 1, label, Style::Axis);
    }

    drawTrail(canvas, top, height);
    if (!m_trail.empty())
        canvas.put(column(m_trail.back().azimuth), row(m_trail.back().elevation), QStringLiteral("◆"),
                   m_moment.crashed ? Style::Alarm : Style::Kite);
}

/// As drawWindow(), in dots.
void FlightView::drawTrail(TerminalCanvas &canvas, int top, int height) const
{
    const int width = canvas.columns() - axisWidth - 1;
    const auto x = [width](double azimuth) {
        const double column = axisWidth + std::clamp(0.5 - azimuth / 120.0, 0.0, 1.0) * (width - 1);
        return int(std::lround(TerminalCanvas::DotColumns * column + 0.5));
    };
    const auto y = [top, height](double elevation) {
        const double row = top + std::clamp(1.0 - elevation / 90.0, 0.0, 1.0) * (height - 1);
        return int(std::lround(TerminalCanvas::DotRows * row + 1.5));
    };
    for (std::size_t i = 0; i < m_trail.size(); ++i) {
        const TrailPoint &point = m_trail[i];
        const TrailPoint &before = m_trail[i > 0 && point.time - m_trail[i - 1].time <= longestGap ? i - 1 : i];
        const double age = (m_moment.time - point.time) / trailDuration;
        const Style style = age > 0.6 ? Style::TrailOld : age > 0.25 ? Style::TrailMiddle : Style::TrailNew;
        canvas.stroke(x(before.azimuth), y(before.elevation), x(point.azimuth), y(point.elevation), style);
    }
}

/// The power of the last minute, from the right to the left. \param height rows, the last one is
/// the label
void FlightView::drawPlot(TerminalCanvas &canvas, int top, int height) const
{
    constexpr double kilowatt = 1e3;
    const int width = canvas.columns() - axisWidth - 1;
    const int rows = height - 1;
    double lowest = 0.0, highest = 0.0;
    for (const PowerPoint &point : m_powers) {
        lowest = std::min(lowest, point.power);
        highest = std::max(highest, point.power);
    }
    const double upper = niceLimit(std::max(highest, kilowatt));
    const double lower = lowest < 0.0 ? -niceLimit(-lowest) : 0.0;
    const auto row = [&](double power) { return top + (upper - power) / (upper - lower) * (rows - 1); };

    for (int y = top; y < top + rows; ++y)
        canvas.put(axisWidth - 1, y, QStringLiteral("│"), Style::Axis);
    for (const double power : {upper, 0.0, lower})
        canvas.put(0, int(std::lround(row(power))), QStringLiteral("%1 ┤").arg(power / kilowatt, 4), Style::Axis);
    canvas.put(axisWidth, top + rows, QStringLiteral("power [kW], last %1 s").arg(plotDuration), Style::Axis);

    const auto x = [&](double time) {
        const double share = 1.0 - (m_moment.time - time) / plotDuration;
        return int(std::lround(TerminalCanvas::DotColumns * (axisWidth + share * (width - 1)) + 0.5));
    };
    const auto y = [&](double power) { return int(std::lround(TerminalCanvas::DotRows * row(power) + 1.5)); };
    for (std::size_t i = 0; i < m_powers.size(); ++i) {
        const PowerPoint &point = m_powers[i];
        const PowerPoint &before = m_powers[i > 0 && point.time - m_powers[i - 1].time <= longestGap ? i - 1 : i];
        canvas.stroke(x(before.time), y(before.power), x(point.time), y(point.power), Style::TrailNew);
    }
}

/// In three columns, closer to each other where the terminal is narrow.
void FlightView::drawFigures(TerminalCanvas &canvas, int top) const
{
    constexpr double shortest = 100.0, longest = 200.0;  // of the tether [m]
    constexpr int longestBar = 30;
    const bool isNarrow = canvas.columns() < narrowBelow;
    const int pitch = isNarrow ? 20 : 24;
    const int numberWidth = isNarrow ? 6 : 8;
    const int frame = 1 + pitch + 4 + 6;  // columns beside the bar
    const int barWidth = std::clamp(canvas.columns() - frame, 1, longestBar);
    const double share = std::clamp((m_moment.tetherLength - shortest) / (longest - shortest), 0.0, 1.0);
    const int filled = int(std::lround(share * barWidth));
    const double meanPower = m_moment.time > 0.0 ? m_moment.energy / m_moment.time : 0.0;
    const auto put = [&](int column, int row, const char *label, double value, int precision, const char *unit) {
        canvas.put(1 + column * pitch, top + row,
                   QStringLiteral("%1 %2 %3")
                       .arg(QString::fromLatin1(label), -8)
                       .arg(value, numberWidth, 'f', precision)
                       .arg(QString::fromLatin1(unit)));
    };
    put(0, 0, "tether", m_moment.tetherLength, 1, "m");
    canvas.put(
        1 + pitch, top,
        QStringLiteral("100 %1%2 200 m").arg(QString(filled, QChar(0x2588)), QString(barWidth - filled, QChar(0x2591))),
        Style::Axis);
    canvas.put(1 + pitch + 4, top, QString(filled, QChar(0x2588)), Style::TrailNew);
    put(0, 1, "power", m_moment.power, 0, "W");
    put(1, 1, "mean", meanPower, 0, "W");
    put(2, 1, "energy", m_moment.energy * 1e-3, 1, "kJ");
    put(0, 2, "altitude", m_moment.position.z(), 1, "m");
    put(1, 2, "force", m_moment.tetherForce, 0, "N");
    put(2, 2, "wind", m_moment.windVelocity.norm(), 1, "m/s");
}

}  // namespace awe
