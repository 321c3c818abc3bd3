// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "OwnApplication.h"
#include "QPlcMasterNode.h"
#include "node/session/Arming.h"
#include "node/session/AskedStop.h"
#include "node/session/InitializeSequence.h"
#include "node/session/MasterAudit.h"
#include "node/session/MasterBeacon.h"
#include "node/session/MasterError.h"
#include "node/session/MasterEvictions.h"
#include "node/session/MasterReports.h"
#include "node/session/MasterViewers.h"
#include "node/session/NeededNodes.h"
#include "node/session/PhaseTexts.h"
#include "node/session/SequenceAsker.h"
#include "node/session/ServerSettings.h"
#include "node/session/StartSequence.h"
#include "node/session/StopSequence.h"
#include "node/statistics/EventKeeper.h"

#include <QtCore/QTimer>

/// Wires the parts of a master: carries out what the table of states says, and takes in what
/// programs and clients ask. docs/design/sequences.md says who does what.
class QPlcMasterNodePrivate final : private qplc::MasterControl
{
public:
    static QPlcMasterNodePrivate &of(const QPlcMasterNode &master) { return *master.d; }

    explicit QPlcMasterNodePrivate(QPlcMasterNode *master);

    /// Fixes the signal table and makes everything that depends on it. \return false when there is
    /// no table
    bool prepare();
    bool startServer(const QPlcUnderlyingProtocol &protocol);
    bool addLocalNode(QPlcSlaveNode *node);
    void removeLocalNode(QPlcSlaveNode *node);

    bool initializeAllStates();
    /// \param cycles  to compute; 0: as the cycle limit says
    /// \param token  of the permission that the asker shows; 0: none
    bool startRealTime(quint64 cycles, quint64 token);
    /// One cycle of the clock External, on the calling thread. \threadsafe yes
    QPlcMasterNode::StepResult step();
    bool arm();
    bool reset();
    void stop(const QString &reason);
    /// Which nodes an initialization or a start needs now, and why they are missing; empty: none.
    QString missingText() const;
    /// Of the phase at hand, else of the next one.
    qplc::ChosenProfile profile() const;

    bool apply(qplc::MasterEvent event, const QString &reason = QString()) override;
    QPlcMasterNode::State state() const override { return m_state; }

    /// All that depends on the signal table, each part after those that it needs.
    struct Parts
    {
        explicit Parts(QPlcMasterNodePrivate &master);
        /// Whether a phase has begun, with its initialization.
        bool isPhaseUnderWay() const { return phase.isRunning() || step.isUnderWay(); }

        qplc::NodeRegistry registry;
        qplc::MasterCycle cycle;
        qplc::MasterWrites settings;
        qplc::MasterLeases leases;
        qplc::OwnSignals ownSignals;
        qplc::RosterMaker rosters;
        qplc::RealTimePhase phase;
        qplc::MasterServer server;
        qplc::MasterFaults faults;
        qplc::MasterReports reports;
        qplc::MasterAudit audit;
        qplc::MasterEvictions evictions;
        qplc::MasterViewers viewers;
        qplc::PhaseTexts texts;
        qplc::InitialValues values;
        qplc::StartMessages starts;
        qplc::SequenceStep step;
        qplc::JoinSequence joining;
        qplc::InitializeSequence initialization;
        qplc::StartSequence starting;
        qplc::StopSequence stopping;
    };

    QPlcMasterNode *const q;
    std::optional<qplc::OwnApplication> application;  // ends last
    QPlcSignalTable table;
    qplc::PhaseSettings phaseSettings;
    qplc::ServerSettings serverSettings;
    QString networkSecurity = QStringLiteral("none");  // as Hello tells it
    qplc::Arming arming;
    QString stateReason;        // of SafeStop and Fault
    quint64 latch = 0;          // number of the newest safe stop or fault
    qplc::AskedStop askedStop;  // until the next phase
    qplc::SequenceAsker asker;
    qplc::EventLoopTimer stepTimer;
    qplc::EventLoopTimer joinTimer;
    qplc::Journal journal;
    qplc::MasterError error;
    qplc::Leases leaseBooks;
    qplc::PhaseProfile phaseProfile;
    const quint64 session;
    const QString uuid;
    qplc::CyclicHub hub;
    qplc::MasterBeacon beacon;
    qplc::NodeSessions nodes;
    qplc::NeededNodes needed;
    qplc::Evictions evictions;
    std::unique_ptr<Parts> parts;  // null: there is no table yet
    qplc::EventKeeper eventKeeper;

private:
    using Connection = qplc::MasterConnection;
    class Requests;

    void connectParts();
    void startInitialized();
    void announce(const qplc::messages::StatesInitialized &news) override;
    void nodeAttached(Connection *connection);
    void nodeLost(Connection *connection, const QString &reason);
    void receive(Connection *connection, const QPlcMessage &message);

    void enter(QPlcMasterNode::State newState, const QString &reason);
    void prepareFor(qplc::MasterAction action);
    void carryOut(qplc::MasterAction action, const QString &reason);

    QPlcMasterNode::State m_state = QPlcMasterNode::Off;
    std::shared_ptr<qplc::NodeSession> m_joiner;  // who LetJoin is about
    Qt::HANDLE m_startThread = nullptr;           // that of the master, when a phase was started
    bool m_startAfterwards = false;               // the initialization at hand belongs to a start
};
