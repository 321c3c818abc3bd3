// SPDX-License-Identifier: Apache-2.0
#include "QPlcSlaveNode.h"

#include "IndexListCode.h"
#include "QPlcSignalIndexTable.h"
#include "QPlcSlaveNodePrivate.h"
#include "node/cycle/PeriodRange.h"
#include "transport/FaultPlan.h"

#include <QtCore/QEventLoop>
#include <QtCore/QMetaMethod>
#include <QtCore/QTimer>

#include <stdexcept>

namespace {

bool refuseWatchdog(QPlcSlaveNodePrivate &node, double seconds)
{
    node.setError(QPlcSlaveNode::OptionError,
                  QStringLiteral("node '%1': a watchdog time of %2 s is out of range; use 0 (none) ... 86400 s")
                      .arg(node.name)
                      .arg(seconds));
    return false;
}

}  // namespace

/// The code of a node whose program works with lists of values.
class QPlcSlaveNode::ListCode : public qplc::IndexListCode
{
public:
    explicit ListCode(QPlcSlaveNode &node)
        : m_node(node)
    {
    }

    QPlcSignalIndexList inputList() override { return m_node.declareInputSignals(); }
    QPlcSignalIndexList outputList() override { return m_node.declareOutputSignals(); }
    void bind(const QPlcSignalTable &table, const qplc::PayloadLayout &inputs,
              const qplc::PayloadLayout &outputs) override
    {
        m_table = table;
        m_inputs = inputs;
        m_outputs = outputs;
    }
    void reset(char *outputs) override { write(m_node.initialOutputSignals(), outputs); }
    void initialize(const char *inputs) override { m_node.initialize(qplc::NodeRuntime::toList(m_inputs, inputs)); }
    void step(const QPlcCycle &, const char *inputs, char *outputs) override
    {
        const QPlcSignalList inputValues = qplc::NodeRuntime::toList(m_inputs, inputs);
        if (m_node.isTwoPhase())
            m_node.updateStates(inputValues);
        write(m_node.isTwoPhase() ? m_node.outputSignals() : m_node.realTimeout(inputValues), outputs);
    }
    void makeSafe(SafeStateReason reason, const char *) override { m_node.safeState(reason); }
    void stopped() override { m_node.stopped(); }

private:
    void write(const QPlcSignalList &values, char *outputs) const
    {
        qplc::NodeRuntime::fromList(values, m_table, m_outputs, outputs);
    }

    QPlcSlaveNode &m_node;
    QPlcSignalTable m_table;
    qplc::PayloadLayout m_inputs;
    qplc::PayloadLayout m_outputs;
};

QPlcSlaveNode::QPlcSlaveNode(const QString &name, RealTimeViolationPolicy policy, QObject *parent)
    : QPlcSlaveNode(name, policy, std::make_unique<ListCode>(*this), parent)
{
}

QPlcSlaveNode::QPlcSlaveNode(const QString &name, RealTimeViolationPolicy policy, std::unique_ptr<qplc::NodeCode> code,
                             QObject *parent)
    : QObject(parent)
    , d(std::make_unique<QPlcSlaveNodePrivate>(this, name, policy, std::move(code)))
{
    qRegisterMetaType<QPlcSlaveNode::Error>("QPlcSlaveNode::Error");
    qRegisterMetaType<QPlcSlaveNode::State>("QPlcSlaveNode::State");
    qRegisterMetaType<QPlcSlaveNode::SafeStateReason>("QPlcSlaveNode::SafeStateReason");
    qRegisterMetaType<QPlcSignalList>("QPlcSignalList");
    qRegisterMetaType<QPlcUnderlyingProtocol>("QPlcUnderlyingProtocol");
    qRegisterMetaType<QPlcMessage>("QPlcMessage");
    qRegisterMetaType<QPlcAbstractSocket::Error>("QPlcAbstractSocket::Error");
}

QPlcSlaveNode::~QPlcSlaveNode()
{
    d->endBeforeDestruction();
    d->cycle.reset();
    if (d->localMaster)
        d->localMaster->removeLocalNode(this);
}

void QPlcSlaveNode::connectNotify(const QMetaMethod &signal)
{
    if (signal == QMetaMethod::fromSignal(&QPlcSlaveNode::realTimedOut))
        QMetaObject::invokeMethod(this, [this] { d->watchCycles(); });  // in the thread of the object
}

QString QPlcSlaveNode::name() const
{
    return d->name;
}

void QPlcSlaveNode::setName(const QString &name)
{
    Q_ASSERT_X(!d->hasChannel, "QPlcSlaveNode::setName", "a registered node keeps its name");
    d->name = name;
}

