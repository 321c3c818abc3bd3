// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "History.h"
#include "Strangers.h"

#include <QtCore/QTimer>

namespace soak {

/// Tries to get in all the time, while the event loop runs.
class Intruder
{
public:
    /// \param attempts  per second; 0: none
    Intruder(quint16 port, int attempts, quint64 seed, HistoryWriter &history);

private:
    void tryAgain();

    static constexpr int Interval = 100;  // [ms]
    const quint16 m_port;
    const int m_attempts;  // in each interval
    HistoryWriter &m_history;
    Strangers m_strangers;
    QTimer m_timer;
    quint64 m_made = 0;
};

}  // namespace soak
