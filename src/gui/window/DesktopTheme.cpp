// SPDX-License-Identifier: Apache-2.0
#include "DesktopTheme.h"

#ifdef QTPLC_HAS_DBUS
#include "ColorSchemePortal.h"
#endif

#include <QtCore/QEvent>
#include <QtCore/QPointer>
#include <QtWidgets/QApplication>

namespace qplc {

DesktopTheme *DesktopTheme::instance()
{
    static QPointer<DesktopTheme> theme;
    if (!theme)
        theme = new DesktopTheme(qApp);
    return theme;
}

DesktopTheme::DesktopTheme(QObject *parent)
    : QObject(parent)
    , m_theme(Theme::byName(Theme::System))
    , m_isPaletteDark(m_theme.isDark)
{
    m_soon.setSingleShot(true);
    connect(&m_soon, &QTimer::timeout, this, &DesktopTheme::readPalette);
    connect(qApp, &QGuiApplication::paletteChanged, this, &DesktopTheme::takePalette);
    qApp->installEventFilter(this);
#ifdef QTPLC_HAS_DBUS
    connect(new ColorSchemePortal(this), &ColorSchemePortal::told, this, [this](ColorSchemePortal::Scheme scheme) {
        m_isDarkByPortal.reset();
        if (scheme != ColorSchemePortal::NoPreference)
            m_isDarkByPortal = scheme == ColorSchemePortal::Dark;
        follow();
    });
#endif
}

void DesktopTheme::givePalette(const QPalette &palette)
{
    m_given = palette;
    m_isGiven = true;
    m_isGiving = true;
    QApplication::setPalette(palette);
    m_isGiving = false;
}

void DesktopTheme::takePalette(const QPalette &palette)
{
    if (m_isGiving)
        return;
    m_isPaletteDark = Theme::isDarkPalette(palette);
    follow();
}

bool DesktopTheme::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() == QEvent::ThemeChange)
        m_soon.start();
    return QObject::eventFilter(watched, event);
}

/// That of the desktop is behind the one that was given.
void DesktopTheme::readPalette()
{
    m_isGiving = true;
    QApplication::setPalette(QPalette());
    m_isPaletteDark = Theme::isDarkPalette(QApplication::palette());
    if (m_isGiven)
        QApplication::setPalette(m_given);
    m_isGiving = false;
    follow();
}

void DesktopTheme::follow()
{
    const bool isDarkNow = m_isDarkByPortal.value_or(m_isPaletteDark);
    m_theme = Theme::byName(isDarkNow ? Theme::Dark : Theme::Light);
    Q_EMIT changed();
}

}  // namespace qplc
