// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSignalDefinition.h"
#include "QPlcSignalTable.h"
#include "node/cycle/Roster.h"
#include "protocol/messages/Leases.h"

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace qplc {

/// Who has taken over which signal: at most one holder for each, who must be heard of before a
/// deadline. Bookkeeping only: looks at no clock, sets no signal. Times are ns on any steady clock.
class Leases
{
public:
    using Holder = const void *;
    using Signals = std::vector<QPlcSignalIndex>;

    struct Lease
    {
        Holder holder = nullptr;          // null: lost
        QString name;                     // of the holder, of a lost lease that of the last one
        std::int64_t timeout = 0;         // longest silence of the holder
        std::shared_ptr<LeaseTerm> term;  // its end without a word of the holder; cycles keep it, too
        bool isLost() const { return holder == nullptr; }
        messages::LeaseState state() const
        {
            return isLost() ? messages::LeaseState::Lost : messages::LeaseState::Held;
        }
    };

    /// Gives \a signals to \a holder, whoever had them.
    void take(const Signals &signals, Holder holder, const QString &name, std::int64_t timeout, std::int64_t now);
    void release(const Signals &signals);
    /// \a holder was heard of. What is over by then stays over.
    void renew(Holder holder, std::int64_t now);
    /// Loses the leases whose holder was silent for too long. \return their signals
    Signals loseSilent(std::int64_t now);
    /// Loses the leases of \a holder, who is gone. \return their signals
    Signals loseAllOf(Holder holder);

    /// null: nobody has taken it.
    const Lease *find(QPlcSignalIndex signal) const;
    bool isHeldBy(QPlcSignalIndex signal, Holder holder) const;
    /// Whether somebody else than \a holder has it, and is not lost.
    bool isHeldByOther(QPlcSignalIndex signal, Holder holder) const;
    Signals signalsOf(Holder holder) const;
    /// When the next lease is lost without a word of its holder; none: there is nothing to lose.
    std::optional<std::int64_t> nextDeadline() const;
    /// By index, up to the last one that is taken; lost ones too.
    std::vector<bool> mask() const;
    /// For the cycles.
    std::vector<Roster::HeldTerm> terms() const;
    const std::map<QPlcSignalIndex, Lease> &all() const { return m_leases; }

private:
    template<typename Predicate>
    Signals lose(Predicate isLost);

    std::map<QPlcSignalIndex, Lease> m_leases;
};

}  // namespace qplc
