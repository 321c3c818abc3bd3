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

/// A process image's worth of the world: a model, a sensor, an actuator, a controller, a view.
///
/// A node reads and writes signals by name. Its master asks it once in each cycle: the inputs of the last cycle come in, realTimeout() computes, the
/// outputs go back. Derive from QPlcCompactSlaveNode for typed ports and a cycle without allocations; derive from this class for lists of values:
///
/// ```cpp
/// class Doubler : public QPlcSlaveNode
/// {
/// public:
///     Doubler() : QPlcSlaveNode("Doubler", ErrorZeroOrderHold) {}
/// protected:
///     QPlcSignalIndexList declareInputSignals() override { QPlcSignalIndexList list; m_in = list.insert("in"); return list; }
///     QPlcSignalIndexList declareOutputSignals() override { QPlcSignalIndexList list; m_out = list.insert("out"); return list; }
///     QPlcSignalList realTimeout(const QPlcSignalList &inputs) override
///     {
///         QPlcSignalList outputs;
///         outputs.insert(m_out, 2.0 * inputs.value(m_in).toReal());
///         return outputs;
///     }
/// private:
///     QPlcSignalIndex m_in, m_out;
/// };
/// ```
///
/// Threads: the object lives in the thread that made it and needs its event loop. realTimeout() is called on the cycle thread of the node (of the
/// master, for a local node); all other virtual functions are called in the thread of the object while no cycle runs. They never run at the same time.
/// While cycles run the members of a derived class are in use, so it disconnects before it loses them:
///
/// ```cpp
/// ~Doubler() override { disconnectFromMaster(); }
/// ```
///
/// QPlcNodeApplication does so before it returns, and ports (QPlcInput, QPlcOutput, ...) protect themselves and all members that are declared before the last one of them. Whoever forgets
/// it is warned: the cycles then end in the destructor of this class, and safeState() is not called.
class QTPLC_EXPORT QPlcSlaveNode : public QObject
{
    Q_OBJECT
public:
    /// What the master does when the answer of this node is not there in time (real-time violation).
    enum RealTimeViolationPolicy : quint8 {
        SilentZeroOrderHold,  ///< goes on with the last values
        ErrorZeroOrderHold,   ///< goes on with the last values and reports
        SilentWait,           ///< time stands still until the answer is there
        ErrorWait,            ///< as SilentWait, and reports
        SafeStopWhenLate      ///< reports, and the whole plant stops safely
    };
    Q_ENUM(RealTimeViolationPolicy)

    enum State : quint8 {
        Disconnected,
        Connecting,
        Registering,  ///< connected; the master has not accepted yet
        Rejected,     ///< the master has refused, for a reason that does not pass by itself
        Registered,   ///< no cycles
        Initializing,
        Ready,  ///< initialized
        RealTime,
        SafeStop,  ///< its safe state: told so by the master, or by the silence or loss of it
        Fault,     ///< its own code has failed: safe state until the next initialization
        Off = Registered
    };
    Q_ENUM(State)

    /// Why safeState() is called.
    enum SafeStateReason : quint8 {
        PhaseEnded,         ///< the master has stopped, or this node leaves
        MasterStopsSafely,  ///< the master has told so: SafeStop
        WatchdogReason,     ///< no frame within the watchdog time
        MasterLost,         ///< the connection is gone
        CodeFailed          ///< realTimeout() or step() of this node threw
    };
    Q_ENUM(SafeStateReason)

    /// What a watchdog does that has timed out.
    enum class WatchdogReaction : quint8 {
        Report,    ///< watchdogTimedOut(), a line in the log, Counters::watchdog; the node goes on with the next frame
        SafeState  ///< as Report, and safeState(); the node drops its connection and connects again
    };
    Q_ENUM(WatchdogReaction)

    /// When the node connects again by itself, after 0.1 s at first, and then at longer and longer intervals up to 5 s.
    enum ReconnectPolicy : quint8 {
        NeverReconnect,
        ReconnectWhenLost,  ///< after it was registered and has lost its master; not when the master ended as wanted
        ReconnectAlways     ///< for ever, also when the master is not there yet, ends, or refuses
    };
    Q_ENUM(ReconnectPolicy)

