// SPDX-License-Identifier: Apache-2.0
#include "LossWatch.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

namespace qplc {

namespace {

void setOption(int descriptor, int level, int option, int value)
{
    ::setsockopt(descriptor, level, option, &value, sizeof value);
}

}  // namespace

void LossWatch::begin(int descriptor)
{
    setOption(descriptor, IPPROTO_TCP, TCP_KEEPIDLE, Idle);
    setOption(descriptor, IPPROTO_TCP, TCP_KEEPINTVL, Interval);
    setOption(descriptor, IPPROTO_TCP, TCP_KEEPCNT, Probes);
    setOption(descriptor, IPPROTO_TCP, TCP_USER_TIMEOUT, Unacknowledged);
    setOption(descriptor, SOL_SOCKET, SO_KEEPALIVE, 1);
}

void LossWatch::end(int descriptor)
{
    setOption(descriptor, IPPROTO_TCP, TCP_USER_TIMEOUT, 0);
    setOption(descriptor, SOL_SOCKET, SO_KEEPALIVE, 0);
}

}  // namespace qplc
