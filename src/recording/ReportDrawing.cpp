// SPDX-License-Identifier: Apache-2.0
#include "ReportDrawing.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr double Width = 720.0;
constexpr double Height = 200.0;
constexpr double Left = 76.0;
constexpr double Right = 10.0;
constexpr double Top = 8.0;
constexpr double Bottom = 26.0;
constexpr double CountHeight = 12.0;  // of the count above a bar
constexpr double BorderWidth = 76.0;  // of a border below the bars, with some room
constexpr int Curves = 6;             // colours

/// A round distance of some \a count ticks.
double tickStep(double span, int count)
{
    const double rough = span / count;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double digit = rough / power;
    return power * (digit <= 1.0 ? 1.0 : digit <= 2.0 ? 2.0 : digit <= 5.0 ? 5.0 : 10.0);
}

QByteArray coordinate(double value)
{
    return QByteArray::number(value, 'f', 1);
}

QByteArray line(double x1, double y1, double x2, double y2)
{
    return "<line x1=\"" + coordinate(x1) + "\" y1=\"" + coordinate(y1) + "\" x2=\"" + coordinate(x2) + "\" y2=\""
        + coordinate(y2) + "\"/>";
}

QByteArray text(double x, double y, const char *anchor, const QString &content)
{
    return "<text x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) + "\" text-anchor=\"" + anchor + "\">"
        + content.toHtmlEscaped().toUtf8() + "</text>";
}

/// Places of values on an axis.
struct Axis
{
    double low;
    double high;
    double from;  // place of low
    double to;

    double at(double value) const { return from + (value - low) / (high - low) * (to - from); }
};

/// With some room around the values.
Axis axisOf(const ReportPlot &plot)
{
    overview::Bucket all;
    for (const auto &curve : plot.curves) {
        for (const overview::Bucket &bucket : curve) {
            if (std::isfinite(bucket.minimum) && std::isfinite(bucket.maximum))
                all.add(bucket);
        }
    }
    const double span = all.maximum - all.minimum;
    const double room = span > 0.0 ? 0.05 * span : std::max(std::abs(all.maximum) * 0.05, 1.0);
    return {all.minimum - room, all.maximum + room, Height - Bottom, Top};
}

/// Lines of times above \a bottom, and their labels below it.
void addTimes(const Axis &x, double bottom, QByteArray *grid, QByteArray *labels)
{
    const bool isHours = x.high - x.low > 2 * 3600.0;
    const bool isMinutes = !isHours && x.high - x.low > 300.0;
    const double unit = isHours ? 3600.0 : isMinutes ? 60.0 : 1.0;
    const double horizontal = tickStep((x.high - x.low) / unit, 6) * unit;
    for (double value = std::ceil(x.low / horizontal) * horizontal; value <= x.high; value += horizontal) {
        *grid += line(x.at(value), Top, x.at(value), bottom);
        const bool isLast = value + horizontal > x.high;
        const QString name = isLast ? isHours ? QStringLiteral(" h")
                : isMinutes                   ? QStringLiteral(" min")
                                              : QStringLiteral(" s")
                                    : QString();
        *labels += text(x.at(value), bottom + 19, "middle", shortNumber(value / unit) + name);
    }
}

QByteArray gridOf(const Axis &x, const Axis &y)
{
    QByteArray grid = "<g class=\"grid\">";
    QByteArray labels = "<g class=\"label\">";
    const double vertical = tickStep(y.high - y.low, 5);
    for (double value = std::ceil(y.low / vertical) * vertical; value <= y.high; value += vertical) {
        grid += line(Left, y.at(value), Width - Right, y.at(value));
        const double rounded = std::abs(value) < 1e-9 * vertical ? 0.0 : value;
        labels += text(Left - 6, y.at(value) + 5, "end", shortNumber(rounded));
    }
    addTimes(x, Height - Bottom, &grid, &labels);
    return grid + "</g>" + labels + "</g>";
}

