// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcTheme.h"

#include <QtCore/QString>

namespace qplc {

/// The look of a window: which one it is, and what only the window itself needs of it. A value
/// type.
struct Theme : QPlcTheme
{
    enum Name {
        System,  // Light or Dark, as the desktop is
        Light,
        Dark,
        Sunlight  // black on white, thick lines, for outdoors
    };

    static Theme byName(Name name);
    /// Whether texts of \a palette are light on dark.
    static bool isDarkPalette(const QPalette &palette);
    /// "Light"; for layouts on disk and menus.
    static QString nameText(Name name);
    /// System when \a text is none of them.
    static Name nameOf(const QString &text);

    /// The colour that says which plant a panel or the bar shows, behind text of the colour of the
    /// window. \param number Plant::number()
    QColor plant(int number) const { return curve(number); }
};

}  // namespace qplc
