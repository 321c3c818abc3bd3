// SPDX-License-Identifier: Apache-2.0
#include "QPlcTheme.h"

#include <array>

namespace {

using Curves = std::array<QRgb, 8>;

// Hues after Okabe and Ito, "Color Universal Design", 2008; lighter or darker as the background
// asks for contrast.
constexpr Curves curvesOnWhite
    = {0xff0072b2, 0xffd55e00, 0xff007a5a, 0xffb5548f, 0xff9a6b00, 0xff3a8fc4, 0xff5c5c5c, 0xff8c1c13};
constexpr Curves curvesOnBlack
    = {0xff56b4e9, 0xffe69f00, 0xff2fc49a, 0xffde8fc0, 0xfff0e442, 0xff7f9cff, 0xffc0c0c0, 0xffff7a59};

}  // namespace

QColor QPlcTheme::curve(int index) const
{
    const Curves &curves = isDark ? curvesOnBlack : curvesOnWhite;
    return QColor::fromRgb(curves[std::size_t(index) % curves.size()]);
}

Qt::PenStyle QPlcTheme::curveStyle(int index)
{
    constexpr std::array<Qt::PenStyle, 3> rounds = {Qt::SolidLine, Qt::DashLine, Qt::DotLine};
    return rounds[std::size_t(index) / curvesOnWhite.size() % rounds.size()];
}

QPalette QPlcTheme::palette() const
{
    QPalette palette(surface, window);
    palette.setColor(QPalette::Window, window);
    palette.setColor(QPalette::WindowText, text);
    palette.setColor(QPalette::Base, surface);
    palette.setColor(QPalette::AlternateBase, isDark ? surface.lighter(112) : surface.darker(103));
    palette.setColor(QPalette::Text, text);
    palette.setColor(QPalette::Button, isDark ? surface.lighter(125) : surface.darker(104));
    palette.setColor(QPalette::ButtonText, text);
    palette.setColor(QPalette::BrightText, alarm);
    palette.setColor(QPalette::ToolTipBase, surface);
    palette.setColor(QPalette::ToolTipText, text);
    palette.setColor(QPalette::PlaceholderText, mutedText);
    palette.setColor(QPalette::Highlight, accent);
    palette.setColor(QPalette::HighlightedText, isDark ? window : QColor(Qt::white));
    palette.setColor(QPalette::Link, accent);
    palette.setColor(QPalette::Mid, line);
    palette.setColor(QPalette::Dark, isDark ? window.darker(130) : line.darker(120));
    palette.setColor(QPalette::Light, isDark ? line : QColor(Qt::white));
    for (const QPalette::ColorRole role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
        palette.setColor(QPalette::Disabled, role, stale);
    return palette;
}
