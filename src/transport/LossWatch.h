// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace qplc {

/// Lets the kernel tell soon when the other end of a TCP connection is gone without a word: its
/// board has no power, or the wire is cut.
///
/// Left alone, a connection on which nothing is sent never ends, and one on which something is sent
/// ends after a quarter of an hour.
struct LossWatch
{
    static constexpr int Idle = 1;      // [s] of silence before the first question: cycles have a channel of their own
    static constexpr int Interval = 1;  // [s] between two questions
    static constexpr int Probes = 4;    // without an answer: a plug may be out of its socket for a moment
    static constexpr int Unacknowledged = 5000;  // [ms] of what was sent: as long as the questions take

    /// Watches the connection of \a descriptor from now on. What is no TCP connection stays as it
    /// is.
    static void begin(int descriptor);
    /// Not any more: for a stream that its reader may leave unread for as long as he likes.
    static void end(int descriptor);
};

}  // namespace qplc
