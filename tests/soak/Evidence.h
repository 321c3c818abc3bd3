// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "History.h"
#include "NemesisPlan.h"

#include <functional>

namespace soak {

/// Times at which the machine did not let run what was ready to.
class Stalls
{
public:
    Stalls() = default;
    explicit Stalls(const History &runner);
    /// [ns] of the time from \a begin to \a end that the machine stood still.
    qint64 within(qint64 begin, qint64 end) const;
    std::size_t count() const { return m_spans.size(); }
    /// Of all the time that \a runner has records of [0 ... 1].
    double shareOf(const History &runner) const;

private:
    struct Span
    {
        qint64 begin, end;
    };
    std::vector<Span> m_spans;  // apart from each other, in order
};

/// A fault as it was done.
struct DoneFault
{
    FaultKind kind = FaultKind::KillNode;
    int node = -1;
    qint64 begin = 0;      // [ns]
    qint64 effect = 0;     // from here on it can be seen: a killed process is gone
    qint64 end = 0;        // its cause is gone; when it never went: begin of the next one
    qint64 recovered = 0;  // the whole plant runs again; when it never did: the end of the run
    qint64 amount = 0;     // what was really done
    quint64 seed = 0;
    bool isAlone = true;  // the plant had recovered before it, and recovered after it: what it did can be told apart

    bool isOfMaster() const { return soak::isOfMaster(kind); }
};

/// All that is known of a run: what its processes have written down, and nothing else.
struct Evidence
{
    PlantShape shape;
    qint64 period = 10'000'000;  // [ns]
    bool hasManifest = false;    // which needs all nodes
    History runner;
    std::vector<History> nodes;    // one for each life, in the order of lives
    std::vector<History> masters;  // likewise
    Stalls stalls;
    std::vector<DoneFault> faults;

    /// Reads all histories of a folder. \return false when one of them does not read: \a error has
    /// the sentence
    static bool read(const QString &folder, const Profile &profile, Evidence *evidence, QString *error);
    /// Puts all records in the order of their times, and derives stalls and faults from the history
    /// of the runner. \pre all histories are there
    void complete();

    /// The master that ran at \a time; null: none.
    const History *masterAt(qint64 time) const;
    const History *lifeOf(int node, quint32 life) const;
    /// Whether a fault explains what happened at \a time to \a node (-1: to the plant as a whole).
    bool isExplained(qint64 time, int node) const;
};

/// Follows the states of a master from its first record on.
class PhaseBegins
{
public:
    /// Whether cycles of a new phase begin with the next \a record.
    bool isOne(const Record &record);

private:
    quint64 m_state = Record::Off;
};

/// The first record of \a history at \a time or later. \pre its records are in order, as complete()
/// leaves them
std::vector<Record>::const_iterator firstFrom(const History &history, qint64 time);
/// Of \a history, the records of one kind between two times.
std::vector<const Record *> recordsOf(const History &history, Record::Kind kind, int subject, qint64 begin, qint64 end);

}  // namespace soak
