// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Field.h"
#include "Greeting.h"
#include "QPlcMessage.h"
#include "Vocabulary.h"

/// Initialization, start and stop: docs/protocol.md, sections 4, 5.3 and 9.
namespace qplc::messages {

struct InitializeAllStates
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::InitializeAllStates;
    using Answer = Done;
    static constexpr auto fields = fieldList();
};

struct SendYourInitialOutputStates
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::SendYourInitialOutputStates;
    std::optional<Hex64> phase;  // cycleZero of the phase that the node joins

    static constexpr auto fields = fieldList(field("phase", &SendYourInitialOutputStates::phase, Presence::WhenSet));
};

struct ReceiveMyInitialOutputStates
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::ReceiveMyInitialOutputStates;
    using Answer = NoAnswer;
    QByteArray values;    // packed output payload
    bool goesOn = false;  // the node has kept its state

    static constexpr auto fields = fieldList(field("values", &ReceiveMyInitialOutputStates::values, Presence::Required),
                                             field("goesOn", &ReceiveMyInitialOutputStates::goesOn, Presence::WhenSet));
};

struct InitializeWithValues
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::InitializeWithValues;
    QByteArray values;  // packed input payload

    static constexpr auto fields = fieldList(field("values", &InitializeWithValues::values, Presence::Required));
};

struct Initialized
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Initialized;
    using Answer = NoAnswer;
    static constexpr auto fields = fieldList();
};

struct StatesInitialized
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::StatesInitialized;
    bool ok = false;
    QString text;  // why not

    static constexpr auto fields
        = fieldList(field("ok", &StatesInitialized::ok), field("text", &StatesInitialized::text, Presence::WhenSet));
};

struct StartRealTime
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::StartRealTime;
    using Answer = Done;
    std::optional<quint64> cycles;  // the master stops by itself after so many
    std::optional<Hex64> token;     // of Armed

    static constexpr auto fields = fieldList(field("cycles", &StartRealTime::cycles, Presence::Checked),
                                             field("token", &StartRealTime::token, Presence::WhenSet));
};

/// Where the inputs of a node lie in the datagrams of a group.
struct GroupPlace
{
    int part = 0;
    int offset = 0;  // [byte]
    int size = 0;    // [byte]
    Hex64 hash;

    static constexpr auto fields = fieldList(
        field("part", &GroupPlace::part, Presence::Required), field("offset", &GroupPlace::offset, Presence::Required),
        field("size", &GroupPlace::size, Presence::Required), field("hash", &GroupPlace::hash, Presence::Required));
    friend bool operator==(const GroupPlace &a, const GroupPlace &b)
    {
        return a.part == b.part && a.offset == b.offset && a.size == b.size && a.hash == b.hash;
    }
};

struct RealTimeStarted
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::RealTimeStarted;
    std::chrono::nanoseconds period{0};
    ClockKind clock = ClockKind::RealTime;
    double scale = 1.0;
    QString profile;  // "Simulation"; everything else is a plant
    Hex64 firstCycle;
    Hex64 cycleZero;
    std::optional<GroupPlace> group;

    static constexpr auto fields = fieldList(
        field("period", &RealTimeStarted::period, Presence::Checked),
        field("clock", &RealTimeStarted::clock, Presence::Required), field("scale", &RealTimeStarted::scale),
        field("profile", &RealTimeStarted::profile, Presence::WhenSet),
        field("firstCycle", &RealTimeStarted::firstCycle), field("cycleZero", &RealTimeStarted::cycleZero),
        field("group", &RealTimeStarted::group, Presence::Checked));
};

struct RealTimeReady
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::RealTimeReady;
    using Answer = NoAnswer;
    static constexpr auto fields = fieldList();
};

struct Stop
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Stop;
    using Answer = Done;
    QString whoever;  // the person
    QString how;      // "Esc Esc"

    static constexpr auto fields
        = fieldList(field("whoever", &Stop::whoever, Presence::WhenSet), field("how", &Stop::how, Presence::WhenSet));
};

struct RealTimeStopped
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::RealTimeStopped;
    QString reason;
    std::optional<Hex64> lastCycle;  // number on the wire of the last cycle that was sent to the node; none: none was
    quint64 before = 0;              // as in the frames of that cycle

    static constexpr auto fields = fieldList(field("reason", &RealTimeStopped::reason),
                                             field("lastCycle", &RealTimeStopped::lastCycle, Presence::WhenSet),
                                             field("before", &RealTimeStopped::before, Presence::WhenSet, {0, 65535}));
};

struct SafeStop
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::SafeStop;
    using Answer = Done;
    QString reason;

    static constexpr auto fields = fieldList(field("reason", &SafeStop::reason, Presence::WhenSet));
};

struct Reset
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Reset;
    using Answer = Done;
    quint64 latch = 0;  // as in State: the safe stop or fault that the sender has seen

    static constexpr auto fields = fieldList(field("latch", &Reset::latch, Presence::Required));
};

/// Somebody goes, and does not come back before Admit.
struct Evict
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Evict;
    using Answer = Done;
    QString name;  // of a node or person

    static constexpr auto fields = fieldList(field("name", &Evict::name, Presence::Required));
};

struct Admit
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Admit;
    using Answer = Done;
    QString name;

    static constexpr auto fields = fieldList(field("name", &Admit::name, Presence::Required));
};

struct Armed
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Armed;
    Hex64 token;
    std::chrono::nanoseconds validFor{0};

    static constexpr auto fields
        = fieldList(field("token", &Armed::token, Presence::Required), field("validFor", &Armed::validFor));
};

struct Arm
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Arm;
    using Answer = Armed;
    static constexpr auto fields = fieldList();
};

}  // namespace qplc::messages
