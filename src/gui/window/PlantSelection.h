// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plant/PlantList.h"

#include <QtCore/QSet>

namespace qplc {

/// What the bar of a window, its commands and STOP mean: the selected plant
/// (PlantList::selected()), and whether it is initialized.
class PlantSelection : public QObject
{
    Q_OBJECT
public:
    /// \param plants  outlives the selection
    explicit PlantSelection(PlantList *plants, QObject *parent = nullptr);

    PlantList *plants() const { return m_plants; }
    /// Null while there is none.
    Plant *plant() const { return m_plants->selected(); }
    void select(Plant *plant) { m_plants->select(plant); }
    void selectNext();
    /// What STOP means: the plants of which this window has taken over signals; without any the
    /// selected plant, or, if that is a recording, all plants. Empty: there is none. A plant that a
    /// person controlled when its master was lost is what STOP means until the master is back, or
    /// the person controls or selects another plant: a stop that cannot arrive must not arrive in a
    /// plant that was not meant.
    QVector<Plant *> plantsToStop() const;
    /// Whether the master of the selected plant has initialized all nodes, and runs no cycles yet.
    bool isInitialized() const { return m_initialized.contains(plant()); }

Q_SIGNALS:
    /// Another plant, another number of plants, anything of the state of the selected one, or what
    /// STOP means.
    void changed();
    void commandFailed(const QString &sentence);

private:
    void follow(Plant *plant);
    void forget(Plant *plant);
    void followControl(Plant *plant);
    void forgetLost();

    PlantList *m_plants;
    QSet<Plant *> m_controlled;
    QSet<Plant *> m_initialized;
};

}  // namespace qplc
