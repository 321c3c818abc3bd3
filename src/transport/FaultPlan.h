// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <cstdint>
#include <optional>

namespace qplc {

/// What a network does to frames, for tests: which of them get lost, come twice, late, out of
/// order, or with wrong bits. A value type.
///
/// As text: words `key=value` with commas between them, for example
/// `loss=5%,delay=2ms,jitter=500us,seed=7`.
///   loss, duplicate, reorder, corrupt   share of the frames, 0% ... 100%
///   delay, jitter                       0 ... 10s (ns, us, ms, s); a frame is late by delay, and by up
///                                       to jitter more
///   cut=BEGIN[+LENGTH[/PERIOD]]         nothing passes from BEGIN after the first frame on, for
///                                       LENGTH (else for good), again each PERIOD
///   seed                                0 ... 2^64 - 1, 1 unless said: the same seed gives the
///                                       same faults to the same frames
/// With -sent or -received behind its name (loss-sent=5%) a word holds for this direction, as the
/// program sees it; without it for both.
struct FaultPlan
{
    struct Direction
    {
        double loss = 0.0;  // probabilities, 0 ... 1
        double duplicate = 0.0;
        double reorder = 0.0;
        double corrupt = 0.0;
        std::int64_t delay = 0;      // [ns]
        std::int64_t jitter = 0;     // [ns]
        std::int64_t cutBegin = -1;  // [ns] after the first frame; -1: never
        std::int64_t cutLength = 0;  // [ns]; 0: for good
        std::int64_t cutPeriod = 0;  // [ns]; 0: once

        bool isNothing() const;
        /// Whether nothing passes \a elapsed [ns] after the first frame.
        bool isCut(std::int64_t elapsed) const noexcept;
    };

    Direction sent;
    Direction received;
    std::uint64_t seed = 1;

    /// \return nothing, with the word that is wrong and the remedy in \a error
    static std::optional<FaultPlan> fromText(const QString &text, QString *error);
};

}  // namespace qplc
