// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Events.h"
#include "Greeting.h"
#include "Leases.h"
#include "Phases.h"
#include "Records.h"
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
    case Kind::NodeEvent:
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
    case Kind::Note:
    case Kind::GetRecords:
    case Kind::Records:
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
    template<typename Message>
    static constexpr bool has = (std::is_same_v<Message, Messages> || ...);
};

/// The messages of all lists.
template<typename... Lists>
struct JoinedLists
{
    using Type = List<>;
};
template<typename... Messages>
struct JoinedLists<List<Messages...>>
{
    using Type = List<Messages...>;
};
template<typename... First, typename... Second, typename... Others>
struct JoinedLists<List<First...>, List<Second...>, Others...> : JoinedLists<List<First..., Second...>, Others...>
{
};

/// Who may send a message to a master.
enum class Sender : quint8 {
    Everybody,  ///< an Observer registers as a listener without outputs
    Operators   ///< and Engineers
};
/// What a message does at a master.
enum class Purpose : quint8 {
    Opening,   ///< makes somebody known to a master, or a node of it
    Report,    ///< tells what a node has done
    Question,  ///< changes nothing
    Command    ///< does something to the plant, and is written down
};
/// When a master carries a message out.
enum class Turn : quint8 {
    InOrder,  ///< after what its sender has sent before
    Urgent    ///< at once; commands of its sender that still wait are refused
};
/// What a sender waits for.
enum class Outcome : quint8 {
    None,    ///< nothing: the message has NoAnswer
    Prompt,  ///< its Answer, or Failed
    Late,    ///< as Prompt, but after nodes have done their part: later messages are answered before
    Certain  ///< its Answer, never Failed
};
enum class Writes : quint8 {
    Nothing,
    Signals  ///< or takes or releases the right to: needs a right to each of them
};

/// What is known of a message from a node or tool, by its kind.
struct Use
{
    QPlcMessage::Kind kind = QPlcMessage::Invalid;
    Sender sender = Sender::Operators;
    Purpose purpose = Purpose::Report;
    Turn turn = Turn::InOrder;
    Outcome outcome = Outcome::None;
    QPlcMessage::Kind answer = QPlcMessage::Invalid;
};

template<typename Message, typename = void>
struct HasAnswer : std::false_type
{
};
template<typename Message>
struct HasAnswer<Message, std::void_t<typename Message::Answer>> : std::true_type
{
};

/// All that is known of a message from a node or tool, besides its fields and its answer.
template<typename Message, Sender sender, Purpose purpose, Turn turn, Outcome outcome, Writes writes>
struct Row
{
    static_assert(HasAnswer<Message>::value,
                  "a message to a master needs `using Answer = ...;`: Done for a command "
                  "that has no other answer, NoAnswer for what nobody waits for");
    static_assert((outcome == Outcome::None) == std::is_same_v<typename Message::Answer, NoAnswer>,
                  "a message needs Outcome::None with NoAnswer, and another Outcome with any other Answer");
    static_assert(sender == Sender::Everybody || purpose == Purpose::Command || purpose == Purpose::Question,
                  "only commands and questions can be kept to operators");

    template<bool isListed>
    using If = std::conditional_t<isListed, List<Message>, List<>>;
    using All = List<Message>;
    using Openings = If<purpose == Purpose::Opening>;
    using Requests = If<purpose != Purpose::Opening>;
    using WriteSignals = If<writes == Writes::Signals>;
    static constexpr Use use{Message::kind, sender, purpose, turn, outcome, Message::Answer::kind};
};

template<typename... Rows>
struct Table
{
    using All = typename JoinedLists<typename Rows::All...>::Type;
    using Openings = typename JoinedLists<typename Rows::Openings...>::Type;
    using Requests = typename JoinedLists<typename Rows::Requests...>::Type;
    using WriteSignals = typename JoinedLists<typename Rows::WriteSignals...>::Type;
    static constexpr Use uses[] = {Rows::use...};
};

