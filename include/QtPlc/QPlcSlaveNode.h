// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcAbstractSocket.h"
#include "QPlcCycle.h"
#include "QPlcProfile.h"
#include "QPlcRealTimeOptions.h"
#include "QPlcSecurity.h"
#include "QPlcSignalIndexList.h"
#include "QPlcSignalList.h"
#include "QPlcSignalTable.h"
#include "QPlcSlaveStatistics.h"
#include "QPlcUnderlyingProtocol.h"

#include <QtCore/QObject>

#include <chrono>
#include <memory>

namespace qplc {
class NodeCode;
class PayloadLayout;
}  // namespace qplc
class QPlcSlaveNodePrivate;

/// A node of a plant: a model, a sensor, an actuator, a controller, a view.
///
/// A node reads and writes signals by name. Its master asks it once in each cycle: the inputs
/// arrive, realTimeout() computes, the outputs go back. Derive from QPlcCompactSlaveNode for typed
/// ports and a cycle without allocations. Derive from this class for lists of values:
///
/// \code
/// class Doubler : public QPlcSlaveNode
/// {
/// public:
///     Doubler() : QPlcSlaveNode("Doubler", ErrorZeroOrderHold) {}
///     ~Doubler() override { disconnectFromMaster(); }
///
/// protected:
///     QPlcSignalIndexList declareInputSignals() override
///     {
///         QPlcSignalIndexList list;
///         m_in = list.insert("in");
///         return list;
///     }
///     QPlcSignalIndexList declareOutputSignals() override
///     {
///         QPlcSignalIndexList list;
///         m_out = list.insert("out");
///         return list;
///     }
///     QPlcSignalList realTimeout(const QPlcSignalList &inputs) override
///     {
///         QPlcSignalList outputs;
///         outputs.insert(m_out, 2.0 * inputs.value(m_in).toReal());
///         return outputs;
///     }
///
/// private:
///     QPlcSignalIndex m_in, m_out;
/// };
/// \endcode
///
/// While cycles run, the cycle thread uses the members of the derived class. Call
/// disconnectFromMaster() in the destructor of that class, as above. QPlcNodeApplication does it
/// before it returns. Ports protect themselves and all members that are declared before the last
/// port. You get a warning if you forget it: the cycles then end in the destructor of this class,
/// and safeState() is not called.
///
/// Errors: a function that fails returns false, or errorOccurred() follows; error() and
/// errorString() have the reason. An exception in your code never leaves the node: the node goes to
/// State::Fault and its safe state, and the master is told.
///
/// \threadsafe no: the object lives in the thread that made it and needs its event loop. The cycle
///     thread of the node (for a local node that of the master) calls realTimeout(),
///     outputSignals() and updateStates(). All other virtual functions are called in the thread of
///     the object while no cycle runs; safeState() may come from both. They never run at the same
///     time
///
/// \ingroup nodes
class QTPLC_EXPORT QPlcSlaveNode : public QObject
{
    Q_OBJECT
public:
    /// What the master does when the answer of this node does not arrive in time (real-time
    /// violation).
    enum RealTimeViolationPolicy : quint8 {
        SilentZeroOrderHold,  ///< it goes on with the last values
        ErrorZeroOrderHold,   ///< it goes on with the last values, and reports the violation
        SilentWait,           ///< it waits: time stands still until the answer arrives
        ErrorWait,            ///< it waits, and reports the violation
        SafeStopWhenLate      ///< it reports the violation, and the whole plant stops safely
    };
    Q_ENUM(RealTimeViolationPolicy)

    /// What the node does.
    enum State : quint8 {
        Disconnected,  ///< it has no connection
        Connecting,    ///< it waits for the connection
        Registering,   ///< it is connected; the master has not accepted it yet
        Rejected,      ///< the master has refused it, for a reason that does not pass by itself
        Registered,    ///< the master has accepted it; no cycles run
        Initializing,  ///< it gives its initial outputs
        Ready,         ///< it has its initial inputs; a real-time phase may begin
        RealTime,      ///< it computes cycles
        /// It is in its safe state: the master stops safely, is silent, or is lost.
        SafeStop,
        Fault,            ///< its own code has failed: safe state until the next initialization
        Off = Registered  ///< the same as Registered; the name of the thesis
    };
    Q_ENUM(State)

