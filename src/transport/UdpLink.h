// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CyclicLink.h"
#include "SocketAddress.h"

#include <array>
#include <memory>

namespace qplc {

/// A UDP socket that exchanges datagrams with one master only.
class UdpLink : public CyclicLink
{
public:
    /// Null, with the reason in \a error, when there is no socket to be had.
    static std::unique_ptr<CyclicLink> open(const SocketAddress &master, quint16 *localPort, QString *error);

    Status receive(const char **frame, std::size_t *size) noexcept override { return read(frame, size, 0); }
    Status poll(const char **frame, std::size_t *size) noexcept override;
    bool send(const char *frame, std::size_t size) noexcept override;

protected:
    explicit UdpLink(int descriptor)
        : CyclicLink(descriptor)
        , m_source(descriptor)
    {
    }
    /// Connects the socket to \a master, from a port of its own.
    bool connectTo(const SocketAddress &master, quint16 *localPort, QString *error);

    int m_source;  // where frames of the master come in

private:
    static constexpr std::size_t LargestDatagram = 2048;  // longer than every frame: what is cut off here is none

    Status read(const char **frame, std::size_t *size, int flags) noexcept;

    std::array<char, LargestDatagram> m_buffer;
};

}  // namespace qplc
