// SPDX-License-Identifier: Apache-2.0
#include "TouchStyle.h"

#include <QtGui/QTouchDevice>
#include <QtWidgets/QApplication>
#include <QtWidgets/QStyleFactory>
#include <QtWidgets/QStyleOptionMenuItem>

#include <algorithm>

namespace qplc {

TouchStyle::TouchStyle(const QString &base)
    : QProxyStyle(QStyleFactory::create(base))
    , m_base(base)
{
}

bool TouchStyle::isUseful()
{
    const QList<const QTouchDevice *> devices = QTouchDevice::devices();
    return std::any_of(devices.begin(), devices.end(),
                       [](const QTouchDevice *device) { return device->type() == QTouchDevice::TouchScreen; });
}

void TouchStyle::setOn(bool isOn)
{
    const auto *touch = qobject_cast<TouchStyle *>(QApplication::style());
    if (isOn == (touch != nullptr))
        return;
    if (isOn)
        QApplication::setStyle(new TouchStyle(QApplication::style()->objectName()));
    else
        QApplication::setStyle(QStyleFactory::create(touch->m_base));
}

int TouchStyle::pixelMetric(PixelMetric metric, const QStyleOption *option, const QWidget *widget) const
{
    const int usual = QProxyStyle::pixelMetric(metric, option, widget);
    switch (metric) {
    case PM_TitleBarHeight:
        return std::max(usual, Target + 4);  // room for buttons of the size of a target
    case PM_ScrollBarSliderMin:
        return std::max(usual, Target);
    case PM_ScrollBarExtent:
    case PM_SliderLength:
    case PM_SliderControlThickness:
    case PM_IndicatorWidth:
    case PM_IndicatorHeight:
    case PM_ExclusiveIndicatorWidth:
    case PM_ExclusiveIndicatorHeight:
        return std::max(usual, 24);
    case PM_SliderThickness:
        return std::max(usual, 32);
    default:
        return usual;
    }
}

QSize TouchStyle::sizeFromContents(ContentsType type, const QStyleOption *option, const QSize &size,
                                   const QWidget *widget) const
{
    const QSize usual = QProxyStyle::sizeFromContents(type, option, size, widget);
    switch (type) {
    case CT_MenuItem: {
        const auto *item = qstyleoption_cast<const QStyleOptionMenuItem *>(option);
        const bool isLine = item && item->menuItemType == QStyleOptionMenuItem::Separator;
        return isLine ? usual : usual.expandedTo({0, Target});
    }
    case CT_PushButton:
    case CT_ToolButton:
    case CT_ComboBox:
    case CT_LineEdit:
    case CT_SpinBox:
    case CT_CheckBox:
    case CT_RadioButton:
    case CT_MenuBarItem:
    case CT_TabBarTab:
    case CT_ItemViewItem:
    case CT_HeaderSection:
        return usual.expandedTo({0, Target});
    default:
        return usual;
    }
}

}  // namespace qplc
