// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcMasterNode.h"
#include "QPlcSlaveNode.h"
#include "node/cycle/NodeRuntime.h"
#include "node/cycle/SlaveCycle.h"
#include "node/session/BackOff.h"
#include "node/session/ControlClient.h"
#include "node/session/NodeEvents.h"
#include "node/state/SlaveStates.h"
#include "node/statistics/ReportLimiter.h"
#include "protocol/messages/MessageTable.h"
#include "transport/TransportKind.h"

#include <QtCore/QPointer>
#include <QtCore/QSocketNotifier>
#include <QtCore/QTimer>

#include <memory>
#include <optional>
#include <variant>

/// The control side of a slave: registration, and the phases that the master announces.
class QPlcSlaveNodePrivate : public qplc::NodeTraits
{
public:
    QPlcSlaveNodePrivate(QPlcSlaveNode *node, const QString &name, QPlcSlaveNode::RealTimeViolationPolicy policy,
                         std::unique_ptr<qplc::NodeCode> code);
    static QPlcSlaveNodePrivate &of(const QPlcSlaveNode &node) { return *node.d; }

    void connectToMaster(const QPlcUnderlyingProtocol &master);
    void disconnectFromMaster();
    /// The class of the user is being destroyed, and no part of ours yet: cycles that still run end
    /// here, with a warning, and call nothing of it any more.
    void endBeforeDestruction();

    /// As SlaveCycle::cycleInProgress(). \threadsafe yes, while it is registered
    quint64 cycleInProgress() const { return cycle ? cycle->cycleInProgress() : 0; }
    /// Emits realTimedOut() after cycles, from now on.
    void watchCycles();
    /// Emits hasInitialized() with the inputs, when anybody listens.
    void tellInitialized();

    /// What a master tells with an event, for the function that belongs to it.
    using Told = std::variant<std::monostate, qplc::messages::Registered, qplc::messages::SendYourInitialOutputStates,
                              qplc::messages::InitializeWithValues, qplc::messages::RealTimeStarted,
                              qplc::messages::RealTimeStopped>;
    /// Something has happened: the node goes to the next state as qplc::slaveStates() says, and
    /// does what belongs to it.
    void apply(qplc::SlaveEvent event, const Told &told = {});
    /// The safe state, in the thread of the node, while no cycle runs.
    void makeSafe(QPlcSlaveNode::SafeStateReason reason);
    /// Emits safeStateEntered(), once in a phase.
    void tellSafe(QPlcSlaveNode::SafeStateReason reason);
    void setError(QPlcSlaveNode::Error newError, const QString &text);

