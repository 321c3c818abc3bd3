// SPDX-License-Identifier: Apache-2.0
#include "SoakRun.h"

#include "Intruder.h"
#include "PlantKeys.h"
#include "ReferenceClock.h"
#include "Strangers.h"

#include <QtCore/QDir>
#include <QtCore/QElapsedTimer>
#include <QtCore/QStandardPaths>

#include <csignal>

namespace soak {

namespace {

constexpr int Consequences = 100;  // [ms] after a fault, until watchdogs and connections have had their say
constexpr int AtOnce = 8;      // processes that start beside each other: hundreds would leave the master no processor
constexpr int Settling = 350;  // [ms] after a fault, until all of it has been counted

}  // namespace

SoakRun::SoakRun(const Profile &profile, int seconds, quint64 seed, const QString &folder)
    : m_profile(profile)
    , m_seconds(seconds)
    , m_seed(seed)
    , m_folder(folder)
    , m_plant(profile, folder, m_history)
    , m_operator(m_history, profile.shape.nodes)
{
    m_history.open(QDir(folder).filePath(QStringLiteral("Runner.history")), &m_errorString);
}

SoakRun::~SoakRun() = default;

bool SoakRun::setError(const QString &text)
{
    m_errorString = text;
    return false;
}

/// Makes keys, and takes those of the operator.
bool SoakRun::secure()
{
    if (!m_profile.isSecured())
        return true;
    QPlcSecurity::setCurrent(PlantKeys::ofOperator(m_folder));
    return PlantKeys::write(m_folder, m_profile.shape.nodes, &m_errorString);
}

bool SoakRun::start()
{
    if (!m_errorString.isEmpty() || !secure() || !m_plant.startMaster(&m_errorString))
        return false;
    m_operator.useMaster(m_plant.port());
    for (int node = 0; node < m_profile.shape.nodes; ++node) {
        m_plant.startNode(node);
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

/// Programs beside the plant that take processors, memory and disk, until the object goes.
bool SoakRun::startLoad(std::unique_ptr<PlantProcess> *load)
{
    if (!m_profile.isLoaded)
        return true;
    const QString program = QStandardPaths::findExecutable(QStringLiteral("stress-ng"));
    if (program.isEmpty())
        return setError(QStringLiteral("no stress-ng; scripts/setup --tests installs it"));
    *load = std::make_unique<PlantProcess>(
        program,
        QStringList{QStringLiteral("--cpu"), QStringLiteral("2"), QStringLiteral("--vm"), QStringLiteral("1"),
                    QStringLiteral("--vm-bytes"), QStringLiteral("64M"), QStringLiteral("--hdd"), QStringLiteral("1"),
                    QStringLiteral("--temp-path"), m_folder},
        QDir(m_folder).filePath(QStringLiteral("Load.log")));
    return true;
}

bool SoakRun::run()
{
    const ReferenceClock reference(m_history, std::max<qint64>(1'000'000, m_profile.periodUs * 1000 / 4));
    std::unique_ptr<PlantProcess> load;
    if (!start() || !startLoad(&load))
        return false;
    rest(2);
    Intruder intruder(m_plant.port(), m_profile.attemptsPerSecond, m_seed, m_folder, m_history);
    if (m_profile.faultEvery == 0) {
        rest(m_seconds);
    } else {
        const int count = m_profile.faultCount > 0 ? m_profile.faultCount * m_seconds / m_profile.seconds
                                                   : m_seconds * 1000 / m_profile.faultEvery;
        QElapsedTimer timer;
        timer.start();
        for (const Fault &fault : planOf(m_profile, count, m_seed)) {
            if (m_profile.faultCount == 0 && timer.elapsed() >= 1000 * qint64(m_seconds))
                break;  // each of them took longer than it may
            if (!suffer(fault))
                return false;
        }
    }
    intruder.end();                           // what is used at last is what was used before there was one
    rest(3);                                  // longer than the master is patient with a stranger
    m_history.append(Record::Recovered, -1);  // what comes now is the end
    m_operator.stop();
    Operator::wait(Settling);
    const QStringList bad = m_plant.end();
    return bad.isEmpty()
        || setError(QStringLiteral("did not end when told to: %1").arg(bad.join(QStringLiteral(", "))));
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
    if (!recover())  // it may have gone safe for a stall of the machine
        return false;
    QElapsedTimer timer;
    timer.start();
    m_history.append(Record::FaultBegins, fault.node, {quint64(fault.kind), quint64(fault.amount), fault.seed});
    const int amount = inject(fault);
    m_history.append(Record::FaultEnds, fault.node, {quint64(fault.kind), quint64(amount)});
    if (fault.kind == FaultKind::StopNode || fault.kind == FaultKind::StopMaster)
        Operator::wait(Consequences);
    if (!recover())
        return false;
    const int settling = fault.kind == FaultKind::KillNode ? Consequences : Settling;
    Operator::wait(std::max(settling, m_profile.faultEvery - int(timer.elapsed())));
    m_plant.recordUsage(m_operator.isRunning());
    return true;
}

void SoakRun::stopFor(PlantProcess &process, int milliseconds)
{
    process.sendSignal(SIGSTOP);
    Operator::wait(milliseconds);
    process.sendSignal(SIGCONT);
}

/// Does it, until its cause is gone. \return how much of it was really done
int SoakRun::inject(const Fault &fault)
{
    Strangers strangers(fault.seed);
    switch (fault.kind) {
    case FaultKind::KillNode:
        m_operator.expectAnother(fault.node);
        m_plant.startNode(fault.node);  // kills the life before
        return 1;
    case FaultKind::StopNode:
        stopFor(m_plant.node(fault.node), fault.amount);
        return fault.amount;
    case FaultKind::KillMaster:
        m_plant.master().destroy();
        Operator::wait(10 * int(m_profile.shape.hold + 2) * int(m_profile.periodUs) / 10'000);
        m_plant.startMaster(&m_errorString);
        m_operator.useMaster(m_plant.port());
        return 1;
    case FaultKind::StopMaster:
        stopFor(m_plant.master(), fault.amount);
        return fault.amount;
    case FaultKind::GarbageDatagrams:
        return strangers.sendDatagrams(m_plant.port(), fault.amount);
    case FaultKind::GarbageControl: {
        const int made = strangers.sendGarbage(m_plant.port(), fault.amount);
        Operator::wait(50);
        return made;
    }
    case FaultKind::GarbageToNodes: {
        int sent = 0;
        const QStringList addresses = m_operator.datagramAddresses();
        for (const QString &address : addresses)
            sent += strangers.sendDatagrams(quint16(address.section(QLatin1Char(':'), 1).toUInt()),
                                            fault.amount / addresses.size());
        return sent;
    }
    case FaultKind::StoppedReader: {
        const int asked = strangers.askWithoutReading(m_plant.port(), fault.amount);
        Operator::wait(200);
        return asked;
    }
    case FaultKind::ConnectFlood: {
        const int made = strangers.connectOnly(m_plant.port(), fault.amount);
        Operator::wait(100);
        return made;
    }
    default:
        m_operator.expectAnother(fault.node);
        m_plant.startNode(fault.node,
                          {QStringLiteral("--enable-fault-injection"), QStringLiteral("--faults"),
                           linkFaultsOf(fault.kind, fault.seed)});
        m_operator.bringToRealTime(Patience);  // what is done begins with the first frame
        Operator::wait(fault.amount);
        m_operator.expectAnother(fault.node);
        m_plant.startNode(fault.node);
        return fault.amount;
    }
}

}  // namespace soak
