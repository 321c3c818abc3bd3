// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Descriptor.h"

#include <QtCore/QSocketNotifier>
#include <QtCore/QString>
#include <QtCore/QTimer>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace qplc {

/// Passes descriptors to local nodes of the same user: the end of the master.
///
/// A node connects and sends a key before it registers, and names the key in its Register. So its
/// connection is there when the master looks for it, and nobody waits for anybody. Connections of
/// other users are closed without being read. Thread of the master.
class LocalListener
{
public:
    /// Most connections that wait for their registration; then the oldest one is closed. All nodes
    /// of a computer may start at once.
    static constexpr std::size_t MaximumWaiting = 256;

    /// Listens for nodes of the master with this session. \return false, with the reason in \a
    /// error
    bool open(std::uint64_t session, QString *error);
    void close();
    /// Sends \a descriptors to the node that has sent \a key, and ends its connection.
    /// \return false, with the reason in \a error
    bool pass(std::uint64_t key, const std::vector<int> &descriptors, QString *error);
    /// Connections that wait for their registration.
    std::size_t waiting() const { return m_waiting.size(); }

private:
    struct Waiting
    {
        Descriptor socket;
        std::int64_t since = 0;
        std::optional<std::uint64_t> key;
    };

    void acceptAll();
    void readKeys();
    void startClock();
    void dropOld();

    Descriptor m_socket;
    std::unique_ptr<QSocketNotifier> m_notifier;
    std::unique_ptr<QTimer> m_clock;  // of the thread that has called open()
    std::vector<Waiting> m_waiting;   // the oldest one is the first
};

}  // namespace qplc