    QPlcSlaveNode *const q;
    bool hasChannel = false;  // registered, with the cyclic channel; or in the process of the master
    QPlcSlaveNode::ReconnectPolicy reconnectPolicy = QPlcSlaveNode::ReconnectWhenLost;
    QString faultPlan;
    QPlcSignalTable ownTable;
    QPlcRealTimeOptions realTimeOptions;
    std::optional<std::chrono::nanoseconds> watchdog;  // else as the profile says
    int watchdogPeriods = 0;                           // it is at least so many periods long
    std::optional<QPlcSlaveNode::WatchdogReaction> watchdogReaction;
    QPlcProfile::Value phaseProfile
        = QPlcProfile::Automatic;  // of the phase at hand or the last one; Automatic: there was none
    std::chrono::nanoseconds watchdogOfPhase{0};
    const std::unique_ptr<qplc::NodeCode> code;
    qplc::NodeRuntime runtime;
    QPlcSlaveNode::State state = QPlcSlaveNode::Disconnected;
    QPlcSlaveNode::Error error = QPlcSlaveNode::NoError;
    QString errorString;
    std::unique_ptr<qplc::SlaveCycle> cycle;
    QPlcUnderlyingProtocol master;
    QPointer<QPlcMasterNode> localMaster;  // in whose process the node runs
    qplc::ControlClient control;           // child of the node, as the timers
    qplc::NodeEvents events;

private:
    void enter(QPlcSlaveNode::State newState);
    bool prepareFor(qplc::SlaveAction action, qplc::SlaveEvent event, const Told &told);
    void carryOut(qplc::SlaveAction action, const Told &told);
    void openConnection();
    void closeConnection(QPlcSlaveNode::SafeStateReason reason);
    void closeAfterWatchdog();
    void retryLater(qplc::SlaveEvent event);
    static std::optional<qplc::SentCycles::Last> lastSent(const Told &told);
    void stopPhase(const qplc::messages::RealTimeStopped &stop);
    void lookForRest();
    void endRest();
    void haltCycles(const std::optional<qplc::SentCycles::Last> &last = std::nullopt);
    void endPhase(QPlcSlaveNode::SafeStateReason reason);
    void codeFailed(const QString &text, const std::optional<qplc::messages::Hex64> &phase = {});
    class FromMaster;
    bool isExpected(const QPlcMessage &message) const;
    void handle(const QPlcMessage &message);
    void refuseUnreadable(const QPlcMessage &message, const QString &reason);
    bool sendEvent(const qplc::messages::NodeEvent &event);
    template<typename Message>
    void send(const Message &message)
    {
        control.tell(qplc::messages::toMessage(message));
    }
    bool isOrdered() const;
    QStringList features() const;
    void greet();
    void proceedAfterHello();
    bool chooseTable(QPlcSignalTable *table);
    std::optional<std::chrono::nanoseconds> ownWatchdog() const;
    void registerAtMaster();
    void proceedAfterRegistered(const qplc::messages::Registered &registered);
    bool hasSealedFrames() const;
    qplc::ControlEnds controlEnds() const;
    bool beginLink(qplc::messages::Register *request);
    void probe(const qplc::messages::Registered &registered);
    void openChannel(const qplc::messages::Registered &registered, const qplc::TransportKind &kind);
    bool finishLink(const qplc::messages::Registered &registered);
    void giveLink(std::unique_ptr<qplc::CyclicLink> link);
    void connectCyclicChannel(const qplc::messages::AttachCyclicChannel &wish);
    void tellRegistered();
    void sendInitialOutputs(const qplc::messages::SendYourInitialOutputStates &request);
    bool canGoOn(const qplc::messages::SendYourInitialOutputStates &request) const;
    void applyProfile(qplc::SlaveCycle::Phase *phase);
    void watchdogHasTimedOut(quint64 lastCycle);
    bool initializeWith(const qplc::messages::InitializeWithValues &initial);
    bool startCycles(const qplc::messages::RealTimeStarted &start);
    bool refusePhase(QPlcSlaveNode::Error reason, const QString &text);
    void controlLost(qplc::ControlClient::Loss loss, const QString &reason);
    void masterLost(QPlcAbstractSocket::Error socketError, const QString &text);
    void giveUp(QPlcSlaveNode::Error newError, const QString &text);
    void takeReports();
    void report(const qplc::CycleEvent &event);

    /// Tells one phase of one master from all others.
    struct PhaseName
    {
        quint64 session;
        quint64 cycleZero;
        bool operator==(const PhaseName &other) const
        {
            return session == other.session && cycleZero == other.cycleZero;
        }
    };

    QPlcMasterSocket *m_cyclicSocket = nullptr;
    std::optional<QPlcMessage> m_outputsAwaited;       // request of a master that has its cyclic connection already
    const qplc::TransportKind *m_transport = nullptr;  // that of the address of the master, or the one chosen by it
    std::unique_ptr<qplc::CyclicLink> m_link;          // until the cycle takes it
    std::unique_ptr<qplc::DatagramProbe> m_probe;      // of m_link, while the node waits for an answer
    std::unique_ptr<QSocketNotifier> m_reportNotifier;
    QSocketNotifier *m_cycleNotifier = nullptr;  // child of the node: it goes with it into another thread
    QTimer m_retryTimer;                         // children of the node: they go with it into another thread
    QTimer m_patience;                           // with an attempt to connect again
    QTimer m_rest;                               // runs while frames are taken that a stop has overtaken
    qplc::messages::RealTimeStopped m_stopTold;  // that stop
    qplc::BackOff m_backOff;
    bool m_wasRegistered = false;  // since connectToMaster()
    bool m_inPhase = false;        // from startCycles() to endPhase(); not for a node in the process of its master
    quint64 m_phase = 0;           // ordinal
    std::optional<PhaseName>
        m_lastPhase;                 // that the node has taken part in; none: it has failed since, or there was none
    bool m_goesOn = false;           // in m_lastPhase, where it was: no initialization
    bool m_isSafeByWatchdog = true;  // in this phase
    qplc::ReportLimiter m_watchdogReports;
    bool m_isSafeTold = false;  // in this phase
    QString m_uuid;
};
