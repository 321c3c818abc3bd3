// SPDX-License-Identifier: Apache-2.0
#include "CyclicLink.h"

#include <cerrno>
#include <unistd.h>

namespace qplc {

CyclicLink::~CyclicLink()
{
    if (m_descriptor >= 0)
        ::close(m_descriptor);
}

bool CyclicLink::isTransient(int error)
{
    return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

}  // namespace qplc
