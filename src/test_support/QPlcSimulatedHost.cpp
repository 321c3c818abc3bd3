// SPDX-License-Identifier: Apache-2.0
#include "QPlcSimulatedHost.h"

#include "SimulatedHost.h"

#include <cstdlib>
#include <cxxabi.h>

namespace {

constexpr int mostHosts = 200;  // 127.0.1.1 ... 127.0.1.200

QHostAddress addressOf(int host, const QString &name)
{
    if (host >= mostHosts)
        qFatal("QPlcSimulatedHost: host '%s' is too many, a simulator has %d; use a host again, with kill() and "
               "start(), or another simulator",
               qPrintable(name), mostHosts);
    return QHostAddress(0x7F000101 + quint32(host));
}

/// "QPlcMasterNode" of the text that a compiler has for a type.
QByteArray nameOf(const std::type_info &type)
{
    int status = 0;
    const std::unique_ptr<char, decltype(&std::free)> name(abi::__cxa_demangle(type.name(), nullptr, nullptr, &status),
                                                           &std::free);
    return status == 0 ? name.get() : type.name();
}

}  // namespace

QPlcSimulatedHost::QPlcSimulatedHost(QPlcSimulator &simulator, const QString &name)
    : m_host(std::make_unique<qplc::SimulatedHost>(simulator.m_simulator, name, addressOf(simulator.m_hosts++, name)))
{
}

QPlcSimulatedHost::~QPlcSimulatedHost() = default;

QString QPlcSimulatedHost::name() const
{
    return m_host->name();
}

QPlcUnderlyingProtocol QPlcSimulatedHost::place() const
{
    return QPlcUnderlyingProtocol::fromString(
        QStringLiteral("sim://%1:%2").arg(m_host->address().toString()).arg(QPlcUnderlyingProtocol::DefaultPort));
}

void QPlcSimulatedHost::startProgram(const std::type_info &type, const std::function<std::shared_ptr<void>()> &make)
{
    m_type = &type;
    m_host->start([&] {
        std::shared_ptr<void> program = make();
        m_program = program.get();
        return program;
    });
}

void *QPlcSimulatedHost::programOf(const std::type_info &type) const
{
    if (m_program && *m_type != type)
        qFatal("QPlcSimulatedHost: the program of host '%s' is a %s and no %s; ask for program<%s>()",
               qPrintable(name()), nameOf(*m_type).constData(), nameOf(type).constData(), nameOf(*m_type).constData());
    return m_program;
}

void QPlcSimulatedHost::call(const std::function<void()> &code)
{
    m_host->call(code);
}

void QPlcSimulatedHost::startThread(const std::function<void()> &code)
{
    if (!isRunning())
        qFatal("QPlcSimulatedHost::startThread(): no program runs on host '%s'; call start() before",
               qPrintable(name()));
    m_host->startThread(code);
}

void QPlcSimulatedHost::kill(End end)
{
    m_host->kill(end == Power ? qplc::SimulatedHost::End::Power : qplc::SimulatedHost::End::Program);
    m_program = nullptr;
}

void QPlcSimulatedHost::setStopped(bool stopped)
{
    m_host->setStopped(stopped);
}

void QPlcSimulatedHost::setClock(std::chrono::nanoseconds offset, double drift)
{
    if (isRunning())
        qFatal("QPlcSimulatedHost::setClock(): the program of host '%s' runs already; call setClock() before start()",
               qPrintable(name()));
    qplc::SimulatedHost::Clocks clocks = m_host->clocks();
    clocks.offset = offset.count();
    clocks.drift = std::int64_t(drift * 1000.0);
    m_host->setClocks(clocks);
}

void QPlcSimulatedHost::stepWallClock(std::chrono::nanoseconds step)
{
    qplc::SimulatedHost::Clocks clocks = m_host->clocks();
    clocks.wallOffset += step.count();
    m_host->setClocks(clocks);
}
