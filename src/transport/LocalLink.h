// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CyclicLink.h"
#include "SharedChannel.h"

#include <QtCore/QString>

#include <array>
#include <memory>
#include <sys/types.h>

namespace qplc {

/// What a master on this machine names for a link, each as "/proc/PID/fd/N".
struct LocalPaths
{
    QString channel;   // memory of a SharedChannel
    QString doorbell;  // memory of a Doorbell
    QString pipe;      // what wakes the master
};

/// Memory that a node shares with its master.
class LocalLink final : public CyclicLink
{
public:
    /// Opens only sealed memory and a pipe that belong to \a owner, the user of the master: see
    /// PeerFile. Null, with the reason in \a error, when they cannot be opened.
    static std::unique_ptr<CyclicLink> open(const LocalPaths &paths, uid_t owner, QString *error);

    Status receive(const char **frame, std::size_t *size) noexcept override;
    Status poll(const char **frame, std::size_t *size) noexcept override;
    bool send(const char *frame, std::size_t size) noexcept override { return channel()->outputs.push(frame, size); }
    void flush() noexcept override { static_cast<Doorbell *>(m_bell.data())->ring(m_descriptor); }

private:
    LocalLink()
        : CyclicLink(-1)
    {
    }
    bool openAll(const LocalPaths &paths, uid_t owner, QString *error);
    SharedChannel *channel() const noexcept { return static_cast<SharedChannel *>(m_memory.data()); }

    SharedMemory m_memory;
    SharedMemory m_bell;
    std::array<char, 2048> m_frame{};
};

}  // namespace qplc
