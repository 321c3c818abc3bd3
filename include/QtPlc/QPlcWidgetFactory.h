// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"

#include <QtCore/QString>

class QPlcWidget;
class QWidget;

/// Makes widgets of one type for a Control Center, which knows no types itself; mostly it is a QPlcWidgetFactoryOf.
class QTPLC_GUI_EXPORT QPlcWidgetFactory
{
public:
    virtual ~QPlcWidgetFactory();
    /// As QPlcWidget::type() of what it makes; unique in a program.
    virtual int type() const = 0;
    /// What people call it, and layouts on disk: "Time plot". Unique in a program, and never translated.
    virtual QString name() const = 0;
    virtual QPlcWidget *createNew(QWidget *parent = nullptr) const = 0;
};
