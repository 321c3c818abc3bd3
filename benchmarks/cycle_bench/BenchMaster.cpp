// SPDX-License-Identifier: Apache-2.0
#include "BenchMaster.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QEventLoop>
#include <QtCore/QFile>
#include <QtCore/QRandomGenerator>
#include <QtCore/QTimer>

#include <algorithm>
#include <chrono>
#include <sched.h>
#include <unistd.h>

namespace {

/// The value that a fraction \a q of \a sorted does not exceed.
qint64 percentile(const std::vector<qint64> &sorted, double q)
{
    return sorted.empty() ? 0 : sorted[std::min(sorted.size() - 1, std::size_t(q * double(sorted.size())))];
}

QPlcDistribution distributionOf(std::vector<qint64> values)
{
    std::sort(values.begin(), values.end());
    QPlcDistribution figures;
    figures.count = values.size();
    figures.p50 = percentile(values, 0.5);
    figures.p99 = percentile(values, 0.99);
    figures.p999 = percentile(values, 0.999);
    figures.maximum = values.empty() ? 0 : values.back();
    return figures;
}

void addPercentiles(QJsonObject *fields, const QString &name, const QPlcDistribution &figures)
{
    fields->insert(name + QStringLiteral("_p50_us"), double(figures.p50) * 1e-3);
    fields->insert(name + QStringLiteral("_p99_us"), double(figures.p99) * 1e-3);
    fields->insert(name + QStringLiteral("_p999_us"), double(figures.p999) * 1e-3);
    fields->insert(name + QStringLiteral("_max_us"), double(figures.maximum) * 1e-3);
}

/// Periods in which the plant did not get what it should: without all answers, or left out.
double missedCycles(const QPlcCycleStatistics &statistics)
{
    return double(statistics.incompleteCycles + statistics.skippedCycles);
}

}  // namespace

BenchMaster::BenchMaster(const BenchOptions &options)
    : m_options(options)
    , m_probe(options)
{
}

bool BenchMaster::setError(const QString &text)
{
    m_errorString = text;
    return false;
}

bool BenchMaster::prepare()
{
    m_master.setSignalTable(benchTable(m_options));
    m_master.setClock(m_options.isBackToBack() ? QPlcClock::lockstep() : QPlcClock::realTime());
    QPlcRealTimeOptions realTime;
    realTime.lockMemory = ::sched_getscheduler(0) == SCHED_FIFO;
    if (m_options.idleLatencyUs >= 0)
        realTime.idleLatency = m_options.idleLatencyUs;
    realTime.spin = qint64(m_options.spinUs) * 1000;
    m_master.setRealTimeOptions(realTime);
    m_master.setInitializationTimeout(std::chrono::seconds(10));
    if (!m_options.isBackToBack() && !m_master.setInterval(std::chrono::microseconds(m_options.periodUs)))
        return setError(m_master.errorString());
    return m_master.addLocalNode(&m_probe) || setError(m_master.errorString());
}

/// One key, with which each slave is itself.
bool BenchMaster::makeKeys()
{
    QFile file(m_keysFolder.filePath(QStringLiteral("keys.ini")));
    const QByteArray key = QByteArray::number(QRandomGenerator::system()->generate64(), 16).rightJustified(64, 'a');
    QByteArray text;
    for (int i = 0; i < m_options.slaves; ++i)
        text += "[" + BenchSlave::nameOf(i).toUtf8() + "]\nkey = " + key + "\nrole = Node\n";
    const bool isWritten = file.open(QIODevice::WriteOnly)
        && file.setPermissions(QFileDevice::ReadOwner | QFileDevice::WriteOwner) && file.write(text) == text.size();
    if (!isWritten)
        return setError(QStringLiteral("cannot write %1: %2").arg(file.fileName(), file.errorString()));
    m_keysFile = file.fileName();
    m_master.setSecurity(QPlcSecurity::preSharedKeys(m_keysFile));
    m_master.setArmingRequired(false);  // nothing moves here
    return true;
}

bool BenchMaster::addSlaves()
{
    if (m_options.isInProcess()) {
        for (int i = 0; i < m_options.slaves; ++i) {
            m_localSlaves.push_back(std::make_unique<BenchSlave>(m_options, i));
            if (!m_master.addLocalNode(m_localSlaves.back().get()))
                return setError(m_master.errorString());
        }
        return true;
    }
    if (m_options.transport == QLatin1String("udp-multicast"))
        m_master.setMulticastGroup(QHostAddress(QStringLiteral("239.255.76.68")));
    if (m_options.isSealed && !makeKeys())
        return false;
    if (!m_master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)))
        return setError(m_master.errorString());
    const QString address = QStringLiteral("%1://127.0.0.1:%2").arg(m_options.transport).arg(m_master.serverPort());
    QElapsedTimer clock;
    clock.start();
    for (int i = 0; i < m_options.slaves; ++i) {
        if (!m_processes.start(m_options.slaveArguments(i, address, m_keysFile)))
            return setError(QStringLiteral("cannot start slave process %1").arg(i));
    }
    if (!waitForSlaves())
        return false;
    m_registration = double(clock.nsecsElapsed()) * 1e-9;
    return true;
}

bool BenchMaster::waitForSlaves()
{
    QElapsedTimer timer;
    timer.start();
    while (m_master.nodes().size() < m_options.slaves + 1) {
        if (timer.elapsed() > 60000 || !m_processes.allAlive())
            return setError(
                QStringLiteral("only %1 of %2 slaves came").arg(m_master.nodes().size() - 1).arg(m_options.slaves));
        wait(0.01);
    }
    return true;
}

