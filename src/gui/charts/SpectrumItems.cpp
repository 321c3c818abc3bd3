// SPDX-License-Identifier: Apache-2.0
#include "SpectrumItems.h"

#include <QtGui/QImage>
#include <QtGui/QPainter>
#include <QtGui/QPen>

#include <qwt_scale_map.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace qplc {

namespace {

constexpr double farAway = 1e5;  // [px] that a painter draws to

/// Values that a logarithmic axis cannot show are far below.
double placeOf(const QwtScaleMap &map, double value)
{
    const bool isLog = map.transformation() != nullptr;
    if (isLog && !(value > 0.0))
        return map.p1() > map.p2() ? farAway : -farAway;
    return std::clamp(map.transform(value), -farAway, farAway);
}

}  // namespace

SpectrumCurve::SpectrumCurve(Spectrum::Lines lines)
    : m_lines(std::move(lines))
{
    setZ(20.0);
}

void SpectrumCurve::setLook(const QColor &color, double width)
{
    m_color = color;
    m_width = width;
}

/// The lowest and the highest line of each pixel, in their order.
QPolygonF SpectrumCurve::shape(const QwtScaleMap &xMap, const QwtScaleMap &yMap) const
{
    QPolygonF points;
    const std::vector<double> &values = m_lines.values;
    const std::size_t count = values.size();
    const double step = m_lines.step;
    if (count == 0 || !(step > 0.0))
        return points;
    const bool isLog = xMap.transformation() != nullptr;
    const auto first = std::size_t(std::clamp(std::floor(xMap.s1() / step), isLog ? 1.0 : 0.0, double(count)));
    const auto behind = std::size_t(std::clamp(std::ceil(xMap.s2() / step) + 1.0, 0.0, double(count)));
    std::size_t low = first;
    std::size_t high = first;
    double pixel = -farAway;
    const auto flush = [&] {
        for (const std::size_t line : {std::min(low, high), std::max(low, high)}) {
            const QPointF point(xMap.transform(double(line) * step), placeOf(yMap, values[line]));
            if (points.isEmpty() || points.last() != point)
                points.append(point);
        }
    };
    for (std::size_t line = first; line < behind; ++line) {
        const double here = std::floor(xMap.transform(double(line) * step));
        if (here != pixel) {
            if (line != first)
                flush();
            pixel = here;
            low = high = line;
        } else {
            low = values[line] < values[low] ? line : low;
            high = values[line] > values[high] ? line : high;
        }
    }
    if (first < behind)
        flush();
    return points;
}

