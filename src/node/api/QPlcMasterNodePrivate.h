// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LocalNode.h"
#include "QPlcMasterNode.h"
#include "node/cycle/MasterCycle.h"
#include "node/cycle/NodeRegistry.h"
#include "node/cycle/ProfileDefaults.h"
#include "node/session/Arming.h"
#include "node/session/AskedStop.h"
#include "node/session/GoneNodes.h"
#include "node/session/MasterBeacon.h"
#include "node/session/MasterLeases.h"
#include "node/session/MasterServer.h"
#include "node/session/MasterSettings.h"
#include "node/session/ViewerPushes.h"
#include "node/state/MasterStates.h"
#include "node/statistics/Journal.h"
#include "node/statistics/RefusedValues.h"
#include "node/statistics/StatisticSignals.h"

#include <QtCore/QPointer>
#include <QtCore/QSocketNotifier>
#include <QtCore/QTimer>

#include <memory>
#include <set>

/// States and sequences of a master: initialization, start, stop, and nodes that join while others run.
///
/// A sequence is a row of steps; in each step every participating node owes one answer, and the next step begins when all have given it. Listeners do not
/// participate: they are told the same, and join when they have answered.
class QPlcMasterNodePrivate
{
public:
    explicit QPlcMasterNodePrivate(QPlcMasterNode *master);
    ~QPlcMasterNodePrivate();

    /// Fixes the signal table and makes everything that depends on it. \return false when there is no table
    bool prepare();
    bool claimSignal(const QString &name, QPlcSignalIndex *place, bool (*accepts)(QPlcSignalType),
                     const QString &wantedType);
    bool startServer(const QPlcUnderlyingProtocol &protocol);
    void injectFaults();
    bool addLocalNode(QPlcSlaveNode *node);
    void removeLocalNode(QPlcSlaveNode *node);

    bool initializeAllStates();
    /// \param isPermitted  false: arming is required, and what the asker showed permits nothing
    bool startRealTime(quint64 cycles, bool isPermitted);
    void stop(const QString &reason);
    /// The master, its server or a local node ends.
    void end(const QString &reason);
    void safeStop(const QString &reason);
    bool arm();
    bool isArmingRequired() const { return armingWanted.value_or(!security.isNone()); }
    bool isStartPermitted(quint64 token) const;
    bool reset();
    /// Of the phase at hand, else of the next one.
    qplc::ChosenProfile profile() const;
    /// Why the latched fault cannot be reset yet; empty: it can.
    QString remainingCause() const;
    bool setSignalValue(const QString &name, const QPlcValue &value);

    /// Something has happened: the master goes to the next state as qplc::masterStates() says, and does what belongs to it.
    /// \param reason  for people; empty: none
    /// \return false when the present state refuses \a event: error() is StateError then and says why
    bool apply(qplc::MasterEvent event, const QString &reason = QString());
    bool setError(QPlcMasterNode::Error newError, const QString &text);
    /// \param source  the node that is to blame
    bool setError(QPlcMasterNode::Error newError, const QString &text, const QString &source,
                  qplc::JournalEvent::Kind kind);
    QPlcNodeInfo info(const qplc::NodeSlot &slot) const;
    QPlcCycleStatistics cycleStatistics(QPlcDistribution::Detail detail) const;
    bool activateStatisticSignal(QPlcStatisticFigure figure, const QString &signalName, const QString &nodeName);

    QPlcMasterNode *const q;
    QPlcSignalTable table;
    std::chrono::nanoseconds interval{10'000'000};
    QPlcClock clock;
    QPlcOverrunPolicy overrunPolicy;
    QPlcRealTimeOptions realTimeOptions;
    quint64 cycleLimit = 0;
    bool insecureNetworkAllowed = false;
    bool hasBeacon = false;
    QString faultPlan;
    QPlcSecurity security;
    int maximumConnections = qplc::ConnectionGate::Limits().connections;
    QString networkSecurity = QStringLiteral("none");  // as Hello tells it
    QString localName;
    QHostAddress multicastGroup;
    QPlcSignalIndex timeSignal = QPlcInvalidSignalIndex;
    QPlcSignalIndex jitterSignal = QPlcInvalidSignalIndex;
    QPlcSignalIndex workloadSignal = QPlcInvalidSignalIndex;
    QPlcProfile::Value profileWanted = QPlcProfile::Automatic;
    std::optional<std::chrono::nanoseconds> longestWait;  // else as the profile says
    std::optional<std::chrono::nanoseconds> gapLimit;     // likewise
    int overrunLimit = 0;
    std::optional<bool> armingWanted;  // else: with security
    qplc::Arming arming;
    QPlcMasterNode::State state = QPlcMasterNode::Off;
    QString stateReason;        // of SafeStop and Fault
    qplc::AskedStop askedStop;  // until the next phase
    QPlcMasterNode::Error error = QPlcMasterNode::NoError;
    QString errorString;
    QTimer stepTimer;
    qplc::Journal journal;
    qplc::RefusedValues refusedValues;
    qplc::Leases leaseBooks;
    const quint64 session;
    const QString uuid;
    std::unique_ptr<qplc::NodeRegistry> registry;
    qplc::CyclicHub hub;
    std::unique_ptr<qplc::MasterCycle> cycle;
    std::unique_ptr<qplc::MasterServer> server;
    qplc::MasterBeacon beacon;
    qplc::StatisticSignals statisticSignals;
    std::unique_ptr<qplc::MasterSettings> settings;
    std::unique_ptr<qplc::MasterLeases> leases;
    std::unique_ptr<qplc::ViewerPushes> pushes;

private:
    using Connection = qplc::MasterConnection;
    class Requests;
    enum class Step : quint8 { None, CollectOutputs, DistributeInputs, Start };

