// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Field.h"
#include "Greeting.h"
#include "QPlcMessage.h"

/// One writer at a time by permission of the master: docs/protocol.md, section 5.7.
namespace qplc::messages {

enum class LeaseState : quint8 {
    Held,
    Lost  ///< the holder is gone
};

template<>
struct Names<LeaseState>
{
    static constexpr std::pair<LeaseState, const char *> all[]
        = {{LeaseState::Held, "held"}, {LeaseState::Lost, "lost"}};
};

struct LeaseEntry
{
    QString signal;
    QString holder;  // of a lost lease: who held it last
    LeaseState lease = LeaseState::Held;
    std::chrono::nanoseconds timeout{0};

    static constexpr auto fields
        = fieldList(field("signal", &LeaseEntry::signal, Presence::Required), field("holder", &LeaseEntry::holder),
                    field("lease", &LeaseEntry::lease), field("timeout", &LeaseEntry::timeout));
};

struct Leases
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Leases;
    std::vector<LeaseEntry> leases;

    static constexpr auto fields = fieldList(field("leases", &Leases::leases));
};

struct LeasesChanged
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::LeasesChanged;
    std::vector<LeaseEntry> leases;

    static constexpr auto fields = fieldList(field("leases", &LeasesChanged::leases));
};

struct GetLeases
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::GetLeases;
    using Answer = Leases;
    static constexpr auto fields = fieldList();
};

struct TakeLease
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::TakeLease;
    using Answer = Done;
    static constexpr Range timeoutRange{1e7, 3.6e12};  // [ns]
    QStringList signals;
    QMap<QString, QString> values;  // signal -> first value
    QString whoever;                // the holder as shown to people
    std::chrono::nanoseconds timeout{1'000'000'000};
    bool takeOver = false;  // also from another holder

    static constexpr auto fields = fieldList(field("signals", &TakeLease::signals, Presence::Required),
                                             field("values", &TakeLease::values, Presence::Checked),
                                             field("whoever", &TakeLease::whoever, Presence::Checked),
                                             field("timeout", &TakeLease::timeout, Presence::Checked, timeoutRange),
                                             field("takeOver", &TakeLease::takeOver, Presence::WhenSet));
};

struct ReleaseLease
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::ReleaseLease;
    using Answer = Done;
    std::optional<QStringList> signals;  // without it all that the asker holds

    static constexpr auto fields = fieldList(field("signals", &ReleaseLease::signals, Presence::Checked));
};

}  // namespace qplc::messages
