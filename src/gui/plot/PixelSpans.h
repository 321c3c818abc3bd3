// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QRect>

#include <optional>
#include <vector>

namespace qplc {

/// Turns a curve into filled rectangles of device pixels: one vertical span for each column, all of
/// a line touching each other; equal neighbours are one rectangle.
///
/// Rectangles are what a raster painter fills fastest, and thick lines cost as little as thin ones:
/// each span grows by the thickness, so no pixel is filled twice.
class PixelSpans
{
public:
    /// What of a line is drawn: \a on columns, then \a off columns not, and so on, beginning at
    /// column \a first.
    struct Dashes
    {
        int on = 0;  // [px]; 0: all of it
        int off = 0;
        int first = 0;
    };

    /// Begins a new curve. \param clip  what is seen [px]
    /// \param thickness  of the line [px], >= 1
    void begin(const QRect &clip, int thickness);
    /// The same as dashes. What goes up and down between two dashes is drawn as dashes on top of
    /// each other, from end to end, so that no peak is lost; a line shorter than a dash and a pause
    /// is whole.
    void begin(const QRect &clip, int thickness, const Dashes &dashes);
    /// Begins a line at column \a x, with all pixels of it from \a top to \a bottom.
    void moveTo(int x, int top, int bottom);
    /// Goes straight from (\a fromX, \a fromY), which belongs to the line, to (\a x, \a y), which
    /// does from now on. \pre fromX <= x
    void lineTo(int fromX, int fromY, int x, int y);
    /// Adds pixels to the last column of the line.
    void include(int top, int bottom);
    /// Ends the line, if there is one. A line of one pixel becomes a dot of three by three, unless
    /// it touches the line before or the one that begins next: a gap too short to be seen is none.
    void endLine();

    const std::vector<QRect> &rectangles() const { return m_rectangles; }

private:
    struct Span
    {
        int top;
        int bottom;
    };
    /// A span and its column.
    struct Place
    {
        int x;
        Span span;
    };

    bool isLonely() const;
    void finishLine();
    void growDot();
    Span thickened(int column) const;
    void emitWhole(int left, int right);
    void emitBlock(int left, int right);
    void emitDashed(int left, int right);
    void emitBetweenDashes(int x, Span span);
    bool isOff(int x) const;
    void emitSpan(int x, Span span);

    QRect m_clip;
    Dashes m_dashes;
    int m_before = 0;  // pixels that a line is thicker to the left and to the top
    int m_behind = 0;  // and to the right and to the bottom
    int m_x = 0;       // column of the first span
    std::vector<Span> m_spans;
    std::optional<Place> m_lineBefore;  // where it ended
    std::optional<Place> m_lineBehind;  // where it begins
    std::vector<QRect> m_rectangles;
};

}  // namespace qplc