void SpectrumCurve::draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
                         const QRectF & /*canvas*/) const
{
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(QPen(m_color, m_width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter->drawPolyline(shape(xMap, yMap));
}

// ---- spectrogram ----

SpectrogramItem::SpectrogramItem(Spectrum::Picture picture)
    : m_picture(std::move(picture))
{
    setZ(5.0);  // below the grid
}

const QVector<SpectrogramItem::Stop> &SpectrogramItem::colors()
{
    static const QVector<Stop> stops{{0.0, QColor(12, 16, 48)},
                                     {0.25, QColor(44, 52, 140)},
                                     {0.5, QColor(28, 126, 156)},
                                     {0.75, QColor(98, 194, 112)},
                                     {1.0, QColor(252, 238, 120)}};
    return stops;
}

double SpectrogramItem::columnAt(double time) const
{
    return (time - m_picture.begin) / m_picture.duration;
}

/// A line is in the middle of its frequencies.
double SpectrogramItem::lineAt(double frequency) const
{
    return frequency / m_picture.step + 0.5;
}

namespace {

std::array<QRgb, 256> colorTable()
{
    std::array<QRgb, 256> table{};
    const QVector<SpectrogramItem::Stop> &stops = SpectrogramItem::colors();
    int stop = 0;
    for (int i = 0; i < int(table.size()); ++i) {
        const double place = double(i) / double(table.size() - 1);
        while (stop + 2 < stops.size() && place > stops[stop + 1].place)
            ++stop;
        const SpectrogramItem::Stop &low = stops[stop];
        const SpectrogramItem::Stop &high = stops[stop + 1];
        const double share = (place - low.place) / (high.place - low.place);
        const auto mixed = [share](int a, int b) { return int(std::lround(a + share * (b - a))); };
        table[std::size_t(i)]
            = qRgb(mixed(low.color.red(), high.color.red()), mixed(low.color.green(), high.color.green()),
                   mixed(low.color.blue(), high.color.blue()));
    }
    return table;
}

}  // namespace

/// The lines, or columns, that each pixel has a part of.
QVector<SpectrogramItem::Span> SpectrogramItem::spans(const QwtScaleMap &map, double begin, double pixels, double ratio,
                                                      bool areLines) const
{
    const std::size_t count = areLines ? m_picture.lines : m_picture.columns;
    const auto numberAt = [&](double place) {
        const double value = map.invTransform(begin + place / ratio);
        return areLines ? lineAt(value) : columnAt(value);
    };
    QVector<Span> spans(int(std::ceil(pixels * ratio)));
    for (int pixel = 0; pixel < spans.size(); ++pixel) {
        const double one = numberAt(pixel);
        const double other = numberAt(pixel + 1);
        const double low = std::floor(std::min(one, other));
        const double high = std::max(std::ceil(std::max(one, other)), low + 1.0);
        const auto inside = [count](double number) { return std::size_t(std::clamp(number, 0.0, double(count))); };
        spans[pixel] = {inside(low), inside(high)};
    }
    return spans;
}

void SpectrogramItem::draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
                           const QRectF &canvas) const
{
    if (m_picture.columns == 0 || !(m_picture.highest > 0.0F))
        return;
    static const std::array<QRgb, 256> table = colorTable();
    const double ratio = painter->device()->devicePixelRatioF();
    const QVector<Span> columns = spans(xMap, canvas.left(), canvas.width(), ratio, false);
    const QVector<Span> lines = spans(yMap, canvas.top(), canvas.height(), ratio, true);
    QImage image(columns.size(), lines.size(), QImage::Format_ARGB32);
    image.fill(Qt::transparent);
    const double low = std::log10(double(m_picture.lowest));
    const double decades = std::max(std::log10(double(m_picture.highest)) - low, 1e-6);
    for (int y = 0; y < lines.size(); ++y) {
        auto *pixels = reinterpret_cast<QRgb *>(image.scanLine(y));
        for (int x = 0; x < columns.size(); ++x) {
            float greatest = -1.0F;
            for (std::size_t column = columns[x].begin; column < columns[x].end; ++column)
                for (std::size_t line = lines[y].begin; line < lines[y].end; ++line)
                    greatest = std::max(greatest, m_picture.at(column, line));
            if (greatest < 0.0F)
                continue;
            const double place = greatest > 0.0F ? (std::log10(double(greatest)) - low) / decades : 0.0;
            pixels[x] = table[std::size_t(std::lround(std::clamp(place, 0.0, 1.0) * 255.0))];
        }
    }
    image.setDevicePixelRatio(ratio);
    painter->drawImage(canvas.topLeft(), image);
}

// ---- cursor ----

SpectrumCursor::SpectrumCursor()
{
    setZ(40.0);
}

void SpectrumCursor::place(std::optional<double> frequency, bool isUpright)
{
    m_frequency = frequency;
    m_isUpright = isUpright;
}

void SpectrumCursor::draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
                          const QRectF &canvas) const
{
    if (!m_frequency)
        return;
    painter->setPen(QPen(m_color, 1.0));
    if (m_isUpright) {
        const double x = placeOf(xMap, *m_frequency);
        painter->drawLine(QPointF(x, canvas.top()), QPointF(x, canvas.bottom()));
    } else {
        const double y = placeOf(yMap, *m_frequency);
        painter->drawLine(QPointF(canvas.left(), y), QPointF(canvas.right(), y));
    }
}

}  // namespace qplc
