// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QProxyStyle>

namespace qplc {

/// A style whose buttons, lines, menus, rows and title bars are large enough for fingers: 40 px.
class TouchStyle : public QProxyStyle
{
    Q_OBJECT
public:
    static constexpr int Target = 40;  // [px]

    /// \param base  the style for mice, by its name
    explicit TouchStyle(const QString &base);

    /// Whether there is a touch screen.
    static bool isUseful();
    /// Gives all windows of the application this style, or the one of before.
    static void setOn(bool isOn);

    int pixelMetric(PixelMetric metric, const QStyleOption *option, const QWidget *widget) const override;
    QSize sizeFromContents(ContentsType type, const QStyleOption *option, const QSize &size,
                           const QWidget *widget) const override;

private:
    QString m_base;
};

}  // namespace qplc
