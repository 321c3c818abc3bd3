// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SequenceFixtures.h"
#include "node/session/RealTimePhase.h"

/// The cycles of a master as its sequences start and end them, with scripted nodes. Cycles have a
/// thread, but no node is in them.
struct PhaseBench : SequenceBench
{
    explicit PhaseBench(const QPlcSignalTable &signalTable = testTable())
        : SequenceBench(signalTable)
    {
        settings.interval = std::chrono::seconds(10);  // no test waits for a second cycle
    }
    ~PhaseBench() { phase.end(); }

    qplc::MasterWrites set{registry, image, leases};
    qplc::OwnSignals own{registry, table, leases, set};
    qplc::RosterMaker rosters{table, registry, nodes, leases};
    qplc::RealTimePhase phase{image, registry, rosters, own, settings, profile, journal};

    QPlcSignalIndex index(const char *signal) const { return table.indexOf(QString(signal)); }
    bool start()
    {
        QString error;
        return phase.start(&error);
    }
    void remove(const std::shared_ptr<ScriptedSession> &session)
    {
        nodes.remove(*session);
        registry.remove(session->slot());
    }
};
