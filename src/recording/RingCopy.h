// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "node/cycle/RecordLayout.h"
#include "node/cycle/RingMemory.h"
#include "protocol/messages/Records.h"

#include <array>
#include <optional>

namespace qplc {

/// The ring of a master on another computer, copied into one of this computer as fast as a recorder
/// here puts it to safety. A recorder reads the copy like any ring: its bytes have the same places.
///
/// It sleeps, waits and asks nobody: it says what to ask the master, and takes the answers. So a
/// test needs neither time nor a network.
///
/// For one thread.
class RingCopy
{
public:
    static constexpr std::int64_t LookForRings = 200'000'000;   // [ns] between two questions for a ring
    static constexpr std::int64_t LookForRecords = 50'000'000;  // [ns] likewise for records, when there were none
    static constexpr std::int64_t ReportEach = 1'000'000'000;   // [ns]

    enum State : std::uint8_t {
        Looking,   ///< the master has no ring
        Opening,   ///< the master tells what the ring is
        Ready,     ///< file() is there, for a recorder
        Ended,     ///< the master knows that the recorder needs no more of this ring
        Abandoned  ///< the master has this ring no more: the recorder gets what has come
    };

    /// \param computer  the name of this one, for people at the master
    explicit RingCopy(const QString &computer);
    /// Deletes the file, if a recorder has not done so.
    ~RingCopy();
    RingCopy(const RingCopy &) = delete;
    RingCopy &operator=(const RingCopy &) = delete;

    /// Deletes the copies of recorders that were killed. What is in no file is still in the ring of
    /// the master.
    static void removeDead();

    State state() const { return m_state; }
    QByteArray file() const { return m_file; }

    /// What to ask the master now. Nothing: it is too early, or the last question has no answer
    /// yet.
    std::optional<messages::GetRecords> question(std::int64_t now);
    /// \return false: it is no answer to the question. This copy cannot go on then
    bool take(const messages::Records &answer, std::int64_t now, QString *error);
    /// The question will have no answer.
    void forgetQuestion() { m_asked.reset(); }
    void abandon();
    /// The recorder wants no more of this ring. \return what to tell the master
    messages::GetRecords end();

private:
    struct Part
    {
        RingRegion region;
        std::uint64_t received = 0;           // place behind all that has come
        std::uint64_t base = 0;               // where the copy begins
        std::uint64_t capacity = 0;           // in the ring of the master [byte]
        std::int64_t due = 0;                 // [ns]
        std::optional<std::uint64_t> jump{};  // what comes next when all before is in safety
        bool hasBegun = false;

        std::uint64_t saved() const;
        void leap();
    };

    std::optional<messages::GetRecords> openingQuestion(std::int64_t now);
    std::optional<messages::GetRecords> recordsQuestion(std::int64_t now);
    bool takeName(const messages::Records &answer, QString *error);
    bool takeDescription(const messages::Records &answer, QString *error);
    bool beginPart(Part *part, const messages::Records &answer, QString *error);
    bool takeRecords(Part *part, const messages::Records &answer, std::int64_t now, QString *error);
    bool make(QString *error);
    bool commit(Part *part, QString *error);
    void addReport(messages::GetRecords *question, std::int64_t now);

    const QString m_computer;
    State m_state = Looking;
    QString m_ring;
    QByteArray m_file;
    QByteArray m_description;
    std::optional<std::uint64_t> m_descriptionSize;
    RingMemory m_memory;
    std::array<Part, 2> m_parts;  // cycles, texts
    std::size_t m_next = 0;       // of them, that is asked next
    std::optional<messages::GetRecords> m_asked;
    std::int64_t m_due = 0;       // of the next question for a ring [ns]
    std::int64_t m_reported = 0;  // [ns]
    bool m_isRecorded = false;    // a recorder is attached
    bool m_isEnding = false;      // the master does not know yet that there is none any more
    bool m_hasEnd = false;        // no cycles follow
};

}  // namespace qplc
