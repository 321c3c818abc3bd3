// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Program.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QTimer>

#include <algorithm>
#include <memory>

/// awe_master, listening. \param port  0: any; null when it does not start
inline std::unique_ptr<Program> startMaster(const QString &port)
{
    auto master = std::make_unique<Program>(QStringLiteral(QTPLC_PROGRAMS "/awe_master"),
                                            QStringList{QStringLiteral("--port=%1").arg(port)});
    return master->waitForOutput(QStringLiteral("\n")) ? std::move(master) : nullptr;
}

inline QString portOf(Program &master)
{
    return master.output().section(QLatin1Char('\n'), 0, 0).section(QLatin1Char(' '), 1);
}

/// The longest time in which the event loop did not come round.
class Heartbeat
{
public:
    Heartbeat()
    {
        m_clock.start();
        QObject::connect(&m_timer, &QTimer::timeout, [this] { m_longest = std::max(m_longest, m_clock.restart()); });
        m_timer.start(5);
    }
    qint64 longest() const { return m_longest; }  // [ms]

private:
    QElapsedTimer m_clock;
    QTimer m_timer;
    qint64 m_longest = 0;
};
