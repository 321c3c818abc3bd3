// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NemesisPlan.h"

namespace soak {

class Operator;

inline constexpr int Patience = 20'000;  // [ms] with what is to come at once: far more than a loaded machine needs

/// The master and the nodes of a profile, each in its newest life, and all that may happen to them:
/// as processes (PlantProcesses), or simulated (SimulatedPlant).
class TestedPlant
{
public:
    static constexpr int TheMaster = -1;  // instead of the number of a node

    TestedPlant() = default;
    virtual ~TestedPlant();
    TestedPlant(const TestedPlant &) = delete;
    TestedPlant &operator=(const TestedPlant &) = delete;

    /// Before the first master.
    virtual bool prepare(QString *error) = 0;
    /// Starts a master, again at the place of the one before. \return false when it does not listen
    virtual bool startMaster(QString *error) = 0;
    virtual void killMaster() = 0;
    virtual QPlcUnderlyingProtocol master() const = 0;
    /// Starts a node; its life before is killed. \param linkFaults as linkFaultsOf() says; empty:
    /// none
    virtual void startNode(int node, const QString &linkFaults) = 0;
    /// SIGSTOP or SIGCONT. \param node  or TheMaster
    virtual void setStopped(int node, bool stopped) = 0;
    /// Does a fault of a kind that needs more than the functions above. \return how much of it was
    /// really done
    virtual int inject(const Fault &fault, Operator &person) = 0;
    /// Waits until the cause of each fault is gone that had not ended when inject() returned.
    virtual void waitForCauses() {}
    /// What happens all the time while faults come and go: load, intruders.
    virtual bool beginBeside(QString * /*error*/) { return true; }
    virtual void endBeside() {}
    /// Writes down what all processes use. \param compare  the whole plant runs: numbers are to be
    /// the same each time
    virtual void recordUsage(bool /*compare*/) {}
    /// Ends all nodes, then the master, in an orderly way. \return those that did not
    virtual QStringList end() = 0;
};

}  // namespace soak
