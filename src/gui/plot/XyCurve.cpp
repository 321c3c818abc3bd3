// SPDX-License-Identifier: Apache-2.0
#include "XyCurve.h"

#include <QtGui/QPainter>

#include <qwt_scale_map.h>

#include <cmath>

namespace qplc {

using Row = SignalStore::Row;

namespace {

constexpr double dotRadius = 4.5;  // [px]
constexpr double farthest = 1e6;   // [px], lest painters count beyond their numbers

QPointF pixelOf(const QwtScaleMap &xMap, const QwtScaleMap &yMap, double x, double y)
{
    return {std::fmax(std::fmin(xMap.transform(x), farthest), -farthest),
            std::fmax(std::fmin(yMap.transform(y), farthest), -farthest)};
}

/// Reads one channel at the times of another one, which go up.
class Follower
{
public:
    explicit Follower(const QPlcPast &past)
        : m_rows(PastRows::of(past))
        , m_row(m_rows.store->firstRow())
    {
    }
    /// NaN where there is no row of just this time, or no value that its writer gave.
    float at(SignalStore::Time time)
    {
        const SignalStore &store = *m_rows.store;
        if (m_row >= store.endRow() || store.time(m_row) != time)
            m_row = store.rowAt(time, m_row);
        const bool isThere = m_row < store.endRow() && store.time(m_row) == time;
        return isThere ? store.writtenValue(m_rows.channel, m_row++) : NAN;
    }

private:
    PastRows m_rows;
    Row m_row;
};

}  // namespace

XyCurve::XyCurve(const QPlcPast &x, const QPlcPast &y, const QString &title)
    : QwtPlotItem(QwtText(title))
    , m_x(x)
    , m_y(y)
{
    setZ(20.0);
}

void XyCurve::setTimes(Time begin, Time end)
{
    m_begin = begin;
    m_end = end;
}

void XyCurve::setDot(std::optional<Time> time, const QColor &color)
{
    m_dotTime = time;
    m_dotColor = color;
}

QPlcPast::Range XyCurve::rangeOf(const QPlcPast &past) const
{
    return past.range(past.rowAt(m_begin), past.rowAt(m_end + 1));
}

QPointF XyCurve::dot() const
{
    const auto [rows, channel] = PastRows::of(m_x);
    const SignalStore &store = *rows;
    const std::optional<Row> row = m_dotTime ? store.rowHoldingAt(*m_dotTime) : store.newestRow();
    if (!row)
        return {NAN, NAN};
    return {double(store.writtenValue(channel, *row)), double(Follower(m_y).at(store.time(*row)))};
}

void XyCurve::readPath(const QwtScaleMap &xMap, const QwtScaleMap &yMap) const
{
    m_shape.clear();
    const auto [rows, channel] = PastRows::of(m_x);
    const SignalStore &store = *rows;
    Follower follower(m_y);
    const Row end = store.rowAt(m_end + 1);
    for (Row row = store.rowAt(m_begin); row < end; ++row) {
        const auto x = double(store.writtenValue(channel, row));
        const auto y = double(follower.at(store.time(row)));
        const bool isPair = !std::isnan(x) && !std::isnan(y);
        if (!isPair || store.beginsAnew(row))
            m_shape.interrupt();
        if (isPair)
            m_shape.add(pixelOf(xMap, yMap, x, y));
    }
}

void XyCurve::draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap, const QRectF & /*canvas*/) const
{
    readPath(xMap, yMap);
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(QPen(m_color, m_lineWidth, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    for (const std::vector<QPointF> &piece : m_shape.finish()) {
        if (piece.size() == 1)
            painter->drawPoint(piece.front());
        else
            painter->drawPolyline(piece.data(), int(piece.size()));
    }
    const QPointF at = dot();
    if (std::isnan(at.x()) || std::isnan(at.y()))
        return;
    painter->setPen(QPen(m_dotColor.lightness() < 128 ? Qt::white : Qt::black, 1.0));
    painter->setBrush(m_dotColor);
    painter->drawEllipse(pixelOf(xMap, yMap, at.x(), at.y()), dotRadius, dotRadius);
}

}  // namespace qplc