    /// Why safeState() is called.
    enum SafeStateReason : quint8 {
        PhaseEnded,         ///< the master has stopped, or this node leaves
        MasterStopsSafely,  ///< the master is in its state SafeStop
        WatchdogReason,     ///< no frame came within the watchdog time
        MasterLost,         ///< the connection to the master is lost
        CodeFailed          ///< a function of this node, for example step(), threw an exception
    };
    Q_ENUM(SafeStateReason)

    /// What a watchdog does after its time-out.
    enum class WatchdogReaction : quint8 {
        /// It emits watchdogTimedOut(), logs and counts; the node goes on with the next frame.
        Report,
        SafeState  ///< as Report, and safeState(); the node drops its connection and connects again
    };
    Q_ENUM(WatchdogReaction)

    /// How much an event matters to people (reportEvent()).
    enum EventSeverity : quint8 {
        InfoEvent,     ///< for those who look back
        WarningEvent,  ///< somebody should look at it
        ErrorEvent     ///< something does not work
    };
    Q_ENUM(EventSeverity)

    /// When the node connects again by itself: after 0.1 s at first, then at growing intervals of
    /// up to 5 s.
    enum ReconnectPolicy : quint8 {
        NeverReconnect,  ///< it stays disconnected until you call connectToMaster()
        /// If it was registered and has lost its master; not if the master has ended in order.
        ReconnectWhenLost,
        /// Always, also if the master is not there yet, ends, or refuses the node.
        ReconnectAlways
    };
    Q_ENUM(ReconnectPolicy)

    /// Kinds of errors.
    enum Error {
        NoError,          ///< nothing has failed since connectToMaster()
        ConnectionError,  ///< the master cannot be reached, or was lost
        /// The master refuses: unknown signal, wrong type, second writer, name in use.
        RegistrationError,
        SignalError,    ///< a declared signal does not exist or has another type
        UserCodeError,  ///< a function of the derived class threw an exception
        WatchdogError,  ///< no frame came within the watchdog time
        ProtocolError,  ///< the master sent something that this version does not understand
        OptionError     ///< a setting of this object is not valid
    };
    Q_ENUM(Error)

    /// Makes a node that is not connected.
    /// \param name  under which the node registers; unique at its master
    /// \param policy  what the master does when an answer is late
    /// \param parent  owns the node, if given
    explicit QPlcSlaveNode(const QString &name, RealTimeViolationPolicy policy = ErrorZeroOrderHold,
                           QObject *parent = nullptr);
    /// Disconnects from the master. If cycles still run it warns, and safeState() is not called:
    /// call disconnectFromMaster() before.
    ~QPlcSlaveNode() override;

    /// Returns the name under which the node registers.
    QString name() const;
    /// Sets the name under which the node registers.
    /// \pre the node is not registered
    void setName(const QString &name);
    /// Returns what the master does when an answer is late.
    RealTimeViolationPolicy realTimeViolationPolicy() const;

    /// Sets whether the node is a listener; default false. The master never waits for a listener,
    /// with any clock, and a listener is never late: its answer counts in the cycle in which it
    /// arrives. Initialization and start do not wait for it, so it may miss the first cycles. In a
    /// process of its own its faults end its connection, not the plant.
    /// \pre the node is not registered
    void setListener(bool listener);
    /// Returns true if the master does not wait for the answers of this node.
    bool isListener() const;

    /// Sets whether the node is critical; default false. The master stops safely when a critical
    /// node is lost, fails, or is late too often: each late answer counts 2, each answer in time
    /// takes 1 off, and at 10 the master stops. The master does not start without a critical node
    /// that has registered before (QPlcMasterNode::setManifest()). A listener is never critical.
    /// \pre the node is not registered
    void setCritical(bool critical);
    /// Returns the value of setCritical(). It has no effect for a listener.
    bool isCritical() const;

