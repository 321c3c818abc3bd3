// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSimulatedRoad.h"

#include <QtCore/QtGlobal>

#include <chrono>
#include <functional>

namespace qplc {
class Simulator;
}

class QPlcSimulatedHost;

/// Runs a whole plant (master, nodes and tools) in one thread and in virtual time.
///
/// \code
/// QPlcSimulator::run(1, [](QPlcSimulator &simulator) {
///     QPlcSimulatedHost masterHost(simulator, "master");
///     auto *master = masterHost.start<QPlcMasterNode>();
///     masterHost.call([&] { master->startServer(masterHost.place()); });
///     simulator.runFor(std::chrono::minutes(1));
/// });
/// \endcode
///
/// The code of masters and nodes is that of the field. Clocks, timers, random numbers, cycle
/// threads and the network are simulated. Delays and faults follow from the seed: the same seed
/// gives the same run. A minute takes milliseconds. Timers of Qt that your nodes use live in
/// virtual time, too. Your code takes no virtual time: the simulator does not find nodes that
/// compute for too long. docs/howto/test-a-plant.md shows a whole test.
///
/// \threadsafe no: call all functions in the thread in which run() calls the scenario
///
/// \ingroup test
class QPlcSimulator
{
public:
    /// Calls \a scenario in a thread of its own with a new simulator, and returns when the scenario
    /// has returned. Objects of the scenario, hosts first, have to be destroyed before it returns.
    /// \param seed  start of all random numbers
    /// \param scenario  lets no exception out: one ends the test program. In a test framework that
    ///     fails by exceptions, collect the results and check them after run()
    /// \pre a QCoreApplication exists
    static void run(quint64 seed, const std::function<void(QPlcSimulator &)> &scenario);

    QPlcSimulator(const QPlcSimulator &) = delete;
    QPlcSimulator &operator=(const QPlcSimulator &) = delete;

    /// Returns the seed of run(). Report it when a test fails: with it you repeat the run.
    quint64 seed() const;
    /// Returns the virtual time since the begin. Clocks of hosts may differ from it.
    std::chrono::nanoseconds now() const;
    /// Returns a number that follows from all that has travelled on the network so far, and when.
    /// Two runs with the same digest were the same.
    quint64 digest() const;

    /// Lets \a duration of virtual time pass: 0 or more. A negative one ends the test program with
    /// a message.
    void runFor(std::chrono::nanoseconds duration);
    /// Lets virtual time pass until \a isReached returns true. It is called each virtual
    /// millisecond.
    /// \param longest  longest virtual time to wait: 0 or more, as in runFor()
    /// \return false when \a longest has passed before
    bool runUntil(const std::function<bool()> &isReached, std::chrono::nanoseconds longest);

    /// Sets all roads that have no road of their own.
    void setRoads(const QPlcSimulatedRoad &road);
    /// Sets the road of what \a from sends to \a to. The way back is another road.
    void setRoad(const QPlcSimulatedHost &from, const QPlcSimulatedHost &to, const QPlcSimulatedRoad &road);
    /// Removes all roads that setRoad() has set.
    void resetRoads();

private:
    friend class QPlcSimulatedHost;
    explicit QPlcSimulator(qplc::Simulator &simulator);

    qplc::Simulator &m_simulator;
    int m_hosts = 0;  // so far
};
