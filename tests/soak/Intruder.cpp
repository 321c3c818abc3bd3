// SPDX-License-Identifier: Apache-2.0
#include "Intruder.h"

namespace soak {

Intruder::Intruder(quint16 port, int attempts, quint64 seed, HistoryWriter &history)
    : m_port(port)
    , m_attempts(attempts * Interval / 1000)
    , m_history(history)
    , m_strangers(seed)
{
    QObject::connect(&m_timer, &QTimer::timeout, &m_timer, [this] { tryAgain(); });
    if (m_attempts > 0)
        m_timer.start(Interval);
}

void Intruder::tryAgain()
{
    m_strangers.leave();  // those of the last time, who have been refused meanwhile
    m_made += quint64(m_strangers.sendGarbage(m_port, m_attempts));
    m_history.append(Record::Attempts, -1, {m_made});
}

}  // namespace soak
