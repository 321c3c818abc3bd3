// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcClock.h"
#include "QPlcCycleStatistics.h"
#include "QPlcLease.h"
#include "QPlcMasterStatistics.h"
#include "QPlcNodeInfo.h"
#include "QPlcOverrunPolicy.h"
#include "QPlcProfile.h"
#include "QPlcQuality.h"
#include "QPlcRealTimeOptions.h"
#include "QPlcSchedule.h"
#include "QPlcSecurity.h"
#include "QPlcSignalTable.h"
#include "QPlcSlaveNode.h"
#include "QPlcStatisticFigure.h"
#include "QPlcUnderlyingProtocol.h"

#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtCore/QVector>

#include <chrono>
#include <memory>

class QPlcMasterNodePrivate;

/// The owner of the cycle clock and of the values of all signals.
///
/// ```cpp
/// QPlcCoreApplication application(argc, argv);
/// QPlcSignalIndexTable table;
/// if (!table.initializeFromIniFile("signals.ini"))
///     return 2;
/// QPlcMasterNode master;
/// master.setTimeSignal("masterTime");
/// master.setInterval(std::chrono::milliseconds(10));
/// if (!master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 50000)))
///     return 2;
/// return application.exec();
/// ```
///
/// In each cycle every node gets its inputs of the cycle before and answers with its outputs; nodes with same-cycle inputs (QPlcInputTiming) are asked when
/// the nodes have answered whose outputs they read. A node that would close an algebraic loop of such inputs is refused. Nodes come over the network (startServer()) or live in this
/// process (addLocalNode()).
///
/// Threads: the object lives in the thread that made it and needs its event loop; cycles run on a thread of their own, which nothing here ever waits for
/// and which never waits for anything here.
class QTPLC_EXPORT QPlcMasterNode : public QObject
{
    Q_OBJECT
public:
    enum State : quint8 {
        Off,
        Initializing,  ///< an initialization, or a start, is under way
        Ready,         ///< all nodes are initialized: can be armed and started
        RealTime,
        WaitingForLateSlaves,  ///< a node with a Wait policy has not answered: time stands still
        SafeStop,  ///< latched: cycles go on, all nodes are told their safe values and compute nothing, until reset()
        Fault      ///< it cannot run: no port, or no cycle thread; until reset() or a startServer() that succeeds
    };
    Q_ENUM(State)

    enum Error {
        NoError,
        SignalError,          ///< a signal that does not exist, has the wrong type or another writer
        IntervalError,        ///< period or clock out of range
        ServerError,          ///< the port cannot be used
        NodeError,            ///< a node was refused, got lost or failed
        InitializationError,  ///< a node did not give its initial outputs in time
        StateError,           ///< not possible in the present state
        RealTimeError         ///< the cycle thread could not be made, or an overrun with QPlcOverrunPolicy::Stop
    };
    Q_ENUM(Error)

    explicit QPlcMasterNode(QObject *parent = nullptr);
    ~QPlcMasterNode() override;

    /// The signals of this controller. Unless set: those of the process (QPlcSignalIndexTable) at the first use.
    /// \return false when nodes are registered already
    bool setSignalTable(const QPlcSignalTable &table);
    QPlcSignalTable signalTable() const;

    // ---- signals that the master writes itself ----
    /// Time of the cycle: wall clock at the start of the real-time phase + nominal time of the cycle (1970-01-01 + nominal time in lockstep). Type DateTime.
    bool setTimeSignal(const QString &signalName);
    /// Jitter [s]: wake-up of this cycle - its nominal time; 0 in lockstep. Type Real32 or Real64.
    bool activateJitterMeasurement(const QString &signalName);
    /// Workload [s]: time that the master itself spent on the cycle before, without waiting for answers; 0 in lockstep. Type Real32 or Real64.
    bool activateWorkloadMeasurement(const QString &signalName);
    /// Writes one figure of the statistics into a signal: durations in s (Real32 or Real64), counters as numbers (also integers; they stay at the largest
    /// number of their type). Updated twice a second and at the end of the phase; 0 before the first update, and always 0 in lockstep, where results must not
    /// depend on the machine.
    /// \param nodeName  of the node to which the figure belongs; it may register later. Empty: the master
    /// \return false when the signal does not exist, has another type or another writer, or the figure belongs to the other kind (master, node)
    bool activateStatisticSignal(QPlcStatisticFigure figure, const QString &signalName,
                                 const QString &nodeName = QString());

