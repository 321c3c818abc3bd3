// SPDX-License-Identifier: Apache-2.0
#include "QPlcSimulatedHost.h"

#include "SimulatedHost.h"

QPlcSimulatedHost::QPlcSimulatedHost(QPlcSimulator &simulator, const QString &name)
    : m_host(std::make_unique<qplc::SimulatedHost>(simulator.m_simulator, name,
                                                   QHostAddress(0x7F000101 + quint32(simulator.m_hosts++))))
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

void QPlcSimulatedHost::startProgram(const std::function<std::shared_ptr<void>()> &make)
{
    m_host->start([&] {
        std::shared_ptr<void> program = make();
        m_program = program.get();
        return program;
    });
}

void QPlcSimulatedHost::call(const std::function<void()> &code)
{
    m_host->call(code);
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
