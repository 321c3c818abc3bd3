// SPDX-License-Identifier: Apache-2.0
// Apart from SerialLine.cpp: the structures of the kernel have the names of those of the C library.
#include "SerialMode.h"

#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <cstdlib>
#include <sys/ioctl.h>

namespace qplc {

bool setSerialRate(int descriptor, int baud)
{
    termios2 line = {};
    if (::ioctl(descriptor, TCGETS2, &line) != 0)
        return false;
    line.c_cflag = (line.c_cflag & ~tcflag_t(CBAUD | CIBAUD)) | BOTHER;  // the input has the rate of the output
    line.c_ospeed = line.c_ispeed = speed_t(baud);
    return ::ioctl(descriptor, TCSETS2, &line) == 0 && ::ioctl(descriptor, TCGETS2, &line) == 0
        && 50LL * std::llabs(static_cast<long long>(line.c_ospeed) - baud) <= baud;
}

}  // namespace qplc
