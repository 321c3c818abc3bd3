// SPDX-License-Identifier: Apache-2.0
#include "gui/plot/PixelSpans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace qplc {

namespace {

constexpr int blockWidth = 16;  // columns
constexpr int leastCore = 16;   // rows: fewer are not worth rectangles of their own
constexpr int dotGrowth = 1;    // pixels to each side of a value that stands alone

}  // namespace

void PixelSpans::begin(const QRect &clip, int thickness)
{
    begin(clip, thickness, {});
}

void PixelSpans::begin(const QRect &clip, int thickness, const Dashes &dashes)
{
    m_clip = clip;
    m_dashes = dashes;
    m_before = (thickness - 1) / 2;
    m_behind = thickness / 2;
    m_spans.clear();
    m_lineBefore.reset();
    m_rectangles.clear();
    m_spans.reserve(std::size_t(clip.width() + 2 * thickness + 4));
    m_rectangles.reserve(3 * m_spans.capacity());  // a core and what is above and below it
}

void PixelSpans::moveTo(int x, int top, int bottom)
{
    m_lineBehind = Place{x, {top, bottom}};
    finishLine();
    m_x = x;
    m_spans.push_back({top, bottom});
}

void PixelSpans::include(int top, int bottom)
{
    Span &span = m_spans.back();
    span = {std::min(span.top, top), std::max(span.bottom, bottom)};
}

void PixelSpans::lineTo(int fromX, int fromY, int x, int y)
{
    // Columns that are not seen, not even by the thickness of the line: what is beyond them is left
    // out.
    const int unseenLeft = m_clip.left() - m_behind - 1;
    const int unseenRight = m_clip.right() + m_before + 1;
    if (fromX >= unseenRight)
        return;
    const double slope = x > fromX ? double(y - fromY) / (x - fromX) : 0.0;
    const auto edgeBehind = [=](int column) { return int(std::lround(fromY + slope * (column + 0.5 - fromX))); };
    const int first = std::clamp(unseenLeft, fromX, x);
    int edge = fromY;  // where the line enters the column
    if (first > fromX) {
        edge = edgeBehind(first - 1);
        m_x = first;
        m_spans.assign(1, {edge, edge});
    }
    const int last = std::min(x, unseenRight);
    for (int column = first; column < last; ++column) {
        const int nextEdge = edgeBehind(column);
        include(std::min(edge, nextEdge), std::max(edge, nextEdge));
        edge = nextEdge;
        m_spans.push_back({edge, edge});
    }
    if (last == x)
        include(std::min(edge, y), std::max(edge, y));
}

void PixelSpans::endLine()
{
    m_lineBehind.reset();
    finishLine();
}

void PixelSpans::finishLine()
{
    if (m_spans.empty())
        return;
    const Place end{m_x + int(m_spans.size()) - 1, m_spans.back()};
    if (isLonely())
        growDot();
    m_lineBefore = end;
    const int left = std::max(m_x - m_before, m_clip.left());
    const int right = std::min(m_x + int(m_spans.size()) - 1 + m_behind, m_clip.right());
    if (m_dashes.on > 0 && int(m_spans.size()) > m_dashes.on + m_dashes.off)
        emitDashed(left, right);
    else
        emitWhole(left, right);
    m_spans.clear();
}

void PixelSpans::emitWhole(int left, int right)
{
    for (int x = left; x <= right; x += blockWidth)
        emitBlock(x, std::min(x + blockWidth - 1, right));
}

bool PixelSpans::isOff(int x) const
{
    const int period = m_dashes.on + m_dashes.off;
    const int place = (x - m_dashes.first) % period;
    return (place < 0 ? place + period : place) >= m_dashes.on;
}

void PixelSpans::emitDashed(int left, int right)
{
    for (int x = left; x <= right; ++x) {
        const Span span = thickened(x - m_x);
        isOff(x) ? emitBetweenDashes(x, span) : emitSpan(x, span);
    }
}

void PixelSpans::emitBetweenDashes(int x, Span span)
{
    const Span seen{std::max(span.top, m_clip.top()), std::min(span.bottom, m_clip.bottom())};
    const int thickness = m_before + m_behind + 1;
    if (seen.bottom - seen.top < thickness + m_dashes.off)
        return;
    const int lastTop = seen.bottom - m_dashes.on + 1;
    for (int y = seen.top; y + m_dashes.on < lastTop; y += m_dashes.on + m_dashes.off)
        emitSpan(x, {y, y + m_dashes.on - 1});
    emitSpan(x, {std::max(lastTop, seen.top), seen.bottom});
}

/// Columns that have many rows in common get them as one rectangle: painters fill rows quicker than
/// columns.
void PixelSpans::emitBlock(int left, int right)
{
    std::array<Span, blockWidth> spans{};
    Span core{m_clip.top(), m_clip.bottom()};
    for (int x = left; x <= right; ++x) {
        const Span span = thickened(x - m_x);
        spans[std::size_t(x - left)] = span;
        core = {std::max(core.top, span.top), std::min(core.bottom, span.bottom)};
    }
    const bool hasCore = right > left && core.bottom - core.top >= leastCore;
    for (int x = left; x <= right; ++x) {
        const Span &span = spans[std::size_t(x - left)];
        emitSpan(x, {span.top, hasCore ? core.top - 1 : span.bottom});
    }
    if (!hasCore)
        return;
    m_rectangles.emplace_back(QPoint(left, core.top), QPoint(right, core.bottom));
    for (int x = left; x <= right; ++x)
        emitSpan(x, {core.bottom + 1, spans[std::size_t(x - left)].bottom});
}

/// A single pixel that touches no other line.
bool PixelSpans::isLonely() const
{
    const Span own = m_spans.front();
    const auto isTouching = [&](const std::optional<Place> &other) {
        const int reach = m_before + m_behind + 1;
        return other && std::abs(other->x - m_x) <= reach && other->span.top <= own.bottom + reach
            && other->span.bottom >= own.top - reach;
    };
    const bool isPixel = m_spans.size() == 1 && own.top == own.bottom;
    return isPixel && !isTouching(m_lineBefore) && !isTouching(m_lineBehind);
}

/// Nobody sees a single pixel.
void PixelSpans::growDot()
{
    m_x -= dotGrowth;
    const Span span{m_spans.front().top - dotGrowth, m_spans.front().bottom + dotGrowth};
    m_spans.assign(2 * dotGrowth + 1, span);
}

/// The span of a column counted from the first one, after each pixel has become a square.
PixelSpans::Span PixelSpans::thickened(int column) const
{
    const int from = std::max(column - m_behind, 0);
    const int to = std::min(column + m_before, int(m_spans.size()) - 1);
    Span all = m_spans[std::size_t(from)];
    for (int i = from + 1; i <= to; ++i) {
        const Span &span = m_spans[std::size_t(i)];
        all = {std::min(all.top, span.top), std::max(all.bottom, span.bottom)};
    }
    return {all.top - m_before, all.bottom + m_behind};
}

void PixelSpans::emitSpan(int x, Span span)
{
    const int top = std::max(span.top, m_clip.top());
    const int bottom = std::min(span.bottom, m_clip.bottom());
    if (top > bottom)
        return;
    if (!m_rectangles.empty()) {
        QRect &last = m_rectangles.back();
        if (last.right() == x - 1 && last.top() == top && last.bottom() == bottom) {
            last.setRight(x);
            return;
        }
    }
    m_rectangles.emplace_back(QPoint(x, top), QPoint(x, bottom));
}

}  // namespace qplc
