// SPDX-License-Identifier: Apache-2.0
#include "QPlcMasterNode.h"

#include "QPlcMasterNodePrivate.h"
#include "QPlcSignalIndexTable.h"
#include "node/cycle/PeriodRange.h"
#include "realtime/TimeSource.h"

using namespace std::chrono_literals;

namespace {

bool isSingleReal(QPlcSignalType type)
{
    return type.isReal() && !type.isArray();
}

bool isDateTime(QPlcSignalType type)
{
    return type.isDateTime();
}

}  // namespace

QPlcMasterNode::QPlcMasterNode(QObject *parent)
    : QObject(parent)
    , d(std::make_unique<QPlcMasterNodePrivate>(this))
{
    qRegisterMetaType<QPlcMasterNode::State>("QPlcMasterNode::State");
    qRegisterMetaType<QPlcMasterNode::Error>("QPlcMasterNode::Error");
}

QPlcMasterNode::~QPlcMasterNode()
{
    const QSignalBlocker silence(this);  // nobody wants to hear from a master that is half gone
    d->end(QStringLiteral("the master ends"));
    stopServer();
}

bool QPlcMasterNode::setSignalTable(const QPlcSignalTable &table)
{
    if (d->registry)
        return d->setError(StateError,
                           QStringLiteral("the signal table can only be set before signals, nodes and servers"));
    d->table = table;
    return true;
}

QPlcSignalTable QPlcMasterNode::signalTable() const
{
    return d->table;
}

bool QPlcMasterNode::setTimeSignal(const QString &signalName)
{
    return d->claimSignal(signalName, &d->timeSignal, &isDateTime, QStringLiteral("DateTime"));
}

bool QPlcMasterNode::activateJitterMeasurement(const QString &signalName)
{
    return d->claimSignal(signalName, &d->jitterSignal, &isSingleReal, QStringLiteral("Real"));
}

bool QPlcMasterNode::activateWorkloadMeasurement(const QString &signalName)
{
    return d->claimSignal(signalName, &d->workloadSignal, &isSingleReal, QStringLiteral("Real"));
}

bool QPlcMasterNode::activateStatisticSignal(QPlcStatisticFigure figure, const QString &signalName,
                                             const QString &nodeName)
{
    return d->activateStatisticSignal(figure, signalName, nodeName);
}

bool QPlcMasterNode::setInterval(std::chrono::nanoseconds period)
{
    if (period < qplc::ShortestPeriod || period > qplc::LongestPeriod)
        return d->setError(IntervalError,
                           QStringLiteral("a period of %1 s is out of range; use 0.00001 ... 10 s")
                               .arg(double(period.count()) * 1e-9));
    d->interval = period;
    return true;
}

std::chrono::nanoseconds QPlcMasterNode::interval() const
{
    return d->interval;
}

bool QPlcMasterNode::setClock(QPlcClock clock)
{
    if (!clock.isValid())
        return d->setError(
            IntervalError,
            QStringLiteral("a clock of %1 times real time is out of range; use 0.001 ... 1000, or lockstep")
                .arg(clock.scale()));
    d->clock = clock;
    return true;
}

QPlcClock QPlcMasterNode::clock() const
{
    return d->clock;
}

void QPlcMasterNode::setRealTimeOptions(const QPlcRealTimeOptions &options)
{
    d->realTimeOptions = options;
}

bool QPlcMasterNode::setOverrunPolicy(QPlcOverrunPolicy policy)
{
    if (!policy.isValid())
        return d->setError(IntervalError,
                           QStringLiteral("catching up %1 cycles is out of range; use 1 ... %2")
                               .arg(policy.catchUpCycles())
                               .arg(QPlcOverrunPolicy::MaximumCatchUp));
    d->overrunPolicy = policy;
    return true;
}

QPlcOverrunPolicy QPlcMasterNode::overrunPolicy() const
{
    return d->overrunPolicy;
}

void QPlcMasterNode::setCycleLimit(quint64 cycles)
{
    d->cycleLimit = cycles;
}

void QPlcMasterNode::setInitializationTimeout(std::chrono::milliseconds time)
{
    d->stepTimer.setInterval(time);
}

void QPlcMasterNode::setProfile(QPlcProfile::Value profile)
{
    d->profileWanted = profile;
}

QPlcProfile::Value QPlcMasterNode::profile() const
{
    return d->profile().value;
}

QString QPlcMasterNode::profileReason() const
{
    return d->profile().reason;
}

void QPlcMasterNode::setLongestWait(std::chrono::nanoseconds time)
{
    d->longestWait = time;
}

void QPlcMasterNode::setGapLimit(std::chrono::nanoseconds time)
{
    d->gapLimit = time;
}

void QPlcMasterNode::setOverrunLimit(int overruns)
{
    d->overrunLimit = overruns;
}

void QPlcMasterNode::setArmingRequired(bool required)
{
    d->armingWanted = required;
}

bool QPlcMasterNode::isArmingRequired() const
{
    return d->isArmingRequired();
}

bool QPlcMasterNode::startServer(const QPlcUnderlyingProtocol &protocol)
{
    return d->startServer(protocol);
}

void QPlcMasterNode::setLocalName(const QString &name)
{
    d->localName = name;
}

void QPlcMasterNode::setMulticastGroup(const QHostAddress &group)
{
    d->multicastGroup = group;
}

void QPlcMasterNode::setBeacon(bool on)
{
    d->hasBeacon = on;
}