QPlcSlaveNode::RealTimeViolationPolicy QPlcSlaveNode::realTimeViolationPolicy() const
{
    return d->policy;
}

void QPlcSlaveNode::setListener(bool listener)
{
    Q_ASSERT_X(!d->hasChannel, "QPlcSlaveNode::setListener", "a registered node stays what it is");
    d->listener = listener;
}

bool QPlcSlaveNode::isListener() const
{
    return d->listener;
}

void QPlcSlaveNode::setCritical(bool critical)
{
    Q_ASSERT_X(!d->hasChannel, "QPlcSlaveNode::setCritical", "a registered node stays what it is");
    d->critical = critical;
}

bool QPlcSlaveNode::isCritical() const
{
    return d->critical;
}

void QPlcSlaveNode::setReconnectPolicy(ReconnectPolicy policy)
{
    d->reconnectPolicy = policy;
}

QPlcSlaveNode::ReconnectPolicy QPlcSlaveNode::reconnectPolicy() const
{
    return d->reconnectPolicy;
}

void QPlcSlaveNode::setListeningInterval(int cycles)
{
    Q_ASSERT_X(!d->hasChannel, "QPlcSlaveNode::setListeningInterval", "a registered node stays what it is");
    Q_ASSERT_X(cycles >= 1 && cycles <= qplc::ListeningInterval::Longest, "QPlcSlaveNode::setListeningInterval",
               "a listener hears one of 1 ... 1 000 000 cycles");
    d->interval = qplc::ListeningInterval(cycles);
}

int QPlcSlaveNode::listeningInterval() const
{
    return d->interval.cycles();
}

void QPlcSlaveNode::setSameCycle(bool sameCycle)
{
    Q_ASSERT_X(!d->hasChannel, "QPlcSlaveNode::setSameCycle", "a registered node stays what it is");
    d->sameCycle = sameCycle;
}

bool QPlcSlaveNode::isSameCycle() const
{
    return d->sameCycle;
}

void QPlcSlaveNode::setTwoPhase(bool twoPhase)
{
    Q_ASSERT_X(!d->hasChannel, "QPlcSlaveNode::setTwoPhase", "a registered node stays what it is");
    d->twoPhase = twoPhase;
}

bool QPlcSlaveNode::isTwoPhase() const
{
    return d->twoPhase;
}

void QPlcSlaveNode::setReceivesQuality(bool wanted)
{
    Q_ASSERT_X(!d->hasChannel, "QPlcSlaveNode::setReceivesQuality", "a registered node stays what it is");
    d->quality = wanted;
}

bool QPlcSlaveNode::receivesQuality() const
{
    return d->quality;
}

void QPlcSlaveNode::requestSafeStop()
{
    d->runtime.requestSafeStop();
}

void QPlcSlaveNode::setSignalTable(const QPlcSignalTable &table)
{
    d->ownTable = table;
}

QPlcSignalTable QPlcSlaveNode::signalTable() const
{
    return d->ownTable.isEmpty() ? QPlcSignalIndexTable::current() : d->ownTable;
}

void QPlcSlaveNode::setRealTimeOptions(const QPlcRealTimeOptions &options)
{
    d->realTimeOptions = options;
}

QPlcRealTimeOptions QPlcSlaveNode::realTimeOptions() const
{
    return d->realTimeOptions;
}

bool QPlcSlaveNode::setFaultPlan(const QString &plan)
{
    Q_ASSERT_X(!d->hasChannel, "QPlcSlaveNode::setFaultPlan", "a registered node stays what it is");
    QString text;
    if (!plan.isEmpty() && !qplc::FaultPlan::fromText(plan, &text)) {
        d->setError(OptionError, QStringLiteral("node '%1': fault plan: %2").arg(d->name, text));
        return false;
    }
    d->faultPlan = plan;
    return true;
}

QString QPlcSlaveNode::faultPlan() const
{
    return d->faultPlan;
}

void QPlcSlaveNode::activateWorkloadMeasurement(const QString &signalName)
{
    d->runtime.setWorkloadSignal(signalName);
}

void QPlcSlaveNode::setSecurity(const QPlcSecurity &security)
{
    d->control.setSecurity(security);
}

bool QPlcSlaveNode::isSecured() const
{
    return d->control.connection() && d->control.connection()->isSecured();
}

bool QPlcSlaveNode::activateWatchdog(std::chrono::nanoseconds time)
{
    constexpr std::chrono::hours longest{24};
    if (time < std::chrono::nanoseconds(0) || time > longest)
        return refuseWatchdog(*d, double(time.count()) * 1e-9);
    setDefaultWatchdog(time, 0);
    return true;
}

