// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtGui/QIcon>

namespace qplc {

enum class LayoutIcon { Settings, Float, Dock, Maximize, Restore, Close, Add };

/// A line drawing in the colour of texts of the palette at the moment of painting: right in light
/// and dark, and sharp at every scale where the program has set Qt::AA_UseHighDpiPixmaps.
QIcon layoutIcon(LayoutIcon icon);

}  // namespace qplc
