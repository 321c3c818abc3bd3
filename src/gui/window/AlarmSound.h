// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/models/EventLogModel.h"

#include <QtCore/QElapsedTimer>

#include <functional>

namespace qplc {

/// Lets errors be heard when they happen, once in 5 s at most: who looks elsewhere looks up. What
/// happened before the window came is quiet.
class AlarmSound : public QObject
{
    Q_OBJECT
public:
    /// \param play  the sound
    AlarmSound(EventLogModel *events, std::function<void()> play, QObject *parent = nullptr);

    bool isOn() const { return m_isOn; }
    void setOn(bool isOn) { m_isOn = isOn; }

private:
    void hear(const PlantEvent &event);

    std::function<void()> m_play;
    QElapsedTimer m_sincePlayed;
    bool m_isOn = true;
};

}  // namespace qplc