    enum Error {
        NoError,
        ConnectionError,    ///< the master cannot be reached, or was lost
        RegistrationError,  ///< the master refused: unknown signal, wrong type, second writer, name in use
        SignalError,        ///< a signal that this node declares does not exist or does not fit
        UserCodeError,      ///< a function of the derived class threw
        WatchdogError,      ///< no frame from the master within the watchdog time
        ProtocolError,
        OptionError  ///< a setting of this object that cannot be meant
    };
    Q_ENUM(Error)

    explicit QPlcSlaveNode(const QString &name, RealTimeViolationPolicy policy = ErrorZeroOrderHold,
                           QObject *parent = nullptr);
    ~QPlcSlaveNode() override;

    QString name() const;
    /// Sets the name under which the node registers. \pre not connected
    void setName(const QString &name);
    RealTimeViolationPolicy realTimeViolationPolicy() const;

    /// A listener is never waited for, by no clock, and is never late: what it answers is taken in the cycle in which it is there. Initialization and start do
    /// not wait for it either: it may miss the first cycles. In another process than the master its faults end its connection, not the plant. \pre not connected
    void setListener(bool listener);
    bool isListener() const;

    /// A critical node is one that the plant must not go on without: when it is lost, fails, or is late too often (each late answer counts 2, each one in time
    /// takes 1 off, 10 are too many), the master stops safely. A node is not critical unless set, and a listener never is. \pre not connected
    void setCritical(bool critical);
    bool isCritical() const;

    /// ReconnectWhenLost unless set.
    void setReconnectPolicy(ReconnectPolicy policy);
    ReconnectPolicy reconnectPolicy() const;
    /// Lets a listener without outputs hear fewer cycles, for a slow link or a slow reader: the first one at once, then the first one of each turn of \a cycles, counted from cycle 0 of the
    /// phase. The others are not sent, and their values are nowhere: a peak between two frames is not seen. They are not missed either: QPlcCycle::missedCycles() and Counters::missed
    /// then count turns. A master that does not know of this sends every cycle.
    /// \param cycles  1 (every cycle, the default) ... 1 000 000. A node that is no listener, has outputs, or uses multicast is refused with more than 1: RegistrationError. \pre not connected
    void setListeningInterval(int cycles);
    int listeningInterval() const;

    /// Makes all inputs of this node same-cycle (QPlcInputTiming::SameCycle), however each of them was declared. \pre not connected
    void setSameCycle(bool sameCycle);
    bool isSameCycle() const;

    /// A two-phase node computes its outputs out of its state alone, and then moves the state on with the inputs of the same cycle: outputSignals() and
    /// updateStates() (for ports: QPlcCompactSlaveNode::outputs() and update()) take the place of realTimeout(). Its inputs have no direct feed-through, so it
    /// closes loops of same-cycle inputs: a model, an integrator, a delay. The outputs of the first cycle are the initial ones. \pre not connected
    void setTwoPhase(bool twoPhase);
    bool isTwoPhase() const;

    /// Lets the master send the quality of each input (QPlcQuality) with its value, at the price of a byte: QPlcInput::quality(), QPlcIOSlaveNode::inputQuality().
    /// With it or without, the node gets safe values for inputs that have no good ones. \pre not connected
    void setReceivesQuality(bool wanted);
    bool receivesQuality() const;

    /// The table in which the signals of this node are looked up. Unless set: that of the process (QPlcSignalIndexTable), else the one that the
    /// master sends at registration. Only signals that the node uses have to match those of the master.
    void setSignalTable(const QPlcSignalTable &table);
    QPlcSignalTable signalTable() const;

    /// What the cycle thread asks of the operating system. Takes effect at the next start of the real-time phase.
    void setRealTimeOptions(const QPlcRealTimeOptions &options);
    QPlcRealTimeOptions realTimeOptions() const;

    /// Lets the cyclic frames of this node meet the faults of a bad network, for a test: docs/faults.md has the words, for example "loss=5%,delay=2ms,seed=7"; empty: none.
    /// The master is told, and shows it. Without effect in the process of the master. \pre not connected
    /// \return false when \a plan cannot be meant: error() is then OptionError and nothing has changed
    bool setFaultPlan(const QString &plan);
    QString faultPlan() const;

