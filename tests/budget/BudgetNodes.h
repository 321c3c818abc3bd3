// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CycleCosts.h"

#include <deque>

/// What a run of budget_cycles is about.
struct BudgetRun
{
    QString transport = QStringLiteral("udp");  // udp, tcp, local, inprocess, steps
    int slaves = 1;
    quint64 cycles = 1000;
    int periodUs = 0;  // 0: lockstep
    QString
        // a cost that the check has to find: allocation, lock, page-fault, system-call,
        // instructions; empty: none
        plant;

    static constexpr int Inputs = 3;  // Real32, master -> slave
    static constexpr int Outputs = 32;
};

/// The signals of all slaves: "in7.2" is the third input of slave 7.
QPlcSignalTable budgetTable(int slaves);

/// A slave with 3 inputs and 32 outputs of type Real32, which watches what its cycle thread costs.
class BudgetSlave : public QPlcCompactSlaveNode
{
public:
    BudgetSlave(const BudgetRun &run, int index);
    QJsonObject costs() const { return m_costs.toJson(); }

private:
    void step(const QPlcCycle &cycle) override;
    void plant(quint64 cycle);

    const QString m_plant;
    CycleCosts m_costs;
    std::deque<QPlcInput<float>> m_in;
    std::deque<QPlcOutput<float>> m_out;
    char *m_pages = nullptr;
    volatile quint64 m_sink = 0;
};

/// Lives in the process of the master: writes new inputs for all slaves in each cycle, and watches
/// what the cycle thread of the master costs.
class BudgetProbe : public QPlcCompactSlaveNode
{
public:
    explicit BudgetProbe(const BudgetRun &run);
    QJsonObject costs() const { return m_costs.toJson(); }

private:
    void step(const QPlcCycle &cycle) override;

    CycleCosts m_costs;
    std::deque<QPlcOutput<float>> m_requests;
};