    // ---- cycle ----
    /// Sets the period. Takes effect at the next start.
    /// \param period  10 us ... 10 s; below some 200 us only few computers keep it, which the statistics tell
    /// \return false when out of range: nothing has changed
    bool setInterval(std::chrono::nanoseconds period);
    bool setInterval(double seconds) { return setInterval(std::chrono::nanoseconds(qRound64(seconds * 1e9))); }
    std::chrono::nanoseconds interval() const;
    /// Takes effect at the next start. \return false when the clock is not valid
    bool setClock(QPlcClock clock);
    QPlcClock clock() const;
    void setRealTimeOptions(const QPlcRealTimeOptions &options);
    /// What becomes of cycles whose period is over before they could begin; SkipToGrid unless set. Takes effect at the next start; lockstep ignores it.
    /// \return false when \a policy is not valid: error() is then IntervalError and nothing has changed
    bool setOverrunPolicy(QPlcOverrunPolicy policy);
    QPlcOverrunPolicy overrunPolicy() const;
    /// Ends the real-time phase by itself after \a cycles periods (skipped ones count, so that the simulated time is exact); 0: never. Takes effect at the next start.
    void setCycleLimit(quint64 cycles);
    /// Sets the longest wait for each answer of a node during initialization and start, in each profile.
    /// \param time  1 ms or longer; 2 s unless set
    void setInitializationTimeout(std::chrono::milliseconds time);

    /// Sets how strict the plant is where table, nodes and options say nothing: see QPlcProfile. Takes effect at the next
    /// initialization or start.
    /// \param profile  Automatic (unless set): the master chooses
    void setProfile(QPlcProfile::Value profile);
    /// Returns the profile of the phase at hand; between phases the one that the next phase would have. Never Automatic.
    QPlcProfile::Value profile() const;
    /// Returns why it is this profile, for people: "node 'Winch' drives real devices".
    QString profileReason() const;

    // ---- safe stop (docs/design/states.md) ----
    // Besides these limits, safeStop(), a late node with the policy SafeStopWhenLate, and a critical node that is lost, fails or is late too often
    // (QPlcSlaveNode::setCritical()) lead to State::SafeStop. All limits take effect at the next start.
    /// Sets the longest stay in WaitingForLateSlaves, on the clock of the master; 0: for ever. Unless set, the profile decides.
    /// Lockstep waits for ever.
    void setLongestWait(std::chrono::nanoseconds time);
    /// Sets the longest time by which a cycle may begin late (the program was stopped, the computer slept); 0: any. Unless set,
    /// the profile decides. Lockstep has no such limit.
    void setGapLimit(std::chrono::nanoseconds time);
    /// Overruns in a row that are too many; 0 (unless set): any number is borne, as on a computer that does other things, too.
    void setOverrunLimit(int overruns);
    /// Whether a start, by whomever, is two steps: arm() in state Ready, then the start within 5 s. Unless set, with security (setSecurity()) it is, and without it is not.
    void setArmingRequired(bool required);
    bool isArmingRequired() const;

    // ---- nodes ----
    /// Accepts nodes at the address and port of \a protocol: control over TCP, cyclic frames over TCP and UDP, as each node likes. Port 0 takes a free one.
    /// An address that is not loopback is bound only after setInsecureNetworkAllowed(true); else the server listens on loopback, and says so.
    bool startServer(const QPlcUnderlyingProtocol &protocol);
    /// A name under which nodes of this machine and user find this master (QPlcUnderlyingProtocol::local()): letters, digits, '.', '-', '_'; empty: the port
    /// number only. Takes effect with startServer().
    void setLocalName(const QString &name);
    /// A group (an IPv4 multicast address, say 239.255.76.68) for nodes that connect by QPlcUnderlyingProtocol::udpMulticast(); a null address: none.
    /// The datagrams do not leave the network of the address that the server listens on. Takes effect with startServer().
    void setMulticastGroup(const QHostAddress &group);
    /// Lets people find this master on the network without knowing its address: sends a datagram every 2 s to the multicast group 239.255.81.80:50081 of the networks
    /// of the address that the server listens on (of none beyond this machine for a loopback). It tells address, port, the local name or the name of the
    /// program, and the hash of the signal table to everybody there. Off unless set. Takes effect with startServer().
    void setBeacon(bool on);
    void stopServer();
    /// 0 when not listening.
    quint16 serverPort() const;
    /// Lets startServer() listen to the network, where everybody can read and command the plant.
    void setInsecureNetworkAllowed(bool allowed);
    /// Lets the cyclic frames of all nodes meet the faults of a bad network, for a test: docs/faults.md has the words, for example "loss=5%,delay=2ms,seed=7"; empty: none.
    /// Whoever connects is told, and sees it. Takes effect with startServer(); multicast groups have no faults.
    /// \return false when \a plan cannot be meant, or the server runs: error() is then StateError and nothing has changed
    bool setFaultPlan(const QString &plan);
    QString faultPlan() const;
    /// Who may connect, and what each identity may do; nobody is asked unless set. With it every address may be listened on. Files are read again for each connection:
    /// who was revoked does not come in again, and who was added does. Takes effect with startServer().
    void setSecurity(const QPlcSecurity &security);
    QPlcSecurity security() const;
    /// How many nodes and tools may be connected at a time; 320 unless set, which is for 254 nodes. Further ones are closed at once. Takes effect with startServer().
    void setMaximumConnections(int connections);
    /// Registers \a node, which then lives in this process and is called on the cycle thread. The caller keeps owning it. A node that ends leaves
    /// the master; while cycles run it must not end before removeLocalNode(). \return false when it is refused, or when the state is not Off
    bool addLocalNode(QPlcSlaveNode *node);
    void removeLocalNode(QPlcSlaveNode *node);
    /// All registered nodes, in the order of their registration.
    QVector<QPlcNodeInfo> nodes() const;
    /// The order in which the nodes() are asked in a cycle, and how old the values are that they read.
    QPlcSchedule schedule() const;
    /// Name of the node that writes \a signalName; empty: none.
    QString writer(const QString &signalName) const;
    /// Signals that somebody has taken over by a lease, also where the holder is lost, in the order of the table.
    QVector<QPlcLease> leases() const;