    /// Writes the workload [s] into the signal \a signalName (Real32 or Real64), which becomes an output of this node: the time from the frame at hand
    /// to the answer ready to be sent, in the same cycle; 0 in lockstep, where results must not depend on the machine.
    void activateWorkloadMeasurement(const QString &signalName);
    /// Sets the watchdog time: watchdogTimedOut() follows when no frame has come for \a time during the real-time phase.
    /// Unless set, the profile of the plant decides (QPlcProfile). Takes effect at the next start.
    ///
    /// A master that waits for a late node sends nothing to the others: where nodes have a Wait policy, use a time that is
    /// longer than QPlcMasterNode::setLongestWait(). Lockstep has no watchdog.
    /// \param time  on the clock of the master; 0: no watchdog
    void activateWatchdog(std::chrono::nanoseconds time);
    void activateWatchdog(double seconds) { activateWatchdog(std::chrono::nanoseconds(qRound64(seconds * 1e9))); }
    /// Returns the watchdog time of the phase at hand or the last one; before the first phase the one that was set. 0: none.
    std::chrono::nanoseconds watchdog() const;
    /// Sets what a watchdog does that has timed out. Unless set, the profile of the plant decides (QPlcProfile): Report in a
    /// simulation, SafeState in a plant. Takes effect at the next start.
    void setWatchdogReaction(WatchdogReaction reaction);

    /// Tells the master that this node drives real devices: then the automatic profile is Plant (QPlcProfile), and a phase with
    /// the profile Simulation refuses the node until the next start. QPlcHardwareNode does this by itself. \pre not connected
    void setHardware(bool hardware);
    bool isHardware() const;

    /// Returns the profile of the phase at hand or the last one, as the master has told it; Automatic before the first phase.
    QPlcProfile::Value profile() const;

    /// Lets the master stop safely with the next answer of this node, as if it were late or lost while critical: an emergency stop button was pressed, a limit of the machine
    /// was passed. From the cycles of the node or any thread; without effect outside of the real-time phase. \threadsafe yes
    void requestSafeStop();

    State state() const;
    Error error() const;
    QString errorString() const;
    /// Where the node was told to connect last; invalid: nowhere yet.
    QPlcUnderlyingProtocol masterProtocol() const;
    /// Frames since the start of the real-time phase, and what was wrong with them.
    struct Counters
    {
        quint64 cycles = 0;      ///< computed
        quint64 missed = 0;      ///< cycles that never arrived; turns of setListeningInterval()
        quint64 duplicated = 0;  ///< requests that came again; answered, never computed twice
        quint64 outdated = 0;    ///< requests of cycles before the newest
        quint64 rejected = 0;    ///< garbage, other sessions, corrupted frames
        quint64 forged = 0;      ///< sealed frames that were not as the master seals them
        quint64 watchdog = 0;    ///< watchdog time-outs
        quint64 refused
            = 0;  ///< values of inputs that were not taken, because they are not finite or outside of the limits of the table
    };
    /// \threadsafe yes
    Counters counters() const;
    /// Durations of the cycles since the start of the real-time phase; without values for a node in the process of its master, which measures them itself
    /// (QPlcMasterNode::cycleStatistics()).
    QPlcSlaveStatistics statistics(QPlcDistribution::Detail detail = QPlcDistribution::FiguresOnly) const;

