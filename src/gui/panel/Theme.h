// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>
#include <QtGui/QColor>
#include <QtGui/QPalette>

namespace qplc {

/// The colours of a window. What is normal is grey; colour is for curves and for what is not normal, and never the only sign. A value type.
struct Theme
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

    /// The colour of curve \a index, 0 ...: eight that people with any colour vision tell apart, then again from the first one on.
    QColor curve(int index) const;
    /// The colour that says which plant a panel or the bar shows, behind text of the colour of the window. \param number  Plant::number()
    QColor plant(int number) const { return curve(number); }
    /// The line of curve \a index: solid for the first eight, then dashes, then dots, then solid again, so that 24 curves look different.
    static Qt::PenStyle curveStyle(int index);
    /// For QApplication::setPalette().
    QPalette palette() const;

    bool isDark = false;
    QColor window;   // behind panels
    QColor surface;  // of panels, plots, tables
    QColor text;
    QColor mutedText;  // units, labels, hints
    QColor line;       // grids, frames, separators
    QColor accent;     // what can be acted upon, focus, selection
    QColor good;
    QColor warning;
    QColor alarm;
    QColor stale;             // values that are no longer true
    QColor held;              // signals that a person has taken over
    double curveWidth = 1.5;  // [px]
};

}  // namespace qplc
