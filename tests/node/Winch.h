// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodeFixtures.h"

#include <mutex>

inline QPlcSignalTable winchTable()
{
    return QPlcSignalTable::fromIni("[speed]\ntype = Real64\nsafe = 0.5\n[length]\ntype = Real64\nsafe = 300\n");
}

/// Drives something, and remembers what happened to it, in order.
class Winch : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    explicit Winch()
        : QPlcCompactSlaveNode(QStringLiteral("Winch"))
    {
        setSignalTable(winchTable());
    }
    std::function<void(const QPlcCycle &)> onStep;
    QStringList story()
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        return m_story;
    }
    double speedAtRest = -1.0;

protected:
    void step(const QPlcCycle &cycle) override
    {
        m_length = 100.0 + m_speed;
        tell("step");
        if (onStep)
            onStep(cycle);
    }
    void safeState(SafeStateReason reason) override
    {
        speedAtRest = m_speed;
        tell(QByteArray("safe ") + QMetaEnum::fromType<SafeStateReason>().valueToKey(reason));
    }
    void stopped() override { tell("stopped"); }

private:
    void tell(const QByteArray &what)
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        if (what != "step" || m_story.isEmpty() || m_story.last() != "step")
            m_story << QString::fromLatin1(what);
    }

    std::mutex m_mutex;
    QStringList m_story;
    QPlcInput<double> m_speed{this, "speed"};
    QPlcOutput<double> m_length{this, "length"};
};
