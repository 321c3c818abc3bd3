// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CyclicLink.h"
#include "LocalConnection.h"
#include "SharedChannel.h"

#include <array>
#include <memory>

namespace qplc {

/// Memory that a node shares with its master, which passes it while the node registers.
class LocalLink final : public CyclicLink
{
public:
    /// Connects to the master with this session. \return null, with the reason in \a error
    static std::unique_ptr<LocalLink> begin(std::uint64_t session, QString *error);
    /// To be named in Register.
    std::uint64_t key() const { return m_connection.key(); }
    /// Takes what the master has passed with its Registered: only sealed memory that fits \a
    /// volume, and a pipe on which no write waits.
    /// \return false, with the reason in \a error
    bool finish(const CycleVolume &volume, QString *error);

    Status receive(const char **frame, std::size_t *size) noexcept override;
    Status poll(const char **frame, std::size_t *size) noexcept override;
    bool send(const char *frame, std::size_t size) noexcept override { return m_channel.outputs.push(frame, size); }
    void flush() noexcept override { static_cast<Doorbell *>(m_bell.data())->ring(m_descriptor); }

private:
    LocalLink()
        : CyclicLink(-1)
    {
    }

    LocalConnection m_connection;
    SharedChannel m_channel;
    SharedMemory m_bell;
    std::array<char, 2048> m_frame{};
};

}  // namespace qplc
