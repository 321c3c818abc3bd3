// SPDX-License-Identifier: Apache-2.0
#include "QPlcMasterNode.h"

#include "QPlcMasterNodePrivate.h"
#include "QPlcSignalIndexTable.h"
#include "node/cycle/PeriodRange.h"
#include "node/session/MasterReplies.h"
#include "node/statistics/StatisticsReply.h"
#include "protocol/messages/Vocabulary.h"
#include "realtime/TimeSource.h"

using namespace std::chrono_literals;

namespace {

constexpr int mostOverruns = 1'000'000;
constexpr int mostConnections = 65'535;
constexpr std::chrono::hours longestTime{24};

/// \param fault  why a signal could not be claimed; empty: it was
bool isClaimed(QPlcMasterNodePrivate &master, const QString &fault)
{
    return fault.isEmpty() ? master.error.clear() : master.error.set(QPlcMasterNode::SignalError, fault);
}

bool refusePeriod(QPlcMasterNodePrivate &master, double seconds)
{
    return master.error.set(QPlcMasterNode::IntervalError,
                            QStringLiteral("a period of %1 s is out of range; use 0.00001 ... 10 s").arg(seconds));
}

/// Whether \a time may be a limit; if not, tells what may.
/// \param limit  "an initialization timeout"
bool isLimit(QPlcMasterNodePrivate &master, std::chrono::nanoseconds time, std::chrono::nanoseconds shortest,
             const QString &limit)
{
    if (time >= shortest && time <= longestTime)
        return master.error.clear();
    return master.error.set(QPlcMasterNode::IntervalError,
                            QStringLiteral("%1 of %2 s is out of range; use %3 ... 86400 s")
                                .arg(limit)
                                .arg(double(time.count()) * 1e-9)
                                .arg(double(shortest.count()) * 1e-9));
}

/// Whether \a number may be a limit; if not, tells what may.
/// \param limit  "a limit of %1 overruns"
bool isLimit(QPlcMasterNodePrivate &master, int number, int smallest, int largest, const QString &limit)
{
    if (number >= smallest && number <= largest)
        return master.error.clear();
    return master.error.set(
        QPlcMasterNode::IntervalError,
        QStringLiteral("%1 is out of range; use %2 ... %3").arg(limit.arg(number)).arg(smallest).arg(largest));
}

}  // namespace

QPlcMasterNode::QPlcMasterNode(QObject *parent)
    : QObject(parent)
    , d(std::make_unique<QPlcMasterNodePrivate>(this))
{
    qRegisterMetaType<QPlcMasterNode::State>("QPlcMasterNode::State");
    qRegisterMetaType<QPlcMasterNode::Error>("QPlcMasterNode::Error");
    qRegisterMetaType<QPlcMasterNode::StepResult>("QPlcMasterNode::StepResult");
}

QPlcMasterNode::~QPlcMasterNode()
{
    const QSignalBlocker silence(this);  // nobody wants to hear from a master that is half gone
    d->apply(qplc::MasterEvent::End, QStringLiteral("the master ends"));
    stopServer();
}

bool QPlcMasterNode::setSignalTable(const QPlcSignalTable &table)
{
    if (d->parts)
        return d->error.set(StateError,
                            QStringLiteral("the signal table can only be set before signals, nodes and servers"));
    d->table = table;
    return d->error.clear();
}

QPlcSignalTable QPlcMasterNode::signalTable() const
{
    return d->table;
}

bool QPlcMasterNode::setTimeSignal(const QString &signalName)
{
    return d->prepare() && isClaimed(*d, d->parts->ownSignals.claim(qplc::OwnSignals::Time, signalName));
}

bool QPlcMasterNode::activateJitterMeasurement(const QString &signalName)
{
    return d->prepare() && isClaimed(*d, d->parts->ownSignals.claim(qplc::OwnSignals::Jitter, signalName));
}

