// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QRect>

#include <algorithm>

namespace qplc {

/// \a geometry moved and made smaller so that a person sees all of it in \a room, the part of a
/// screen that windows may use.
inline QRect onScreen(const QRect &geometry, const QRect &room)
{
    QRect moved(geometry.topLeft(), geometry.size().boundedTo(room.size()));
    moved.moveLeft(std::clamp(moved.left(), room.left(), room.right() + 1 - moved.width()));
    moved.moveTop(std::clamp(moved.top(), room.top(), room.bottom() + 1 - moved.height()));
    return moved;
}

}  // namespace qplc
