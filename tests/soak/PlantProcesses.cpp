// SPDX-License-Identifier: Apache-2.0
#include "PlantProcesses.h"

#include "NodeOptions.h"
#include "Operator.h"
#include "PlantKeys.h"
#include "Strangers.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QDir>
#include <QtCore/QElapsedTimer>
#include <QtCore/QFile>
#include <QtCore/QStandardPaths>

#include <csignal>
#include <sys/prctl.h>

namespace soak {

namespace {

/// Descriptors, threads and resident memory [kB] of a process.
std::array<quint64, 3> usageOf(qint64 process)
{
    const QString folder = QStringLiteral("/proc/%1/").arg(process);
    std::array<quint64, 3> usage{};
    usage[0] = quint64(
        QDir(folder + QStringLiteral("fd")).entryList(QDir::AllEntries | QDir::System | QDir::NoDotAndDotDot).size());
    QFile status(folder + QStringLiteral("status"));
    if (!status.open(QIODevice::ReadOnly))
        return usage;
    const QList<QByteArray> lines = status.readAll().split('\n');
    for (const QByteArray &line : lines) {
        if (line.startsWith("Threads:"))
            usage[1] = line.mid(8).trimmed().toULongLong();
        else if (line.startsWith("VmRSS:"))
            usage[2] = line.mid(6).trimmed().split(' ').constFirst().toULongLong();
    }
    return usage;
}

}  // namespace

PlantProcess::PlantProcess(const QString &program, const QStringList &arguments, const QString &logFile)
{
    setStandardErrorFile(logFile, QIODevice::Append);
    start(QDir(QCoreApplication::applicationDirPath()).filePath(program), arguments);
    waitForStarted(Patience);
}

PlantProcess::~PlantProcess()
{
    destroy();
}

void PlantProcess::setupChildProcess()
{
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
}

void PlantProcess::sendSignal(int number) const
{
    if (processId() > 0)
        ::kill(pid_t(processId()), number);
}

void PlantProcess::destroy()
{
    if (state() == NotRunning)
        return;
    kill();
    waitForFinished(Patience);
}

bool PlantProcess::end()
{
    if (state() == NotRunning)
        return exitStatus() == NormalExit;
    terminate();
    if (waitForFinished(Patience))
        return exitStatus() == NormalExit;
    destroy();
    return false;
}

PlantProcesses::PlantProcesses(const Profile &profile, quint64 seed, const QString &folder, HistoryWriter &history)
    : m_profile(profile)
    , m_seed(seed)
    , m_folder(folder)
    , m_history(history)
    , m_nodes(std::size_t(profile.shape.nodes))
{
}

PlantProcesses::~PlantProcesses() = default;

/// Makes keys, and takes those of the operator.
bool PlantProcesses::prepare(QString *error)
{
    m_reference
        = std::make_unique<ReferenceClock>(m_history, std::max<qint64>(1'000'000, m_profile.periodUs * 1000 / 4));
    if (!m_profile.isSecured())
        return true;
    QPlcSecurity::setCurrent(PlantKeys::ofOperator(m_folder));
    return PlantKeys::write(m_folder, m_profile.shape.nodes, error);
}

/// Programs beside the plant that take processors, memory and disk, and intruders.
bool PlantProcesses::beginBeside(QString *error)
{
    m_intruder = std::make_unique<Intruder>(m_port, m_profile.attemptsPerSecond, m_seed, m_folder, m_history);
    if (!m_profile.isLoaded)
        return true;
    const QString program = QStandardPaths::findExecutable(QStringLiteral("stress-ng"));
    if (program.isEmpty()) {
        *error = QStringLiteral("no stress-ng; scripts/setup --tests installs it");
        return false;
    }
    const QStringList arguments{QStringLiteral("--cpu"),       QStringLiteral("2"),
                                QStringLiteral("--vm"),        QStringLiteral("1"),
                                QStringLiteral("--vm-bytes"),  QStringLiteral("64M"),
                                QStringLiteral("--hdd"),       QStringLiteral("1"),
                                QStringLiteral("--temp-path"), m_folder};
    m_load = std::make_unique<PlantProcess>(program, arguments, file(QStringLiteral("Load.log")));
    return true;
}

void PlantProcesses::endBeside()
{
    m_intruder->end();
}

void PlantProcesses::setStopped(int node, bool stopped)
{
    PlantProcess &process = node == TheMaster ? *m_master : *m_nodes[std::size_t(node)].process;
    process.sendSignal(stopped ? SIGSTOP : SIGCONT);
}

int PlantProcesses::inject(const Fault &fault, Operator &person)
{
    Strangers strangers(fault.seed);
    int done = 0;
    switch (fault.kind) {
    case FaultKind::GarbageDatagrams:
        return strangers.sendDatagrams(m_port, fault.amount);
    case FaultKind::GarbageControl:
        done = strangers.sendGarbage(m_port, fault.amount);
        Operator::wait(50);
        return done;
    case FaultKind::GarbageToNodes: {
        const QStringList addresses = person.datagramAddresses();
        for (const QString &address : addresses)
            done += strangers.sendDatagrams(quint16(address.section(QLatin1Char(':'), 1).toUInt()),
                                            fault.amount / addresses.size());
        return done;
    }
    case FaultKind::StoppedReader:
        done = strangers.askWithoutReading(m_port, fault.amount);
        Operator::wait(200);
        return done;
    case FaultKind::ConnectFlood:
        done = strangers.connectOnly(m_port, fault.amount);
        Operator::wait(100);
        return done;
    default:
        return 0;
    }
}

QString PlantProcesses::file(const QString &name) const
{
    return QDir(m_folder).filePath(name);
}

QStringList PlantProcesses::priorityArguments() const
{
    return m_profile.priority > 0 ? QStringList{QStringLiteral("--priority"), QString::number(m_profile.priority)}
                                  : QStringList();
}

/// \param identity  empty: the master
QStringList PlantProcesses::securityArguments(const QString &identity) const
{
    if (!m_profile.isSecured())
        return {};
    const QStringList mode{QStringLiteral("--security"), QStringLiteral("psk"), QStringLiteral("--keys"),
                           PlantKeys::fileIn(m_folder)};
    return identity.isEmpty() ? mode : mode + QStringList{QStringLiteral("--identity"), identity};
}

bool PlantProcesses::startMaster(QString *error)
{
    if (m_master)
        m_master->destroy();
    const QString name = QStringLiteral("Master-life%1").arg(++m_masterLife);
    const QString log = file(name + QStringLiteral(".log"));
    QStringList arguments = shapeArguments(m_profile.shape, m_masterLife, file(name + QStringLiteral(".history")))
        + QStringList{QStringLiteral("--period-us"), QString::number(m_profile.periodUs), QStringLiteral("--port"),
                      QString::number(m_port)}
        + priorityArguments() + securityArguments(QString());
    if (m_profile.judgesMemory)  // what it has taken is resident at once, and what becomes more is growth
        arguments << QStringLiteral("--lock-memory");
    m_master = std::make_unique<PlantProcess>(QStringLiteral("soak_master"), arguments, log);
    m_history.append(Record::Started, -1, {quint64(m_master->processId()), m_masterLife});
    QElapsedTimer timer;
    timer.start();
    while (!m_master->canReadLine() && m_master->state() == QProcess::Running && timer.elapsed() < Patience)
        m_master->waitForReadyRead(20);
    const QByteArray line = m_master->readLine().trimmed();
    m_port = quint16(line.mid(5).toUInt());
    if (!line.startsWith("port ") || m_port == 0)
        *error = QStringLiteral("the master does not listen; %1 says why").arg(log);
    return m_port != 0;
}

void PlantProcesses::startNode(int node, const QString &linkFaults)
{
    Node &slot = m_nodes[std::size_t(node)];
    if (slot.process) {
        slot.process->destroy();
        m_history.append(Record::Gone, node);
    }
    const QString name = QStringLiteral("%1-life%2").arg(nodeName(node)).arg(++slot.life);
    const double watchdog = double(m_profile.shape.hold * m_profile.periodUs) * 1e-6;
    const QStringList arguments = shapeArguments(m_profile.shape, slot.life, file(name + QStringLiteral(".history")))
        + QStringList{QStringLiteral("--node"),
                      QString::number(node),
                      QStringLiteral("--watchdog"),
                      QString::number(watchdog),
                      QStringLiteral("--stay"),
                      QStringLiteral("--master"),
                      QStringLiteral("%1://127.0.0.1:%2").arg(QString::fromLatin1(transportOf(node))).arg(m_port)};
    const QStringList faults = linkFaults.isEmpty()
        ? QStringList()
        : QStringList{QStringLiteral("--enable-fault-injection"), QStringLiteral("--faults"), linkFaults};
    const QStringList critical = isCritical(node) ? QStringList{QStringLiteral("--critical")} : QStringList();
    slot.process = std::make_unique<PlantProcess>(QStringLiteral("soak_node"),
                                                  arguments + critical + priorityArguments()
                                                      + securityArguments(nodeName(node)) + faults,
                                                  file(name + QStringLiteral(".log")));
    m_history.append(Record::Started, node, {quint64(slot.process->processId()), slot.life});
}

void PlantProcesses::recordUsage(bool compare)
{
    const auto record = [&](int node, quint32 life, const PlantProcess &process) {
        const std::array<quint64, 3> usage = usageOf(process.processId());
        m_history.append(Record::Usage, node, {usage[0], usage[1], usage[2], life, compare ? 1U : 0U});
    };
    record(-1, m_masterLife, *m_master);
    for (std::size_t node = 0; node < m_nodes.size(); ++node) {
        if (m_nodes[node].process && m_nodes[node].process->state() == QProcess::Running)
            record(int(node), m_nodes[node].life, *m_nodes[node].process);
    }
}

QStringList PlantProcesses::end()
{
    QStringList bad;
    for (std::size_t node = 0; node < m_nodes.size(); ++node) {
        if (m_nodes[node].process && !m_nodes[node].process->end())
            bad << nodeName(int(node));
    }
    if (m_master && !m_master->end())
        bad << QStringLiteral("Master");
    return bad;
}

}  // namespace soak
