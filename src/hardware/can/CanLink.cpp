// SPDX-License-Identifier: Apache-2.0
#include "CanLink.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <linux/can/netlink.h>
#include <linux/if.h>
#include <linux/rtnetlink.h>
#include <sys/socket.h>
#include <unistd.h>

namespace qplc {

namespace {

/// Calls \a take with kind, data and size of each attribute in a piece of a netlink message.
template<typename Take>
void forEachAttribute(const char *data, int size, Take take)
{
    rtattr attribute;
    while (size >= int(sizeof attribute)) {
        std::memcpy(&attribute, data, sizeof attribute);
        const int length = attribute.rta_len;
        if (length < int(sizeof attribute) || length > size)
            return;
        take(attribute.rta_type & NLA_TYPE_MASK, data + RTA_LENGTH(0), length - int(RTA_LENGTH(0)));
        const int step = std::min(int(RTA_ALIGN(length)), size);
        data += step;
        size -= step;
    }
}

void readCanAttribute(int kind, const char *data, int size, CanLink *link)
{
    if (kind == IFLA_CAN_STATE && size >= int(sizeof(quint32))) {
        quint32 state = 0;
        std::memcpy(&state, data, sizeof state);
        if (state <= CAN_STATE_BUS_OFF)
            link->state = CanBus::State(state);
    } else if (kind == IFLA_CAN_CTRLMODE && size >= int(sizeof(can_ctrlmode))) {
        can_ctrlmode mode;
        std::memcpy(&mode, data, sizeof mode);
        link->isOneShot = (mode.flags & CAN_CTRLMODE_ONE_SHOT) != 0;
    }
}

}  // namespace

CanLink CanLink::fromMessage(const char *message, int size)
{
    CanLink link;
    nlmsghdr header;
    ifinfomsg info;
    const int begin = int(NLMSG_SPACE(sizeof info));
    if (size < begin)
        return link;
    std::memcpy(&header, message, sizeof header);
    if (header.nlmsg_type != RTM_NEWLINK || int(header.nlmsg_len) < begin)
        return link;
    std::memcpy(&info, message + NLMSG_HDRLEN, sizeof info);
    link.hasEcho = (info.ifi_flags & IFF_ECHO) != 0;
    const int end = std::min(size, int(header.nlmsg_len));
    forEachAttribute(message + begin, end - begin, [&link](int kind, const char *data, int length) {
        if (kind != IFLA_LINKINFO)
            return;
        bool isCan = false;
        forEachAttribute(data, length, [&](int part, const char *content, int partLength) {
            isCan = isCan || (part == IFLA_INFO_KIND && partLength >= 3 && std::memcmp(content, "can", 3) == 0);
            if (isCan && part == IFLA_INFO_DATA)
                forEachAttribute(content, partLength, [&link](int canKind, const char *value, int valueLength) {
                    readCanAttribute(canKind, value, valueLength, &link);
                });
        });
    });
    return link;
}

CanLink CanLink::read(int index)
{
    struct
    {
        nlmsghdr header;
        ifinfomsg info;
    } request;
    std::memset(&request, 0, sizeof request);
    request.header.nlmsg_len = NLMSG_LENGTH(sizeof request.info);
    request.header.nlmsg_type = RTM_GETLINK;
    request.header.nlmsg_flags = NLM_F_REQUEST;
    request.info.ifi_family = AF_UNSPEC;
    request.info.ifi_index = index;
    const int netlink = socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE);
    if (netlink < 0)
        return {};
    std::array<char, 16384> answer{};
    ssize_t size = ::send(netlink, &request, request.header.nlmsg_len, 0);
    if (size > 0)
        size = recv(netlink, answer.data(), answer.size(), MSG_DONTWAIT);  // the kernel has answered in send()
    ::close(netlink);
    return size > 0 ? fromMessage(answer.data(), int(size)) : CanLink();
}

}  // namespace qplc
