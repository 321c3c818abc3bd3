// SPDX-License-Identifier: Apache-2.0
#include "Gates.h"

namespace soak {

namespace {

Stamp seenIn(const Record &step)
{
    return {quint32(step.numbers[Record::SeenLife]), quint32(step.numbers[Record::SeenCounter]),
            step.numbers[Record::SeenCheck]};
}

int writerRead(const Evidence &evidence, int node)
{
    return (node + evidence.shape.nodes - 1) % evidence.shape.nodes;
}

/// All values 0, the drive too, or safe: what is seen when nobody has written, or when all went
/// safe.
bool isNothing(const Evidence &evidence, int writer, const Record &step)
{
    const Stamp seen = seenIn(step);
    if (seen.life != 0 || seen.counter != 0 || seen.check != 0)
        return false;
    const quint64 check = step.numbers[Record::ComputedCheck];
    return check == checkOfNothing(evidence.shape, writer, 0.0)
        || check == checkOfNothing(evidence.shape, writer, SafeDrive);
}

QString placeOf(const History &history, const Record &record)
{
    return QStringLiteral("%1, cycle %2").arg(history.name).arg(record.cycle);
}

/// The checks that a life has written, by its counter.
std::vector<quint64> writtenBy(const History &history)
{
    std::vector<quint64> checks;
    for (const Record &record : history.records) {
        if (record.kind != Record::Reset && record.kind != Record::Step)
            continue;
        const std::size_t counter = std::size_t(record.numbers[Record::WrittenCounter]);
        checks.resize(std::max(checks.size(), counter + 1));
        checks[counter] = record.numbers[Record::WrittenCheck];
    }
    return checks;
}

}  // namespace

void Gate::fail(const QString &text)
{
    constexpr int mostExamples = 5;
    ++failed;
    if (examples.size() < mostExamples)
        examples << text;
}

void Gate::largest(const QString &figure, double value)
{
    figures[figure] = std::max(value, figures.value(figure, value));
}

Gate valuesAreWhole(const Evidence &evidence)
{
    Gate gate("values are whole");
    for (const History &history : evidence.nodes) {
        const int writer = writerRead(evidence, history.node);
        for (const Record &record : history.records) {
            if (record.kind != Record::Step)
                continue;
            ++gate.looked;
            if (record.numbers[Record::SeenCheck] != record.numbers[Record::ComputedCheck]
                && !isNothing(evidence, writer, record))
                gate.fail(QStringLiteral("%1: wrong or mixed values of %2 (life %3, counter %4)")
                              .arg(placeOf(history, record), nodeName(writer))
                              .arg(record.numbers[Record::SeenLife])
                              .arg(record.numbers[Record::SeenCounter]));
        }
    }
    return gate;
}

Gate valuesWereWritten(const Evidence &evidence)
{
    Gate gate("values were written so");
    QMap<QPair<int, quint32>, std::vector<quint64>> written;
    for (const History &history : evidence.nodes)
        written.insert({history.node, history.life}, writtenBy(history));
    for (const History &history : evidence.nodes) {
        const int writer = writerRead(evidence, history.node);
        for (const Record &record : history.records) {
            if (record.kind != Record::Step || isNothing(evidence, writer, record))
                continue;
            ++gate.looked;
            const Stamp seen = seenIn(record);
            const auto life = written.constFind({writer, seen.life});
            if (life == written.constEnd() || seen.counter >= life->size() || (*life)[seen.counter] != seen.check)
                gate.fail(QStringLiteral("%1: %2 says nothing of having written this (life %3, counter %4)")
                              .arg(placeOf(history, record), nodeName(writer))
                              .arg(seen.life)
                              .arg(seen.counter));
        }
    }
    return gate;
}

Gate valuesNeverGoBack(const Evidence &evidence)
{
    Gate gate("values never go back");
    std::vector<Stamp> newest(std::size_t(evidence.shape.nodes));  // over all lives of a reader
    for (const History &history : evidence.nodes) {
        Stamp &last = newest[std::size_t(history.node)];
        bool isPhaseNew = true;  // in a new phase there may be nothing at first
        for (const Record &record : history.records) {
            isPhaseNew = isPhaseNew || record.kind == Record::Phase;
            if (record.kind != Record::Step)
                continue;
            ++gate.looked;
            const Stamp seen = seenIn(record);
            const bool isSafe
                = fromBits(record.numbers[Record::Drive]) == SafeDrive;  // of a writer that went safe itself
            if (seen.life == 0 && (isPhaseNew || isSafe))
                continue;
            isPhaseNew = false;
            if (last.isNewerThan(seen))
                gate.fail(QStringLiteral("%1: life %2, counter %3 after life %4, counter %5")
                              .arg(placeOf(history, record))
                              .arg(seen.life)
                              .arg(seen.counter)
                              .arg(last.life)
                              .arg(last.counter));
            else
                last = seen;
        }
    }
    return gate;
}

Gate stepsComeOnce(const Evidence &evidence)
{
    Gate gate("steps come once");
    for (const History &history : evidence.nodes) {
        const Record *last = nullptr;
        for (const Record &record : history.records) {
            if (record.kind == Record::Phase)
                last = nullptr;
            if (record.kind != Record::Step)
                continue;
            ++gate.looked;
            const quint64 missed = record.numbers[Record::Missed];
            if (last && record.cycle != last->cycle + 1 + missed)
                gate.fail(QStringLiteral("%1 follows cycle %2, and %3 are told as missed")
                              .arg(placeOf(history, record))
                              .arg(last->cycle)
                              .arg(missed));
            gate.figures[QStringLiteral("missed")] += double(missed);
            last = &record;
        }
    }
    return gate;
}

}  // namespace soak
