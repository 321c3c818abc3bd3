// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Events.h"
#include "Greeting.h"
#include "Leases.h"
#include "Phases.h"
#include "Registration.h"
#include "SignalValues.h"
#include "State.h"
#include "Statistics.h"

#include <QtCore/QJsonDocument>

#include <limits>

/// All control messages: a kind without a struct does not compile.
namespace qplc::messages {

/// Whether \a number is a kind of this version. An enumerator without a row does not compile.
#pragma GCC diagnostic push
#pragma GCC diagnostic error "-Wswitch"
constexpr bool isKind(quint8 number)
{
    using Kind = QPlcMessage;
    switch (QPlcMessage::Kind(number)) {
    case Kind::Invalid:
        return false;
    case Kind::Hello:
    case Kind::Register:
    case Kind::Registered:
    case Kind::Rejected:
    case Kind::AttachCyclicChannel:
    case Kind::CyclicChannelAttached:
    case Kind::MasterEnds:
    case Kind::InitializeAllStates:
    case Kind::SendYourInitialOutputStates:
    case Kind::ReceiveMyInitialOutputStates:
    case Kind::InitializeWithValues:
    case Kind::Initialized:
    case Kind::StatesInitialized:
    case Kind::StartRealTime:
    case Kind::RealTimeStarted:
    case Kind::RealTimeReady:
    case Kind::Stop:
    case Kind::RealTimeStopped:
    case Kind::SafeStop:
    case Kind::Reset:
    case Kind::Arm:
    case Kind::Armed:
    case Kind::Evict:
    case Kind::Admit:
    case Kind::GetState:
    case Kind::State:
    case Kind::GetSignals:
    case Kind::Signals:
    case Kind::SetSignals:
    case Kind::Done:
    case Kind::Failed:
    case Kind::NodeFault:
    case Kind::GetStatistics:
    case Kind::Statistics:
    case Kind::GetSchedule:
    case Kind::Schedule:
    case Kind::TakeLease:
    case Kind::ReleaseLease:
    case Kind::GetLeases:
    case Kind::Leases:
    case Kind::LeasesChanged:
    case Kind::GetEvents:
    case Kind::Events:
        return true;
    }
    return false;
}
#pragma GCC diagnostic pop

/// Whether \a isListed is true for every kind, and for nothing else.
template<typename IsListed>
constexpr bool isEveryKind(IsListed isListed)
{
    for (int number = 0; number <= std::numeric_limits<quint8>::max(); ++number) {
        if (isKind(quint8(number)) != isListed(QPlcMessage::Kind(number)))
            return false;
    }
    return true;
}

template<typename... Messages>
struct List
{
    static constexpr bool contains(QPlcMessage::Kind kind) { return ((Messages::kind == kind) || ...); }
};

/// The messages of two lists.
template<typename First, typename Second>
struct JoinedLists;
template<typename... First, typename... Second>
struct JoinedLists<List<First...>, List<Second...>>
{
    using Type = List<First..., Second...>;
};

/// By what somebody becomes known to a master, and a node of it.
using Openings = List<ClientHello, Register, AttachCyclicChannel>;
/// What a master answers, or carries out, for those that it knows.
using Requests = List<InitializeAllStates, ReceiveMyInitialOutputStates, Initialized, StartRealTime, RealTimeReady,
                      Stop, SafeStop, Reset, Arm, Evict, Admit, GetState, GetSignals, SetSignals, NodeFault,
                      GetStatistics, GetSchedule, TakeLease, ReleaseLease, GetLeases, GetEvents>;
/// What a node or tool sends to its master.
using FromClient = JoinedLists<Openings, Requests>::Type;
/// How a master begins and ends a connection.
using Greetings = List<MasterHello, Rejected, MasterEnds>;
/// By what a master leads a node through its registration and its phases.
using ToNode = List<Registered, CyclicChannelAttached, SendYourInitialOutputStates, InitializeWithValues,
                    RealTimeStarted, RealTimeStopped, StatesInitialized>;
/// What a master answers, and tells who wants to know.
using Replies = List<Armed, State, Signals, Done, Failed, Statistics, Schedule, Leases, LeasesChanged, Events>;
/// What a master sends to a node or tool.
using FromMaster = JoinedLists<Greetings, JoinedLists<ToNode, Replies>::Type>::Type;

static_assert(isEveryKind([](QPlcMessage::Kind kind) {
                  return FromClient::contains(kind) || FromMaster::contains(kind);
              }),
              "a kind of QPlcMessage has no struct in FromClient or FromMaster");

/// What every role may send to a master; an Observer registers as a listener without outputs.
using EverybodyMaySend
    = List<ClientHello, Register, AttachCyclicChannel, ReceiveMyInitialOutputStates, Initialized, RealTimeReady, Stop,
           SafeStop, GetState, GetSignals, NodeFault, GetStatistics, GetSchedule, GetLeases, GetEvents>;
/// What Operators and Engineers may send.
using OperatorsMaySend
    = List<InitializeAllStates, StartRealTime, Reset, Arm, Evict, Admit, SetSignals, TakeLease, ReleaseLease>;

/// Whether each message of FromClient, and no other one, is in exactly one of two lists.
template<typename First, typename Second>
constexpr bool isFromClientSplitInto(First, Second)
{
    return isEveryKind([](QPlcMessage::Kind kind) {
        const bool isListed = First::contains(kind) != Second::contains(kind);
        return isListed ? FromClient::contains(kind) : FromMaster::contains(kind);
    });
}

static_assert(isFromClientSplitInto(EverybodyMaySend(), OperatorsMaySend()),
              "a message of FromClient is in neither of EverybodyMaySend and OperatorsMaySend, or in both");

/// What writes signals, or takes or releases the right to: needs a right to each of them.
using WriteSignals = List<Register, SetSignals, TakeLease, ReleaseLease>;
/// All others of FromClient.
using WriteNoSignals = List<ClientHello, AttachCyclicChannel, InitializeAllStates, ReceiveMyInitialOutputStates,
                            Initialized, StartRealTime, RealTimeReady, Stop, SafeStop, Reset, Arm, Evict, Admit,
                            GetState, GetSignals, NodeFault, GetStatistics, GetSchedule, GetLeases, GetEvents>;

static_assert(isFromClientSplitInto(WriteSignals(), WriteNoSignals()),
              "a message of FromClient is in neither of WriteSignals and WriteNoSignals, or in both");

template<typename Message>
QPlcMessage toMessage(const Message &message)
{
    return {Message::kind, toObject(message)};
}

/// Reads \a message. Nothing where it is of another kind, or a field that is needed cannot be used.
/// \param error  names that field
template<typename Message>
std::optional<Message> readAs(const QPlcMessage &message, QString *error = nullptr)
{
    Message read;
    QString text;
    if (message.kind() == Message::kind && fromObject(message.fields(), &read, &text))
        return read;
    if (error)
        *error = text;
    return std::nullopt;
}

/// The fields of a message as they came, for those who pass them on.
inline QJsonDocument jsonOf(const QPlcMessage &message)
{
    return QJsonDocument(message.fields());
}

/// What became of a message.
enum class Dispatch : quint8 {
    Delivered,
    Malformed,  ///< a field that is needed cannot be used
    Unknown     ///< no message of the list has this kind
};

/// Reads \a message as the struct of \a Messages that has its kind, and gives it to \a handler.
///
/// The handler has an overload for each of them: one that is forgotten does not compile.
/// \param error  of Malformed: a sentence that names the field
template<typename Handler, typename... Messages>
Dispatch dispatch(List<Messages...>, const QPlcMessage &message, Handler &&handler, QString *error)
{
    Dispatch result = Dispatch::Unknown;
    const auto tryOne = [&](auto read) {
        if (decltype(read)::kind != message.kind() || result != Dispatch::Unknown)
            return;
        result = Dispatch::Malformed;
        if (fromObject(message.fields(), &read, error)) {
            result = Dispatch::Delivered;
            handler(read);
        }
    };
    (tryOne(Messages()), ...);
    return result;
}

}  // namespace qplc::messages
