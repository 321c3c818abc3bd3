// SPDX-License-Identifier: Apache-2.0
#include "DescriptorMessage.h"

#include <cerrno>
#include <cstring>
#include <sys/socket.h>

namespace qplc {

namespace {

/// The memory in which the kernel takes and gives descriptors.
union ControlBuffer
{
    cmsghdr alignment;
    char bytes[CMSG_SPACE(DescriptorMessage::MaximumDescriptors * sizeof(int))];
};

/// All that have arrived: what is not wanted is closed, too.
std::vector<Descriptor> takeDescriptors(msghdr *message)
{
    std::vector<Descriptor> taken;
    for (cmsghdr *control = CMSG_FIRSTHDR(message); control; control = CMSG_NXTHDR(message, control)) {
        if (control->cmsg_level != SOL_SOCKET || control->cmsg_type != SCM_RIGHTS)
            continue;
        const std::size_t count = (control->cmsg_len - CMSG_LEN(0)) / sizeof(int);
        for (std::size_t i = 0; i < count; ++i) {
            int number = -1;
            std::memcpy(&number, CMSG_DATA(control) + i * sizeof number, sizeof number);
            taken.emplace_back(number);
        }
    }
    return taken;
}

}  // namespace

bool sendDescriptors(int socket, std::uint64_t key, const std::vector<int> &descriptors) noexcept
{
    iovec data{&key, sizeof key};
    ControlBuffer control{};
    msghdr message{};
    message.msg_iov = &data;
    message.msg_iovlen = 1;
    const std::size_t size = descriptors.size() * sizeof(int);
    if (size > 0) {
        message.msg_control = control.bytes;
        message.msg_controllen = CMSG_SPACE(size);
        cmsghdr *header = CMSG_FIRSTHDR(&message);
        header->cmsg_level = SOL_SOCKET;
        header->cmsg_type = SCM_RIGHTS;
        header->cmsg_len = CMSG_LEN(size);
        std::memcpy(CMSG_DATA(header), descriptors.data(), size);
    }
    return ::sendmsg(socket, &message, MSG_DONTWAIT | MSG_NOSIGNAL) == ssize_t(sizeof key);
}

std::optional<DescriptorMessage> receiveDescriptors(int socket)
{
    std::uint64_t key = 0;
    iovec data{&key, sizeof key};
    ControlBuffer control{};
    msghdr message{};
    message.msg_iov = &data;
    message.msg_iovlen = 1;
    message.msg_control = control.bytes;
    message.msg_controllen = sizeof control.bytes;
    const ssize_t count = ::recvmsg(socket, &message, MSG_DONTWAIT | MSG_CMSG_CLOEXEC);
    if (count < 0)
        return std::nullopt;
    DescriptorMessage received{key, takeDescriptors(&message)};
    if (count != ssize_t(sizeof key) || (message.msg_flags & (MSG_TRUNC | MSG_CTRUNC)) != 0) {
        const bool isClosed = count == 0 && received.descriptors.empty();
        received.descriptors.clear();  // close() may set errno
        errno = isClosed ? ECONNRESET : EBADMSG;
        return std::nullopt;
    }
    return received;
}

}  // namespace qplc
