// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanBus.h"
#include "WallTimeConverter.h"

#include <array>
#include <ctime>
#include <linux/can.h>
#include <sys/socket.h>

namespace qplc {

/// A CAN interface of the kernel, by a raw socket.
class SocketCanBus : public CanBus
{
public:
    explicit SocketCanBus(const QString &interface);
    ~SocketCanBus() override;

    static bool isName(const QString &interface);

    void close() override;
    int descriptor() const override { return m_socket; }

protected:
    bool join(const Options &options) override;
    int readFrames(CanFrame *frames, int capacity) noexcept override;
    int writeFrames(const CanFrame *frames, int count) noexcept override;

private:
    static constexpr int BatchSize = 64;

    bool makeSocket();
    bool findInterface(bool needsFd);
    bool setOptions();
    bool setFilters(const Options &options);
    bool bindSocket();
    bool setOption(int level, int name, const void *value, socklen_t size, const char *what);
    bool failWith(const QString &what, const QString &remedy);
    void lookAtClocks() noexcept;
    int convert(int received, CanFrame *frames) noexcept;
    qint64 readControl(msghdr *message) noexcept;

    const QString m_interface;
    int m_socket = -1;
    int m_index = 0;        // of the interface
    bool m_isFd = false;    // the interface can do CAN FD
    quint32 m_dropped = 0;  // frames that found no room in the queue of the socket, as the kernel counts them
    WallTimeConverter m_clock;

    std::array<canfd_frame, BatchSize> m_frames{};
    std::array<iovec, BatchSize> m_parts{};
    std::array<mmsghdr, BatchSize> m_messages{};
    struct Control
    {
        alignas(cmsghdr) char bytes[CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(quint32))];
    };
    std::array<Control, BatchSize> m_control{};
};

}  // namespace qplc
