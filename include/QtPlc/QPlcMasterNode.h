// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcClock.h"
#include "QPlcCycleStatistics.h"
#include "QPlcLease.h"
#include "QPlcManifest.h"
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

/// The master of a plant: it owns the cycle clock and the values of all signals.
///
/// \code
/// int main(int argc, char **argv)
/// {
///     QPlcCoreApplication application(argc, argv);
///     QPlcSignalIndexTable table;
///     if (!table.initializeFromIniFile("signals.ini"))
///         return application.usageError(table.errorString());
///     QPlcMasterNode master;
///     master.setTimeSignal("masterTime");
///     master.setInterval(std::chrono::milliseconds(10));
///     if (!master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 50000)))
///         return application.usageError(master.errorString());
///     return application.exec();
/// }
/// \endcode
///
/// In each cycle every node gets its inputs of the cycle before and answers with its outputs. Nodes
/// with same-cycle inputs (QPlcInputTiming) are asked after the nodes whose outputs they read. A
/// node that would close an algebraic loop of such inputs is refused. Nodes connect over the
/// network (startServer()) or live in the process of the master (addLocalNode()).
///
/// The plant stops safely (State::SafeStop) when safeStop() is called, when a limit of
/// setLongestWait(), setGapLimit() or setOverrunLimit() is exceeded, when a node with the policy
/// SafeStopWhenLate is late, and when a critical node (QPlcSlaveNode::setCritical()) is lost,
/// fails, or is late too often. docs/design/states.md has all states.
///
/// Errors: a function that fails returns false and changes nothing; error() and errorString() have
/// the reason, and errorOccurred() is emitted. A function that returns true sets error() back to
/// NoError.
///
/// \threadsafe no, except step(): the object lives in the thread that made it and needs its event
///     loop. Cycles run on a thread of their own; neither thread waits for the other
///
/// \ingroup master
class QTPLC_EXPORT QPlcMasterNode : public QObject
{
    Q_OBJECT
public:
    /// What the plant does.
    enum State : quint8 {
        Off,                   ///< no cycles, and no initialization
        Initializing,          ///< an initialization or a start is under way
        Ready,                 ///< all nodes are initialized: it can be armed and started
        RealTime,              ///< cycles run
        WaitingForLateSlaves,  ///< a node with a Wait policy has not answered: time stands still
        /// Latched: cycles go on, but all nodes have safe values and compute nothing, until
        /// reset().
        SafeStop,
        /// It cannot run: no port or no cycle thread; until reset() or a startServer() that
        /// succeeds.
        Fault
    };
    Q_ENUM(State)

    /// Kinds of errors.
    enum Error {
        NoError,  ///< nothing has failed since the last function that returned true
        /// A signal does not exist, has the wrong type, or has another writer.
        SignalError,
        IntervalError,  ///< period, clock, overrun policy or limit out of range
        /// The port cannot be used, or a file of the security settings is wrong.
        ServerError,
        NodeError,  ///< a node was refused, was lost, or has failed
        /// A node did not give its initial outputs in time, or they are out of range.
        InitializationError,
        StateError,  ///< not possible in the current state
        /// The cycle thread could not be made, or the master was too late: overrun, gap.
        RealTimeError
    };
    Q_ENUM(Error)

    /// How a step() has ended.
    enum class StepResult : quint8 {
        Complete,  ///< all nodes except listeners have answered
        /// A node was lost, in this step or since the last one, or did not answer within the
        /// longest wait: the signals that it writes have no new values, as if it were late in real
        /// time.
        Late,
        /// The plant stops safely, also because of this step: nodes have safe values and compute
        /// nothing.
        SafeStop,
        /// No cycles run, or they have ended in this step: it was stopped, or the code of a node
        /// has failed (error() is NodeError then).
        Stopped,
        Busy  ///< another thread is in a step(): nothing has happened
    };
    Q_ENUM(StepResult)

    /// Makes a master in the state Off, without signals and nodes.
    /// \param parent  owns the master, if given
    explicit QPlcMasterNode(QObject *parent = nullptr);
    /// Ends the cycles, tells all nodes that the master ends, and closes the server. Emits no
    /// signals.
    ~QPlcMasterNode() override;

