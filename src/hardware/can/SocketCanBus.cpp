// SPDX-License-Identifier: Apache-2.0
#include "CanBus.h"
#include "CanLink.h"
#include "WallTimeConverter.h"
#include "realtime/TimeSource.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <limits>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <linux/sock_diag.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace qplc {

namespace {

constexpr int canQueueSize = 4 << 20;  // [byte] some thousand frames

// What is told of errors; each of the others can come with every frame.
constexpr can_err_mask_t canErrorKinds = CAN_ERR_TX_TIMEOUT | CAN_ERR_CRTL | CAN_ERR_TRX | CAN_ERR_ACK | CAN_ERR_BUSOFF
    | CAN_ERR_BUSERROR | CAN_ERR_RESTARTED;

ifreq requestFor(const QString &interface)
{
    ifreq request;
    std::memset(&request, 0, sizeof request);
    const QByteArray name = interface.toLocal8Bit();
    std::memcpy(request.ifr_name, name.constData(), std::min(size_t(name.size()), sizeof request.ifr_name - 1));
    return request;
}

can_filter filterFor(quint32 key)
{
    can_filter filter;
    filter.can_id = key;  // the bit for 29 bits is that of the kernel
    filter.can_mask = CAN_EFF_FLAG | ((key & CAN_EFF_FLAG) ? CAN_EFF_MASK : CAN_SFF_MASK);
    return filter;
}

can_filter filterForGroup(quint32 group)
{
    can_filter filter;
    filter.can_id = group << 8 | CAN_EFF_FLAG;
    filter.can_mask = CAN_EFF_FLAG | (CanFrame::isForOneNode(group) ? 0x3FF0000U : 0x3FFFF00U);
    return filter;
}

canfd_frame kernelFrame(const CanFrame &frame)
{
    canfd_frame result;
    std::memset(&result, 0, sizeof result);
    result.can_id = frame.key();
    if (frame.has(CanFrame::Remote))
        result.can_id |= CAN_RTR_FLAG;
    if (frame.has(CanFrame::Error))
        result.can_id |= CAN_ERR_FLAG;
    if (frame.has(CanFrame::Fd))
        result.flags = quint8((frame.has(CanFrame::BitRateSwitch) ? CANFD_BRS : 0)
                              | (frame.has(CanFrame::ErrorPassive) ? CANFD_ESI : 0));
    result.len = frame.size;
    if (!frame.has(CanFrame::Remote))
        std::memcpy(result.data, frame.data.data(), frame.size);
    return result;
}

CanFrame frameOfKernel(const canfd_frame &frame, bool isFd)
{
    CanFrame result;
    const bool isError = (frame.can_id & CAN_ERR_FLAG) != 0;
    const bool isExtended = (frame.can_id & CAN_EFF_FLAG) != 0 && !isError;
    result.id = frame.can_id & (isExtended || isError ? CAN_EFF_MASK : CAN_SFF_MASK);
    result.flags = quint8((isExtended ? CanFrame::Extended : 0) | (isError ? CanFrame::Error : 0)
                          | ((frame.can_id & CAN_RTR_FLAG) && !isError ? CanFrame::Remote : 0));
    if (isFd)
        result.flags |= quint8(CanFrame::Fd | ((frame.flags & CANFD_BRS) ? CanFrame::BitRateSwitch : 0)
                               | ((frame.flags & CANFD_ESI) ? CanFrame::ErrorPassive : 0));
    result.size = std::min<quint8>(frame.len, isFd ? CANFD_MAX_DLEN : CAN_MAX_DLEN);
    if (!result.has(CanFrame::Remote))
        std::memcpy(result.data.data(), frame.data, result.size);
    return result;
}

// The interface has no room now; the next frames may find some.
bool isCanQueueFull(int error)
{
    return error == ENOBUFS || error == EAGAIN || error == EWOULDBLOCK || error == ENOMEM;
}

/// A CAN interface of the kernel, by a raw socket.
class SocketCanBus final : public CanBus
{
public:
    explicit SocketCanBus(const QString &interface)
        : m_interface(interface)
    {
    }

    ~SocketCanBus() override { SocketCanBus::close(); }

    void close() override
    {
        if (m_socket >= 0)
            ::close(m_socket);
        m_socket = -1;
    }

    int descriptor() const override { return m_socket; }

protected:
    bool join(const Options &options) override
    {
        close();
        m_dropped = 0;
        if (makeSocket() && findInterface(options.needsFd) && setOptions() && lookAtLink(options) && setFilters(options)
            && bindSocket()) {
            lookAtClocks();
            m_clock.drained(monotonicNow());
            return true;
        }
        close();
        return false;
    }

