// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidgetFactory.h"

/// The factory of a panel class that has `typeName()` and a constructor with the parent.
///
/// \code
/// class Compass : public QPlcWidget
/// {
/// public:
///     static QString typeName() { return "Compass"; }
///     using QPlcWidget::QPlcWidget;
///     QString kind() const override { return typeName(); }
/// };
/// QPlcControlCenter controlCenter;
/// controlCenter.addPanel<Compass>();  // the short form of:
/// controlCenter.addAvailableWidget(QPlcWidget::registerFactory(new QPlcWidgetFactoryOf<Compass>));
/// \endcode
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
template<typename Widget>
class QPlcWidgetFactoryOf : public QPlcWidgetFactory
{
public:
    /// Makes the factory.
    /// \param title  what people read in menus; empty: `Widget::typeName()`
    explicit QPlcWidgetFactoryOf(const QString &title = QString())
        : m_title(title)
    {
    }

    QString name() const override { return Widget::typeName(); }
    QString title() const override { return m_title.isEmpty() ? name() : m_title; }
    QPlcWidget *createNew(QWidget *parent = nullptr) const override { return new Widget(parent); }

private:
    QString m_title;
};
