// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidgetFactory.h"

/// The factory of a class with `staticType`, `typeName()` and a constructor that takes the parent.
///
/// ```cpp
/// class Compass : public QPlcWidget
/// {
/// public:
///     static constexpr int staticType = UserType + 1;
///     static QString typeName() { return QStringLiteral("Compass"); }
///     explicit Compass(QWidget *parent = nullptr);
///     int type() const override { return staticType; }
/// };
/// using CompassFactory = QPlcWidgetFactoryOf<Compass>;
///
/// controlCenter.addAvailableWidget(QPlcWidget::registerFactory(new CompassFactory));
/// ```
template<typename Widget>
class QPlcWidgetFactoryOf : public QPlcWidgetFactory
{
public:
    int type() const override { return Widget::staticType; }
    QString name() const override { return Widget::typeName(); }
    QPlcWidget *createNew(QWidget *parent = nullptr) const override { return new Widget(parent); }
};
