// SPDX-License-Identifier: Apache-2.0
#include "TitleButton.h"

#include <QtCore/QEvent>
#include <QtWidgets/QStyle>

#include <algorithm>

namespace qplc {

TitleButton::TitleButton(QWidget *parent)
    : QToolButton(parent)
{
    setAutoRaise(true);
    setIconSize({14, 14});
    setFixedSize(sizeIn(this), sizeIn(this));
}

int TitleButton::sizeIn(const QWidget *widget)
{
    constexpr int usual = 20;
    constexpr int border = 4;
    return std::max(usual, widget->style()->pixelMetric(QStyle::PM_TitleBarHeight, nullptr, widget) - border);
}

void TitleButton::changeEvent(QEvent *event)
{
    QToolButton::changeEvent(event);
    if (event->type() == QEvent::StyleChange)
        setFixedSize(sizeIn(this), sizeIn(this));
}

}  // namespace qplc