    /// Sets the signals of this plant. By default it takes the table of the process
    /// (QPlcSignalIndexTable) at the first use.
    /// \return false when signals, nodes or a server use the table already
    bool setSignalTable(const QPlcSignalTable &table);
    /// Returns the table of this plant; empty before it was set or first used.
    QPlcSignalTable signalTable() const;

    // ---- signals that the master writes itself ----
    /// Lets the master write the time of the cycle into a signal: the wall clock at the start of
    /// the real-time phase plus the nominal time of the cycle. With a clock that is not timed
    /// (QPlcClock::isTimed()) it is 1970-01-01 plus the nominal time.
    /// \param signalName  of type DateTime, without another writer
    bool setTimeSignal(const QString &signalName);
    /// Lets the master write its jitter [s] into a signal: the wake-up of this cycle minus its
    /// nominal time; 0 if the clock is not timed.
    /// \param signalName  of type Real32 or Real64, without another writer
    bool activateJitterMeasurement(const QString &signalName);
    /// Lets the master write its workload [s] into a signal: the time that it has spent itself on
    /// the cycle before, without waiting for answers; 0 if the clock is not timed.
    /// \param signalName  of type Real32 or Real64, without another writer
    bool activateWorkloadMeasurement(const QString &signalName);
    /// Lets the master write a figure of the statistics into a signal: durations in s, counters as
    /// numbers. An integer signal stays at the largest number of its type. The value is updated
    /// twice a second and at the end of the phase. It is 0 before the first update, and always if
    /// the clock is not timed: then results must not depend on the machine.
    /// \param figure  what is measured
    /// \param signalName  Real32 or Real64 for a duration, any single number for a counter; without
    ///     another writer
    /// \param nodeName  node that the figure belongs to; it may register later. Empty: the master
    /// \return false when the signal does not exist, has another type or another writer, or when
    ///     the figure does not fit: one of a node without a name, one of the master with a name
    bool activateStatisticSignal(QPlcStatisticFigure figure, const QString &signalName,
                                 const QString &nodeName = QString());

    // ---- cycle ----
    /// Sets the period. Takes effect at the next start.
    /// \param period  10 us to 10 s; default 10 ms. Few computers keep a period below 200 us: the
    ///     statistics show it
    /// \return false when the period is out of range (IntervalError)
    bool setInterval(std::chrono::nanoseconds period);
    /// Sets the period in seconds, rounded to 1 ns, as above. NaN and infinity are out of range.
    bool setInterval(double seconds);
    /// Returns the nominal time between two cycles.
    std::chrono::nanoseconds interval() const;
    /// Sets how the cycles follow each other; default QPlcClock::realTime(). Takes effect at the
    /// next start.
    /// \return false when the clock is not valid (IntervalError)
    bool setClock(QPlcClock clock);
    /// Returns how the cycles follow each other.
    QPlcClock clock() const;
    /// Sets what the cycle thread asks of the operating system. Takes effect at the next start.
    /// Options that are out of range let that start fail (RealTimeError); realTimeSettings() shows
    /// what the system has granted.
    void setRealTimeOptions(const QPlcRealTimeOptions &options);
    /// Sets what happens to cycles whose period is over before they could begin; default
    /// QPlcOverrunPolicy::skipToGrid(). Takes effect at the next start; a clock that is not timed
    /// ignores it.
    /// \return false when the policy is not valid (IntervalError)
    bool setOverrunPolicy(QPlcOverrunPolicy policy);
    /// Returns what happens to cycles whose period is over before they could begin.
    QPlcOverrunPolicy overrunPolicy() const;
    /// Ends the real-time phase by itself after a number of periods. Skipped cycles count, so the
    /// simulated time is exact. Takes effect at the next start.
    /// \param cycles  0: no limit (default)
    void setCycleLimit(quint64 cycles);
    /// Computes one cycle with the clock QPlcClock::external(), on the calling thread, and returns
    /// when all nodes have answered. Simulated time advances by interval(), however long the step
    /// takes.
    ///
    /// It waits for remote nodes up to setLongestWait() (5 s by default), for all stages of the
    /// cycle together; the time that local nodes compute adds to it. At this limit a node with a
    /// Wait policy, with SafeStopWhenLate, or a critical one stops the plant safely. The cycle goes
    /// on without any other node (Late), and the next steps do not wait for it until it has
    /// answered again: a node that hangs costs one limit, not one in each step. stop(), safeStop(),
    /// and the same requests of operators end the wait within 20 ms, and act also between steps.
    ///
    /// If you call it on the thread of the master, it also handles what the cycle has reported:
    /// state() and error() are current when it returns. But messages of nodes and tools wait until
    /// the event loop runs. With remote nodes, use QPlcEmbeddedMaster, or give the master a thread
    /// of its own.
    ///
    /// With this clock, your program needs no QCoreApplication: if it has none when it adds nodes,
    /// starts the server or the cycles, the master makes one, in a thread of its own, and ends it
    /// when it is destroyed. Make your own one, if you need it, before that.
    ///
    /// \code
    /// class Tank : public QPlcCompactSlaveNode
    /// {
    /// public:
    ///     Tank() : QPlcCompactSlaveNode("Tank") {}
    /// private:
    ///     QPlcOutput<double> m_level{this, "level"};  // [m]
    ///     void step(const QPlcCycle &cycle) override { m_level = m_level + cycle.dt(); }
    /// };
    /// int main(int argc, char **argv)
    /// {
    ///     QPlcCoreApplication application(argc, argv);
    ///     QPlcMasterNode master;
    ///     master.setSignalTable(QPlcSignalTable::fromIni("[level]\ntype = Real64\n"));
    ///     master.setClock(QPlcClock::external());
    ///     Tank tank;
    ///     if (!master.addLocalNode(&tank) || !master.startRealTime())
    ///         return application.usageError(master.errorString());
    ///     for (int cycle = 0; cycle < 100; ++cycle)
    ///         master.step();
    ///     return 0;
    /// }
    /// \endcode
    /// \threadsafe yes, between the start and the destruction of the master: any thread, one at a
    ///     time; a second one gets Busy. Do not call it, or other functions of the master, from the
    ///     code of a local node
    StepResult step();
    /// Sets the longest wait for each answer of a node during initialization and start, in each
    /// profile. A node that joins while others run, and a listener, may take up to twice as long.
    /// The connection of a node that does not answer ends. A node waits at least 10 s for its first
    /// frame: if you set a longer time, set a watchdog of the nodes that is longer than it.
    /// \param time  1 ms to 24 h; default 2 s
    /// \return false when \a time is out of range (IntervalError)
    bool setInitializationTimeout(std::chrono::milliseconds time);