bool QPlcMasterNode::activateWorkloadMeasurement(const QString &signalName)
{
    return d->prepare() && isClaimed(*d, d->parts->ownSignals.claim(qplc::OwnSignals::Workload, signalName));
}

bool QPlcMasterNode::activateStatisticSignal(QPlcStatisticFigure figure, const QString &signalName,
                                             const QString &nodeName)
{
    const QString fault = qplc::OwnSignals::faultOf(figure, signalName, nodeName);
    if (!fault.isEmpty())
        return d->error.set(SignalError, fault);
    return d->prepare() && isClaimed(*d, d->parts->ownSignals.add(figure, signalName, nodeName));
}

bool QPlcMasterNode::setInterval(std::chrono::nanoseconds period)
{
    if (period < qplc::ShortestPeriod || period > qplc::LongestPeriod)
        return refusePeriod(*d, double(period.count()) * 1e-9);
    d->phaseSettings.interval = period;
    return d->error.clear();
}

bool QPlcMasterNode::setInterval(double seconds)
{
    const std::optional<std::chrono::nanoseconds> period = qplc::nanosecondsOf(seconds);
    return period ? setInterval(*period) : refusePeriod(*d, seconds);
}

std::chrono::nanoseconds QPlcMasterNode::interval() const
{
    return d->phaseSettings.interval;
}

bool QPlcMasterNode::setClock(QPlcClock clock)
{
    if (!clock.isValid())
        return d->error.set(
            IntervalError,
            QStringLiteral("a clock of %1 times real time is out of range; use 0.001 ... 1000, or another clock")
                .arg(clock.scale()));
    d->phaseSettings.clock = clock;
    return d->error.clear();
}

QPlcClock QPlcMasterNode::clock() const
{
    return d->phaseSettings.clock;
}

void QPlcMasterNode::setRealTimeOptions(const QPlcRealTimeOptions &options)
{
    d->phaseSettings.realTimeOptions = options;
}

bool QPlcMasterNode::setOverrunPolicy(QPlcOverrunPolicy policy)
{
    if (!policy.isValid())
        return d->error.set(IntervalError,
                            QStringLiteral("catching up %1 cycles is out of range; use 1 ... %2")
                                .arg(policy.catchUpCycles())
                                .arg(QPlcOverrunPolicy::MaximumCatchUp));
    d->phaseSettings.overrunPolicy = policy;
    return d->error.clear();
}

QPlcOverrunPolicy QPlcMasterNode::overrunPolicy() const
{
    return d->phaseSettings.overrunPolicy;
}

void QPlcMasterNode::setCycleLimit(quint64 cycles)
{
    d->phaseSettings.cycleLimit = cycles;
}

bool QPlcMasterNode::setInitializationTimeout(std::chrono::milliseconds time)
{
    const bool isGood = isLimit(*d, time, 1ms, QStringLiteral("an initialization timeout"));
    if (isGood) {
        d->stepTimer.setLength(time);
        d->joinTimer.setLength(time);
    }
    return isGood;
}

void QPlcMasterNode::setProfile(QPlcProfile::Value profile)
{
    d->phaseSettings.profile = profile;
}

QPlcProfile::Value QPlcMasterNode::profile() const
{
    return d->profile().value;
}

QString QPlcMasterNode::profileReason() const
{
    return d->profile().reason;
}

void QPlcMasterNode::setEventFile(const QString &fileName)
{
    d->eventKeeper.setFile(fileName);
}

QString QPlcMasterNode::eventFile() const
{
    return d->eventKeeper.file();
}

bool QPlcMasterNode::setManifest(const QPlcManifest &manifest)
{
    if (serverPort() != 0 || (d->parts && !d->parts->registry.nodes().empty()))
        return d->error.set(StateError, QStringLiteral("the manifest can only be set before servers and nodes"));
    if (manifest.isEmpty())
        return d->error.set(NodeError,
                            QStringLiteral("the manifest names no node; read one with QPlcManifest::fromIniFile()"));
    d->needed.setManifest(manifest);
    return d->error.clear();
}