bool QPlcSlaveNode::activateWatchdog(double seconds)
{
    const std::optional<std::chrono::nanoseconds> time = qplc::nanosecondsOf(seconds);
    return time ? activateWatchdog(*time) : refuseWatchdog(*d, seconds);
}

void QPlcSlaveNode::setDefaultWatchdog(std::chrono::nanoseconds time, int periods)
{
    d->watchdog = time;
    d->watchdogPeriods = periods;
}

std::chrono::nanoseconds QPlcSlaveNode::watchdog() const
{
    return d->phaseProfile == QPlcProfile::Automatic ? d->watchdog.value_or(std::chrono::nanoseconds(0))
                                                     : d->watchdogOfPhase;
}

void QPlcSlaveNode::setWatchdogReaction(WatchdogReaction reaction)
{
    d->watchdogReaction = reaction;
}

void QPlcSlaveNode::setHardware(bool hardware)
{
    Q_ASSERT_X(!d->hasChannel, "QPlcSlaveNode::setHardware", "a registered node stays what it is");
    d->hardware = hardware;
}

bool QPlcSlaveNode::isHardware() const
{
    return d->hardware;
}

QPlcProfile::Value QPlcSlaveNode::profile() const
{
    return d->phaseProfile;
}

QPlcSlaveNode::State QPlcSlaveNode::state() const
{
    return d->state;
}

QPlcSlaveNode::Error QPlcSlaveNode::error() const
{
    return d->error;
}

QString QPlcSlaveNode::errorString() const
{
    return d->errorString;
}

QPlcUnderlyingProtocol QPlcSlaveNode::masterProtocol() const
{
    return d->master;
}

QPlcSlaveStatistics QPlcSlaveNode::statistics(QPlcDistribution::Detail detail) const
{
    return d->cycle ? d->cycle->statistics().read(detail) : QPlcSlaveStatistics();
}

QPlcSlaveNode::Counters QPlcSlaveNode::counters() const
{
    Counters counters = d->cycle ? d->cycle->counters() : Counters();
    counters.refused = d->runtime.refusedInputs();
    return counters;
}

const QPlcCycle &QPlcSlaveNode::cycle() const
{
    return d->runtime.cycle();
}

bool QPlcSlaveNode::connectToMasterAndWaitForConnected(const QPlcUnderlyingProtocol &master,
                                                       std::chrono::milliseconds timeout)
{
    QEventLoop loop;
    QTimer timer;
    timer.setSingleShot(true);
    connect(&timer, &QTimer::timeout, &loop, &QEventLoop::quit);
    connect(this, &QPlcSlaveNode::connectedToMaster, &loop, &QEventLoop::quit);
    connect(this, &QPlcSlaveNode::errorOccurred, &loop, &QEventLoop::quit);
    connectToMaster(master);
    const auto isComing = [this] { return d->state == Connecting || d->state == Registering; };
    if (isComing()) {
        timer.start(timeout);
        loop.exec(QEventLoop::ExcludeUserInputEvents);
    }
    if (isComing()) {
        const bool hasTime = timer.isActive();  // the application quits
        d->disconnectFromMaster();
        if (!hasTime)
            d->setError(ConnectionError,
                        QStringLiteral("node '%1': no answer of a master at %2 within %3 ms; check address and port")
                            .arg(name(), master.toString())
                            .arg(timeout.count()));
    }
    return d->hasChannel;
}

void QPlcSlaveNode::connectToMaster(const QPlcUnderlyingProtocol &master)
{
    d->connectToMaster(master);
}

void QPlcSlaveNode::disconnectFromMaster()
{
    d->disconnectFromMaster();
}

void QPlcSlaveNode::reportEvent(EventSeverity severity, const QString &text)
{
    d->events.tell(qplc::messages::Severity(severity), text);
}

void QPlcSlaveNode::beginAlarm(const QString &alarm, EventSeverity severity, const QString &text)
{
    Q_ASSERT_X(!alarm.isEmpty(), "QPlcSlaveNode::beginAlarm", "a condition needs a name");
    d->events.begin(alarm, qplc::messages::Severity(severity), text);
}

void QPlcSlaveNode::endAlarm(const QString &alarm, const QString &text)
{
    d->events.end(alarm, text);
}

void QPlcSlaveNode::sendMessageToMaster(const QPlcMessage &message)
{
    d->control.tell(message);
}

QPlcSignalList QPlcSlaveNode::realTimeout(const QPlcSignalList &)
{
    throw std::logic_error("there is no realTimeout() to call: override it, or use setTwoPhase(true); and disconnect "
                           "the node before it is destroyed");
}
