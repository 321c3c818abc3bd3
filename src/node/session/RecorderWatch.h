// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "node/cycle/RecordRing.h"
#include "node/statistics/Journal.h"
#include "protocol/messages/State.h"

#include <QtCore/QTimer>

#include <functional>
#include <memory>
#include <optional>

namespace qplc {

/// Looks once a second what the recorder of the phase does: what it says in the header of the ring,
/// whether it says anything at all, and how many cycles nobody has recorded. Trouble is an alarm in
/// the journal, which also tells when it is over.
///
/// Threads: that of the master.
class RecorderWatch
{
public:
    /// A recorder that says nothing for so long stalls [ns]: it speaks each second.
    static constexpr std::int64_t Patience = 5'000'000'000;

    /// \param missing  cycles of the phase at hand that have no record
    RecorderWatch(Journal &journal, std::function<std::uint64_t()> missing);

    /// Of a phase that is about to begin. Null: it has no ring.
    void watch(const std::shared_ptr<RecordRing> &ring);
    /// What there was at the last look. Nothing: there was no ring yet.
    const std::optional<messages::RecorderEntry> &status() const { return m_status; }
    /// Done each second. \param now [ns] on the monotonic clock
    void look(std::int64_t now);

private:
    messages::RecorderState stateOf(const RecordRing &ring, const RecorderReport &report, std::int64_t now);
    void tellState(messages::RecorderState before);
    void tellMissing(std::uint64_t before);

    Journal &m_journal;
    std::function<std::uint64_t()> m_missing;
    std::weak_ptr<RecordRing> m_ring;
    std::optional<messages::RecorderEntry> m_status;
    QTimer m_timer;
    std::uint64_t m_version = 0;  // of the newest report
    std::int64_t m_changed = 0;   // when it came [ns]
    bool m_isMissingTold = false;
};

}  // namespace qplc
