// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

namespace qplc {

/// Sends \a count datagrams over loopback to a thread that sends them back, one after the other,
/// and tells how long each one took.
/// \param now  a clock [ns] \param onRoundTrip  is called for each datagram that came back [ns]
/// \return false when there is no socket, or a datagram did not come back within 0.1 s
bool probeLoopback(int count, const std::function<std::int64_t()> &now,
                   const std::function<void(std::int64_t)> &onRoundTrip);

}  // namespace qplc
