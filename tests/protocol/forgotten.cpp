// SPDX-License-Identifier: Apache-2.0
// Messages of which something is forgotten. Not part of a program: forgotten.py sees that this file
// compiles, and that with FORGOTTEN the compiler refuses each mistake with the sentence beside it.
#include "node/session/ControlClient.h"
#include "protocol/messages/ListAnswer.h"

namespace qplc::messages {

struct Complete : GetEvents
{
    QString text;
    Hex64 number;
    std::optional<std::chrono::nanoseconds> duration;
    std::vector<EventEntry> entries;
    QJsonObject others;

    static constexpr auto fields = joined(GetEvents::fields,
                                          fieldList(field("text", &Complete::text), field("number", &Complete::number),
                                                    field("duration", &Complete::duration),
                                                    field("entries", &Complete::entries), rest(&Complete::others)));
};
const QJsonObject complete = toObject(Complete());
using CompleteRow
    = Row<Complete, Sender::Everybody, Purpose::Question, Turn::InOrder, Outcome::Prompt, Writes::Nothing>;
const Use use = CompleteRow::use;
const QPlcMessage sent = toMessage(GetEvents());

#ifdef FORGOTTEN
struct MissingField
{
    int listed = 0;
    std::optional<Hex64> missing;
    static constexpr auto fields = fieldList(field("listed", &MissingField::listed));
};
const QJsonObject a = toObject(MissingField());
// refused: a member of this struct of messages is missing in its `fields`

struct SameMember
{
    bool first = false;
    bool second = false;
    static constexpr auto fields = fieldList(field("first", &SameMember::first), field("second", &SameMember::first));
};
const QJsonObject b = toObject(SameMember());
// refused: two entries in `fields` have the same name, or the same member

struct HasConstructor
{
    HasConstructor() = default;
    explicit HasConstructor(int);
    int listed = 0;
    static constexpr auto fields = fieldList(field("listed", &HasConstructor::listed));
};
const QJsonObject c = toObject(HasConstructor());
// refused: a struct of messages needs public members and no constructor

struct WithoutAnswer
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::GetEvents;
    static constexpr auto fields = fieldList();
};
const Use d
    = Row<WithoutAnswer, Sender::Operators, Purpose::Command, Turn::InOrder, Outcome::Prompt, Writes::Nothing>::use;
// refused: a message to a master needs `using Answer = ...;`

const Use e = Row<Stop, Sender::Everybody, Purpose::Command, Turn::Urgent, Outcome::None, Writes::Nothing>::use;
// refused: a message needs Outcome::None with NoAnswer, and another Outcome with any other Answer

const Use f = Row<NodeFault, Sender::Operators, Purpose::Report, Turn::InOrder, Outcome::None, Writes::Nothing>::use;
// refused: only commands and questions can be kept to operators

const QPlcMessage g = toMessage(WithoutAnswer());
// refused: a message that is sent needs a row in ClientTable, or a place in the lists of FromMaster

void ask(ControlClient &client)
{
    client.request(NodeFault(), [](const auto &) {});
}
// refused: a message with NoAnswer is not a request; send it with tell()
#endif

}  // namespace qplc::messages
