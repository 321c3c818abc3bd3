// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/Theme.h"

#include <QtCore/QObject>
#include <QtCore/QTimer>

#include <optional>

namespace qplc {

/// The theme of the desktop, light or dark, as it is now: its settings portal tells it where there
/// is one, else its palette. One for all windows of the program, which give their own palettes to
/// the application.
///
/// Threads: that of the windows.
class DesktopTheme : public QObject
{
    Q_OBJECT
public:
    /// Made by the first window, before it changes the palette; lives as long as the application.
    static DesktopTheme *instance();

    const Theme &theme() const { return m_theme; }
    /// What windows use in place of QApplication::setPalette(): a palette that anybody else gives
    /// the application is one of the desktop.
    void givePalette(const QPalette &palette);

Q_SIGNALS:
    void changed();

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    explicit DesktopTheme(QObject *parent);
    void takePalette(const QPalette &palette);
    void readPalette();
    void follow();

    Theme m_theme;
    bool m_isPaletteDark = false;
    std::optional<bool> m_isDarkByPortal;
    QPalette m_given;
    bool m_isGiven = false;
    bool m_isGiving = false;
    QTimer m_soon;  // a change is told to each of the windows
};

}  // namespace qplc