QPlcManifest QPlcMasterNode::manifest() const
{
    return d->needed.manifest();
}

QString QPlcMasterNode::missingNodes() const
{
    return d->missingText();
}

bool QPlcMasterNode::evict(const QString &name)
{
    qplc::Refusal refusal;
    return d->error.clear() && d->prepare()
        && (d->parts->evictions.evict(name, nullptr, &refusal) || d->error.set(NodeError, refusal.text));
}

bool QPlcMasterNode::admit(const QString &name)
{
    qplc::Refusal refusal;
    return d->error.clear() && d->prepare()
        && (d->parts->evictions.admit(name, nullptr, &refusal) || d->error.set(NodeError, refusal.text));
}

QStringList QPlcMasterNode::evictedNames() const
{
    return d->evictions.names();
}

bool QPlcMasterNode::setLongestWait(std::chrono::nanoseconds time)
{
    const bool isGood = isLimit(*d, time, 0ns, QStringLiteral("a longest wait"));
    if (isGood)
        d->phaseSettings.longestWait = time;
    return isGood;
}

bool QPlcMasterNode::setGapLimit(std::chrono::nanoseconds time)
{
    const bool isGood = isLimit(*d, time, 0ns, QStringLiteral("a gap limit"));
    if (isGood)
        d->phaseSettings.gapLimit = time;
    return isGood;
}

bool QPlcMasterNode::setOverrunLimit(int overruns)
{
    const bool isGood = isLimit(*d, overruns, 0, mostOverruns, QStringLiteral("a limit of %1 overruns"));
    if (isGood)
        d->phaseSettings.overrunLimit = overruns;
    return isGood;
}

void QPlcMasterNode::setArmingRequired(bool required)
{
    d->serverSettings.armingWanted = required;
}

bool QPlcMasterNode::isArmingRequired() const
{
    return d->serverSettings.isArmingRequired();
}

bool QPlcMasterNode::startServer(const QPlcUnderlyingProtocol &protocol)
{
    return d->startServer(protocol);
}

void QPlcMasterNode::setLocalName(const QString &name)
{
    d->serverSettings.localName = name;
}

void QPlcMasterNode::setMulticastGroup(const QHostAddress &group)
{
    d->serverSettings.multicastGroup = group;
}

void QPlcMasterNode::setBeacon(bool on)
{
    d->serverSettings.hasBeacon = on;
}

void QPlcMasterNode::stopServer()
{
    if (!d->parts)
        return;
    d->apply(qplc::MasterEvent::End, QStringLiteral("the server of the master ends"));
    d->beacon.end();
    d->parts->server.close();
}

quint16 QPlcMasterNode::serverPort() const
{
    return d->parts ? d->parts->server.port() : 0;
}

void QPlcMasterNode::setInsecureNetworkAllowed(bool allowed)
{
    d->serverSettings.insecureNetworkAllowed = allowed;
}

bool QPlcMasterNode::setFaultPlan(const QString &plan)
{
    QString text;
    if (!plan.isEmpty() && !qplc::FaultPlan::fromText(plan, &text))
        return d->error.set(StateError, QStringLiteral("fault plan: %1").arg(text));
    if (serverPort() != 0)
        return d->error.set(StateError, QStringLiteral("a fault plan is set before the server starts: stop it first"));
    d->serverSettings.faultPlan = plan;
    return d->error.clear();
}

QString QPlcMasterNode::faultPlan() const
{
    return d->serverSettings.faultPlan;
}

void QPlcMasterNode::setSecurity(const QPlcSecurity &security)
{
    d->serverSettings.security = security;
}

QPlcSecurity QPlcMasterNode::security() const
{
    return d->serverSettings.security;
}

