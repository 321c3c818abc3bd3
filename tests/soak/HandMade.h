// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Gates.h"

/// Histories of a plant of three nodes that runs as it should, for tests that spoil them. Period 10
/// ms, hold 3; the operator starts at 1 s, cycle k is at 2 s + k x 10 ms.
class HandMade
{
public:
    static constexpr qint64 Millisecond = 1'000'000;
    static constexpr qint64 Period = 10 * Millisecond;
    static constexpr qint64 Begin = 2000 * Millisecond;
    static qint64 at(quint64 cycle) { return Begin + qint64(cycle) * Period; }

    explicit HandMade(int cycles = 100)
    {
        evidence.shape = {3, 100, 3};
        evidence.period = Period;
        evidence.masters.resize(1);
        evidence.masters[0].name = "Master-life1";
        evidence.masters[0].life = 1;
        add(master(), soak::Record::Born, -1, 500 * Millisecond);
        for (int node = 0; node < 3; ++node) {
            addLife(node, 1);
            add(master(), soak::Record::Registered, node, 600 * Millisecond);
        }
        add(runner(), soak::Record::Command, -1, 1000 * Millisecond);
        setState(soak::Record::RealTime, 1900 * Millisecond);
        for (int cycle = 0; cycle < cycles; ++cycle) {
            add(master(), soak::Record::Cycle, -1, at(quint64(cycle)), {1}, quint64(cycle));
            for (int node = 0; node < 3; ++node)
                addStep(node, quint64(cycle));
        }
        m_end = at(quint64(cycles));
        addCounters(quint64(cycles), 0);
        setState(soak::Record::Off, m_end + Millisecond);
    }

    soak::Evidence evidence;

    soak::History &master() { return evidence.masters.back(); }
    soak::History &runner() { return evidence.runner; }
    soak::History &node(int number)
    {
        const auto found = std::find_if(evidence.nodes.rbegin(), evidence.nodes.rend(),
                                        [&](const soak::History &history) { return history.node == number; });
        return *found;
    }
    qint64 end() const { return m_end; }

    static soak::Record &add(soak::History &history, soak::Record::Kind kind, int subject, qint64 time,
                             std::initializer_list<quint64> numbers = {}, quint64 cycle = 0)
    {
        soak::Record record = soak::makeRecord(kind, subject, numbers, cycle);
        record.time = time;
        record.thread = 1;
        history.records.push_back(record);
        return history.records.back();
    }
    /// A process of a node that begins its phase with the number 1 of its counter.
    void addLife(int number, quint32 life, qint64 time = 1800 * Millisecond)
    {
        soak::History history;
        history.node = number;
        history.life = life;
        history.name = QString("Node%1-life%2").arg(number).arg(life);
        evidence.nodes.push_back(history);
        add(evidence.nodes.back(), soak::Record::Reset, number, time, {0, 1, stampOf(number, life, 1).check});
        add(evidence.nodes.back(), soak::Record::Phase, number, time + Millisecond);
    }
    static soak::Stamp stampOf(int number, quint32 life, quint32 counter)
    {
        return {life, counter, soak::rawValue(number, life, counter, 0)};
    }
    /// The step of cycle k writes the number k + 2, and sees what the last one wrote.
    soak::Record &addStep(int number, quint64 cycle, quint64 quality = soak::Record::NoQuality)
    {
        const quint32 life = node(number).life;
        const soak::Stamp written = stampOf(number, life, quint32(cycle + 2));
        const soak::Stamp seen = stampOf((number + 2) % 3, 1, quint32(cycle + 1));
        return add(node(number), soak::Record::Step, number, at(cycle) + Millisecond,
                   {0, written.counter, written.check, seen.life, seen.counter, seen.check, seen.check,
                    soak::bitsOf(0.5), quality},
                   cycle);
    }
    soak::Record &step(int number, quint64 cycle)
    {
        soak::History &history = node(number);
        const auto found
            = std::find_if(history.records.begin(), history.records.end(), [&](const soak::Record &record) {
                  return record.kind == soak::Record::Step && record.cycle == cycle;
              });
        return *found;
    }
    void setState(soak::Record::MasterState state, qint64 time, quint64 cycle = 0)
    {
        add(master(), soak::Record::State, -1, time, {quint64(state)}, cycle);
    }
    void addCounters(quint64 cycles, quint64 skipped, quint64 strangers = 0, qint64 time = 0)
    {
        add(master(), soak::Record::Counters, -1, time > 0 ? time : m_end, {1, cycles, skipped, strangers});
    }
    /// A fault from \a begin to \a end; the plant runs again 0.1 s later.
    void addFault(soak::FaultKind kind, int number, qint64 begin, qint64 end, quint64 amount = 1)
    {
        add(runner(), soak::Record::FaultBegins, number, begin, {quint64(kind), amount});
        add(runner(), soak::Record::FaultEnds, number, end, {quint64(kind), amount});
        add(runner(), soak::Record::Recovered, -1, end + 100 * Millisecond);
    }
    /// Takes records of a history away.
    template<typename Predicate>
    static void remove(soak::History &history, Predicate predicate)
    {
        history.records.erase(std::remove_if(history.records.begin(), history.records.end(), predicate),
                              history.records.end());
    }
    /// Nothing of \a history from cycle \a first to cycle \a last.
    static void removeCycles(soak::History &history, quint64 first, quint64 last)
    {
        remove(history, [=](const soak::Record &record) {
            const bool isOfCycle = record.kind == soak::Record::Step || record.kind == soak::Record::Cycle;
            return isOfCycle && record.cycle >= first && record.cycle <= last;
        });
    }
    template<typename Judge>
    soak::Gate judge(Judge gate)
    {
        add(runner(), soak::Record::Recovered, -1, m_end + 500 * Millisecond);
        const auto byTime = [](const soak::Record &a, const soak::Record &b) { return a.time < b.time; };
        for (soak::History &history : evidence.nodes)
            std::stable_sort(history.records.begin(), history.records.end(), byTime);
        for (soak::History &history : evidence.masters)
            std::stable_sort(history.records.begin(), history.records.end(), byTime);
        std::stable_sort(runner().records.begin(), runner().records.end(), byTime);
        evidence.complete();
        return gate(evidence);
    }

private:
    qint64 m_end = 0;
};

/// What a test says when a gate is not as it should be.
inline QByteArray textOf(const soak::Gate &gate)
{
    return QString("looked %1, failed %2, excused %3: %4")
        .arg(gate.looked)
        .arg(gate.failed)
        .arg(gate.excused)
        .arg(gate.examples.join("; "))
        .toUtf8();
}
