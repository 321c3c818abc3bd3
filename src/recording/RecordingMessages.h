// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "node/cycle/RingReader.h"

#include <QtCore/QByteArray>

#include <optional>
#include <vector>

namespace qplc {

/// Messages of a recording beside those of /plant, written and read:
/// docs/design/recording-format.md.

/// The channels of what has happened, in the order of RecordedText::Topic and of Happening::Topic.
constexpr const char *happeningChannels[] = {"/events", "/commands", "/leases", "/statistics"};

/// The description of a message of /nodes, as a file of ROS says it.
QByteArray nodesSchema();
/// The message of /nodes: what the master has exchanged with each node in the cycle of \a view.
QByteArray nodesMessage(const CycleView &view);
/// Reads a message of /nodes. RecordedNode::cycle is an age [cycles], as ageOf() says.
/// \return false when it is not such a message
bool readNodes(const QByteArray &message, std::vector<RecordedNode> *nodes);
/// The age in the cycle \a number of the request \a cycle, or the request of an age: both are the
/// difference. NoCycle stays what it is.
std::uint64_t ageOf(std::uint64_t cycle, std::uint64_t number);

/// The message of /gaps.
QByteArray gapMessage(const RecordedGap &gap);
/// Reads a message of /gaps; what is not in it is 0. \return false when it does not say where the
/// gap ends
bool readGap(const QByteArray &message, RecordedGap *gap);

/// 16 hexadecimal digits.
QByteArray digestText(std::uint64_t digest);
/// The number behind "key": in a message that a recorder has written as JSON.
std::optional<std::uint64_t> numberIn(const QByteArray &message, const QByteArray &key, int base = 10);

}  // namespace qplc
