// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Wire.h"

#include <utility>

/// Words that messages share: docs/protocol.md lists them.
namespace qplc::messages {

/// Returns \a text as a constant. QLatin1String counts its characters at run time with clang.
template<int Size>
constexpr QLatin1String word(const char (&text)[Size])
{
    return QLatin1String(text, Size - 1);
}

/// How a master calls itself where nodes go by their names.
constexpr QLatin1String masterName = word("Master");

/// Why a master refuses: `error` of Rejected and Failed.
namespace errorWord {
constexpr QLatin1String versionMismatch = word("VersionMismatch");
constexpr QLatin1String nameInUse = word("NameInUse");
constexpr QLatin1String unknownSignal = word("UnknownSignal");
constexpr QLatin1String typeMismatch = word("TypeMismatch");
constexpr QLatin1String unitMismatch = word("UnitMismatch");
constexpr QLatin1String safetyMismatch = word("SafetyMismatch");
constexpr QLatin1String signalHasWriter = word("SignalHasWriter");
constexpr QLatin1String writerNotNamed = word("WriterNotNamed");
constexpr QLatin1String leaseHeld = word("LeaseHeld");
constexpr QLatin1String profileMismatch = word("ProfileMismatch");
constexpr QLatin1String manifestMismatch = word("ManifestMismatch");
constexpr QLatin1String tooManyNodes = word("TooManyNodes");
constexpr QLatin1String algebraicLoop = word("AlgebraicLoop");
constexpr QLatin1String wrongState = word("WrongState");
constexpr QLatin1String malformedMessage = word("MalformedMessage");
constexpr QLatin1String invalidValue = word("InvalidValue");
constexpr QLatin1String nodeError = word("NodeError");
constexpr QLatin1String tooLong = word("TooLong");
constexpr QLatin1String securityNeeded = word("SecurityNeeded");
constexpr QLatin1String denied = word("Denied");
constexpr QLatin1String evicted = word("Evicted");
constexpr QLatin1String timedOut = word("TimedOut");
constexpr QLatin1String tooMuch = word("TooMuch");
constexpr QLatin1String unknownRing = word("UnknownRing");
constexpr QLatin1String all[]
    = {versionMismatch, nameInUse,        unknownSignal,   typeMismatch,     unitMismatch,   signalHasWriter,
       writerNotNamed,  leaseHeld,        profileMismatch, manifestMismatch, tooManyNodes,   algebraicLoop,
       wrongState,      malformedMessage, invalidValue,    nodeError,        tooLong,        securityNeeded,
       denied,          evicted,          timedOut,        tooMuch,          safetyMismatch, unknownRing};
/// Of a client itself: the connection ended before there was an answer. Never sent.
constexpr QLatin1String lost = word("Lost");
}  // namespace errorWord

/// What a master does. docs/design/states.md has all events of each state.
enum class MasterState : quint8 {
    Unknown,  ///< a word of a newer master
    Off,
    Initializing,
    Ready,
    RealTime,
    WaitingForLateSlaves,
    SafeStop,
    Fault
};

template<>
struct Names<MasterState>
{
    static constexpr std::pair<MasterState, const char *> all[]
        = {{MasterState::Off, "Off"},
           {MasterState::Initializing, "Initializing"},
           {MasterState::Ready, "Ready"},
           {MasterState::RealTime, "RealTime"},
           {MasterState::WaitingForLateSlaves, "WaitingForLateSlaves"},
           {MasterState::SafeStop, "SafeStop"},
           {MasterState::Fault, "Fault"}};
};

/// The state of this name. Those of nodes have the names of those of masters, where both have one.
inline MasterState stateNamed(const QString &name)
{
    return valueNamed<MasterState>(name).value_or(MasterState::Unknown);
}

/// Whether cycles run, or stand still for a moment; safe ones, too.
constexpr bool hasCycles(MasterState state)
{
    return state == MasterState::RealTime || state == MasterState::WaitingForLateSlaves
        || state == MasterState::SafeStop;
}

/// Whether nothing moves until the master is reset.
constexpr bool isLatched(MasterState state)
{
    return state == MasterState::SafeStop || state == MasterState::Fault;
}

/// Who is at the other end of a control connection.
enum class Part : quint8 { Tool, Node };

template<>
struct Names<Part>
{
    static constexpr std::pair<Part, const char *> all[] = {{Part::Tool, "tool"}, {Part::Node, "node"}};
};

/// What time is.
enum class ClockKind : quint8 { RealTime, Scaled, Lockstep, External };

template<>
struct Names<ClockKind>
{
    static constexpr std::pair<ClockKind, const char *> all[] = {{ClockKind::RealTime, "RealTime"},
                                                                 {ClockKind::Scaled, "Scaled"},
                                                                 {ClockKind::Lockstep, "Lockstep"},
                                                                 {ClockKind::External, "External"}};
};

}  // namespace qplc::messages
