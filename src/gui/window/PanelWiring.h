// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "gui/panel/WindowContext.h"

#include <QtCore/QVector>

namespace qplc {

/// Gives all panels of a window their context and, to those that want them, values of the plant that has the signal table of the process; and collects what they write.
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
    void send(const QPlcSignalList &values);
    void findPlant();

    WindowContext *m_context;
    QVector<QPlcWidget *> m_widgets;
    Plant *m_plant = nullptr;  // the one with the table of the process; null: there is none
};

}  // namespace qplc