void QPlcMasterNode::stopServer()
{
    if (!d->server)
        return;
    d->end(QStringLiteral("the server of the master ends"));
    d->beacon.end();
    d->server->close();
}

quint16 QPlcMasterNode::serverPort() const
{
    return d->server ? d->server->port() : 0;
}

void QPlcMasterNode::setInsecureNetworkAllowed(bool allowed)
{
    d->insecureNetworkAllowed = allowed;
}

bool QPlcMasterNode::setFaultPlan(const QString &plan)
{
    QString text;
    if (!plan.isEmpty() && !qplc::FaultPlan::fromText(plan, &text))
        return d->setError(StateError, QStringLiteral("fault plan: %1").arg(text));
    if (serverPort() != 0)
        return d->setError(StateError, QStringLiteral("a fault plan is set before the server starts: stop it first"));
    d->faultPlan = plan;
    return true;
}

QString QPlcMasterNode::faultPlan() const
{
    return d->faultPlan;
}

void QPlcMasterNode::setSecurity(const QPlcSecurity &security)
{
    d->security = security;
}

QPlcSecurity QPlcMasterNode::security() const
{
    return d->security;
}

void QPlcMasterNode::setMaximumConnections(int connections)
{
    d->maximumConnections = connections;
}

bool QPlcMasterNode::addLocalNode(QPlcSlaveNode *node)
{
    Q_ASSERT_X(node, "QPlcMasterNode::addLocalNode", "a node is needed");
    return d->addLocalNode(node);
}

void QPlcMasterNode::removeLocalNode(QPlcSlaveNode *node)
{
    d->removeLocalNode(node);
}

QVector<QPlcNodeInfo> QPlcMasterNode::nodes() const
{
    QVector<QPlcNodeInfo> infos;
    if (!d->registry)
        return infos;
    for (const std::shared_ptr<qplc::NodeSlot> &slot : d->registry->nodes()) {
        if (slot->local || slot->peer)  // else its cyclic channel is not there yet
            infos.append(d->info(*slot));
    }
    return infos;
}

QPlcSchedule QPlcMasterNode::schedule() const
{
    return d->registry ? qplc::describeSchedule(*d->registry, d->table) : QPlcSchedule();
}

QString QPlcMasterNode::writer(const QString &signalName) const
{
    const QPlcSignalIndex index = d->table.indexOf(signalName);
    return d->registry && index != QPlcInvalidSignalIndex ? d->registry->writer(index) : QString();
}

QPlcMasterNode::State QPlcMasterNode::state() const
{
    return d->state;
}

QString QPlcMasterNode::stateReason() const
{
    return d->stateReason;
}

QString QPlcMasterNode::causeThatRemains() const
{
    return d->remainingCause();
}

bool QPlcMasterNode::isArmed() const
{
    return d->arming.isArmed(qplc::monotonicNow());
}

QPlcMasterNode::Error QPlcMasterNode::error() const
{
    return d->error;
}

QString QPlcMasterNode::errorString() const
{
    return d->errorString;
}

QPlcMasterStatistics QPlcMasterNode::statistics() const
{
    QPlcMasterStatistics statistics = d->cycle ? d->cycle->statistics() : QPlcMasterStatistics();
    if (d->server)
        d->server->count(&statistics);
    return statistics;
}

QPlcCycleStatistics QPlcMasterNode::cycleStatistics(QPlcDistribution::Detail detail) const
{
    return d->cycleStatistics(detail);
}

QVector<QPlcRealTimeSetting> QPlcMasterNode::realTimeSettings() const
{
    return d->cycle ? d->cycle->realTimeSettings() : QVector<QPlcRealTimeSetting>();
}

QVector<QPlcLease> QPlcMasterNode::leases() const
{
    return d->leases ? d->leases->list() : QVector<QPlcLease>();
}

quint64 QPlcMasterNode::cycle() const
{
    return d->cycle ? d->cycle->cycle() : 0;
}

QPlcValue QPlcMasterNode::signalValue(const QString &signalName) const
{
    const QPlcSignalIndex index = d->table.indexOf(signalName);
    return d->cycle && index != QPlcInvalidSignalIndex ? d->cycle->value(index) : QPlcValue();
}

QPlcQuality QPlcMasterNode::signalQuality(const QString &signalName) const
{
    const QPlcSignalIndex index = d->table.indexOf(signalName);
    if (!d->cycle || index == QPlcInvalidSignalIndex)
        return {};
    return QPlcQuality::fromByte(quint8(d->cycle->values()[d->cycle->qualityOffset(index)]));
}

bool QPlcMasterNode::setSignalValue(const QString &signalName, const QPlcValue &value)
{
    return d->setSignalValue(signalName, value);
}

bool QPlcMasterNode::initializeAllStates()
{
    return d->initializeAllStates();
}

bool QPlcMasterNode::startRealTime()
{
    return d->startRealTime(0, d->isStartPermitted(isArmed() ? d->arming.token() : 0));
}

void QPlcMasterNode::safeStop(const QString &reason)
{
    d->safeStop(reason.isEmpty() ? QStringLiteral("the master was told to") : reason);
}

bool QPlcMasterNode::arm()
{
    return d->arm();
}

bool QPlcMasterNode::reset()
{
    return d->reset();
}

void QPlcMasterNode::stop()
{
    d->stop(QStringLiteral("the master was told to"));
}