    /// Sets when the node connects again by itself; default ReconnectWhenLost. Takes effect at the
    /// next loss.
    void setReconnectPolicy(ReconnectPolicy policy);
    /// Returns when the node connects again by itself.
    ReconnectPolicy reconnectPolicy() const;
    /// Sets how many cycles lie between two frames of a listener without outputs, for a slow link
    /// or a slow reader. The node gets the first frame at once, and then the first one of each
    /// group of \a cycles cycles, counted from cycle 0 of the phase. The master does not send the
    /// others: a peak between two frames is not seen. QPlcCycle::missedCycles() and
    /// Counters::skipped count groups then.
    /// \param cycles  1 (every cycle, the default) to 1 000 000. With more than 1 the registration
    ///     fails (RegistrationError) for a node that is not a listener, has outputs, or uses
    ///     multicast
    /// \pre the node is not registered
    void setListeningInterval(int cycles);
    /// Returns the cycles from one frame to the next; 1 by default.
    int listeningInterval() const;

    /// Sets whether all inputs of this node are same-cycle inputs (QPlcInputTiming::SameCycle),
    /// however each of them was declared. Default false.
    /// \pre the node is not registered
    void setSameCycle(bool sameCycle);
    /// Returns true after setSameCycle(true). Single inputs may be same-cycle inputs even if this
    /// is false.
    bool isSameCycle() const;

    /// Sets whether the node is a two-phase node; default false. Such a node computes its outputs
    /// from its state alone and then moves the state on with the inputs of the same cycle:
    /// outputSignals() and updateStates() (with ports QPlcCompactSlaveNode::outputs() and update())
    /// take the place of realTimeout(). Its inputs have no direct feedthrough, so it breaks
    /// algebraic loops of same-cycle inputs: a model, an integrator, a delay. The outputs of the
    /// first cycle are the initial ones.
    /// \pre the node is not registered
    void setTwoPhase(bool twoPhase);
    /// Returns true if the node is a two-phase node.
    bool isTwoPhase() const;

    /// Sets whether the master sends the quality of each input (QPlcQuality) with its value, which
    /// costs a byte per input and cycle. Default false, for a QPlcIOSlaveNode true. Read it with
    /// QPlcInput::quality() or QPlcIOSlaveNode::inputQuality(). In both cases an input without a
    /// good value has its safe value.
    /// \pre the node is not registered
    void setReceivesQuality(bool wanted);
    /// Returns true if the node receives the quality of its inputs.
    bool receivesQuality() const;

    /// Sets the table in which the node looks up its signals. By default it is the table of the
    /// process (QPlcSignalIndexTable), or if there is none, the table that the master sends at
    /// registration. Only the signals that the node uses have to match those of the master. Takes
    /// effect at the next registration.
    void setSignalTable(const QPlcSignalTable &table);
    /// Returns the table that was set, or that of the process.
    QPlcSignalTable signalTable() const;

    /// Sets what the cycle thread asks of the operating system. Takes effect at the next start of
    /// the real-time phase. Options that are out of range let that start fail with OptionError;
    /// options that the system does not grant cause a warning.
    void setRealTimeOptions(const QPlcRealTimeOptions &options);
    /// Returns what the cycle thread asks of the operating system.
    QPlcRealTimeOptions realTimeOptions() const;

    /// Sets faults of a bad network for the cyclic frames of this node, for a test. docs/faults.md
    /// lists the words. The master is told and shows it. No effect in the process of the master.
    /// \param plan  for example "loss=5%,delay=2ms,seed=7"; empty: no faults (default)
    /// \pre the node is not registered
    /// \return false when \a plan is not valid: error() is then OptionError, and nothing has
    ///     changed
    bool setFaultPlan(const QString &plan);
    /// Returns the fault plan; empty: no faults.
    QString faultPlan() const;

