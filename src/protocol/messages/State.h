// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Field.h"
#include "QPlcMasterStatistics.h"
#include "QPlcMessage.h"
#include "QPlcNodeInfo.h"
#include "QPlcSchedule.h"
#include "Statistics.h"
#include "Vocabulary.h"

/// What a master and its nodes do: docs/protocol.md, section 5.4.
namespace qplc::messages {

/// A registered node, as its master sees it.
template<>
struct Description<QPlcNodeInfo>
{
    using N = QPlcNodeInfo;
    static constexpr auto fields = fieldList(
        field("name", &N::name, Presence::Required), field("id", &N::id), field("inputs", &N::inputs),
        field("outputs", &N::outputs), field("listener", &N::listener), field("critical", &N::critical),
        field("state", &N::state), field("every", &N::every), field("policy", &N::policy),
        field("transport", &N::transport), field("address", &N::address), field("lateAnswers", &N::lateAnswers),
        field("duplicates", &N::duplicates), field("rejected", &N::rejected), field("forged", &N::forged),
        field("resent", &N::resent), field("faults", &N::faultPlan, Presence::WhenSet),
        field("watchdog", &N::watchdog, Presence::WhenSet), field("identity", &N::identity, Presence::WhenSet),
        field("fallback", &N::fallback, Presence::WhenSet));
};

/// A name that Evict keeps out.
struct EvictedEntry
{
    QString name;
    QString by;  // for people, as in the refusals: 'anna'
    Hex64 time;  // [ns] since 1970

    static constexpr auto fields = fieldList(field("name", &EvictedEntry::name, Presence::Required),
                                             field("by", &EvictedEntry::by), field("time", &EvictedEntry::time));
};

/// A Stop that ended the phase that ran last.
struct StopEntry
{
    QString whoever;
    QString how;
    Hex64 time;          // [ns] since 1970
    bool yours = false;  // the connection that reads this has sent it

    static constexpr auto fields = fieldList(field("whoever", &StopEntry::whoever), field("how", &StopEntry::how),
                                             field("time", &StopEntry::time), field("yours", &StopEntry::yours));
};

/// What a master has counted. They go by their names: another version may have more of them.
template<>
struct Counters<QPlcMasterStatistics>
{
    using M = QPlcMasterStatistics;
    static constexpr auto fields = fieldList(
        field("cycles", &M::cycles), field("overruns", &M::overruns), field("skippedCycles", &M::skippedCycles),
        field("lateAnswers", &M::lateAnswers), field("strangers", &M::strangers), field("floods", &M::floods),
        field("refusedConnections", &M::refusedConnections), field("failedHandshakes", &M::failedHandshakes),
        field("deniedMessages", &M::deniedMessages));
};

/// What the recorder of the cycles does.
enum class RecorderState : quint8 {
    Unknown,    ///< a word of a newer master
    None,       ///< nobody records
    Recording,  ///< cycles go into a file
    DiskFull,   ///< the disk has no room; the recorder tries again
    Failing,    ///< the file cannot be written for another reason; the recorder tries again
    Stalled,    ///< the recorder makes no progress, as when its disk stalls
    Gone,       ///< the recorder has ended without a word, and the ring waits for the next one
    Stopped     ///< somebody wants that nothing is recorded
};

template<>
struct Names<RecorderState>
{
    static constexpr std::pair<RecorderState, const char *> all[]
        = {{RecorderState::None, "None"},         {RecorderState::Recording, "Recording"},
           {RecorderState::DiskFull, "DiskFull"}, {RecorderState::Failing, "Failing"},
           {RecorderState::Stalled, "Stalled"},   {RecorderState::Gone, "Gone"},
           {RecorderState::Stopped, "Stopped"}};
};

/// Who records the cycles of the last phase.
struct RecorderEntry
{
    RecorderState state = RecorderState::Unknown;
    QString file;               // the newest one, on the computer of the master
    double bytesPerSecond = 0;  // written, over the last seconds
    quint64 freeBytes = 0;      // of the disk
    quint64 missing = 0;        // cycles of the phase that are in no recording
    QString error;              // the newest one of the recorder; empty: there was none

