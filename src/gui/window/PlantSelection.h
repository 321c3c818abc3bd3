// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plant/PlantList.h"

#include <QtCore/QSet>

namespace qplc {

/// The one plant of a window that its bar, its commands and STOP mean.
class PlantSelection : public QObject
{
    Q_OBJECT
public:
    /// \param plants  outlives the selection
    explicit PlantSelection(PlantList *plants, QObject *parent = nullptr);

    PlantList *plants() const { return m_plants; }
    /// Null while there is none.
    Plant *plant() const { return m_plant; }
    void select(Plant *plant);
    void selectNext();
    /// Whether the master of the selected plant has initialized all nodes, and runs no cycles yet.
    bool isInitialized() const { return m_initialized.contains(m_plant); }

Q_SIGNALS:
    /// Another plant, another number of plants, or anything of the state of the selected one.
    void changed();
    void commandFailed(const QString &sentence);

private:
    void follow(Plant *plant);
    void forget(Plant *plant);

    PlantList *m_plants;
    Plant *m_plant = nullptr;
    QSet<Plant *> m_initialized;
};

}  // namespace qplc
