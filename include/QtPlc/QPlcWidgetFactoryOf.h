// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidgetFactory.h"

/// The factory of a panel class that has `typeName()` and a constructor with the parent.
///
/// ```cpp
/// controlCenter.addPanel<Compass>();  // the short form of
/// controlCenter.addAvailableWidget(QPlcWidget::registerFactory(new QPlcWidgetFactoryOf<Compass>));
/// ```
/// QPlcWidget shows such a class.
template<typename Widget>
class QPlcWidgetFactoryOf : public QPlcWidgetFactory
{
public:
    /// \param title  what people read; empty: the name
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