    /// Connects, registers and waits until the master has accepted. Needs no running event loop.
    /// \return false when it did not work out within \a timeout: error(), errorString() tell why
    bool connectToMasterAndWaitForConnected(const QPlcUnderlyingProtocol &master,
                                            std::chrono::milliseconds timeout = std::chrono::seconds(5));

public Q_SLOTS:
    /// How this node and its master know each other; QPlcSecurity::current() unless set. Takes effect when it connects.
    void setSecurity(const QPlcSecurity &security);
    /// Whether the control connection is TLS, and the master proven.
    bool isSecured() const;
    /// Begins to connect and register; connectedToMaster() or errorOccurred() follows.
    void connectToMaster(const QPlcUnderlyingProtocol &master);
    /// Ends the cycles of this node, with safeState() and stopped(), and then the connection; a node in the process of its master is removed there. Nothing of the node is called afterwards.
    void disconnectFromMaster();
    /// Sends any control message, for example InitializeAllStates. Nothing happens without a connection.
    void sendMessageToMaster(const QPlcMessage &message);
    void initializeAllStates() { sendMessageToMaster(QPlcMessage(QPlcMessage::InitializeAllStates)); }
    void startRealTime() { sendMessageToMaster(QPlcMessage(QPlcMessage::StartRealTime)); }
    void stop() { sendMessageToMaster(QPlcMessage(QPlcMessage::Stop)); }

Q_SIGNALS:
    void connectedToMaster();
    void disconnectedFromMaster();
    void errorWithMaster(QPlcAbstractSocket::Error error, const QString &text);
    void errorOccurred(QPlcSlaveNode::Error error);
    void stateChanged(QPlcSlaveNode::State state);
    /// initialize() has been called with these values.
    void hasInitialized(const QPlcSignalList &initialSignals);
    void realTimeHasStarted();
    void realTimeHasStopped();
    /// A cycle of this node has been computed: there are new inputs. Emitted in the thread of the object, once for several
    /// cycles when they come faster than this thread takes them, and only while something is connected to it.
    void realTimedOut();
    /// Emitted when no frame has come since the one of cycle \a cycle for the watchdog time. Once for each silence.
    void watchdogTimedOut(quint64 cycle);
    /// safeState() has been called.
    void safeStateEntered(QPlcSlaveNode::SafeStateReason reason);
    /// A message of the master that this class has no use for (State, Signals, Done, Failed, StatesInitialized).
    void messageReceived(const QPlcMessage &message);

protected:
    void connectNotify(const QMetaMethod &signal) override;
    /// Signals that realTimeout() wants. Called at each registration.
    virtual QPlcSignalIndexList declareInputSignals() { return {}; }
    /// Signals that this node, and no other, writes. Called at each registration.
    virtual QPlcSignalIndexList declareOutputSignals() { return {}; }
    /// Brings the node into its initial state and returns the values of its outputs there; those left out keep the initial value of the table.
    virtual QPlcSignalList initialOutputSignals() { return {}; }
    /// Gets the values of the inputs when all nodes have given their initial outputs.
    virtual void initialize(const QPlcSignalList &initialSignals) { Q_UNUSED(initialSignals) }
    /// One cycle. Outputs left out keep their last value. Every node overrides it, except a two-phase node, for which it is not called: else each phase ends with a fault that says so.
    virtual QPlcSignalList realTimeout(const QPlcSignalList &inputSignals);
    /// Two-phase node: its outputs, out of its state alone; those left out keep their last value. Called after updateStates(), for the next cycle.
    virtual QPlcSignalList outputSignals() { return {}; }
    /// Two-phase node: moves the state on with the inputs of the cycle at hand, cycle().
    virtual void updateStates(const QPlcSignalList &inputSignals) { Q_UNUSED(inputSignals) }
    /// Brings what this node drives into its safe state. Its outputs have their safe values from here on (`safe` of the signal table, else 0), without being asked,
    /// and the inputs of a node with ports (QPlcInput) have theirs now.
    /// Called once at the end of each real-time phase at the latest, before stopped(); on the thread of realTimeout() when it is urgent (master, watchdog, fault), else in
    /// the thread of the object; never while another function of the node runs. The rules of realTimeout() hold: short, and without waiting.
    virtual void safeState(SafeStateReason reason) { Q_UNUSED(reason) }
    /// The real-time phase has ended.
    virtual void stopped() {}

    /// Sets the watchdog that is in force until activateWatchdog() sets another one: \a time, or \a periods of the master,
    /// the longer one.
    void setDefaultWatchdog(std::chrono::nanoseconds time, int periods);

    /// The cycle that realTimeout() or updateStates() computes. \pre called from there
    const QPlcCycle &cycle() const;

    /// For kinds of nodes of this library that do not work with lists: \a code takes the place of the functions above.
    QPlcSlaveNode(const QString &name, RealTimeViolationPolicy policy, std::unique_ptr<qplc::NodeCode> code,
                  QObject *parent);

private:
    friend class QPlcSlaveNodePrivate;
    class ListCode;
    std::unique_ptr<QPlcSlaveNodePrivate> d;
};

Q_DECLARE_METATYPE(QPlcSlaveNode::Error)
Q_DECLARE_METATYPE(QPlcSlaveNode::State)
Q_DECLARE_METATYPE(QPlcSlaveNode::SafeStateReason)
