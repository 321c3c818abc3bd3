// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtGui/QFontDatabase>
#include <QtGui/QFontMetricsF>

#include <cmath>

namespace qplc {

/// A font whose digits all have one width, so that figures do not dance: \a font itself, or else
/// the one for code in its size.
inline QFont figureFont(const QFont &font)
{
    const QFontMetricsF metrics(font);
    const double width = metrics.horizontalAdvance(QLatin1Char('0'));
    for (char digit = '1'; digit <= '9'; ++digit) {
        if (std::abs(metrics.horizontalAdvance(QLatin1Char(digit)) - width) > 0.01) {
            QFont fixed = QFontDatabase::systemFont(QFontDatabase::FixedFont);
            if (font.pixelSize() > 0)
                fixed.setPixelSize(font.pixelSize());
            else
                fixed.setPointSizeF(font.pointSizeF());
            fixed.setWeight(font.weight());
            return fixed;
        }
    }
    return font;
}

}  // namespace qplc
