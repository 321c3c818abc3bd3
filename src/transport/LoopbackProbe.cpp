// SPDX-License-Identifier: Apache-2.0
#include "LoopbackProbe.h"

#include <array>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <thread>
#include <unistd.h>

namespace qplc {

namespace {

constexpr std::size_t datagramSize = 64;
constexpr suseconds_t patience = 100'000;  // [us]

/// A UDP socket on a free port of loopback that waits 0.1 s for a datagram.
class LoopbackSocket
{
public:
    LoopbackSocket()
        : m_descriptor(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0))
    {
        const timeval timeout{0, patience};
        ::setsockopt(m_descriptor, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
        m_address.sin_family = AF_INET;
        m_address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof m_address;
        m_isGood = ::bind(m_descriptor, reinterpret_cast<const sockaddr *>(&m_address), size) == 0
            && ::getsockname(m_descriptor, reinterpret_cast<sockaddr *>(&m_address), &size) == 0;
    }
    ~LoopbackSocket()
    {
        if (m_descriptor >= 0)
            ::close(m_descriptor);
    }
    LoopbackSocket(const LoopbackSocket &) = delete;
    LoopbackSocket &operator=(const LoopbackSocket &) = delete;

    /// From here on datagrams go to and come from \a other only.
    bool connectTo(const LoopbackSocket &other)
    {
        return m_isGood && other.m_isGood
            && ::connect(m_descriptor, reinterpret_cast<const sockaddr *>(&other.m_address), sizeof other.m_address)
            == 0;
    }
    bool send() { return ::send(m_descriptor, m_datagram.data(), m_datagram.size(), 0) == ssize_t(datagramSize); }
    bool receive() { return ::recv(m_descriptor, m_datagram.data(), m_datagram.size(), 0) == ssize_t(datagramSize); }

private:
    int m_descriptor;
    bool m_isGood = false;
    sockaddr_in m_address{};
    std::array<char, datagramSize> m_datagram{};
};

}  // namespace

bool probeLoopback(int count, const std::function<std::int64_t()> &now,
                   const std::function<void(std::int64_t)> &onRoundTrip)
{
    LoopbackSocket here;
    LoopbackSocket there;
    if (!here.connectTo(there) || !there.connectTo(here))
        return false;
    std::thread mirror([&there, count] {
        for (int i = 0; i < count && there.receive(); ++i)
            there.send();
    });
    int done = 0;
    for (; done < count; ++done) {
        const std::int64_t sent = now();
        if (!here.send() || !here.receive())
            break;
        onRoundTrip(now() - sent);
    }
    mirror.join();
    return done == count;
}

}  // namespace qplc
