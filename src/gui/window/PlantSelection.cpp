// SPDX-License-Identifier: Apache-2.0
#include "PlantSelection.h"

#include <algorithm>

namespace qplc {

PlantSelection::PlantSelection(PlantList *plants, QObject *parent)
    : QObject(parent)
    , m_plants(plants)
{
    connect(plants, &PlantList::added, this, &PlantSelection::follow);
    connect(plants, &PlantList::removed, this, &PlantSelection::forget);
    connect(plants, &PlantList::selectionChanged, this, [this] {
        forgetLost();
        Q_EMIT changed();
    });
}

void PlantSelection::follow(Plant *plant)
{
    connect(plant, &Plant::initialized, this, [this, plant] {
        m_initialized.insert(plant);
        Q_EMIT changed();
    });
    connect(plant, &Plant::stateChanged, this, [this, plant] {
        const bool isBack = plant->status().master.state == messages::MasterState::Off && m_initialized.contains(plant);
        if (!plant->isConnected() || plant->status().isRunning() || plant->status().isLatched() || isBack)
            m_initialized.remove(plant);
        followControl(plant);
        Q_EMIT changed();
    });
    connect(plant, &Plant::statusChanged, this, &PlantSelection::changed);
    connect(plant, &Plant::leasesChanged, this, [this, plant] {
        followControl(plant);
        Q_EMIT changed();
    });
    connect(plant, &Plant::commandFailed, this,
            [this](int, const QString &sentence) { Q_EMIT commandFailed(sentence); });
    Q_EMIT changed();
}

void PlantSelection::forget(Plant *plant)
{
    plant->disconnect(this);
    m_initialized.remove(plant);
    m_controlled.remove(plant);
    Q_EMIT changed();
}

void PlantSelection::followControl(Plant *plant)
{
    if (!plant->isConnected())
        return;  // it keeps what it was
    const QVector<LeaseStatus> &leases = plant->leases();
    if (std::any_of(leases.begin(), leases.end(), [](const LeaseStatus &lease) { return lease.isMine; }))
        m_controlled.insert(plant);
    else
        m_controlled.remove(plant);
}

void PlantSelection::forgetLost()
{
    for (Plant *lost : m_plants->all()) {
        if (!lost->isConnected())
            m_controlled.remove(lost);
    }
}

void PlantSelection::selectNext()
{
    if (m_plants->size() > 1)
        select(m_plants->at((m_plants->indexOf(plant()) + 1) % m_plants->size()));
}

QVector<Plant *> PlantSelection::plantsToStop() const
{
    QVector<Plant *> controlled, lost;
    for (Plant *each : m_plants->all()) {
        if (m_controlled.contains(each))
            (each->isConnected() ? controlled : lost) << each;
    }
    if (controlled.isEmpty())
        controlled = lost;
    if (controlled.isEmpty() && plant() && !plant()->recording())
        controlled << plant();
    if (controlled.isEmpty()) {
        // A recording is not a plant that anybody could stop.
        for (Plant *each : m_plants->all()) {
            if (!each->recording())
                controlled << each;
        }
    }
    return controlled;
}

}  // namespace qplc