    /// Sets how strict the plant is where table, nodes and options do not say anything: see
    /// QPlcProfile. Takes effect at the next initialization or start.
    /// \param profile  default Automatic: the master chooses
    void setProfile(QPlcProfile::Value profile);
    /// Returns the profile of this phase; between phases the one that the next phase would have.
    /// Never Automatic.
    QPlcProfile::Value profile() const;
    /// Returns why the plant has this profile, for people: "node 'Winch' drives real devices".
    QString profileReason() const;

    /// Sets the file to which the master appends its events, one JSON object in a line, so that
    /// they survive it. `qtplc events --file` shows it, docs/design/event-files.md describes it. A
    /// full file (8 MiB) is renamed, and 8 of them are kept. A thread of its own writes them. If it
    /// cannot, the plant goes on, and the event "event file" says so.
    ///
    /// By default, a master with security, or of a plant with the profile Plant, writes to
    /// NAME-PORT.jsonl in $LOGS_DIRECTORY or $STATE_DIRECTORY (as systemd sets them), else in
    /// $XDG_STATE_HOME/qtplc, else in /var/log/qtplc for root and ~/.local/state/qtplc for others.
    /// \param fileName  in a folder that exists; empty: no file
    void setEventFile(const QString &fileName);
    /// Returns the file to which the master writes its events; empty: none yet.
    QString eventFile() const;

    /// Sets the nodes that the plant needs. Neither an initialization nor a start begins while a
    /// node is missing that the manifest calls critical or required: missingNodes() names it. A
    /// node that the manifest calls critical is critical, whatever it says itself. A node whose
    /// transport, watchdog or identity differs from the manifest is refused. Watchdogs are not
    /// checked in the profile Simulation, and neither they nor identities of local nodes.
    ///
    /// Without a manifest, the master needs each critical node that has registered, or was
    /// refused, since the master was made, until it is destroyed. A local node is needed until
    /// removeLocalNode().
    ///
    /// The profile of the manifest counts if setProfile() has not chosen one. If neither has, the
    /// profile is Plant.
    /// \param manifest  with at least one node; by default there is none
    /// \return false when a server or nodes exist already (StateError), or when \a manifest is
    ///     empty (NodeError)
    bool setManifest(const QPlcManifest &manifest);
    /// Returns the manifest; empty: none.
    QPlcManifest manifest() const;
    /// Returns which nodes an initialization or a start needs and does not find, why, and what to
    /// do; empty: none.
    QString missingNodes() const;

