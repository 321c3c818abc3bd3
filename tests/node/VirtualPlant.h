// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodeFixtures.h"

#include <QtPlcTest>

/// A master with a counter in its process, and Echo on another computer, in virtual time: a second
/// of the plant takes a few milliseconds, and a busy machine changes nothing.
class VirtualPlant
{
public:
    /// \param faults of the frames of Echo, in both directions; empty: none
    VirtualPlant(QPlcSimulator &simulator, const char *faults, std::chrono::milliseconds period)
        : m_simulator(simulator)
        , m_masterHost(simulator, QStringLiteral("master"))
        , m_echoHost(simulator, QStringLiteral("echo"))
        , m_program(m_masterHost.start<MasterProgram>())
        , master(&m_program->master)
        , echo(m_echoHost.start<EchoNode>())
    {
        m_masterHost.call([&] {
            master->setInterval(period);
            m_program->counter.onStep = [this](const QPlcCycle &) { ++steps; };
            m_isThere = master->addLocalNode(&m_program->counter) && master->startServer(m_masterHost.place());
        });
        m_echoHost.call([&] {
            echo->onStep = [this](const QPlcCycle &cycle) {
                isInOrder = isInOrder && (echoSteps == 0 || cycle.number() > newest);
                newest = cycle.number();
                ++echoSteps;
            };
            m_isThere = m_isThere && echo->setFaultPlan(QString::fromLatin1(faults));
            echo->connectToMaster(m_masterHost.place());
        });
    }
    VirtualPlant(const VirtualPlant &) = delete;
    VirtualPlant &operator=(const VirtualPlant &) = delete;
    ~VirtualPlant() { stop(); }

    bool start()
    {
        if (!m_isThere || !waitFor([&] { return master->nodes().size() == 2; }))
            return false;
        m_masterHost.call([&] { master->startRealTime(); });
        return waitFor([&] { return steps > 0; });
    }
    void stop()
    {
        m_masterHost.call([&] { master->stop(); });
    }
    /// Lets time pass. \return false when a minute of it was not enough
    bool waitFor(const std::function<bool()> &isReached)
    {
        return m_simulator.runUntil(isReached, std::chrono::minutes(1));
    }
    QPlcNodeInfo info() const { return master->nodes().last(); }

    quint64 steps = 0;      ///< of the counter
    quint64 echoSteps = 0;  ///< of Echo
    quint64 newest = 0;     ///< cycle of Echo
    bool isInOrder = true;  ///< no cycle of Echo was older than one before

private:
    struct MasterProgram
    {
        CounterNode counter;
        TestMaster master{QPlcClock::realTime()};
    };

    QPlcSimulator &m_simulator;
    QPlcSimulatedHost m_masterHost;
    QPlcSimulatedHost m_echoHost;
    MasterProgram *const m_program;
    bool m_isThere = false;

public:
    TestMaster *const master;
    EchoNode *const echo;
};
