// SPDX-License-Identifier: Apache-2.0
#include "SoakRun.h"

#include <utility>

namespace soak {

namespace {

constexpr int AtOnce = 8;      // processes that start beside each other: hundreds would leave the master no processor
constexpr int Settling = 350;  // [ms] after a fault, until all of it has been counted

/// [ms] after a fault, until watchdogs and connections have had their say.
int consequencesOf(FaultKind kind)
{
    switch (kind) {
    case FaultKind::CutRoad:
    case FaultKind::CutRoadToNode:
        return 1000;  // what a connection has lost is sent again
    case FaultKind::StopNode:
    case FaultKind::StopMaster:
        return 100;
    default:
        return kind > FaultKind::CutLink ? 100 : 0;
    }
}

}  // namespace

SoakRun::SoakRun(const Profile &profile, int seconds, const std::vector<Fault> &plan, TestedPlant &plant,
                 HistoryWriter &history)
    : m_profile(profile)
    , m_seconds(seconds)
    , m_plan(plan)
    , m_plant(plant)
    , m_history(history)
    , m_operator(history, profile.shape.nodes)
{
}

SoakRun::~SoakRun() = default;

bool SoakRun::setError(const QString &text)
{
    m_errorString = text;
    return false;
}

bool SoakRun::start()
{
    if (!m_plant.prepare(&m_errorString) || !m_plant.startMaster(&m_errorString))
        return false;
    m_operator.useMaster(m_plant.master());
    for (int node = 0; node < m_profile.shape.nodes; ++node) {
        m_plant.startNode(node, {});
        if (node % AtOnce == AtOnce - 1 && !m_operator.waitForNodes(node + 1, Patience))
            return setError(m_operator.errorString());
    }
    return recover();
}

/// The operator brings the plant back to motion.
bool SoakRun::recover()
{
    if (!m_operator.bringToRealTime(Patience + 100 * m_profile.shape.nodes))
        return setError(QStringLiteral("the plant does not run: %1").arg(m_operator.errorString()));
    m_history.append(Record::Recovered, -1);
    return true;
}

bool SoakRun::run()
{
    if (!start() || !m_plant.beginBeside(&m_errorString))
        return false;
    rest(2);
    if (!sufferAll())
        return false;
    m_plant.endBeside();
    rest(3);                                  // longer than the master is patient with a stranger
    m_history.append(Record::Recovered, -1);  // what comes now is the end
    m_operator.stop();
    Operator::wait(Settling);
    const QStringList bad = m_plant.end();
    return bad.isEmpty()
        || setError(QStringLiteral("did not end when told to: %1").arg(bad.join(QStringLiteral(", "))));
}

bool SoakRun::sufferAll()
{
    if (m_profile.faultEvery == 0)
        rest(m_seconds);
    const qint64 begin = Operator::now();
    for (const Fault &fault : m_plan) {
        if (m_profile.faultCount == 0 && Operator::now() - begin >= 1000 * qint64(m_seconds))
            break;  // each of them took longer than it may
        if (!suffer(fault))
            return false;
    }
    return !m_isCrowded || comeBack(m_plan.back().kind, true);
}

/// Lets the plant run, and looks at what it uses.
void SoakRun::rest(int seconds)
{
    for (int i = 0; i < seconds; ++i) {
        m_plant.recordUsage(m_operator.isRunning());
        Operator::wait(1000);
    }
    m_plant.recordUsage(m_operator.isRunning());
}

bool SoakRun::suffer(const Fault &fault)
{
    if (!m_isCrowded && !recover())  // it may have gone safe for a stall of the machine
        return false;
    const qint64 begin = Operator::now();
    const bool isFollowed = fault.pause >= 0;
    const bool wasCrowded = m_isCrowded;
    m_history.append(Record::FaultBegins, fault.node,
                     {quint64(fault.kind), quint64(fault.amount), fault.seed, m_isCrowded || isFollowed ? 1U : 0U});
    const int amount = inject(fault);
    m_history.append(Record::FaultEnds, fault.node, {quint64(fault.kind), quint64(amount)});
    m_isCrowded = isFollowed;
    m_isMasterNew = m_isMasterNew || isOfMaster(fault.kind);
    if (isFollowed) {
        Operator::wait(fault.pause);
        return true;
    }
    if (!comeBack(fault.kind, wasCrowded))
        return false;
    const int settling = fault.kind == FaultKind::KillNode ? 100 : Settling;
    Operator::wait(std::max(settling, m_profile.faultEvery - int(Operator::now() - begin)));
    m_plant.recordUsage(m_operator.isRunning());
    return true;
}

/// After a fault, or several at once, of which each may be the one that shows last.
bool SoakRun::comeBack(FaultKind last, bool wereSeveral)
{
    m_isCrowded = false;
    m_plant.waitForCauses();
    if (std::exchange(m_isMasterNew, false))
        m_operator.useMaster(m_plant.master());
    Operator::wait(consequencesOf(wereSeveral ? FaultKind::CutRoad : last));
    return recover();
}

void SoakRun::stopFor(int node, int milliseconds)
{
    m_plant.setStopped(node, true);
    Operator::wait(milliseconds);
    m_plant.setStopped(node, false);
}

/// Evicts a node for a while, and tries to start without it. An evicted node waits for seconds
/// before it connects again; half of them are started again, and connect at once.
int SoakRun::keepOut(const Fault &fault)
{
    const bool isOut = m_operator.evict(fault.node);
    m_operator.tryToStart();
    if (fault.seed % 2 == 0)
        m_plant.startNode(fault.node, {});
    Operator::wait(fault.amount);
    m_operator.tryToStart();
    m_operator.admit(fault.node);
    return isOut ? fault.amount : 0;
}

/// Does it, until its cause is gone. \return how much of it was really done
int SoakRun::inject(const Fault &fault)
{
    if (isLinkFault(fault.kind)) {
        m_operator.expectAnother(fault.node);
        m_plant.startNode(fault.node, linkFaultsOf(fault.kind, fault.seed));
        m_operator.bringToRealTime(Patience);  // what is done begins with the first frame
        Operator::wait(fault.amount);
        m_operator.expectAnother(fault.node);
        m_plant.startNode(fault.node, {});
        return fault.amount;
    }
    switch (fault.kind) {
    case FaultKind::KillNode:
        m_operator.expectAnother(fault.node);
        m_plant.startNode(fault.node, {});  // kills the life before
        return 1;
    case FaultKind::StopNode:
        stopFor(fault.node, fault.amount);
        return fault.amount;
    case FaultKind::KillMaster:
        m_plant.killMaster();
        Operator::wait(10 * int(m_profile.shape.hold + 2) * int(m_profile.periodUs) / 10'000);
        m_plant.startMaster(&m_errorString);
        return 1;
    case FaultKind::EvictNode:
        return keepOut(fault);
    case FaultKind::StopMaster:
        stopFor(TestedPlant::TheMaster, fault.amount);
        return fault.amount;
    default:
        if (fault.kind == FaultKind::PowerNode)
            m_operator.expectAnother(fault.node);
        return m_plant.inject(fault, m_operator);
    }
}

}  // namespace soak
