// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Field.h"
#include "QPlcMessage.h"
#include "Vocabulary.h"

/// The beginning and the end of a control connection: docs/protocol.md, sections 5.1 and 5.5.
namespace qplc::messages {

constexpr int protocolVersion = 2;

/// Extensions, by which both sides of a connection say what they know: docs/protocol.md, section
/// 11.
namespace feature {
constexpr QLatin1String sameCycle = word("sameCycle");
constexpr QLatin1String leases = word("leases");
constexpr QLatin1String events = word("events");
constexpr QLatin1String quality = word("quality");
constexpr QLatin1String outputQuality = word("outputQuality");
constexpr QLatin1String hardware = word("hardware");
constexpr QLatin1String all[] = {sameCycle, leases, events, quality, outputQuality, hardware};
}  // namespace feature

/// The Answer of a message to a master that its sender does not wait for.
struct NoAnswer
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Invalid;
};

/// A client greets.
struct ClientHello
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Hello;
    using Answer = NoAnswer;
    int protocol = 0;
    QString name;
    QString uuid;
    Part role = Part::Tool;
    std::optional<Hex64> tableHash;  // of the table that it has
    QStringList features;            // that it offers
    bool wantsTable = true;          // if it has another one

    static constexpr auto fields = fieldList(
        field("protocol", &ClientHello::protocol), field("name", &ClientHello::name), field("uuid", &ClientHello::uuid),
        field("role", &ClientHello::role), field("tableHash", &ClientHello::tableHash, Presence::WhenSet),
        field("features", &ClientHello::features), field("wantsTable", &ClientHello::wantsTable, Presence::WhenSet));
};

/// The security of a master that listens to a network, and asks nobody who he is.
constexpr QLatin1String insecure = word("insecure");

/// The master greets back.
struct MasterHello
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Hello;
    int protocol = 0;
    QString name;
    QString uuid;
    Hex64 session;  // never 0
    Hex64 tableHash;
    QString table;  // INI text; empty: the client has the same one
    MasterState state = MasterState::Unknown;
    std::chrono::nanoseconds period{0};
    QString security;
    quint32 longestMessage = 0;  // [byte] that it takes after the greeting
    QStringList features;        // that both offer
    QString identity;            // proven; empty without security
    QString role;
    QString faults;

    static constexpr auto fields = fieldList(
        field("protocol", &MasterHello::protocol), field("name", &MasterHello::name), field("uuid", &MasterHello::uuid),
        field("session", &MasterHello::session), field("tableHash", &MasterHello::tableHash),
        field("table", &MasterHello::table, Presence::WhenSet), field("state", &MasterHello::state),
        field("period", &MasterHello::period), field("security", &MasterHello::security),
        field("longestMessage", &MasterHello::longestMessage, Presence::WhenSet),
        field("features", &MasterHello::features), field("identity", &MasterHello::identity, Presence::WhenSet),
        field("role", &MasterHello::role, Presence::WhenSet), field("faults", &MasterHello::faults, Presence::WhenSet));
};

/// Why the last message was refused; the master closes the connection.
struct Rejected
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Rejected;
    QString error;  // a word of section 5.5
    QString text;   // a sentence

    static constexpr auto fields = fieldList(field("error", &Rejected::error), field("text", &Rejected::text));
};

/// The master ends as wanted.
struct MasterEnds
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::MasterEnds;
    static constexpr auto fields = fieldList();
};

/// A request was carried out.
struct Done
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Done;
    static constexpr auto fields = fieldList();
};

/// A request was refused; the connection stays.
struct Failed
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Failed;
    QString error;  // a word of section 5.5
    QString text;   // a sentence

    static constexpr auto fields = fieldList(field("error", &Failed::error), field("text", &Failed::text));
};

}  // namespace qplc::messages
