// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "State.h"

/// What a recorder on another computer reads: docs/protocol.md, section 9.11.
namespace qplc::messages {

/// A part of a ring: bytes that are numbered from 0, by their place.
enum class RingPart : quint8 {
    Description,  ///< text, which does not change
    Cycles,       ///< records of cycles
    Texts         ///< records of what people and programs did
};

template<>
struct Names<RingPart>
{
    static constexpr std::pair<RingPart, const char *> all[]
        = {{RingPart::Description, "description"}, {RingPart::Cycles, "cycles"}, {RingPart::Texts, "texts"}};
};

struct Records
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Records;
    QString ring;  // empty: there is none
    RingPart part = RingPart::Cycles;
    Hex64 from;        // place of the first of `bytes`
    QByteArray bytes;  // fewer than were asked for, where the master has no more, or limits them
    Hex64 head;        // behind all bytes of this part that are written
    Hex64 capacity;    // [byte] of this part in the ring
    Hex64 startTime;   // of cycle 0 [ns since 1970]; 0: not yet, or the clock is not timed

    static constexpr auto fields
        = fieldList(field("ring", &Records::ring), field("part", &Records::part), field("from", &Records::from),
                    field("bytes", &Records::bytes), field("head", &Records::head),
                    field("capacity", &Records::capacity), field("startTime", &Records::startTime));
};

struct GetRecords
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::GetRecords;
    using Answer = Records;
    static constexpr quint64 most = 65536;  // [byte] in one answer
    QString ring;                           // empty: the newest one
    RingPart part = RingPart::Cycles;
    std::optional<Hex64> from;   // none: where a new recorder begins
    std::optional<Hex64> saved;  // all before is in a file: the ring may replace it
    quint64 bytes = most;
    bool ends = false;  // this recorder needs no more of this ring
    std::optional<RecorderEntry> recorder;

    static constexpr auto fields = fieldList(
        field("ring", &GetRecords::ring, Presence::Checked), field("part", &GetRecords::part, Presence::Checked),
        field("from", &GetRecords::from, Presence::Checked), field("saved", &GetRecords::saved, Presence::Checked),
        field("bytes", &GetRecords::bytes, Presence::Checked, {0, double(most)}),
        field("ends", &GetRecords::ends, Presence::WhenSet),
        field("recorder", &GetRecords::recorder, Presence::WhenSet));
};

}  // namespace qplc::messages
