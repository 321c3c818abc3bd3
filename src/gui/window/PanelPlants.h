// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/WindowContext.h"

#include <QtCore/QPointer>
#include <QtCore/QVector>

class QMenu;
class QPlcWidget;

namespace qplc {

class PanelFrame;

/// Says above each panel of which plants it is, by name and colour, as long as the window has
/// several; and lets a person pin it to one.
class PanelPlants : public QObject
{
    Q_OBJECT
public:
    /// \param context  outlives this object
    explicit PanelPlants(WindowContext *context, QObject *parent = nullptr);

    void add(PanelFrame *frame, QPlcWidget *widget);

public Q_SLOTS:
    void showAll();

private:
    struct Panel
    {
        QPointer<PanelFrame> frame;
        QPointer<QPlcWidget> widget;
    };

    void show(const Panel &panel) const;
    QStringList namesOf(const QPlcWidget &widget) const;
    QMenu *makeMenu(QWidget *parent, QPlcWidget *widget) const;

    WindowContext *m_context;
    QVector<Panel> m_panels;
};

}  // namespace qplc