void BenchMaster::wait(double seconds)
{
    QEventLoop loop;
    QTimer::singleShot(std::chrono::milliseconds(qRound64(seconds * 1e3)), &loop, &QEventLoop::quit);
    loop.exec();
}

bool BenchMaster::startPhase()
{
    m_master.startRealTime();
    QElapsedTimer timer;
    timer.start();
    while (m_master.state() != QPlcMasterNode::RealTime && timer.elapsed() < 15000
           && m_master.error() == QPlcMasterNode::NoError)
        wait(0.002);
    return m_master.state() == QPlcMasterNode::RealTime
        || setError(QStringLiteral("the cycles did not start: %1").arg(m_master.errorString()));
}

void BenchMaster::stopPhase()
{
    m_master.stop();
    m_allCycles += m_master.statistics().cycles;
}

BenchMaster::Snapshot BenchMaster::snapshot() const
{
    return {ProcessUsage::of(::getpid()), ProcessUsage::sumOf(m_processes.ids()), LoopbackUsage::now(),
            std::chrono::steady_clock::now().time_since_epoch().count(), m_master.cycleStatistics()};
}

bool BenchMaster::run()
{
    if (!prepare() || !addSlaves())
        return false;
    QElapsedTimer clock;
    clock.start();
    if (!startPhase())
        return false;
    m_start = double(clock.nsecsElapsed()) * 1e-9;
    wait(m_options.warmup);
    if (!m_options.isBackToBack()) {  // statistics begin with a phase
        stopPhase();
        if (!startPhase())
            return false;
    }
    m_before = snapshot();
    m_probe.begin();
    wait(m_options.seconds);
    m_probe.end();
    m_after = snapshot();
    stopPhase();
    return m_master.error() == QPlcMasterNode::NoError || setError(m_master.errorString());
}

void BenchMaster::addUsage(QJsonObject *fields, double cycles) const
{
    const double perSlave = cycles * m_options.slaves;
    const double master = m_after.master.cpuUs - m_before.master.cpuUs;
    const double slaves = m_after.slaves.cpuUs - m_before.slaves.cpuUs;
    fields->insert(QStringLiteral("cpu_master_us"), master / cycles);
    fields->insert(QStringLiteral("cpu_slave_us"), slaves / perSlave);
    fields->insert(QStringLiteral("cpu_total_us"), (master + slaves) / cycles);
    fields->insert(QStringLiteral("ctx_master"),
                   (m_after.master.contextSwitches - m_before.master.contextSwitches) / cycles);
    fields->insert(QStringLiteral("ctx_slave"),
                   (m_after.slaves.contextSwitches - m_before.slaves.contextSwitches) / perSlave);
    fields->insert(QStringLiteral("bytes_per_cycle"), (m_after.loopback.bytes - m_before.loopback.bytes) / cycles);
    fields->insert(QStringLiteral("packets_per_cycle"),
                   (m_after.loopback.packets - m_before.loopback.packets) / cycles);
    fields->insert(QStringLiteral("threads_master"), m_after.master.threads);
    fields->insert(QStringLiteral("threads_slave"), double(m_after.slaves.threads) / m_options.slaves);
    fields->insert(QStringLiteral("rss_slave_kb"), m_after.slaves.residentKb / m_options.slaves);
}

QJsonObject BenchMaster::result() const
{
    const QPlcCycleStatistics &statistics = m_after.statistics;
    const double cycles = std::max(1.0, double(statistics.cycles - m_before.statistics.cycles));
    const double seconds = double(m_after.time - m_before.time) * 1e-9;
    QJsonObject fields{
        {QStringLiteral("peer"), QStringLiteral("qtplc")},
        {QStringLiteral("variant"), m_options.transport + (m_options.isSealed ? QStringLiteral(" sealed") : QString())},
        {QStringLiteral("slaves"), m_options.slaves},
        {QStringLiteral("in"), m_options.inputs},
        {QStringLiteral("out"), m_options.outputs},
        {QStringLiteral("period_us"), m_options.periodUs},
        {QStringLiteral("policy"),
         ::sched_getscheduler(0) == SCHED_FIFO ? QStringLiteral("fifo") : QStringLiteral("other")},
        {QStringLiteral("cycles"), cycles},
        {QStringLiteral("all_cycles"), double(m_allCycles)},
        {QStringLiteral("registration_s"), m_registration},
        {QStringLiteral("start_s"), m_start},
        {QStringLiteral("seconds"), seconds},
        {QStringLiteral("cycles_per_s"), cycles / seconds},
        {QStringLiteral("errors"), double(m_probe.errors())},
        {QStringLiteral("overruns"), missedCycles(statistics) - missedCycles(m_before.statistics)}};
    if (m_options.isBackToBack()) {
        addPercentiles(&fields, QStringLiteral("rtt"), distributionOf(m_probe.intervals()));
    } else {
        addPercentiles(&fields, QStringLiteral("rtt"), statistics.roundTrip.sinceStart);
        addPercentiles(&fields, QStringLiteral("late"), statistics.lateness.sinceStart);
        fields.insert(QStringLiteral("drift_us"), double(m_probe.drift()) * 1e-3);
    }
    addUsage(&fields, cycles);
    return fields;
}
