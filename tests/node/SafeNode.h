// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodeFixtures.h"

#include <atomic>

/// Remembers how it was made safe; its outputs have safe values of their own.
class SafeNode : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    explicit SafeNode(const QString &name = QStringLiteral("Winch"),
                      RealTimeViolationPolicy policy = ErrorZeroOrderHold)
        : QPlcCompactSlaveNode(name, policy)
    {
    }
    std::function<void(const QPlcCycle &)> onStep;
    std::atomic<int> steps{0};
    std::atomic<int> safeStates{0};
    std::atomic<int> reason{-1};

protected:
    void step(const QPlcCycle &cycle) override
    {
        m_echo = 1.0 + double(m_count);
        ++steps;
        if (onStep)
            onStep(cycle);
    }
    void safeState(SafeStateReason why) override
    {
        ++safeStates;
        reason = why;
    }

private:
    QPlcInput<int> m_count{this, "count"};
    QPlcOutput<double> m_echo{this, "echo"};
};
