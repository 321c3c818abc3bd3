// SPDX-License-Identifier: Apache-2.0
#include "Evidence.h"

#include <QtCore/QDir>

#include <algorithm>
#include <limits>
#include <utility>

namespace soak {

namespace {

/// Threads of a process share its history, and may have overtaken each other on their way to it.
void sortByTime(History *history)
{
    const auto isBefore = [](const Record &a, const Record &b) { return a.time < b.time; };
    if (!std::is_sorted(history->records.begin(), history->records.end(), isBefore))
        std::stable_sort(history->records.begin(), history->records.end(), isBefore);
}

}  // namespace

Stalls::Stalls(const History &runner)
{
    std::vector<Span> spans;
    for (const Record &record : runner.records) {
        if (record.kind == Record::Stall)
            spans.push_back({qint64(record.numbers[0]), record.time});
    }
    std::sort(spans.begin(), spans.end(), [](const Span &a, const Span &b) { return a.begin < b.begin; });
    for (const Span &span : spans) {
        if (!m_spans.empty() && span.begin <= m_spans.back().end)
            m_spans.back().end = std::max(m_spans.back().end, span.end);
        else
            m_spans.push_back(span);
    }
}

qint64 Stalls::within(qint64 begin, qint64 end) const
{
    qint64 sum = 0;
    const auto isBefore = [](const Span &span, qint64 time) { return span.end < time; };
    auto span = std::lower_bound(m_spans.begin(), m_spans.end(), begin, isBefore);
    for (; span != m_spans.end() && span->begin < end; ++span)
        sum += std::min(end, span->end) - std::max(begin, span->begin);
    return sum;
}

double Stalls::shareOf(const History &runner) const
{
    if (runner.records.empty())
        return 0.0;
    const qint64 begin = runner.records.front().time;
    const qint64 end = runner.records.back().time;
    return end > begin ? double(within(begin, end)) / double(end - begin) : 0.0;
}

bool PhaseBegins::isOne(const Record &record)
{
    if (record.kind != Record::State)
        return false;
    const quint64 before = std::exchange(m_state, record.numbers[0]);
    return m_state == Record::RealTime && before != Record::WaitingForLateSlaves;
}

bool Evidence::read(const QString &folder, const Profile &profile, Evidence *evidence, QString *error)
{
    evidence->shape = profile.shape;
    evidence->period = profile.periodUs * 1000;
    evidence->hasManifest = profile.hasManifest;
    const QStringList names = QDir(folder).entryList({QStringLiteral("*.history")}, QDir::Files);
    for (const QString &name : names) {
        History history;
        if (!History::read(QDir(folder).filePath(name), &history, error))
            return false;
        history.name = name.section(QLatin1Char('.'), 0, 0);
        history.life = history.name.section(QLatin1String("-life"), 1).toUInt();
        history.node = nodeNumber(history.name.section(QLatin1Char('-'), 0, 0));
        if (history.node >= 0)
            evidence->nodes.push_back(std::move(history));
        else if (history.name.startsWith(QLatin1String("Master")))
            evidence->masters.push_back(std::move(history));
        else
            evidence->runner = std::move(history);
    }
    evidence->complete();
    return true;
}

void Evidence::complete()
{
    const auto byLife = [](const History &a, const History &b) { return a.life < b.life; };
    std::stable_sort(nodes.begin(), nodes.end(), byLife);
    std::stable_sort(masters.begin(), masters.end(), byLife);
    for (std::vector<History> *histories : {&nodes, &masters}) {
        for (History &history : *histories)
            sortByTime(&history);
    }
    sortByTime(&runner);
    stalls = Stalls(runner);
    faults.clear();
    for (const Record &record : runner.records) {
        switch (record.kind) {
        case Record::FaultBegins: {
            DoneFault fault;
            fault.kind = FaultKind(record.numbers[0]);
            fault.node = record.subject == Record::Nobody ? -1 : record.subject;
            fault.begin = fault.effect = record.time;
            fault.seed = record.numbers[2];
            fault.isAlone = record.numbers[3] == 0;
            fault.end = fault.recovered = std::numeric_limits<qint64>::max();
            faults.push_back(fault);
            break;
        }
        case Record::Gone:
            if (!faults.empty() && faults.back().kind == FaultKind::KillNode && faults.back().node == record.subject
                && faults.back().effect == faults.back().begin)
                faults.back().effect = record.time;
            break;
        case Record::FaultEnds:
            if (!faults.empty()) {
                faults.back().end = record.time;
                faults.back().amount = qint64(record.numbers[1]);
            }
            break;
        case Record::Recovered:
            for (auto fault = faults.rbegin(); fault != faults.rend() && fault->recovered > record.time; ++fault) {
                fault->recovered = record.time;
                if (!fault->isAlone)  // its cause may have ended after the begin of the next one
                    fault->end = record.time;
            }
            break;
        default:
            break;
        }
    }
}

const History *Evidence::masterAt(qint64 time) const
{
    const History *found = nullptr;
    for (const History &master : masters) {
        if (!master.records.empty() && master.records.front().time <= time)
            found = &master;
    }
    return found;
}

const History *Evidence::lifeOf(int node, quint32 life) const
{
    const auto isIt = [&](const History &history) { return history.node == node && history.life == life; };
    const auto found = std::find_if(nodes.begin(), nodes.end(), isIt);
    return found == nodes.end() ? nullptr : &*found;
}

bool Evidence::isExplained(qint64 time, int node) const
{
    return std::any_of(faults.begin(), faults.end(), [&](const DoneFault &fault) {
        return fault.begin <= time && time <= fault.recovered
            && (concernsAll(fault.kind) || fault.node == node || node < 0);
    });
}

std::vector<Record>::const_iterator firstFrom(const History &history, qint64 time)
{
    const auto isBefore = [](const Record &record, qint64 begin) { return record.time < begin; };
    return std::lower_bound(history.records.begin(), history.records.end(), time, isBefore);
}

std::vector<const Record *> recordsOf(const History &history, Record::Kind kind, int subject, qint64 begin, qint64 end)
{
    const quint16 wanted = subject < 0 ? Record::Nobody : quint16(subject);
    std::vector<const Record *> found;
    for (auto record = firstFrom(history, begin); record != history.records.end() && record->time <= end; ++record) {
        if (record->kind == kind && record->subject == wanted)
            found.push_back(&*record);
    }
    return found;
}

}  // namespace soak