/// A band from smallest to largest values, cut where there are none.
QByteArray pathOf(const std::vector<overview::Bucket> &curve, const Axis &x, const Axis &y)
{
    QByteArray path;
    QByteArray back;
    const double width = (x.high - x.low) / double(curve.size());
    for (std::size_t i = 0; i <= curve.size(); ++i) {
        const bool isThere = i < curve.size() && (curve[i].flags & overview::HasValue)
            && std::isfinite(curve[i].minimum) && std::isfinite(curve[i].maximum);
        if (!isThere) {
            // Between two cycles there may be intervals without any: only long pauses are cut.
            const bool ends = i == curve.size() || (i > 0 && i + 1 < curve.size() && curve[i].flags != 0);
            if (ends && !back.isEmpty()) {
                path += back + 'Z';
                back.clear();
            }
            continue;
        }
        const QByteArray place = coordinate(x.at(x.low + (double(i) + 0.5) * width));
        path += (back.isEmpty() ? 'M' : 'L') + place + ' ' + coordinate(y.at(curve[i].maximum));
        back.prepend('L' + place + ' ' + coordinate(y.at(curve[i].minimum)));
    }
    return path;
}

}  // namespace

QString shortNumber(double number)
{
    return QString::number(number, 'g', 5);
}

QString shortDuration(double seconds)
{
    const double size = std::abs(seconds);
    if (size >= 1.0 || size == 0.0)
        return QStringLiteral("%1 s").arg(shortNumber(seconds));
    if (size >= 1e-3)
        return QStringLiteral("%1 ms").arg(QString::number(seconds * 1e3, 'g', 3));
    return QStringLiteral("%1 us").arg(QString::number(seconds * 1e6, 'g', 3));
}

QByteArray drawingOf(const ReportPlot &plot)
{
    const Axis x{plot.begin, std::max(plot.end, plot.begin + 1e-9), Left, Width - Right};
    const Axis y = axisOf(plot);
    QByteArray drawing = "<figure><figcaption>" + plot.title.toHtmlEscaped().toUtf8();
    for (int i = 0; i < plot.names.size() && plot.names.size() > 1; ++i)
        drawing += " <span class=\"c" + QByteArray::number(i % Curves) + "\">"
            + plot.names.at(i).toHtmlEscaped().toUtf8() + "</span>";
    drawing += "</figcaption><svg viewBox=\"0 0 " + QByteArray::number(int(Width)) + ' '
        + QByteArray::number(int(Height)) + "\" role=\"img\" aria-label=\"" + plot.title.toHtmlEscaped().toUtf8()
        + "\">" + gridOf(x, y);
    for (std::size_t i = 0; i < plot.curves.size(); ++i)
        drawing += "<path class=\"curve c" + QByteArray::number(int(i) % Curves) + "\" d=\""
            + pathOf(plot.curves[i], x, y) + "\"/>";
    return drawing + "</svg></figure>\n";
}

namespace {

/// Intervals that follow each other with the same state.
struct Piece
{
    std::size_t begin;
    std::size_t end;
    double state;  // NaN: several
};

/// Intervals without cycles go on with the state before, as between two cycles.
std::vector<Piece> piecesOf(const std::vector<overview::Bucket> &intervals)
{
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < intervals.size(); ++i) {
        const overview::Bucket &interval = intervals[i];
        const bool isLast = !pieces.empty() && pieces.back().end == i;
        if ((interval.flags & overview::HasValue) == 0) {
            if (interval.flags == 0 && isLast)
                ++pieces.back().end;
            continue;
        }
        const double state = interval.minimum == interval.maximum ? interval.minimum : std::nan("");
        const bool isSame
            = isLast && (pieces.back().state == state || (std::isnan(pieces.back().state) && std::isnan(state)));
        if (isSame)
            ++pieces.back().end;
        else
            pieces.push_back({i, i + 1, state});
    }
    return pieces;
}

}  // namespace

