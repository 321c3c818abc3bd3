// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "BlackBox.h"
#include "GoneNodes.h"
#include "OwnSignals.h"
#include "PhaseCycles.h"
#include "PhaseProfile.h"
#include "PhaseRing.h"
#include "PhaseSettings.h"
#include "RecorderWatch.h"
#include "RemoteRecorder.h"
#include "RosterMaker.h"

namespace qplc {

/// The cycles of a real-time phase from their start to their end, and what a master does meanwhile:
/// rosters, statistics as signals, overruns in the journal.
class RealTimePhase final : public PhaseCycles
{
public:
    RealTimePhase(MasterCycle &cycle, const NodeRegistry &registry, RosterMaker &rosters, OwnSignals &ownSignals,
                  const PhaseSettings &settings, const PhaseProfile &profile, Journal &journal);

    bool start(QString *error) override;
    bool isRunning() const override { return m_isRunning; }
    quint64 cycle() const override { return m_cycle.cycle(); }
    quint64 cycleZero() const override { return m_cycle.cycleZero(); }
    void renewRoster() override;
    bool hasLeft(const QString &name) const override { return m_gone.hasName(name); }

    /// What the cycles of the phases are recorded from.
    PhaseRing &ring() { return m_ring; }
    const RecorderWatch &recorder() const { return m_recorder; }
    RemoteRecorder &remoteRecorder() { return m_remoteRecorder; }
    /// The cycles around the present one stay, also when nobody records. Nothing is done if none
    /// run. \param reason  "safe stop"
    void keepCycles(const QString &reason);
    void makeSafe() { m_cycle.makeSafe(); }
    static constexpr std::chrono::seconds LongestWaitForRecorder{2};
    /// Calls \a told when a recorder on another computer has the end of the phase: a program may
    /// end with its phase. It waits only with a clock that is not timed, and not longer than
    /// LongestWaitForRecorder. Otherwise it calls at once.
    void whenRecorded(std::function<void()> told);
    /// Calls it now, if it has not been called. \return whether it was called
    bool waitNoLonger();
    /// Waits until the cycle in progress has ended, if cycles run.
    void end();
    /// Whether cycles have ended since the last call; then no node is in them any more.
    bool takeEnd();

    void nodeLeft(const NodeSession *node, const NodeSlot &slot);
    /// Of a node that is there, or was in this phase: what the cycle reports names it by its
    /// number.
    QString nodeName(quint16 id) const;
    bool wasListener(quint16 id) const;
    /// " in cycle 12"; empty: no cycle runs.
    QString cycleText() const;

private:
    void lookForRecorder();
    MasterCycle::Phase settingsOfCycles() const;
    std::shared_ptr<RecordRing> makeRing();

    MasterCycle &m_cycle;
    const NodeRegistry &m_registry;
    RosterMaker &m_rosters;
    OwnSignals &m_ownSignals;
    const PhaseSettings &m_settings;
    const PhaseProfile &m_profile;
    Journal &m_journal;
    GoneNodes m_gone;  // of this phase
    PhaseRing m_ring;
    RecorderWatch m_recorder;
    RemoteRecorder m_remoteRecorder{[this] { return m_ring.isOpen() ? m_ring.file() : QString(); }};
    BlackBox m_blackBox;
    std::function<void()> m_whenRecorded;  // empty: the phase waits for no recorder
    std::int64_t m_waitsUntil = 0;         // [ns]
    QTimer m_recorderTimer;
    bool m_isRunning = false;
    bool m_hasEnded = false;
};

}  // namespace qplc