/// What a node or tool sends to its master, a row each.
using ClientTable = Table<
    Row<ClientHello, Sender::Everybody, Purpose::Opening, Turn::InOrder, Outcome::None, Writes::Nothing>,
    Row<Register, Sender::Everybody, Purpose::Opening, Turn::InOrder, Outcome::None, Writes::Signals>,
    Row<AttachCyclicChannel, Sender::Everybody, Purpose::Opening, Turn::InOrder, Outcome::None, Writes::Nothing>,
    Row<InitializeAllStates, Sender::Operators, Purpose::Command, Turn::InOrder, Outcome::Late, Writes::Nothing>,
    Row<ReceiveMyInitialOutputStates, Sender::Everybody, Purpose::Report, Turn::InOrder, Outcome::None,
        Writes::Nothing>,
    Row<Initialized, Sender::Everybody, Purpose::Report, Turn::InOrder, Outcome::None, Writes::Nothing>,
    Row<StartRealTime, Sender::Operators, Purpose::Command, Turn::InOrder, Outcome::Late, Writes::Nothing>,
    Row<RealTimeReady, Sender::Everybody, Purpose::Report, Turn::InOrder, Outcome::None, Writes::Nothing>,
    Row<Stop, Sender::Everybody, Purpose::Command, Turn::Urgent, Outcome::Certain, Writes::Nothing>,
    Row<SafeStop, Sender::Everybody, Purpose::Command, Turn::Urgent, Outcome::Certain, Writes::Nothing>,
    Row<Reset, Sender::Operators, Purpose::Command, Turn::InOrder, Outcome::Prompt, Writes::Nothing>,
    Row<Arm, Sender::Operators, Purpose::Command, Turn::InOrder, Outcome::Prompt, Writes::Nothing>,
    Row<Evict, Sender::Operators, Purpose::Command, Turn::InOrder, Outcome::Prompt, Writes::Nothing>,
    Row<Admit, Sender::Operators, Purpose::Command, Turn::InOrder, Outcome::Prompt, Writes::Nothing>,
    Row<GetState, Sender::Everybody, Purpose::Question, Turn::InOrder, Outcome::Certain, Writes::Nothing>,
    Row<GetSignals, Sender::Everybody, Purpose::Question, Turn::InOrder, Outcome::Prompt, Writes::Nothing>,
    Row<SetSignals, Sender::Operators, Purpose::Command, Turn::InOrder, Outcome::Prompt, Writes::Signals>,
    Row<NodeFault, Sender::Everybody, Purpose::Report, Turn::InOrder, Outcome::None, Writes::Nothing>,
    Row<NodeEvent, Sender::Everybody, Purpose::Report, Turn::InOrder, Outcome::None, Writes::Nothing>,
    Row<GetStatistics, Sender::Everybody, Purpose::Question, Turn::InOrder, Outcome::Prompt, Writes::Nothing>,
    Row<GetSchedule, Sender::Everybody, Purpose::Question, Turn::InOrder, Outcome::Prompt, Writes::Nothing>,
    Row<TakeLease, Sender::Operators, Purpose::Command, Turn::InOrder, Outcome::Prompt, Writes::Signals>,
    Row<ReleaseLease, Sender::Operators, Purpose::Command, Turn::Urgent, Outcome::Prompt, Writes::Signals>,
    Row<GetLeases, Sender::Everybody, Purpose::Question, Turn::InOrder, Outcome::Prompt, Writes::Nothing>,
    Row<GetEvents, Sender::Everybody, Purpose::Question, Turn::InOrder, Outcome::Prompt, Writes::Nothing>,
    Row<Note, Sender::Operators, Purpose::Command, Turn::InOrder, Outcome::Prompt, Writes::Nothing>,
    // Who records keeps other recorders away, and in lockstep the plant waits for it.
    Row<GetRecords, Sender::Operators, Purpose::Question, Turn::InOrder, Outcome::Prompt, Writes::Nothing>>;

/// By what somebody becomes known to a master, and a node of it.
using Openings = ClientTable::Openings;
/// What a master carries out for those that it knows.
using Requests = ClientTable::Requests;
/// What writes signals, or takes or releases the right to.
using WriteSignals = ClientTable::WriteSignals;
using FromClient = ClientTable::All;

/// How a master begins and ends a connection.
using Greetings = List<MasterHello, Rejected, MasterEnds>;
/// By what a master leads a node through its registration and its phases.
using ToNode = List<Registered, CyclicChannelAttached, SendYourInitialOutputStates, InitializeWithValues,
                    RealTimeStarted, RealTimeStopped, StatesInitialized>;
/// What a master answers, and tells who wants to know.
using Replies = List<Armed, State, Signals, Done, Failed, Statistics, Schedule, Leases, LeasesChanged, Events, Records>;
/// What a master sends to a node or tool.
using FromMaster = JoinedLists<Greetings, ToNode, Replies>::Type;

static_assert(isEveryKind([](QPlcMessage::Kind kind) {
                  return FromClient::contains(kind) || FromMaster::contains(kind);
              }),
              "a kind of QPlcMessage has no struct in ClientTable or FromMaster");

/// The row of a kind. `kind` is Invalid: a node or tool does not send it, or this version does not
/// know it.
constexpr Use useOf(QPlcMessage::Kind kind)
{
    for (const Use &use : ClientTable::uses) {
        if (use.kind == kind)
            return use;
    }
    return {};
}

constexpr bool isCommand(QPlcMessage::Kind kind)
{
    return useOf(kind).purpose == Purpose::Command;
}

/// Whether a message from a node or tool grows with the table of signals, and may be longer than
/// others. All others are as short in a large plant as in a small one, or can be sent in parts.
constexpr bool mayBeLong(QPlcMessage::Kind kind)
{
    return List<Register, ReceiveMyInitialOutputStates, SetSignals>::contains(kind);
}

constexpr bool isUrgent(QPlcMessage::Kind kind)
{
    return useOf(kind).turn == Turn::Urgent;
}

/// The kind of a struct that is sent. One without a row does not compile.
template<typename Message>
constexpr QPlcMessage::Kind kindOf()
{
    static_assert(FromClient::has<Message> || FromMaster::has<Message>,
                  "a message that is sent needs a row in ClientTable, or a place in the lists of FromMaster");
    return Message::kind;
}

template<typename Message>
QPlcMessage toMessage(const Message &message)
{
    return {kindOf<Message>(), toObject(message)};
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
