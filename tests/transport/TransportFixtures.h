// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "transport/CyclicHub.h"
#include "transport/CyclicLink.h"
#include "transport/FrameCutter.h"
#include "transport/SocketAddress.h"

#include <QtCore/QByteArray>
#include <QtTest/QTest>

#include <cstring>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

/// Frames of the transport tests: one byte 'F', one byte with the length of the whole, then
/// anything. Transports know no other frames than those that a cutter shows them.
inline std::size_t toyFrameSize(const void *, const char *header)
{
    return header[0] == 'F' ? std::size_t(static_cast<unsigned char>(header[1])) : 0;
}

constexpr qplc::FrameCutter toyCutter{2, &toyFrameSize, nullptr};
constexpr std::size_t LargestToyFrame = 255;

inline QByteArray toyFrame(int size, char fill = 'x')
{
    QByteArray frame(size, fill);
    frame[0] = 'F';
    frame[1] = char(size);
    return frame;
}

/// Two connected stream sockets of this process.
struct StreamPair
{
    StreamPair() { ok = ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0; }
    ~StreamPair()
    {
        closeEnd(0);
        closeEnd(1);
    }
    /// Gives an end to somebody who will close it.
    int take(int end) { return std::exchange(ends[end], -1); }
    void closeEnd(int end)
    {
        if (ends[end] >= 0)
            ::close(take(end));
    }
    void write(const QByteArray &bytes) const
    {
        QCOMPARE(::send(ends[1], bytes.constData(), std::size_t(bytes.size()), MSG_NOSIGNAL), ssize_t(bytes.size()));
    }
    QByteArray readAll(int end = 1) const
    {
        QByteArray all;
        char bytes[4096];
        for (ssize_t count; (count = ::recv(ends[end], bytes, sizeof bytes, MSG_DONTWAIT)) > 0;)
            all.append(bytes, int(count));
        return all;
    }
    int ends[2] = {-1, -1};
    bool ok = false;
};

/// A UDP socket on a free loopback port.
struct UdpSocket
{
    explicit UdpSocket(const QHostAddress &address = QHostAddress(QHostAddress::LocalHost))
    {
        const qplc::SocketAddress any(address, 0);
        descriptor = ::socket(any.family(), SOCK_DGRAM | SOCK_CLOEXEC, 0);
        ok = ::bind(descriptor, any.data(), any.length) == 0;
        self.length = sizeof self.storage;
        ::getsockname(descriptor, self.data(), &self.length);
    }
    ~UdpSocket() { ::close(descriptor); }
    UdpSocket(const UdpSocket &) = delete;
    UdpSocket &operator=(const UdpSocket &) = delete;
    bool send(const QByteArray &bytes, const qplc::SocketAddress &to) const
    {
        return ::sendto(descriptor, bytes.constData(), std::size_t(bytes.size()), 0, to.data(), to.length)
            == bytes.size();
    }
    QByteArray receive(int flags = 0) const
    {
        char bytes[65536];
        const ssize_t count = ::recv(descriptor, bytes, sizeof bytes, flags);
        return count < 0 ? QByteArray("nothing") : QByteArray(bytes, int(count));
    }
    int descriptor = -1;
    qplc::SocketAddress self;
    bool ok = false;
};
