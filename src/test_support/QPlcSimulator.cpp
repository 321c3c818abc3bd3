// SPDX-License-Identifier: Apache-2.0
#include "QPlcSimulator.h"

#include "QPlcSimulatedHost.h"
#include "SimulatedHost.h"
#include "SimulatedTransport.h"

namespace {

constexpr double longestTime = 3600e9;  // [ns]

/// Ends a test that wants time to go back.
void needsTime(const char *function, std::chrono::nanoseconds duration)
{
    if (duration.count() < 0)
        qFatal("QPlcSimulator::%s: the time is %lld ns; virtual time does not run back, use 0 or more", function,
               static_cast<long long>(duration.count()));
}

/// Ends a test whose road cannot exist.
void needs(const char *what, double value, double most)
{
    if (!(value >= 0.0 && value <= most))
        qFatal("QPlcSimulatedRoad: %s is %g; use 0 to %g", what, value, most);
}

qplc::SimulatedRoad inside(const QPlcSimulatedRoad &road)
{
    needs("loss", road.loss, 1.0);
    needs("duplication", road.duplication, 1.0);
    needs("reordering", road.reordering, 1.0);
    needs("delay [ns]", double(road.delay.count()), longestTime);
    needs("jitter [ns]", double(road.jitter.count()), longestTime);
    needs("lateness [ns]", double(road.lateness.count()), longestTime);
    qplc::SimulatedRoad made;
    made.delay = road.delay.count();
    made.jitter = road.jitter.count();
    made.loss = road.loss;
    made.duplication = road.duplication;
    made.reordering = road.reordering;
    made.lateness = road.lateness.count();
    made.dropsDatagrams = road.dropsDatagrams;
    made.isCut = road.isCut;
    return made;
}

}  // namespace

QPlcSimulator::QPlcSimulator(qplc::Simulator &simulator)
    : m_simulator(simulator)
{
}

void QPlcSimulator::run(quint64 seed, const std::function<void(QPlcSimulator &)> &scenario)
{
    qplc::SimulatedTransport::install();
    qplc::Simulator::run(seed, [&](qplc::Simulator &simulator) {
        QPlcSimulator own(simulator);
        scenario(own);
    });
}

quint64 QPlcSimulator::seed() const
{
    return m_simulator.seed();
}

std::chrono::nanoseconds QPlcSimulator::now() const
{
    return std::chrono::nanoseconds(m_simulator.now());
}

quint64 QPlcSimulator::digest() const
{
    return m_simulator.digest();
}

void QPlcSimulator::runFor(std::chrono::nanoseconds duration)
{
    needsTime("runFor()", duration);
    m_simulator.runFor(duration.count());
}

bool QPlcSimulator::runUntil(const std::function<bool()> &isReached, std::chrono::nanoseconds longest)
{
    needsTime("runUntil()", longest);
    return m_simulator.runUntil(isReached, longest.count());
}

void QPlcSimulator::setRoads(const QPlcSimulatedRoad &road)
{
    m_simulator.network().usual = inside(road);
}

void QPlcSimulator::setRoad(const QPlcSimulatedHost &from, const QPlcSimulatedHost &to, const QPlcSimulatedRoad &road)
{
    m_simulator.network().setRoad(*from.m_host, *to.m_host, inside(road));
}

void QPlcSimulator::resetRoads()
{
    m_simulator.network().resetRoads();
}
