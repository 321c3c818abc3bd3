// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"

#include <QtCore/QString>

class QPlcWidget;
class QWidget;

/// Makes panels of one kind for a Control Center. QPlcControlCenter::addPanel() makes a factory for
/// a class; derive from this class for panels that need more than a constructor.
///
/// \code
/// class Compass : public QPlcWidget
/// {
/// public:
///     using QPlcWidget::QPlcWidget;
///     QString kind() const override { return "Compass"; }
/// };
/// class CompassFactory : public QPlcWidgetFactory
/// {
/// public:
///     QString name() const override { return "Compass"; }
///     QPlcWidget *createNew(QWidget *parent) const override { return new Compass(parent); }
/// };
/// QPlcControlCenter controlCenter;
/// controlCenter.addAvailableWidget(QPlcWidget::registerFactory(new CompassFactory));
/// \endcode
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI_EXPORT QPlcWidgetFactory
{
public:
    /// Destroys the factory; panels that it has made stay.
    virtual ~QPlcWidgetFactory();
    /// Returns the QPlcWidget::type() of its panels, unique in a program; 0 (the default): this
    /// kind has no number.
    virtual int type() const { return 0; }
    /// Returns the kind of its panels, as layouts name it: "Time plot". Unique in a program, never
    /// translated.
    virtual QString name() const = 0;
    /// Returns what people read in menus and above a panel without a title of its own. The default
    /// is name().
    virtual QString title() const { return name(); }
    /// Returns a new panel. \a parent owns it, else the caller.
    virtual QPlcWidget *createNew(QWidget *parent = nullptr) const = 0;
};