    /// Makes a signal an output of this node that has its workload [s]: the time from the frame at
    /// hand to the answer ready to be sent, in the same cycle. In lockstep it is 0, because results
    /// must not depend on the machine. Takes effect at the next registration.
    /// \param signalName  of type Real32 or Real64; empty: no measurement
    void activateWorkloadMeasurement(const QString &signalName);
    /// Sets the watchdog time: watchdogTimedOut() follows when no frame came for \a time during the
    /// real-time phase. By default the profile of the plant decides (QPlcProfile). Takes effect at
    /// the next start. Lockstep has no watchdog; with the clock External only a node with real
    /// devices has one, in real time. For the first frame of a phase a node waits at least 10 s:
    /// the master sends it when its slowest node is ready.
    ///
    /// While a master waits for a late node, it sends no frames to the others: where nodes have a
    /// Wait policy, use a time longer than QPlcMasterNode::setLongestWait().
    /// \param time  up to 24 h on the clock of the master; 0: no watchdog
    /// \return false when \a time is out of range: error() is then OptionError, and nothing has
    ///     changed
    bool activateWatchdog(std::chrono::nanoseconds time);
    /// Sets the watchdog time in seconds, rounded to 1 ns, as above. NaN and infinity are out of
    /// range.
    bool activateWatchdog(double seconds);
    /// Returns the watchdog time of this phase or the last one; before the first phase the one that
    /// was set. 0: no watchdog.
    std::chrono::nanoseconds watchdog() const;
    /// Sets what the watchdog does after its time-out. By default the profile of the plant decides
    /// (QPlcProfile): Report in a simulation, SafeState in a plant. Takes effect at the next start.
    void setWatchdogReaction(WatchdogReaction reaction);

    /// Sets whether this node drives real devices; default false. With such a node the automatic
    /// profile is Plant (QPlcProfile). The master refuses the node while a phase with the profile
    /// Simulation runs. QPlcHardwareNode calls this by itself.
    /// \pre the node is not registered
    void setHardware(bool hardware);
    /// Returns true if the node drives real devices.
    bool isHardware() const;

    /// Returns the profile of this phase or the last one, as the master has sent it; Automatic
    /// before the first phase.
    QPlcProfile::Value profile() const;

    /// Asks the master to stop safely, with the next answer of this node: an emergency stop button
    /// was pressed, or a limit of the machine was passed. No effect outside of the real-time phase.
    /// \threadsafe yes: also from step()
    void requestSafeStop();

    /// Writes an event into the log of the master: windows and recordings have it, with this node
    /// as its source. For example: a sensor was calibrated. The node sends 16 events at once and
    /// then one each second. It counts what is left out, also without a master, and says so in the
    /// next event.
    /// \param text  a sentence for people, at most 500 characters; a longer one is cut
    void reportEvent(EventSeverity severity, const QString &text);
    /// Writes into the log that a condition begins, as reportEvent(). Windows show it as an alarm
    /// until endAlarm(), or until the node leaves. A later master is told, too. If a condition
    /// begins and ends too often, its newest state is written.
    ///
    /// \code
    /// QPlcCompactSlaveNode gear("Gear");
    /// gear.beginAlarm("oil", QPlcSlaveNode::WarningEvent, "the oil has 81 degC; stop soon");
    /// gear.endAlarm("oil", "the oil has 70 degC");
    /// \endcode
    /// \param alarm  name of the condition, unique in this node; at most 64 characters
    void beginAlarm(const QString &alarm, EventSeverity severity, const QString &text);
    /// Writes into the log that a condition is over, and how long it has lasted. Does nothing if it
    /// has not begun.
    void endAlarm(const QString &alarm, const QString &text);