    static constexpr auto fields = fieldList(
        field("state", &RecorderEntry::state), field("file", &RecorderEntry::file),
        field("bytesPerSecond", &RecorderEntry::bytesPerSecond), field("freeBytes", &RecorderEntry::freeBytes),
        field("missing", &RecorderEntry::missing), field("error", &RecorderEntry::error));
};

struct State
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::State;
    MasterState state = MasterState::Unknown;
    QString reason;   // why it is SafeStop or Fault
    QString remains;  // what still keeps Reset from being done
    QString missing;  // nodes that an initialization and a start need
    QVector<EvictedEntry> evicted;
    quint64 latch = 0;  // number of the newest safe stop or fault of this session, from 1; 0: there was none
    bool armed = false;
    bool armingRequired = false;
    Hex64 cycle;
    Hex64 cycleZeroTime;  // UTC of cycle 0 [ns since 1970]; 0: no phase yet, or the master reads no clock
    std::chrono::nanoseconds period{0};
    ClockKind clock = ClockKind::RealTime;
    double scale = 1.0;
    QString profile;
    QString profileReason;
    Hex64 session;
    QVector<QPlcNodeInfo> nodes;
    QMap<QString, double> counters;  // by the names of Counters<QPlcMasterStatistics>
    Hex64 digest;
    std::optional<StopEntry> stopped;
    QString faults;
    std::optional<RecorderEntry> recorder;  // none: no phase was recorded from yet

    static constexpr auto fields = fieldList(
        field("state", &State::state), field("reason", &State::reason), field("remains", &State::remains),
        field("missing", &State::missing, Presence::WhenSet), field("evicted", &State::evicted, Presence::WhenSet),
        field("latch", &State::latch), field("armed", &State::armed), field("armingRequired", &State::armingRequired),
        field("cycle", &State::cycle), field("cycleZeroTime", &State::cycleZeroTime, Presence::WhenSet),
        field("period", &State::period), field("clock", &State::clock), field("scale", &State::scale),
        field("profile", &State::profile), field("profileReason", &State::profileReason),
        field("session", &State::session), field("nodes", &State::nodes), field("counters", &State::counters),
        field("digest", &State::digest), field("stopped", &State::stopped, Presence::WhenSet),
        field("faults", &State::faults, Presence::WhenSet), field("recorder", &State::recorder, Presence::WhenSet));
};

struct GetState
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::GetState;
    using Answer = State;
    static constexpr auto fields = fieldList();
};

template<>
struct Names<QPlcSchedule::Phase>
{
    static constexpr std::pair<QPlcSchedule::Phase, const char *> all[]
        = {{QPlcSchedule::Step, "step"}, {QPlcSchedule::Outputs, "outputs"}, {QPlcSchedule::Update, "update"}};
};

template<>
struct Description<QPlcSchedule::Turn>
{
    using T = QPlcSchedule::Turn;
    static constexpr auto fields = fieldList(field("node", &T::node, Presence::Required), field("phase", &T::phase));
};

template<>
struct Description<QPlcSchedule::Link>
{
    using L = QPlcSchedule::Link;
    static constexpr auto fields
        = fieldList(field("signal", &L::signal, Presence::Required), field("from", &L::from), field("to", &L::to),
                    field("age", &L::age), field("sameCycle", &L::sameCycle));
};

struct Schedule : QPlcSchedule
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Schedule;
    static constexpr auto fields = fieldList(field("stages", &Schedule::stages), field("links", &Schedule::links));
};

struct GetSchedule
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::GetSchedule;
    using Answer = Schedule;
    static constexpr auto fields = fieldList();
};

}  // namespace qplc::messages
