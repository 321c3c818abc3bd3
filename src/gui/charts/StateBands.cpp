// SPDX-License-Identifier: Apache-2.0
#include "StateBands.h"

#include "gui/models/ValueFormat.h"

#include <QtGui/QFontMetricsF>
#include <QtGui/QPainter>

#include <qwt_scale_map.h>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr double textMargin = 4.0;     // [px] beside a name
constexpr double lineRoom = 4.0;       // [px] above and below a name, together
constexpr double gap = 1.0;            // [px] between strips
constexpr double leastText = 18.0;     // [px] with less there is no name
constexpr double colorOfLight = 0.35;  // share of the colour of a state, so that names are read
constexpr double colorOfDark = 0.45;
constexpr double markedShare = 0.4;    // of that colour, where values cannot be trusted
constexpr double markedHeight = 0.25;  // of the strip
constexpr int fewestLetters = 3;       // of a longer name, with the ellipsis
constexpr int bandDigits = 6;

QColor mixed(const QColor &color, const QColor &ground, double share)
{
    const auto part = [share](int of, int with) { return int(std::lround(share * of + (1.0 - share) * with)); };
    return {part(color.red(), ground.red()), part(color.green(), ground.green()), part(color.blue(), ground.blue())};
}

}  // namespace

StateBands::StateBands(const PastRows &rows, const QPlcValueNames &names, const QPlcTheme &theme)
    : m_rows(rows)
    , m_names(names)
    , m_theme(theme)
{
}

void StateBands::setPlace(int place, int count, Room room)
{
    m_place = place;
    m_count = std::max(count, 1);
    m_room = room;
}

double StateBands::lineHeight() const
{
    return QFontMetricsF(m_font).height() + lineRoom;
}

QRectF StateBands::strip(const QRectF &canvas) const
{
    if (m_room == AllHeight) {
        const auto topOf = [&](int place) { return std::round(canvas.top() + place * canvas.height() / m_count); };
        const double end = m_place + 1 < m_count ? topOf(m_place + 1) - gap : canvas.bottom();
        return {QPointF(canvas.left(), topOf(m_place)), QPointF(canvas.right(), end)};
    }
    const double height = std::min(lineHeight(), canvas.height() / m_count);
    const double bottom = canvas.bottom() - m_place * height;
    return {canvas.left(), bottom - height + gap, canvas.width(), height - gap};
}

/// States with names in the order of these; others by their value.
QColor StateBands::colorOf(double value) const
{
    return colorOf(value, 1.0);
}

/// \param share  of the colour of the state
QColor StateBands::colorOf(double value, double share) const
{
    const auto number = qint64(std::llround(value));
    const auto found = std::find_if(m_names.begin(), m_names.end(),
                                    [number](const QPlcValueNames::Entry &entry) { return entry.value == number; });
    const qint64 place = found != m_names.end() ? qint64(found - m_names.begin()) : m_names.size() + std::abs(number);
    constexpr int colors = 8;
    return mixed(m_theme.curve(int(place % colors)), m_theme.surface,
                 share * (m_theme.isDark ? colorOfDark : colorOfLight));
}

QString StateBands::textOf(float value) const
{
    return numberText(double(value), bandDigits, m_names);
}

void StateBands::draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap & /*yMap*/,
                      const QRectF &canvasRect) const
{
    if (!m_rows.store || m_rows.store->isEmpty())
        return;
    const double scale = std::max(1.0, painter->deviceTransform().m11());  // device pixels of a pixel
    const auto timeAt = [this](double x) { return m_origin + std::llround(x * 1e9); };
    const int columns = std::max(1, int(std::lround(xMap.pDist() * scale)));
    m_shape.read(*m_rows.store, m_rows.channel, TimeColumns(timeAt(xMap.s1()), timeAt(xMap.s2()), columns));
    m_runs.read(m_shape);
    const QRectF place = strip(canvasRect);
    // What holds up to the last column of the scale reaches the edge, which is a pixel behind it.
    const auto xOf = [&](int column) {
        return column < columns ? std::min(xMap.p1(), xMap.p2()) + column / scale : place.right();
    };
    const auto pieceOf = [&](int begin, int end) {
        const double left = std::max(xOf(begin), place.left());
        return QRectF(left, place.top(), std::min(xOf(end), place.right()) - left, place.height());
    };
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing, false);
    for (const StateRuns::Run &run : m_runs.runs()) {
        if (const QRectF piece = pieceOf(run.begin, run.end); piece.width() > 0.0)
            painter->fillRect(piece, colorOf(run.value));
    }
    for (const StateRuns::MarkedPart &part : m_runs.markedParts()) {
        const QRectF piece = pieceOf(part.begin, part.end);
        const double height = std::ceil(markedHeight * piece.height());
        if (piece.width() > 0.0)
            painter->fillRect(piece.adjusted(0.0, piece.height() - height, 0.0, 0.0), colorOf(part.value, markedShare));
    }
    const QFontMetricsF metrics(m_font);
    bool needsTitle = m_count > 1;
    painter->setFont(m_font);
    painter->setPen(m_theme.text);
    for (const StateRuns::Run &run : m_runs.runs()) {
        const QRectF piece = pieceOf(run.begin, run.end);
        if (piece.width() < leastText || piece.height() < metrics.ascent())
            continue;
        const QString text = needsTitle ? title().text() + QStringLiteral(": ") + textOf(run.value) : textOf(run.value);
        const QString shown = metrics.elidedText(text, Qt::ElideRight, piece.width() - 1.5 * textMargin);
        if (shown.size() < std::min(text.size(), fewestLetters))
            continue;
        needsTitle = false;
        painter->drawText(piece.adjusted(textMargin, 0.0, 0.0, 0.0), Qt::AlignLeft | Qt::AlignVCenter, shown);
    }
    for (const int spike : m_runs.spikes()) {
        const double x = xOf(spike);
        if (x >= place.left() && x < place.right())
            painter->fillRect(QRectF(x, place.top(), std::max(1.0, 1.0 / scale), place.height()), m_theme.text);
    }
    painter->restore();
}

}  // namespace qplc
