// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ChannelMap.h"
#include "QPlcIOBufferSlaveNode.h"
#include "QPlcQuality.h"
#include "gui/store/SignalStore.h"
#include "node/cycle/ListeningInterval.h"

#include <QtCore/QByteArray>

#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace qplc {

/// Values of one plant: the newest of all signals, the batch since the last view, and the past in a
/// SignalStore.
///
/// Row times are [ns] since 1970: the wall clock at the first row of a phase, and from there on
/// whole periods, also over a lost connection. A phase whose time ran ahead of the wall clock
/// (Lockstep) pushes the begin of the next one. Knows no clock and no connection: it is told the
/// time.
class PlantValues
{
public:
    using Time = std::int64_t;  // [ns]

    /// What a row of the store takes [byte].
    static constexpr std::int64_t bytesOfRow(int channels) { return 9 + std::int64_t(channels) * 13 / 3; }

    struct Budget
    {
        Time history = 600'000'000'000;           // [ns] that the store keeps...
        std::int64_t memory = 150 * 1024 * 1024;  // [byte] ...in at most so much
    };

    /// Begins anew for a table; the past goes. \param period  > 0 [ns]
    void setTable(const QPlcSignalTable &table, Time period, Budget budget);
    void setTable(const QPlcSignalTable &table, Time period) { setTable(table, period, Budget()); }
    const QPlcSignalTable &table() const { return m_table; }
    const ChannelMap &channels() const { return m_channels; }
    /// Null before the first table. Another one from setTable() on, and from a frame on whose
    /// period is much shorter.
    SignalStore *store() const { return m_store.get(); }
    std::shared_ptr<const SignalStore> sharedStore() const { return m_store; }

    /// What a master tells of the phase that runs.
    struct Phase
    {
        quint64 session = 0;  // of the master; 0: it has not told it
        Time cycleZero = 0;   // UTC of cycle 0 [ns]; 0: the phase is not timed

        bool isTimed() const { return session != 0 && cycleZero != 0; }
        bool operator==(const Phase &other) const { return session == other.session && cycleZero == other.cycleZero; }
    };
    /// The master tells which phase runs.
    void setPhase(const Phase &phase);
    /// Of the newest frame; not told: it is too new, or has never come.
    const Phase &phase() const { return m_phaseOfFrames; }
    /// The connection was lost: what comes next may be of the same phase, and then its rows go on
    /// at whole periods.
    void rejoin();
    /// Whether the next frame should wait for setPhase(), which tells if its phase is the one of
    /// before.
    bool isPhaseNeeded() const { return m_isRejoining && m_phaseOfFrames.isTimed() && m_toldPhase.session == 0; }
    /// Of the newest frame: another one after each connection and begin of a phase.
    quint64 run() const { return m_phase; }

    /// Forgets the last batch.
    void beginBatch();
    /// Takes the values of one cycle. \param wallTime  now, since 1970
    void storeFrame(const QPlcIOBufferSlaveNode::Frame &frame, Time wallTime);
    /// Takes the values of one cycle whose time somebody else knows. \param payload as ChannelMap
    /// says \param time after that of the row before
    /// \param qualities a byte for each signal; null: nobody told them, and all are good. In the
    ///         store a value that is not good has the kind of its quality as mark, and an invalid
    ///         one is a gap.
    void storeRow(const char *payload, Time time, const char *qualities = nullptr);
    /// Takes a value that came outside of a cycle. Nothing becomes of one that does not fit.
    void storeValue(QPlcSignalIndex signal, const QPlcValue &value, QPlcQuality quality = QPlcQuality::Good);
    /// What comes next does not continue what is there.
    void interrupt();
    /// Where rows of the past belong.
    struct Gap
    {
        Time after = std::numeric_limits<Time>::min();  // of the row before them
        Time before = 0;                                // of the row behind them
        SignalStore::Seam begin = SignalStore::BeginsAnew;
        SignalStore::Seam end = SignalStore::BeginsAnew;
    };
    /// Puts the rows of \a past, which has the same table, in place of those of the store that are
    /// in \a gap. \param history  to keep from now on, if it is more than so far [ns]
    void fill(const Gap &gap, PlantValues past, Time history);

    bool hasValues() const { return m_hasValues; }
    /// The newest value; invalid before the first, or when there is no such signal.
    QPlcValue value(QPlcSignalIndex signal) const;
    /// How far the newest value can be trusted; invalid before the first, or when there is no such
    /// signal.
    QPlcQuality quality(QPlcSignalIndex signal) const;
    /// The newest values, one for each channel of the store, also those that came outside of a
    /// cycle.
    std::vector<float> newestChannels() const;
    /// The values of \a signalIndices in each cycle of the last batch, oldest first.
    QList<QPlcSignalList> batch(const QVector<QPlcSignalIndex> &signalIndices) const;
    int batchSize() const { return m_batchSize; }
    Time period() const { return m_period; }
    /// Time between two rows that follow each other: a listener need not hear every cycle.
    Time rowPeriod() const { return m_period * Time(m_interval.cycles()); }
    quint64 cycle() const { return m_lastCycle; }
    quint64 rows() const { return m_rows; }  // taken, ever
    quint64 gaps() const { return m_gaps; }  // frames within a phase before which others were lost, ever
    /// Cycles of one phase that were not heard, between two that were.
    struct Hole
    {
        quint64 run = 0;    // of both
        quint64 cycle = 0;  // before it
        Time after = 0;     // of the row of this cycle
        Time before = 0;    // of the row behind it
    };
    /// The holes since the last call that take LeastHole or longer, at most MostHoles of them.
    std::vector<Hole> takeHoles() { return std::exchange(m_holes, {}); }
    static constexpr Time LeastHole = SignalStore::Second;
    static constexpr std::size_t MostHoles = 16;

private:
    struct Doubt
    {
        int channel;
        QPlcQuality::Kind kind;
    };

    void storeQualities(const char *qualities);
    QPlcValue valueIn(const char *payload, QPlcSignalIndex signal) const;
    int wantedRows() const;
    void makeStore();
    void beginPhase(const QPlcIOBufferSlaveNode::Frame &frame, Time wallTime);
    bool goesOn(const QPlcIOBufferSlaveNode::Frame &frame) const;
    bool isLeftOver(const QPlcIOBufferSlaveNode::Frame &frame) const;
    void noteHole(quint64 cycle);

    Budget m_budget;
    QPlcSignalTable m_table;
    ChannelMap m_channels;
    std::shared_ptr<SignalStore> m_store;
    std::vector<float> m_row;
    std::vector<Doubt> m_doubts;  // of m_row: values that are not good
    std::vector<char> m_newest;
    std::vector<char> m_qualities;  // of m_newest, a byte for each signal
    bool m_hasValues = false;
    std::vector<char> m_batch;  // payloads, one behind the other
    int m_batchSize = 0;

    Time m_period = 1;
    ListeningInterval m_interval;
    Time m_phaseStart = 0;
    Time m_lastTime = 0;
    Phase m_toldPhase;
    Phase m_phaseOfFrames;
    bool m_isRejoining = false;
    quint64 m_phase = 0;
    quint64 m_phaseWhenTold = 0;
    quint64 m_lastCycle = 0;
    bool m_isContinued = false;
    quint64 m_rows = 0;
    quint64 m_gaps = 0;
    std::vector<Hole> m_holes;
};

}  // namespace qplc
