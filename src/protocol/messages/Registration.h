// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Field.h"
#include "Greeting.h"
#include "QPlcMessage.h"
#include "Vocabulary.h"

/// How a node joins its master: docs/protocol.md, section 5.2.
namespace qplc::messages {

/// A signal that a node reads or writes.
struct DeclaredSignal
{
    QString name;
    QString type;  // canonical
    QString unit;
    bool sameCycle = false;       // inputs only
    std::optional<Hex64> safety;  // of its safety parameters; none: the node takes those of the master

    static constexpr auto fields
        = fieldList(field("name", &DeclaredSignal::name, Presence::Required),
                    field("type", &DeclaredSignal::type, Presence::Required), field("unit", &DeclaredSignal::unit),
                    field("sameCycle", &DeclaredSignal::sameCycle, Presence::Checked),
                    field("safety", &DeclaredSignal::safety, Presence::Checked));
};

struct Register
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Register;
    using Answer = NoAnswer;
    static constexpr int longestInterval = 1'000'000;   // [cycles]
    static constexpr double longestWatchdog = 86400e9;  // [ns]
    static constexpr int mostOthers = 64;               // fields of a transport, or of a later version
    QString name;
    QString uuid;
    QString policy;
    bool listener = false;
    bool critical = false;
    int every = 1;  // [cycles] for each frame of a listener
    std::vector<DeclaredSignal> inputs;
    std::vector<DeclaredSignal> outputs;
    bool twoPhase = false;
    bool quality = false;
    bool outputQuality = false;
    std::optional<std::chrono::nanoseconds> watchdog;  // its own, that leads to its safe state; 0: it has none
    QString cyclic;                                    // name of the transport
    QString faults;
    QJsonObject transport;  // with the fields that the transport adds

    static constexpr auto fields
        = fieldList(field("name", &Register::name, Presence::Required), field("uuid", &Register::uuid),
                    field("policy", &Register::policy, Presence::Required), field("listener", &Register::listener),
                    field("critical", &Register::critical, Presence::Checked),
                    field("every", &Register::every, Presence::Checked, Range{1, longestInterval}),
                    field("inputs", &Register::inputs, Presence::Required),
                    field("outputs", &Register::outputs, Presence::Required),
                    field("twoPhase", &Register::twoPhase, Presence::Checked),
                    field("quality", &Register::quality, Presence::Checked),
                    field("outputQuality", &Register::outputQuality, Presence::Checked),
                    field("watchdog", &Register::watchdog, Presence::Checked, Range{0, longestWatchdog}),
                    field("cyclic", &Register::cyclic, Presence::Required),
                    field("faults", &Register::faults, Presence::WhenSet), rest(&Register::transport));
};

/// Keys of one registration, a direction each.
struct Seal
{
    QByteArray inputs;
    QByteArray outputs;

    static constexpr auto fields = fieldList(field("inputs", &Seal::inputs, Presence::Required),
                                             field("outputs", &Seal::outputs, Presence::Required));
    friend bool operator==(const Seal &a, const Seal &b) { return a.inputs == b.inputs && a.outputs == b.outputs; }
};

/// Numbers for the datagrams with which a node looks whether UDP gets through.
struct Probe
{
    Hex64 question;
    Hex64 answer;

    static constexpr auto fields = fieldList(field("question", &Probe::question, Presence::Required),
                                             field("answer", &Probe::answer, Presence::Required));
    friend bool operator==(const Probe &a, const Probe &b) { return a.question == b.question && a.answer == b.answer; }
};

struct Registered
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Registered;
    quint16 node = 0;
    Hex64 inputsHash;
    Hex64 outputsHash;
    MasterState state = MasterState::Unknown;
    Hex64 token;  // of the cyclic connection
    std::optional<Seal> seal;
    std::optional<Probe> probe;
    QJsonObject transport;  // with the fields that the transport adds

    static constexpr auto fields = fieldList(
        field("node", &Registered::node, Presence::Required, Range{1, 65535}),
        field("inputsHash", &Registered::inputsHash, Presence::Required),
        field("outputsHash", &Registered::outputsHash, Presence::Required), field("state", &Registered::state),
        field("token", &Registered::token), field("seal", &Registered::seal, Presence::Checked),
        field("probe", &Registered::probe, Presence::Checked), rest(&Registered::transport));
};

/// The first message of a cyclic TCP connection. On the control connection: the node has chosen a
/// transport that needs none.
struct AttachCyclicChannel
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::AttachCyclicChannel;
    using Answer = NoAnswer;
    quint16 node = 0;
    Hex64 token;
    QString cyclic;  // the transport that the node has chosen; empty: that of its Register

    static constexpr auto fields = fieldList(field("node", &AttachCyclicChannel::node, Presence::Required),
                                             field("token", &AttachCyclicChannel::token, Presence::Required),
                                             field("cyclic", &AttachCyclicChannel::cyclic, Presence::WhenSet));
};

struct CyclicChannelAttached
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::CyclicChannelAttached;
    static constexpr auto fields = fieldList();
};

/// The node cannot go on.
struct NodeFault
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::NodeFault;
    using Answer = NoAnswer;
    QString text;
    std::optional<Hex64> phase;  // cycleZero of the phase in whose cycles the node failed

    static constexpr auto fields
        = fieldList(field("text", &NodeFault::text), field("phase", &NodeFault::phase, Presence::WhenSet));
};

}  // namespace qplc::messages