    /// Returns what the node does.
    State state() const;
    /// Returns the kind of the last error. connectToMaster() sets it back to NoError.
    Error error() const;
    /// Returns the last error as a sentence with the remedy; empty: there was none since
    /// connectToMaster().
    QString errorString() const;
    /// Returns the address of the last connectToMaster(); invalid before the first one.
    QPlcUnderlyingProtocol masterProtocol() const;
    /// Numbers of frames since the start of the real-time phase.
    struct Counters
    {
        quint64 cycles = 0;  ///< cycles that were computed
        /// Cycles that the master has sent to the node, and that the node did not compute: lost on
        /// the way, or too old when they came. Until the end of the phase, if its master has told
        /// the end.
        quint64 missed = 0;
        /// Cycles that the master did not send: it had an overrun. With setListeningInterval()
        /// groups of cycles.
        quint64 skipped = 0;
        /// Requests that came twice; the node answers and does not compute again.
        quint64 duplicated = 0;
        quint64 outdated = 0;  ///< requests of older cycles than the newest one
        quint64 rejected = 0;  ///< frames that are malformed, corrupted, or of another session
        /// Sealed frames with a wrong seal: not from the master, or changed on the way.
        quint64 forged = 0;
        quint64 watchdog = 0;  ///< time-outs of the watchdog
        /// Values of inputs that were not taken, because they are not finite or outside of the
        /// limits of the signal table.
        quint64 refused = 0;
    };
    /// Returns the counters of this phase or the last one; all 0 without a connection.
    /// \threadsafe yes
    Counters counters() const;
    /// Returns the durations of the cycles since the start of the real-time phase. A node in the
    /// process of its master has none; QPlcMasterNode::cycleStatistics() measures it.
    /// \param detail  whether histograms are wanted, which take time and memory
    QPlcSlaveStatistics statistics(QPlcDistribution::Detail detail = QPlcDistribution::FiguresOnly) const;

