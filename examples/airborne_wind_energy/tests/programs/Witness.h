// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Program.h"

#include <QtPlcCore>
#include <QtTest/QtTest>

#include <atomic>

/// A node that joins a flight, and sees that it goes on. Threads: step() in that of the cycle, all
/// else in that of the test.
class Witness : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    Witness()
        : QPlcCompactSlaveNode(QStringLiteral("Witness"))
    {
    }
    ~Witness() override { disconnectFromMaster(); }

    bool join(const QString &address)
    {
        return connectToMasterAndWaitForConnected(QPlcUnderlyingProtocol::fromString(address));
    }
    int cycles() const { return m_cycles; }
    /// Waits for another \a count cycles. \return false when they do not come
    bool seesCycles(int count)
    {
        const int wanted = m_cycles + count;
        return QTest::qWaitFor([&] { return m_cycles >= wanted; }, Program::patience);
    }

protected:
    void step(const QPlcCycle &) override { ++m_cycles; }

private:
    std::atomic<int> m_cycles{0};
    QPlcInput<double> m_power{this, "power"};
};