    // ---- safe stop (docs/design/states.md) ----
    /// Sets the longest time in the state WaitingForLateSlaves before the plant stops safely. By
    /// default the profile decides: forever or 5 s. Takes effect at the next start. Lockstep waits
    /// forever. With the clock External it is the longest wait of a step(), in real time, and 5 s
    /// instead of forever.
    /// \param time  up to 24 h on the clock of the master; 0: forever
    /// \return false when \a time is out of range (IntervalError)
    bool setLongestWait(std::chrono::nanoseconds time);
    /// Sets by how much a cycle may begin late before the plant stops safely, for example because
    /// the computer slept. By default the profile decides: any time or 1 s. Takes effect at the
    /// next start. Lockstep and External have no such limit.
    /// \param time  up to 24 h on the clock of the master; 0: any
    /// \return false when \a time is out of range (IntervalError)
    bool setGapLimit(std::chrono::nanoseconds time);
    /// Sets the number of successive overruns that is allowed: one more, and the plant stops
    /// safely. Takes effect at the next start.
    /// \param overruns  1 to 1 000 000; 0: any number (default)
    /// \return false when \a overruns is out of range (IntervalError)
    bool setOverrunLimit(int overruns);
    /// Sets whether a start takes two steps: arm() in the state Ready, then the start within 5 s.
    /// This holds for all persons and programs. By default it is required with security
    /// (setSecurity()).
    void setArmingRequired(bool required);
    /// Returns true if a start takes two steps.
    bool isArmingRequired() const;