    int readFrames(CanFrame *frames, int capacity) noexcept override
    {
        const qint64 begin = monotonicNow();
        int count = 0;
        while (count < capacity) {
            const int wanted = std::min(capacity - count, BatchSize);
            for (int i = 0; i < wanted; ++i) {
                m_parts[i] = {&m_frames[i], sizeof m_frames[i]};
                m_messages[i].msg_hdr = {nullptr, 0, &m_parts[i], 1, &m_control[i], sizeof m_control[i], 0};
            }
            const int received = recvmmsg(m_socket, m_messages.data(), unsigned(wanted), MSG_DONTWAIT, nullptr);
            if (received < 0 && errno == EINTR)
                continue;
            if (received < 0 && errno != EAGAIN && errno != EWOULDBLOCK)
                return count > 0 ? count : lose(errno);  // told again at the next call
            if (received > 0)
                lookAtClocks();
            count += convert(std::max(received, 0), frames + count);
            if (received < wanted) {
                m_clock.drained(begin);
                break;
            }
        }
        return count;
    }

    // Memory of frames that no controller has taken yet.
    bool hasQueue() const noexcept override
    {
        std::array<quint32, SK_MEMINFO_VARS> memory{};
        socklen_t size = sizeof memory;
        return getsockopt(m_socket, SOL_SOCKET, SO_MEMINFO, memory.data(), &size) == 0
            && memory[SK_MEMINFO_WMEM_ALLOC] > 0;
    }

    int writeFrames(const CanFrame *frames, int count) noexcept override
    {
        int sent = 0;
        while (sent < count) {
            const int wanted = std::min(count - sent, BatchSize);
            for (int i = 0; i < wanted; ++i) {
                const CanFrame &frame = frames[sent + i];
                m_frames[i] = kernelFrame(frame);
                m_parts[i] = {&m_frames[i], size_t(frame.has(CanFrame::Fd) ? CANFD_MTU : CAN_MTU)};
                m_messages[i].msg_hdr = {nullptr, 0, &m_parts[i], 1, nullptr, 0, 0};
            }
            const int given = sendmmsg(m_socket, m_messages.data(), unsigned(wanted), MSG_DONTWAIT);
            if (given < 0 && errno == EINTR)
                continue;
            if (given < 0)
                return isCanQueueFull(errno) || sent > 0 ? sent : lose(errno);
            sent += given;
            // A short count says that the next frame met an error; the next call of sendmmsg()
            // tells which.
        }
        return sent;
    }

private:
    static constexpr int BatchSize = 64;

    bool makeSocket()
    {
        m_socket = socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
        return m_socket >= 0
            || failWith(QStringLiteral("the kernel does not support CAN"),
                        QStringLiteral("load its modules as root: modprobe can_raw, and that of the adapter"));
    }

    bool findInterface(bool needsFd)
    {
        ifreq request = requestFor(m_interface);
        if (ioctl(m_socket, SIOCGIFINDEX, &request) < 0)
            return failWith(QStringLiteral("there is no such interface"),
                            QStringLiteral("plug in the adapter and load its module; 'ip link' lists what there is"));
        m_index = request.ifr_ifindex;
        if (ioctl(m_socket, SIOCGIFHWADDR, &request) < 0 || request.ifr_hwaddr.sa_family != ARPHRD_CAN)
            return fail(
                QStringLiteral("%1 is not a CAN interface; give one of those that 'ip link show type can' lists")
                    .arg(m_interface));
        m_isFd = ioctl(m_socket, SIOCGIFMTU, &request) == 0 && request.ifr_mtu >= int(CANFD_MTU);
        if (needsFd && !m_isFd)
            return fail(
                QStringLiteral("%1 is not set up for CAN FD, which messages of the configuration use; as root: ip "
                               "link set %1 down, ip link set %1 up type can bitrate 500000 dbitrate 2000000 fd on")
                    .arg(m_interface));
        if (ioctl(m_socket, SIOCGIFFLAGS, &request) < 0 || !(request.ifr_flags & IFF_UP))
            return fail(QStringLiteral("%1 is down; as root: ip link set %1 up type can bitrate 500000 restart-ms 100 "
                                       "(with the bit rate of the bus)")
                            .arg(m_interface));
        return (request.ifr_flags & IFF_RUNNING)
            || fail(QStringLiteral("%1 is bus-off; check wires, terminators and bit rate, then as root: ip link set %1 "
                                   "type can restart (with restart-ms 100 the kernel does it by itself)")
                        .arg(m_interface));
    }

    bool setOptions()
    {
        const int on = 1;
        // The larger queue is a wish: only root gets more than net.core.rmem_max.
        if (setsockopt(m_socket, SOL_SOCKET, SO_RCVBUFFORCE, &canQueueSize, sizeof canQueueSize) != 0)
            setsockopt(m_socket, SOL_SOCKET, SO_RCVBUF, &canQueueSize, sizeof canQueueSize);
        return (!m_isFd || setOption(SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on, "CAN FD"))
            && setOption(SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on, "time stamps")
            && setOption(SOL_SOCKET, SO_RXQ_OVFL, &on, sizeof on, "the counter of lost frames")
            && setOption(SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &canErrorKinds, sizeof canErrorKinds, "error frames");
    }