    // ---- state ----
    State state() const;
    /// Why the state is SafeStop or Fault, with names; else empty.
    QString stateReason() const;
    /// What still keeps reset() from leaving SafeStop, with names; empty: nothing.
    QString causeThatRemains() const;
    /// Whether arm() was called, and the start is still to come.
    bool isArmed() const;
    Error error() const;
    /// What went wrong last, with the remedy; empty: nothing.
    QString errorString() const;
    /// Counters and the most important durations, quick to read.
    QPlcMasterStatistics statistics() const;
    /// All durations, counters, nodes and the worst cycles since the start of the last real-time phase. Takes some 10 us for the master and for each node; the cycle is
    /// never disturbed. Durations are at most 0.1 s old while cycles run, counters are those of now.
    QPlcCycleStatistics cycleStatistics(QPlcDistribution::Detail detail = QPlcDistribution::FiguresOnly) const;
    /// What became of the real-time options at the last start.
    QVector<QPlcRealTimeSetting> realTimeSettings() const;
    /// Number of the newest complete cycle of the real-time phase.
    quint64 cycle() const;
    /// Newest value of a signal; invalid when there is no such signal.
    QPlcValue signalValue(const QString &signalName) const;
    /// How far the newest value of a signal can be trusted; Invalid when there is no such signal.
    QPlcQuality signalQuality(const QString &signalName) const;
    /// Sets a signal that no node writes, between two cycles.
    /// \return false when it has a writer, is taken over by a lease, does not exist, or \a value does not fit
    bool setSignalValue(const QString &signalName, const QPlcValue &value);

public Q_SLOTS:
    /// Asks all nodes for their initial outputs and gives all of them their initial inputs; statesInitialized() or errorOccurred() follows.
    bool initializeAllStates();
    /// Permits one start within the next 5 s: the first of two steps, so that nothing moves by a single mistake. \return false unless the state is Ready
    bool arm();
    /// Begins the real-time phase, after an initialization if there was none since the last phase; stateChanged(RealTime) or errorOccurred() follows.
    /// \return false when arming is required and arm() was not called in the last 5 s, or when the state does not permit it
    bool startRealTime();
    /// Ends the real-time phase: nodes go to their safe state, signals keep their values here. SafeStop stays what it is.
    void stop();
    /// Stops safely, and latches: from the next cycle on all nodes are told their safe values and compute nothing. When no cycle runs, what was begun or armed
    /// ends, and the state is Off.
    void safeStop(const QString &reason = QString());
    /// Leaves SafeStop or Fault for Off. \return false when the cause is still there: errorString() tells which, and what to do
    bool reset();

Q_SIGNALS:
    void stateChanged(QPlcMasterNode::State state);
    void nodeRegistered(const QString &name);
    void nodeRefused(const QString &name, const QString &reason);
    void nodeLost(const QString &name, const QString &reason);
    void statesInitialized();
    void realTimeHasStarted();
    /// The phase has ended: by stop(), at the cycle limit, or because of an error (then errorOccurred() came before).
    void realTimeHasStopped();
    /// A node with an Error policy had not answered in cycle \a cycle when its time was over.
    void realTimeViolated(const QString &name, quint64 cycle);
    /// From stateChanged(SafeStop) on; \a reason is that of stateReason().
    void safelyStopped(const QString &reason);
    /// Somebody has taken, released or lost a lease: leases() has changed.
    void leaseChanged();
    void errorOccurred(QPlcMasterNode::Error error);

private:
    friend class QPlcMasterNodePrivate;
    std::unique_ptr<QPlcMasterNodePrivate> d;
};

Q_DECLARE_METATYPE(QPlcMasterNode::State)
Q_DECLARE_METATYPE(QPlcMasterNode::Error)
