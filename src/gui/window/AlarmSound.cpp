// SPDX-License-Identifier: Apache-2.0
#include "AlarmSound.h"

#include <utility>

namespace qplc {

AlarmSound::AlarmSound(EventLogModel *events, std::function<void()> play, QObject *parent)
    : QObject(parent)
    , m_play(std::move(play))
{
    connect(events, &QAbstractItemModel::rowsInserted, this, [this, events](const QModelIndex &, int first, int last) {
        for (int row = first; row <= last; ++row)
            hear(events->at(row));
    });
}

void AlarmSound::hear(const PlantEvent &event)
{
    constexpr qint64 pause = 5000;  // [ms]
    const bool isNew = event.time.msecsTo(QDateTime::currentDateTime()) < pause;
    if (!m_isOn || !isNew || event.severity != PlantEvent::Error || event.isAcknowledged)
        return;
    if (m_sincePlayed.isValid() && m_sincePlayed.elapsed() < pause)
        return;
    m_sincePlayed.start();
    m_play();
}

}  // namespace qplc
