// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LayoutTarget.h"

#include <QtCore/QRect>
#include <QtCore/QSize>

#include <functional>

namespace qplc {

/// Where a new panel fits: beside one panel of the page, of which it takes as much as it wants and
/// at most the half.
///
/// All places at the right of and below a panel are compared. The best one gives the new panel
/// about the size that it wants, and leaves its neighbour enough.
/// \param page  place of the tree \a tree, in pixels
/// \param wanted  the size that the new panel wants, with its frame
/// \param wantedOf  the size that a panel of the tree wants
LayoutTarget fittingPlace(const LayoutNode &tree, const QSize &page, const QSize &wanted,
                          const std::function<QSize(const LayoutPanel &)> &wantedOf);

}  // namespace qplc
