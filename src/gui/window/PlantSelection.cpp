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
    connect(plants, &PlantList::selectionChanged, this, &PlantSelection::changed);
}

void PlantSelection::follow(Plant *plant)
{
    connect(plant, &Plant::messagePushed, this, [this, plant](const QPlcMessage &message) {
        if (message.kind() != QPlcMessage::StatesInitialized || !message.fields().value(QStringLiteral("ok")).toBool())
            return;
        m_initialized.insert(plant);
        Q_EMIT changed();
    });
    connect(plant, &Plant::stateChanged, this, [this, plant] {
        const bool isBack = plant->status().state == QLatin1String("Off") && m_initialized.contains(plant);
        if (!plant->isConnected() || plant->status().isRunning() || plant->status().isLatched() || isBack)
            m_initialized.remove(plant);
        Q_EMIT changed();
    });
    connect(plant, &Plant::statusChanged, this, &PlantSelection::changed);
    connect(plant, &Plant::leasesChanged, this, &PlantSelection::changed);
    connect(plant, &Plant::commandFailed, this,
            [this](int, const QString &sentence) { Q_EMIT commandFailed(sentence); });
    Q_EMIT changed();
}

void PlantSelection::forget(Plant *plant)
{
    plant->disconnect(this);
    m_initialized.remove(plant);
    Q_EMIT changed();
}

void PlantSelection::selectNext()
{
    if (m_plants->size() > 1)
        select(m_plants->at((m_plants->indexOf(plant()) + 1) % m_plants->size()));
}

QVector<Plant *> PlantSelection::plantsToStop() const
{
    QVector<Plant *> controlled;
    for (int place = 0; place < m_plants->size(); ++place) {
        const QVector<LeaseStatus> &leases = m_plants->at(place)->leases();
        if (m_plants->at(place)->isConnected()
            && std::any_of(leases.begin(), leases.end(), [](const LeaseStatus &lease) { return lease.isMine; }))
            controlled << m_plants->at(place);
    }
    if (controlled.isEmpty() && plant())
        controlled << plant();
    return controlled;
}

}  // namespace qplc
