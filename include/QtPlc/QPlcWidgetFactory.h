// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"

#include <QtCore/QString>

class QPlcWidget;
class QWidget;

/// Makes panels of one kind for a Control Center, which knows no kinds itself. QPlcControlCenter::addPanel()
/// makes one for a class.
class QTPLC_GUI_EXPORT QPlcWidgetFactory
{
public:
    virtual ~QPlcWidgetFactory();
    /// Returns QPlcWidget::type() of what it makes, unique in a program; 0: its kind has no number.
    virtual int type() const { return 0; }
    /// Returns the kind of what it makes, as layouts name it: "Time plot". Unique in a program, and never
    /// translated.
    virtual QString name() const = 0;
    /// Returns what people read in menus, and above a panel without a title of its own; name() unless
    /// overridden.
    virtual QString title() const { return name(); }
    virtual QPlcWidget *createNew(QWidget *parent = nullptr) const = 0;
};
