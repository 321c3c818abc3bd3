// SPDX-License-Identifier: Apache-2.0
#include "gui/panel/Theme.h"

#include <QtTest/QtTest>

#include <cmath>

using namespace qplc;

namespace {

/// Relative luminance and contrast as in WCAG 2.1.
double luminance(const QColor &color)
{
    const auto linear
        = [](double value) { return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4); };
    return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) + 0.0722 * linear(color.blueF());
}

double contrast(const QColor &a, const QColor &b)
{
    const double la = luminance(a);
    const double lb = luminance(b);
    return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

}  // namespace

class tst_Theme : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void textsStandOutFromTheirBackground_data();
    void textsStandOutFromTheirBackground();
    void curveColoursAreDistinctAndVisible_data() { textsStandOutFromTheirBackground_data(); }
    void curveColoursAreDistinctAndVisible();
    void lineStyleDistinguishesCurvesOfOneColour();
    void namesAreConvertedToTextAndBack();
    void theSystemThemeIsOneOfTheOthers();
};

void tst_Theme::textsStandOutFromTheirBackground_data()
{
    QTest::addColumn<int>("name");
    for (const Theme::Name name : {Theme::Light, Theme::Dark, Theme::Sunlight})
        QTest::newRow(qPrintable(Theme::nameText(name))) << int(name);
}

void tst_Theme::textsStandOutFromTheirBackground()
{
    QFETCH(int, name);
    const Theme theme = Theme::byName(Theme::Name(name));
    const double least = name == Theme::Sunlight ? 7.0 : 4.5;
    for (const QColor &text :
         {theme.text, theme.mutedText, theme.accent, theme.good, theme.warning, theme.alarm, theme.held}) {
        QVERIFY2(contrast(text, theme.surface) >= least,
                 qPrintable(QStringLiteral("%1: %2").arg(text.name()).arg(contrast(text, theme.surface))));
    }
    QVERIFY(contrast(theme.text, theme.window) >= 7.0);
    QVERIFY(contrast(theme.stale, theme.surface) >= 3.0);
}

void tst_Theme::curveColoursAreDistinctAndVisible()
{
    QFETCH(int, name);
    const Theme theme = Theme::byName(Theme::Name(name));
    for (int i = 0; i < 8; ++i) {
        QVERIFY2(contrast(theme.curve(i), theme.surface) >= 3.0,
                 qPrintable(
                     QStringLiteral("%1: %2").arg(theme.curve(i).name()).arg(contrast(theme.curve(i), theme.surface))));
        for (int j = 0; j < i; ++j)
            QVERIFY(theme.curve(i) != theme.curve(j));
    }
    QCOMPARE(theme.curve(8), theme.curve(0));
}

void tst_Theme::namesAreConvertedToTextAndBack()
{
    for (const Theme::Name name : {Theme::System, Theme::Light, Theme::Dark, Theme::Sunlight})
        QCOMPARE(Theme::nameOf(Theme::nameText(name)), name);
    QCOMPARE(Theme::nameOf(QStringLiteral("pink")), Theme::System);
}

void tst_Theme::theSystemThemeIsOneOfTheOthers()
{
    const Theme system = Theme::byName(Theme::System);
    QCOMPARE(system.window, Theme::byName(system.isDark ? Theme::Dark : Theme::Light).window);
}

void tst_Theme::lineStyleDistinguishesCurvesOfOneColour()
{
    const Theme theme = Theme::byName(Theme::Light);
    QSet<QPair<QRgb, int>> looks;
    for (int curve = 0; curve < 24; ++curve)
        looks.insert({theme.curve(curve).rgb(), int(Theme::curveStyle(curve))});
    QCOMPARE(looks.size(), 24);
    for (int curve = 0; curve < 8; ++curve)
        QCOMPARE(Theme::curveStyle(curve), Qt::SolidLine);
    QCOMPARE(Theme::curveStyle(24), Qt::SolidLine);
}

QTEST_MAIN(tst_Theme)
#include "tst_Theme.moc"
