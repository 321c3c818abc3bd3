// SPDX-License-Identifier: Apache-2.0
#include "Theme.h"

#include <QtGui/QGuiApplication>

#include <array>

namespace qplc {

namespace {

Theme light()
{
    Theme theme;
    theme.window = 0xffe9ebee;
    theme.surface = 0xfffcfcfd;
    theme.text = 0xff1d2126;
    theme.mutedText = 0xff5d6670;
    theme.line = 0xffcdd2d8;
    theme.accent = 0xff1f6fb5;
    theme.good = 0xff1e7d46;
    theme.warning = 0xffa86400;
    theme.alarm = 0xffc3261f;
    theme.stale = 0xff8b939c;
    theme.held = 0xff8a3ea8;
    return theme;
}

Theme dark()
{
    Theme theme;
    theme.isDark = true;
    theme.window = 0xff1b1e22;
    theme.surface = 0xff24282d;
    theme.text = 0xffe4e7ea;
    theme.mutedText = 0xff9aa4ae;
    theme.line = 0xff3a4047;
    theme.accent = 0xff5aa9e6;
    theme.good = 0xff4cc38a;
    theme.warning = 0xfff2b134;
    theme.alarm = 0xffff6b62;
    theme.stale = 0xff7b848d;
    theme.held = 0xffc48be0;
    return theme;
}

Theme sunlight()
{
    Theme theme = light();
    theme.window = Qt::white;
    theme.surface = Qt::white;
    theme.text = Qt::black;
    theme.mutedText = 0xff2b2b2b;
    theme.line = 0xff7a7a7a;
    theme.accent = 0xff004a8f;
    theme.good = 0xff005c2a;
    theme.warning = 0xff7a4300;
    theme.alarm = 0xffa80000;
    theme.stale = 0xff5a5a5a;
    theme.held = 0xff5c1080;
    theme.curveWidth = 2.5;
    return theme;
}

constexpr std::array<const char *, 4> names = {"System", "Light", "Dark", "Sunlight"};

}  // namespace

Theme Theme::byName(Name name)
{
    switch (name) {
    case System:
        return isDarkPalette(QGuiApplication::palette()) ? dark() : light();
    case Light:
        return light();
    case Dark:
        return dark();
    case Sunlight:
        return sunlight();
    }
    return light();
}

bool Theme::isDarkPalette(const QPalette &palette)
{
    constexpr int middle = 128;
    return palette.color(QPalette::Window).lightness() < middle;
}

QString Theme::nameText(Name name)
{
    return QString::fromLatin1(names[std::size_t(name)]);
}

Theme::Name Theme::nameOf(const QString &text)
{
    for (std::size_t each = 0; each < names.size(); ++each) {
        if (text == QLatin1String(names[each]))
            return Name(each);
    }
    return System;
}

}  // namespace qplc
