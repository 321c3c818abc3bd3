// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plot/TimeColumns.h"
#include "gui/store/SignalStore.h"

#include <algorithm>
#include <cstdint>

namespace qplc {

/// Answers whether a time plot would look different from when it was drawn last: only then is it
/// worth drawing.
///
/// Data come and go with each cycle, but a picture changes only when a column of pixels is
/// complete, the view or a cursor has moved by a pixel, or settings are others.
///
/// ```cpp
/// if (m_redraw.isDue({columns, oldest, newest, cursorA, cursorB, m_settingsVersion}))
///     m_plot->replot();
/// ```
class RedrawRule
{
public:
    struct Picture
    {
        static constexpr int noCursor = -1;

        TimeColumns columns;
        std::int64_t oldest = 0;  // column of the first row that is kept
        std::int64_t newest = 0;  // column of the last row; before oldest: there are no rows
        int cursorA = noCursor;   // [px]
        int cursorB = noCursor;
        std::uint64_t settings
            = 0;  // any number that changes with what else is seen: colours, gains, sizes, range of the y axis

        /// The picture of what is in a store.
        static Picture of(const SignalStore &store, const TimeColumns &columns)
        {
            Picture picture;
            picture.columns = columns;
            picture.oldest = store.isEmpty() ? 0 : columns.columnOf(store.time(store.firstRow()));
            picture.newest = store.isEmpty() ? -1 : columns.columnOf(store.time(store.endRow() - 1));
            return picture;
        }
    };

    /// Whether \a next differs from the picture that was due last, which it then becomes. The first
    /// picture is always due.
    bool isDue(const Picture &next)
    {
        const bool isSame = m_hasPicture && next.columns == m_last.columns && isEmpty(next) == isEmpty(m_last)
            && atEdge(next.oldest, next) == atEdge(m_last.oldest, next)
            && atEdge(next.newest, next) == atEdge(m_last.newest, next) && next.cursorA == m_last.cursorA
            && next.cursorB == m_last.cursorB && next.settings == m_last.settings;
        m_hasPicture = true;
        m_last = isSame ? m_last : next;
        return !isSame;
    }
    /// The next picture is due, whatever it is.
    void reset() { m_hasPicture = false; }

private:
    static bool isEmpty(const Picture &picture) { return picture.newest < picture.oldest; }
    /// All that is left of the view looks the same, as does all that is right of it.
    static std::int64_t atEdge(std::int64_t column, const Picture &picture)
    {
        return std::clamp(column, picture.columns.first() - 1, picture.columns.end());
    }

    Picture m_last;
    bool m_hasPicture = false;
};

}  // namespace qplc