    /// A frame of this socket comes back to it when it has reached the bus. A one-shot controller
    /// keeps no frame, and does not tell of one that it drops.
    bool lookAtLink(const Options &options)
    {
        const int on = 1;
        const CanLink link = CanLink::read(m_index);
        setState(link.state);
        if (options.sentKeys.empty() || !link.hasEcho || link.isOneShot)
            return true;
        expectConfirmations();
        return setOption(SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, &on, sizeof on, "confirmations");
    }

    bool setFilters(const Options &options)
    {
        std::vector<can_filter> filters;
        for (const quint32 key : options.sentKeys)
            filters.push_back(filterFor(key));
        for (const quint32 key : options.keys)
            filters.push_back(filterFor(key));
        for (const quint32 group : options.groups)
            filters.push_back(filterForGroup(group));
        if (options.receivesAll || filters.size() > CAN_RAW_FILTER_MAX) {
            const can_filter all{0, 0};
            return setOption(SOL_CAN_RAW, CAN_RAW_FILTER, &all, sizeof all, "filters");
        }
        return setOption(SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(), socklen_t(filters.size() * sizeof(can_filter)),
                         "filters");
    }

    bool bindSocket()
    {
        sockaddr_can address;
        std::memset(&address, 0, sizeof address);
        address.can_family = AF_CAN;
        address.can_ifindex = m_index;
        return bind(m_socket, reinterpret_cast<const sockaddr *>(&address), sizeof address) == 0
            || failWith(QStringLiteral("cannot be used"),
                        QStringLiteral("'ip link' lists the interfaces that there are"));
    }

    bool setOption(int level, int name, const void *value, socklen_t size, const char *what)
    {
        return setsockopt(m_socket, level, name, value, size) == 0
            || failWith(QStringLiteral("cannot set %1").arg(QLatin1String(what)),
                        QStringLiteral("the kernel is too old; use 5.4 or newer"));
    }

    bool failWith(const QString &what, const QString &remedy)
    {
        const int number = errno;
        return fail(QStringLiteral("%1: %2 (%3); %4")
                        .arg(m_interface, what, QString::fromLocal8Bit(std::strerror(number)), remedy));
    }

    /// Who is not run between two clocks takes their difference for that of the clocks: the closest
    /// of a few looks counts.
    void lookAtClocks() noexcept
    {
        constexpr int most = 4;
        constexpr qint64 close = 5'000;  // [ns]
        qint64 now = 0;
        qint64 wall = 0;
        qint64 closest = std::numeric_limits<qint64>::max();
        for (int i = 0; i < most && closest > close; ++i) {
            const qint64 before = monotonicNow();
            const qint64 between = wallClockNow();
            const qint64 distance = monotonicNow() - before;
            if (distance < closest) {
                closest = distance;
                now = before + distance / 2;
                wall = between;
            }
        }
        m_clock.look(now, wall);
    }

    // Returns the number of frames received. Data whose size fits no frame does not count, nor
    // do frames of this socket that have reached the bus.
    int convert(int received, CanFrame *frames) noexcept
    {
        int count = 0;
        for (int i = 0; i < received; ++i) {
            const qint64 time = readControl(&m_messages[i].msg_hdr);
            const unsigned size = m_messages[i].msg_len;
            if (m_messages[i].msg_hdr.msg_flags & MSG_CONFIRM) {
                confirm(1);
                continue;
            }
            if (size != CAN_MTU && size != CANFD_MTU)
                continue;
            frames[count] = frameOfKernel(m_frames[i], size == CANFD_MTU);
            frames[count].time = time;
            ++count;
        }
        return count;
    }

    // Returns when the frame came in [ns].
    qint64 readControl(msghdr *message) noexcept
    {
        qint64 time = 0;
        for (cmsghdr *part = CMSG_FIRSTHDR(message); part; part = CMSG_NXTHDR(message, part)) {
            if (part->cmsg_level != SOL_SOCKET)
                continue;
            if (part->cmsg_type == SO_TIMESTAMPNS) {
                timespec stamp;
                std::memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
                time = qint64(stamp.tv_sec) * NanosecondsPerSecond + stamp.tv_nsec;
            } else if (part->cmsg_type == SO_RXQ_OVFL) {
                quint32 dropped = 0;
                std::memcpy(&dropped, CMSG_DATA(part), sizeof dropped);
                countLost(quint32(dropped - m_dropped));
                if (dropped != m_dropped)
                    giveUpUnconfirmed();  // confirmations may be among them
                m_dropped = dropped;
            }
        }
        return m_clock.toMonotonic(time);
    }

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

}  // namespace

std::unique_ptr<CanBus> createSocketCanBus(const QString &interface)
{
    const auto isAllowed = [](QChar character) {
        return character > QLatin1Char(' ') && character < QChar(0x7F) && character != QLatin1Char('/')
            && character != QLatin1Char(':');
    };
    const bool isName = !interface.isEmpty() && interface.size() < IFNAMSIZ
        && std::all_of(interface.cbegin(), interface.cend(), isAllowed);
    return isName ? std::make_unique<SocketCanBus>(interface) : nullptr;
}

}  // namespace qplc