QByteArray drawingOf(const ReportStates &states)
{
    constexpr double bottom = Top + 34.0;
    constexpr double signWidth = 8.5;  // of the labels
    const Axis x{states.begin, std::max(states.end, states.begin + 1e-9), Left, Width - Right};
    const double width = (x.to - x.from) / double(std::max<std::size_t>(states.intervals.size(), 1));
    QByteArray grid;
    QByteArray labels;
    addTimes(x, bottom, &grid, &labels);
    QByteArray strip;
    for (const Piece &piece : piecesOf(states.intervals)) {
        const double left = x.from + double(piece.begin) * width;
        const double length = double(piece.end - piece.begin) * width;
        const bool isState = !std::isnan(piece.state);
        const int color = isState ? int(std::fmod(std::fabs(piece.state), double(Curves))) : 0;
        strip += "<rect class=\"state " + (isState ? "c" + QByteArray::number(color) : QByteArray("several"))
            + "\" x=\"" + coordinate(left) + "\" y=\"" + coordinate(Top) + "\" width=\"" + coordinate(length)
            + "\" height=\"" + coordinate(bottom - Top) + "\"/>";
        const QString name = isState ? states.nameOf(piece.state) : QString();
        if (isState && length > signWidth * (name.size() + 1))
            labels += text(left + length / 2, (Top + bottom) / 2 + 5, "middle", name);
    }
    const QByteArray title = states.title.toHtmlEscaped().toUtf8();
    return "<figure><figcaption>" + title + "</figcaption><svg viewBox=\"0 0 " + QByteArray::number(int(Width)) + ' '
        + QByteArray::number(int(bottom + Bottom)) + "\" role=\"img\" aria-label=\"" + title + "\">" + strip
        + "<g class=\"grid\">" + grid + "</g><g class=\"label\">" + labels + "</g></svg></figure>\n";
}

double LatenessHistogram::border(int range)
{
    return 100.0 * std::pow(10.0, double(range) / RangesOfADecade);
}

void LatenessHistogram::add(std::int64_t lateness, std::uint64_t cycles)
{
    const double decades = lateness > 100 ? std::log10(double(lateness) / 100.0) : 0.0;
    counts[std::min(int(decades * RangesOfADecade), Ranges - 1)] += cycles;
    count += cycles;
    most = std::max(most, lateness);
}

std::int64_t LatenessHistogram::quantile(double part) const
{
    std::uint64_t below = 0;
    for (int range = 0; range < Ranges; ++range) {
        below += counts[range];
        if (double(below) >= part * double(count))
            return std::min(most, std::int64_t(border(range + 1)));
    }
    return most;
}

QByteArray drawingOf(const LatenessHistogram &histogram)
{
    int first = 0;
    int last = LatenessHistogram::Ranges - 1;
    while (first < last && histogram.counts[first] == 0)
        ++first;
    while (last > first && histogram.counts[last] == 0)
        --last;
    const double width = (Width - Left - Right) / (last - first + 1);
    constexpr double highest = Height - Top - CountHeight - Bottom;
    const auto high
        = std::log10(double(*std::max_element(histogram.counts, histogram.counts + LatenessHistogram::Ranges))) + 0.3;
    QByteArray bars = "<g class=\"c0 bar\">";
    QByteArray labels = "<g class=\"label\">";
    for (int range = first; range <= last; ++range) {
        const double x = Left + (range - first) * width;
        const int behindDecade = range % LatenessHistogram::RangesOfADecade;
        const bool hasRoom = (LatenessHistogram::RangesOfADecade - behindDecade) * width >= BorderWidth;
        if (behindDecade == 0 || (range == first && hasRoom))
            labels += text(x, Height - Bottom + 19, x + BorderWidth > Width ? "end" : "start",
                           shortDuration(1e-9 * LatenessHistogram::border(range)));
        if (histogram.counts[range] == 0)
            continue;
        const double y = std::max(1.0, (std::log10(double(histogram.counts[range])) + 0.3) / high * highest);
        bars += "<rect x=\"" + coordinate(x + 0.5) + "\" y=\"" + coordinate(Height - Bottom - y) + "\" width=\""
            + coordinate(std::max(width - 1.0, 1.0)) + "\" height=\"" + coordinate(y) + "\"/>";
        if (width > 24.0)
            labels += text(x + width / 2, Height - Bottom - y - 3, "middle",
                           QString::number(qulonglong(histogram.counts[range])));
    }
    return "<figure><figcaption>Cycles by lateness, logarithmic</figcaption><svg viewBox=\"0 0 "
        + QByteArray::number(int(Width)) + " " + QByteArray::number(int(Height))
        + "\" role=\"img\" aria-label=\"Cycles by lateness\">" + bars + "</g>" + labels + "</g></svg></figure>\n";
}

}  // namespace qplc
