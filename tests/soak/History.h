// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <cstdint>
#include <vector>

namespace soak {

/// What one process has seen and done, in a file that it alone appends to. A process that is killed
/// loses nothing that append() has returned from.
struct Record
{
    enum Kind : quint16 {
        // of a node; subject: its number
        Born = 1,  // numbers: see BornNumber
        Reset,     // initial outputs. numbers: see StepNumber, what is written only
        Phase,     // the real-time phase has begun
        Step,      // numbers: see StepNumber
        Safe,      // the node itself went to its safe state. numbers: see SafeNumber
        PhaseEnded,
        MasterLost,
        KeptOut,  // an attempt to connect has failed, or the connection
        // of a master; subject: a node, or Nobody
        Cycle = 100,  // numbers: see CycleNumber
        State,        // numbers: a MasterState
        Registered,
        Lost,
        Refused,
        Late,
        Error,         // numbers: error
        Counters,      // of the master. numbers: see MasterNumber
        NodeCounters,  // numbers: see NodeNumber
        Heap,          // numbers: see HeapNumber
        // of the runner; subject: a node, or Nobody
        Started = 200,  // a process of the plant. numbers: process, life
        FaultBegins,    // numbers: kind, amount, seed
        FaultEnds,      // numbers: kind, amount that was really done
        Command,        // of the operator: the plant may move. numbers: life of the master
        Recovered,      // the whole plant runs again
        Attempts,       // to do what is forbidden, so far. numbers: see AttemptNumber
        Usage,          // of a process. numbers: see UsageNumber
        Stall,          // the machine did not let a thread run that was ready. numbers: begin [ns]; time: end
        Gone,     // a process of the plant that was killed is gone: the kernel takes its time where it waits for a disk
        Evicted,  // a node: the master has said so
        Admitted,  // a node: the operator is about to let it in again
        Tried      // the operator told a plant to begin that lacks a node. numbers: see TryNumber
    };
    enum MasterState { Off, Initializing, Ready, RealTime, WaitingForLateSlaves, SafeStop, Fault, UnknownState };
    /// The edition of its safety parameters.
    enum BornNumber { ProcessNumber, Edition };
    enum StepNumber {
        Missed,
        WrittenCounter,
        WrittenCheck,
        SeenLife,
        SeenCounter,
        SeenCheck,
        ComputedCheck,
        Drive,
        Quality
    };
    enum CycleNumber { CyclePhase };  // of the same count as MasterPhase and NodePhase
    enum MasterNumber {
        MasterPhase,
        Cycles,
        Skipped,
        Strangers,
        LateAnswers,
        Overruns,
        Incomplete,
        FailedHandshakes,
        DeniedMessages
    };
    /// Connections of strangers, and messages of who may not send them.
    enum AttemptNumber { Made, Ended, Commands, Denials };
    /// [byte] of the heap that the program has taken and not given back, that the heap has from the
    /// system, and that are free at its end.
    enum HeapNumber { HeapInUse, HeapTaken, HeapTop };
    enum NodeNumber { NodePhase, Answers, NodeLate, AnswersLost, Duplicated, Reordered, Rejected, Resent };
    /// Wanted: the phase ended. Ordered: the master stops safely.
    enum SafeNumber { SafeDriveBits, IsWanted, IsOrdered, SafeLimitBits };
    enum TryNumber { IsRefused, IsNamed };
    enum UsageNumber { Descriptors, Threads, ResidentKb, UsageLife, IsCompared };
    static constexpr quint64 NoQuality = 255;  // of a plant without qualities
    static constexpr quint16 Nobody = 0xffff;
    static constexpr int Numbers = 9;

    quint16 kind = 0;
    quint16 subject = Nobody;
    quint32 thread = 0;
    qint64 time = 0;    // [ns] of the monotonic clock, which is one for all processes of the machine
    qint64 waited = 0;  // [ns] that this thread was ready to run and did not
    quint64 cycle = 0;
    quint64 numbers[Numbers] = {};
    quint64 check = 0;
};

class History
{
public:
    QString name;  // "node3-life2"
    quint32 life = 0;
    int node = -1;  // -1: not of a node
    std::vector<Record> records;
    bool isTorn = false;  // its last record was cut

    /// \return false when there is no such file, or a record in it is not what was written: \a
    ///         error has the sentence
    static bool read(const QString &fileName, History *history, QString *error);
};

/// Appends to a history. Threads of a process may share the writer.
class HistoryWriter
{
public:
    HistoryWriter() = default;
    virtual ~HistoryWriter();
    HistoryWriter(const HistoryWriter &) = delete;
    HistoryWriter &operator=(const HistoryWriter &) = delete;

    /// Adds time, thread and check to \a record. \threadsafe yes
    virtual void append(Record record) noexcept = 0;
    void append(Record::Kind kind, int subject, std::initializer_list<quint64> numbers = {},
                quint64 cycle = 0) noexcept;
};

/// A history in a file. A record is one write(): who is killed leaves whole records.
class HistoryFile final : public HistoryWriter
{
public:
    ~HistoryFile() override;

    bool open(const QString &fileName, QString *error);
    using HistoryWriter::append;
    /// Allocates nothing after the first call of a thread.
    void append(Record record) noexcept override;

private:
    int m_file = -1;
};

Record makeRecord(Record::Kind kind, int subject, std::initializer_list<quint64> numbers, quint64 cycle = 0) noexcept;
quint64 checkOf(const Record &record) noexcept;
qint64 monotonicNow() noexcept;
quint64 bitsOf(double number) noexcept;
double fromBits(quint64 bits) noexcept;

}  // namespace soak