    // ---- nodes ----
    /// Accepts nodes and tools at an address: control messages over TCP, cyclic frames over TCP,
    /// UDP or shared memory, as each node chooses. An address other than loopback needs
    /// setSecurity() or setInsecureNetworkAllowed(true); without them the server listens on
    /// loopback and warns.
    /// \param protocol  address and port; port 0 takes a free one, see serverPort(). The kind does
    ///     not matter
    /// \return false when the port cannot be used or a file of the security settings is wrong
    ///     (ServerError; the state is then Fault), or while cycles run (StateError)
    bool startServer(const QPlcUnderlyingProtocol &protocol);
    /// Sets a name by which nodes of this machine and user find this master
    /// (QPlcUnderlyingProtocol::local()). Takes effect with startServer().
    /// \param name  letters, digits, '.', '-', '_'; empty: only the port number (default)
    void setLocalName(const QString &name);
    /// Sets the group for nodes that connect with QPlcUnderlyingProtocol::udpMulticast(). Datagrams
    /// do not leave the network of the address on which the server listens. Takes effect with
    /// startServer().
    /// \param group  an IPv4 multicast address, for example 239.255.76.68; a null address: no group
    ///     (default)
    void setMulticastGroup(const QHostAddress &group);
    /// Sets whether programs can find this master on the network without its address; default
    /// false. Then it sends a datagram every 2 s to the multicast group 239.255.81.80, port 50081,
    /// of the networks of the address on which the server listens. The datagram has address, port,
    /// local name (or the name of the program) and hash of the signal table; everybody on the
    /// network can read it. Takes effect with startServer().
    void setBeacon(bool on);
    /// Ends the cycles, tells all nodes that the master ends, and stops listening. Does nothing
    /// without a server.
    void stopServer();
    /// Returns the port of the server; 0 when it does not listen.
    quint16 serverPort() const;
    /// Sets whether startServer() may listen on the network without security, where everybody can
    /// read and command the plant; default false.
    void setInsecureNetworkAllowed(bool allowed);
    /// Sets faults of a bad network for the cyclic frames of all nodes, for a test. docs/faults.md
    /// lists the words. All programs that connect are told and show it. Multicast groups have no
    /// faults. Takes effect with startServer().
    /// \param plan  for example "loss=5%,delay=2ms,seed=7"; empty: no faults (default)
    /// \return false when \a plan is not valid, or the server runs (StateError)
    bool setFaultPlan(const QString &plan);
    /// Returns the fault plan; empty: no faults.
    QString faultPlan() const;
    /// Sets who may connect, and what each identity may do; default: everybody may do everything.
    /// With security the server may listen on any address. Its files are read for each connection:
    /// a revoked key does not connect again, and a new key does, without a restart. Takes effect
    /// with startServer().
    void setSecurity(const QPlcSecurity &security);
    /// Returns who may connect.
    QPlcSecurity security() const;
    /// Sets how many control and cyclic connections may exist at a time; further ones are closed at
    /// once. Takes effect with startServer().
    /// \param connections  1 to 65 535; default 320, which is enough for 254 nodes
    /// \return false when \a connections is out of range (IntervalError)
    bool setMaximumConnections(int connections);
    /// Registers a node of this process. The cycle thread of the master calls it, or step(). A node
    /// with real devices cannot be local with the clock External: no start begins.
    /// \param node  owned by the caller, not null. A node that is destroyed leaves the master;
    ///     while cycles run, call removeLocalNode() before
    /// \return false when its signals or its name are refused (SignalError, NodeError), or when
    ///     cycles run or a safe stop or fault is latched (StateError). In the state Ready the
    ///     initialization is forgotten
    bool addLocalNode(QPlcSlaveNode *node);
    /// Removes a node that addLocalNode() has added. Cycles that run end before. Does nothing for
    /// any other node.
    void removeLocalNode(QPlcSlaveNode *node);
    /// Ends all connections of a node or person at once, also while cycles run, and refuses new
    /// ones under this name until admit() or the end of this master. A critical node that is
    /// evicted while cycles run stops the plant safely. A node that the plant needs
    /// (missingNodes()) stays needed: no start begins without it. The same as
    /// `qtplc evict NAME`; each eviction is in the event log.
    /// \param name  of a node, of an identity (setSecurity()), or as a tool has greeted. It has to
    ///     be connected, needed, or evicted already
    /// \return false when it is none of these, is a node of this process, or when 1000 names are
    ///     evicted (NodeError)
    bool evict(const QString &name);
    /// Lets somebody in again who was evicted. It has to connect again.
    /// \return false when this name is not evicted (NodeError)
    bool admit(const QString &name);
    /// Returns the names that are evicted, sorted.
    QStringList evictedNames() const;
    /// Returns all registered nodes, in the order of their registration.
    QVector<QPlcNodeInfo> nodes() const;
    /// Returns the order in which the nodes are asked in a cycle, and the age of the values that
    /// they read.
    QPlcSchedule schedule() const;
    /// Returns the name of the node that writes a signal ("Master": the master itself); empty: no
    /// node does, or there is no such signal.
    QString writer(const QString &signalName) const;
    /// Returns the leases of signals, also those whose holder is lost, in the order of the signal
    /// table.
    QVector<QPlcLease> leases() const;

