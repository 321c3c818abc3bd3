// SPDX-License-Identifier: Apache-2.0
#include "BudgetNodes.h"

#include <cstdlib>
#include <mutex>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

constexpr std::size_t Page = 4096;                // [byte]
constexpr std::size_t PlantedPages = 64U << 20U;  // [byte] of addresses, of which a page a cycle is touched

QByteArray signalName(const char *direction, int slave, int number)
{
    return direction + QByteArray::number(slave) + '.' + QByteArray::number(number);
}

}  // namespace

QPlcSignalTable budgetTable(int slaves)
{
    QByteArray ini;
    for (int slave = 0; slave < slaves; ++slave) {
        for (int i = 0; i < BudgetRun::Inputs; ++i)
            ini += '[' + signalName("in", slave, i) + "]\ntype = Real32\n";
        for (int i = 0; i < BudgetRun::Outputs; ++i)
            ini += '[' + signalName("out", slave, i) + "]\ntype = Real32\n";
    }
    return QPlcSignalTable::fromIni(ini);
}

// ---- slave ----

BudgetSlave::BudgetSlave(const BudgetRun &run, int index)
    : QPlcCompactSlaveNode(QStringLiteral("Slave%1").arg(index), SilentZeroOrderHold)
    , m_plant(run.plant)
    , m_costs(run.cycles)
{
    for (int i = 0; i < BudgetRun::Inputs; ++i)
        m_in.emplace_back(this, signalName("in", index, i).constData());
    for (int i = 0; i < BudgetRun::Outputs; ++i)
        m_out.emplace_back(this, signalName("out", index, i).constData());
    if (m_plant == QLatin1String("page-fault")) {
        void *pages
            = ::mmap(nullptr, PlantedPages, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
        ::madvise(pages, PlantedPages, MADV_NOHUGEPAGE);
        m_pages = static_cast<char *>(pages);
    }
}

void BudgetSlave::step(const QPlcCycle &cycle)
{
    m_costs.take(cycle.number());
    for (std::size_t k = 0; k < m_out.size(); ++k)
        m_out[k] = m_in[k % m_in.size()] + float(k);
    if (!m_plant.isEmpty())
        plant(cycle.number());
}

/// One of what the cyclic path must not cost.
void BudgetSlave::plant(quint64 cycle)
{
    static std::mutex mutex;
    if (m_plant == QLatin1String("allocation")) {
        void *volatile memory = std::malloc(8);
        std::free(memory);
    } else if (m_plant == QLatin1String("lock")) {
        const std::lock_guard<std::mutex> lock(mutex);
    } else if (m_plant == QLatin1String("system-call")) {
        ::syscall(SYS_getppid);
    } else if (m_plant == QLatin1String("instructions")) {
        for (int i = 0; i < 1000; ++i)
            m_sink = m_sink + 1;
    } else if (m_pages) {
        m_pages[cycle * Page % PlantedPages] = 1;
    }
}

// ---- probe ----

BudgetProbe::BudgetProbe(const BudgetRun &run)
    : QPlcCompactSlaveNode(QStringLiteral("Probe"), SilentZeroOrderHold)
    , m_costs(run.cycles)
{
    for (int slave = 0; slave < run.slaves; ++slave) {
        for (int i = 0; i < BudgetRun::Inputs; ++i)
            m_requests.emplace_back(this, signalName("in", slave, i).constData());
    }
}

void BudgetProbe::step(const QPlcCycle &cycle)
{
    m_costs.take(cycle.number());
    float value = float(cycle.number() & 1023);
    for (QPlcOutput<float> &request : m_requests)
        request = value += 0.5F;
}