    /// Connects, registers, and waits until the master has accepted the node. It runs an event loop
    /// of its own.
    /// \param timeout  longest time to wait
    /// \return false when the node is not registered after \a timeout, or earlier on an error: see
    ///     errorString(). Also when the application quits meanwhile, which is no error
    bool connectToMasterAndWaitForConnected(const QPlcUnderlyingProtocol &master,
                                            std::chrono::milliseconds timeout = std::chrono::seconds(5));

public Q_SLOTS:
    /// Sets how this node and its master authenticate each other; QPlcSecurity::current() by
    /// default. Takes effect at the next connection.
    void setSecurity(const QPlcSecurity &security);
    /// Returns true if the control connection uses TLS and the master has proven its identity.
    bool isSecured() const;
    /// Begins to connect and to register; connectedToMaster() or errorOccurred() follows. A
    /// connection that exists is ended before. An address that is invalid, or whose transport this
    /// host does not have, is an OptionError.
    void connectToMaster(const QPlcUnderlyingProtocol &master);
    /// Ends the cycles of this node, calls safeState() and stopped(), and closes the connection. A
    /// node in the process of its master is removed there. No function of the node is called
    /// afterwards, and it does not connect again by itself.
    void disconnectFromMaster();
    /// Sends a control message to the master, for example QPlcMessage::InitializeAllStates. Does
    /// nothing without a connection.
    void sendMessageToMaster(const QPlcMessage &message);
    /// Asks the master to initialize all nodes. It may refuse: messageReceived() then has a message
    /// of the kind Failed.
    void initializeAllStates() { sendMessageToMaster(QPlcMessage(QPlcMessage::InitializeAllStates)); }
    /// Asks the master to start the real-time phase; it may refuse, as above.
    void startRealTime() { sendMessageToMaster(QPlcMessage(QPlcMessage::StartRealTime)); }
    /// Asks the master to stop the real-time phase.
    void stop() { sendMessageToMaster(QPlcMessage(QPlcMessage::Stop)); }

Q_SIGNALS:
    /// Emitted when the master has accepted the node and its cyclic channel works.
    void connectedToMaster();
    /// Emitted when a registered node has lost or closed its connection. If the master was lost,
    /// errorOccurred() follows.
    void disconnectedFromMaster();
    /// Emitted after errorOccurred() when the connection failed or was lost.
    /// \param error  kind of the failure, as the socket reports it
    /// \param text  the same as errorString()
    void errorWithMaster(QPlcAbstractSocket::Error error, const QString &text);
    /// Emitted for each error; errorString() has the reason.
    void errorOccurred(QPlcSlaveNode::Error error);
    /// Emitted when the state has changed.
    void stateChanged(QPlcSlaveNode::State state);
    /// Emitted when initialize() has returned.
    /// \param initialSignals  initial values of the inputs
    void hasInitialized(const QPlcSignalList &initialSignals);
    /// Emitted when the node is ready for the first cycle of a real-time phase.
    void realTimeHasStarted();
    /// Emitted when the real-time phase has ended for this node, also by a lost connection;
    /// stopped() has returned.
    void realTimeHasStopped();
    /// Emitted when the node has computed a cycle: there are new inputs. It comes in the thread of
    /// the object, once for several cycles if they are faster than this thread. Connect only if you
    /// need it: without a connection it costs nothing.
    void realTimedOut();
    /// Emitted when no frame came for the watchdog time; once for each silence.
    /// \param cycle  number of the last cycle that came
    void watchdogTimedOut(quint64 cycle);
    /// Emitted when safeState() has returned.
    void safeStateEntered(QPlcSlaveNode::SafeStateReason reason);
    /// Emitted for each message of the master that this class does not handle: State, Signals,
    /// Done, Failed, StatesInitialized.
    void messageReceived(const QPlcMessage &message);

protected:
    /// Begins to watch the cycles when a receiver connects to realTimedOut().
    void connectNotify(const QMetaMethod &signal) override;
    /// Returns the signals that realTimeout() reads. Called at each registration. The default
    /// returns none.
    virtual QPlcSignalIndexList declareInputSignals() { return {}; }
    /// Returns the signals that this node writes. Called at each registration. The default returns
    /// none.
    virtual QPlcSignalIndexList declareOutputSignals() { return {}; }
    /// Brings the node into its initial state and returns the values of its outputs there. Outputs
    /// that are left out get the initial value of the signal table. Called at each initialization,
    /// and when the node joins cycles that run.
    virtual QPlcSignalList initialOutputSignals() { return {}; }
    /// Called with the values of the inputs when all nodes have given their initial outputs.
    virtual void initialize(const QPlcSignalList &initialSignals) { Q_UNUSED(initialSignals) }
    /// Computes one cycle from the inputs and returns the outputs. Outputs that are left out keep
    /// their last value. Called on the cycle thread; it has to end within the period and must not
    /// wait. Override it in each node that is not a two-phase node: the default throws, and the
    /// phase ends with a fault.
    virtual QPlcSignalList realTimeout(const QPlcSignalList &inputSignals);
    /// Two-phase node: returns the outputs, computed from the state alone. Outputs that are left
    /// out keep their last value. Called after updateStates(), for the next cycle.
    virtual QPlcSignalList outputSignals() { return {}; }
    /// Two-phase node: moves the state on with the inputs of the current cycle(). Called on the
    /// cycle thread.
    virtual void updateStates(const QPlcSignalList &inputSignals) { Q_UNUSED(inputSignals) }
    /// Brings what this node drives into its safe state. From now on the outputs have their safe
    /// values (`safe` of the signal table, else 0, or the limit closest to 0); the node does not
    /// send them. The inputs of a node with ports have their safe values, too.
    ///
    /// Called once in each real-time phase, at its end at the latest, and before stopped(). It
    /// comes on the cycle thread when it is urgent (master, watchdog, fault), else in the thread of
    /// the object; never while another function of the node runs. It must be short and must not
    /// wait.
    virtual void safeState(SafeStateReason reason) { Q_UNUSED(reason) }
    /// Called in the thread of the object when the real-time phase has ended.
    virtual void stopped() {}

    /// Sets a watchdog that counts until activateWatchdog() sets another one: the longer one of \a
    /// time and \a periods periods of the master. For derived classes that are not safe without a
    /// watchdog.
    void setDefaultWatchdog(std::chrono::nanoseconds time, int periods);

    /// Returns the cycle that realTimeout() or updateStates() computes.
    /// \pre called from there
    const QPlcCycle &cycle() const;

    /// Makes a node whose code works without lists: \a code takes the place of the virtual
    /// functions above. Only for kinds of nodes of this library.
    QPlcSlaveNode(const QString &name, RealTimeViolationPolicy policy, std::unique_ptr<qplc::NodeCode> code,
                  QObject *parent);

private:
    friend class QPlcSlaveNodePrivate;
    class Q_DECL_HIDDEN ListCode;
    std::unique_ptr<QPlcSlaveNodePrivate> d;
};

Q_DECLARE_METATYPE(QPlcSlaveNode::Error)
Q_DECLARE_METATYPE(QPlcSlaveNode::State)
Q_DECLARE_METATYPE(QPlcSlaveNode::SafeStateReason)