    /// Whether cycles run, safe ones or others.
    bool isRunning() const { return m_isRunning; }
    void receive(Connection *connection, const QPlcMessage &message);
    void request(Connection *connection, bool accepted);
    void enter(QPlcMasterNode::State newState, const QString &reason);
    void prepareFor(qplc::MasterAction action);
    void carryOut(qplc::MasterAction action, const QString &reason);
    void tellRefusal(qplc::MasterEvent event, const char *text);
    void blame(const QString &node, bool mustReturn);
    void tellSafeStop();
    QString stateOf(const qplc::NodeSlot &slot) const;
    bool takesPart(const qplc::NodeSlot &slot) const;
    void prepareViewers();
    QString nameOf(const QObject *socket) const;
    bool checkSecurity();
    void chooseAddress(QHostAddress *address);
    void watchSecurity();
    QString cycleText() const;

    quint64 begin(Step step, Connection::Stage owed);
    bool isStill(quint64 step) const { return m_step != Step::None && m_stepNumber == step; }
    std::shared_ptr<qplc::LocalNode> localNode(const qplc::NodeSlot *slot) const;
    bool hasFixedProfile() const;
    qplc::ChosenProfile profileForNow() const;
    void fixProfile();
    const qplc::ProfileDefaults &defaults() const { return qplc::ProfileDefaults::of(m_profile.value); }
    qplc::Refusal objectionTo(const qplc::NodeDeclaration &node) const;
    void tellReturn(const Connection *connection, bool goesOn);
    void continueSequence(Connection *connection, QPlcMessage::Kind answer, const QByteArray &outputs);
    void advance();
    void collectOutputs();
    QString faultOfOutputs(const qplc::NodeSlot &slot, const char *outputs) const;
    bool takeOutputs(qplc::NodeSlot &slot, const char *outputs);
    void distributeInputs();
    void initializationEnded();
    void beginStart();
    void startCycles();
    void endSequence(const QString &reason);
    void endCycles();
    void tellStopped(const QString &reason);
    void sequenceFailed(const QString &reason);
    void stepTimedOut();
    void answerRequester(bool done, const QString &text);

    std::vector<Connection *> listeners() const;
    void join(Connection *connection);
    void continueJoin(Connection *connection, QPlcMessage::Kind answer, const QByteArray &outputs, bool goesOn);
    void goOn(Connection *connection);
    void sendInitialInputs(const Connection *connection);
    bool storeOutputs(Connection *connection, const QByteArray &values);
    qplc::messages::RealTimeStarted startOf(const qplc::NodeSlot &slot) const;
    void giveRoster();
    std::vector<bool> safeSignals(const qplc::Roster &roster);

    void nodeLost(Connection *connection, const QString &reason);
    void takeReports();
    void report(const qplc::CycleEvent &event);
    void stopAfterOverrun(const qplc::CycleEvent &event);
    bool dropFaulty(quint16 id, const QString &text);
    void fault(const QString &node, bool isCritical, const QString &text);
    void tripped(const qplc::CycleEvent &event);
    void criticalNodeLost(const QString &node, const QString &text);
    bool isCritical(quint16 id) const;
    QString nodeName(quint16 id) const;

    Step m_step = Step::None;
    quint64 m_stepNumber = 0;                                    // of those that have begun
    std::vector<std::shared_ptr<qplc::LocalNode>> m_localNodes;  // loops walk over a copy: nodes may leave
    Connection::Stage m_owed = Connection::Silent;               // stage that every participant reaches by its answer
    std::vector<Connection *> m_participants;
    Connection *m_joiner = nullptr;  // who LetJoin is about
    bool m_isWaitTold = true;        // the wait at hand, by an event: not when all late nodes have a silent policy
    QString m_culprit;               // node that the latched fault is about; empty: none
    bool m_mustReturn = false;       // the culprit was lost: it has to be there again before a reset
    std::vector<bool> m_written;     // by index: signals that nodes have written since the phase began
    qplc::ChosenProfile m_profile;   // of the phase at hand or the last one
    bool m_isRunning = false;
    bool m_hasEnded = false;  // the cycles; and the nodes are still to be told
    bool m_startAfterwards = false;
    quint64 m_cyclesWanted = 0;
    qplc::MulticastParts m_multicastParts;
    QPointer<QPlcSlaveSocket> m_requester;
    qplc::GoneNodes m_gone;                 // of this phase
    std::set<QPlcSignalIndex> m_abandoned;  // of this phase: signals whose writer left before it was ready for cycles
    QStringList m_becameSafe;               // signals of the reports at hand
    std::unique_ptr<QSocketNotifier> m_reportNotifier;
};