    // ---- state ----
    /// Returns what the plant does.
    State state() const;
    /// Returns why the state is SafeStop or Fault, with names; empty in all other states.
    QString stateReason() const;
    /// Returns what keeps reset() from leaving SafeStop, with names; empty: nothing does.
    QString causeThatRemains() const;
    /// Returns true if arm() was called less than 5 s ago and no start has followed.
    bool isArmed() const;
    /// Returns the kind of the last error: why a function has returned false, or what has failed
    /// since. A function that returns true sets it back to NoError.
    Error error() const;
    /// Returns the last error as a sentence with the remedy; empty: there was none.
    QString errorString() const;
    /// Returns counters and the most important durations of this phase or the last one; quick.
    QPlcMasterStatistics statistics() const;
    /// Returns all durations, counters, nodes and the worst cycles since the start of this phase or
    /// the last one. Takes about 10 us for the master and for each node, and never disturbs the
    /// cycle. While cycles run, durations are at most 0.1 s old; counters are current.
    /// \param detail  whether histograms are wanted, which take time and memory
    QPlcCycleStatistics cycleStatistics(QPlcDistribution::Detail detail = QPlcDistribution::FiguresOnly) const;
    /// Returns what the operating system has granted of the real-time options at the last start.
    QVector<QPlcRealTimeSetting> realTimeSettings() const;
    /// Returns the number of the newest complete cycle of the real-time phase.
    quint64 cycle() const;
    /// Returns the newest value of a signal; an invalid value if there is no such signal.
    QPlcValue signalValue(const QString &signalName) const;
    /// Returns the quality of the newest value of a signal; Invalid if there is no such signal.
    QPlcQuality signalQuality(const QString &signalName) const;
    /// Sets a signal that no node writes; the value counts from the next cycle on.
    /// \param value  converted to the type of the signal
    /// \return false when the signal does not exist, has a writer, or is under a lease, when \a
    ///     value does not fit or is out of range (SignalError), or when too many changes wait for
    ///     one cycle (StateError)
    bool setSignalValue(const QString &signalName, const QPlcValue &value);

public Q_SLOTS:
    /// Asks all nodes for their initial outputs, and gives all of them their initial inputs.
    /// statesInitialized() or errorOccurred() follows. Possible in Off and Ready, when no node is
    /// missing (missingNodes()).
    /// \return false when it cannot begin, or has failed at once
    bool initializeAllStates();
    /// Permits one start within the next 5 s: the first of two steps, so that a single mistake
    /// moves nothing.
    /// \return false unless the state is Ready
    bool arm();
    /// Begins the real-time phase. In the state Off an initialization comes first.
    /// stateChanged(RealTime) or errorOccurred() follows.
    /// \return false when arming is required and arm() was not called in the last 5 s, when a node
    ///     is missing (missingNodes()), or when the state or the real-time options do not permit it
    bool startRealTime();
    /// Ends the real-time phase: nodes go to their safe state, and the signals keep their values
    /// here. In SafeStop and Fault it does nothing.
    void stop();
    /// Stops safely, and latches: from the next cycle on all nodes have their safe values and
    /// compute nothing, until reset(). When no cycle runs, an initialization, a start or an arming
    /// ends, and the state is Off.
    /// \param reason  for stateReason(); empty: a sentence about this call
    void safeStop(const QString &reason = QString());
    /// Leaves SafeStop or Fault for Off. Does nothing in Off.
    /// \return false when the cause still exists: errorString() says which and what to do; or when
    ///     nothing is latched
    bool reset();

Q_SIGNALS:
    /// Emitted when the state has changed. stateReason() is set already.
    void stateChanged(QPlcMasterNode::State state);
    /// Emitted when a node is registered and its cyclic channel works.
    void nodeRegistered(const QString &name);
    /// Emitted when a node or tool was refused.
    /// \param name  as it has introduced itself
    /// \param reason  for people
    void nodeRefused(const QString &name, const QString &reason);
    /// Emitted when a registered node has left, in order or not.
    /// \param name  of the node
    /// \param reason  for people
    void nodeLost(const QString &name, const QString &reason);
    /// Emitted when all nodes are initialized. In a start that includes an initialization it comes
    /// before the cycles begin.
    void statesInitialized();
    /// Emitted when the cycles run and the local nodes are started; stateChanged(RealTime) came
    /// before.
    void realTimeHasStarted();
    /// Emitted before the first cycle of a phase, when the memory is there from which its cycles
    /// are recorded. A recorder that begins in a slot that is connected directly gets all cycles.
    /// \param file  of that memory, for `qtplc record --ring`
    void ringIsReady(const QString &file);
    /// Emitted when the phase has ended, after errorOccurred() if that was why. In lockstep up to 2
    /// s later: when a recorder on another computer has the last cycles.
    void realTimeHasStopped();
    /// Emitted when a node with an Error policy had not answered at the end of a cycle.
    /// \param name  of the node
    /// \param cycle  number of the cycle
    void realTimeViolated(const QString &name, quint64 cycle);
    /// Emitted after stateChanged(SafeStop).
    /// \param reason  the same as stateReason()
    void safelyStopped(const QString &reason);
    /// Emitted when leases() has changed: a lease was taken, released or lost.
    void leaseChanged();
    /// Emitted for each error; errorString() has the reason.
    void errorOccurred(QPlcMasterNode::Error error);

private:
    friend class QPlcMasterNodePrivate;
    std::unique_ptr<QPlcMasterNodePrivate> d;
};

Q_DECLARE_METATYPE(QPlcMasterNode::State)
Q_DECLARE_METATYPE(QPlcMasterNode::Error)
Q_DECLARE_METATYPE(QPlcMasterNode::StepResult)
