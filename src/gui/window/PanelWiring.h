// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "gui/panel/WindowContext.h"

#include <QtCore/QSet>
#include <QtCore/QVector>

namespace qplc {

/// Gives all panels of a window their context and, to those that want them, values of their plant,
/// if that has the signal table of the process; and collects what they write.
class PanelWiring : public QObject
{
    Q_OBJECT
public:
    /// \param context  outlives this object
    explicit PanelWiring(WindowContext *context, QObject *parent = nullptr);

    void add(QPlcWidget *widget);
    void remove(QPlcWidget *widget);
    QPlcSignalIndexList outputs() const;
    QPlcSignalList initialOutputs() const;

Q_SIGNALS:
    void outputsChanged();
    void initialOutputsChanged();
    /// A panel writes; to the fed plant, when there is one.
    void outputsSent(const QPlcSignalList &values);

private:
    void deliver(Plant *plant);
    void send(const QPlcWidget &widget, const QPlcSignalList &values);
    void findPlants();
    Plant *plantOf(const QPlcWidget &widget) const;

    WindowContext *m_context;
    QVector<QPlcWidget *> m_widgets;
    QSet<Plant *> m_plants;  // with the table of the process: indices of panels are those of that table
};

}  // namespace qplc