bool QPlcMasterNode::setMaximumConnections(int connections)
{
    const bool isGood = isLimit(*d, connections, 1, mostConnections, QStringLiteral("a limit of %1 connections"));
    if (isGood)
        d->serverSettings.maximumConnections = connections;
    return isGood;
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
    if (!d->parts)
        return infos;
    for (const std::shared_ptr<qplc::NodeSlot> &slot : d->parts->registry.nodes()) {
        if (const auto node = d->nodes.of(slot.get()))  // else its cyclic channel is not there yet
            infos.append(qplc::infoOf(*node));
    }
    return infos;
}

QPlcSchedule QPlcMasterNode::schedule() const
{
    return d->parts ? qplc::describeSchedule(d->parts->registry, d->table) : QPlcSchedule();
}

QString QPlcMasterNode::writer(const QString &signalName) const
{
    const QPlcSignalIndex index = d->table.indexOf(signalName);
    return d->parts && index != QPlcInvalidSignalIndex ? d->parts->registry.writer(index) : QString();
}

QPlcMasterNode::State QPlcMasterNode::state() const
{
    return d->state();
}

QString QPlcMasterNode::stateReason() const
{
    return d->stateReason;
}

QString QPlcMasterNode::causeThatRemains() const
{
    return d->parts ? d->parts->faults.remainingCause() : QString();
}

bool QPlcMasterNode::isArmed() const
{
    return d->arming.isArmed(qplc::monotonicNow());
}

QPlcMasterNode::Error QPlcMasterNode::error() const
{
    return d->error.value();
}

QString QPlcMasterNode::errorString() const
{
    return d->error.text();
}

QPlcMasterStatistics QPlcMasterNode::statistics() const
{
    if (!d->parts)
        return {};
    QPlcMasterStatistics statistics = d->parts->cycle.statistics();
    d->parts->server.count(&statistics);
    return statistics;
}

QPlcCycleStatistics QPlcMasterNode::cycleStatistics(QPlcDistribution::Detail detail) const
{
    return d->parts ? qplc::statisticsOf(d->parts->cycle, d->parts->registry, detail) : QPlcCycleStatistics();
}

QVector<QPlcRealTimeSetting> QPlcMasterNode::realTimeSettings() const
{
    return d->parts ? d->parts->cycle.realTimeSettings() : QVector<QPlcRealTimeSetting>();
}

QVector<QPlcLease> QPlcMasterNode::leases() const
{
    return d->parts ? d->parts->leases.list() : QVector<QPlcLease>();
}

quint64 QPlcMasterNode::cycle() const
{
    return d->parts ? d->parts->cycle.cycle() : 0;
}

QPlcValue QPlcMasterNode::signalValue(const QString &signalName) const
{
    const QPlcSignalIndex index = d->table.indexOf(signalName);
    return d->parts && index != QPlcInvalidSignalIndex ? d->parts->cycle.value(index) : QPlcValue();
}

QPlcQuality QPlcMasterNode::signalQuality(const QString &signalName) const
{
    const QPlcSignalIndex index = d->table.indexOf(signalName);
    if (!d->parts || index == QPlcInvalidSignalIndex)
        return {};
    return QPlcQuality::fromByte(quint8(d->parts->cycle.values()[d->parts->cycle.qualityOffset(index)]));
}

bool QPlcMasterNode::setSignalValue(const QString &signalName, const QPlcValue &value)
{
    if (!d->prepare())
        return false;
    qplc::Refusal refusal;
    if (d->parts->settings.setSignal(signalName, value, &refusal))
        return d->error.clear();
    return d->error.set(refusal.error == qplc::messages::errorWord::wrongState ? StateError : SignalError,
                        refusal.text);
}

bool QPlcMasterNode::initializeAllStates()
{
    return d->initializeAllStates();
}

bool QPlcMasterNode::startRealTime()
{
    return d->startRealTime(0, isArmed() ? d->arming.token() : 0);
}

void QPlcMasterNode::safeStop(const QString &reason)
{
    if (d->parts)
        d->parts->faults.safeStop(reason.isEmpty() ? QStringLiteral("the master was told to") : reason);
}

QPlcMasterNode::StepResult QPlcMasterNode::step()
{
    return d->step();
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
