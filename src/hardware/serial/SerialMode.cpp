// SPDX-License-Identifier: Apache-2.0
#include "SerialMode.h"

#include "QPlcDriverSettings.h"

#include <linux/serial.h>
#include <sys/ioctl.h>

namespace qplc {

namespace {

using namespace std::chrono_literals;

constexpr __u32 DirectionFlags = SER_RS485_ENABLED | SER_RS485_RTS_ON_SEND | SER_RS485_RTS_AFTER_SEND;

/// Drivers of the kernel drop flags that they do not know, without an error. So the flags are read
/// back and compared.
bool setDirection(int descriptor, const SerialMode &mode)
{
    serial_rs485 wanted = {};
    serial_rs485 obtained = {};
    wanted.flags = SER_RS485_ENABLED
        | (mode.direction == SerialMode::RtsOnSend ? SER_RS485_RTS_ON_SEND : SER_RS485_RTS_AFTER_SEND);
    wanted.delay_rts_before_send = __u32(mode.before.count());
    wanted.delay_rts_after_send = __u32(mode.after.count());
    return ::ioctl(descriptor, TIOCSRS485, &wanted) == 0 && ::ioctl(descriptor, TIOCGRS485, &obtained) == 0
        && (obtained.flags & DirectionFlags) == wanted.flags;
}

bool setLowLatency(int descriptor)
{
    serial_struct line = {};
    if (::ioctl(descriptor, TIOCGSERIAL, &line) != 0)
        return false;
    line.flags |= ASYNC_LOW_LATENCY;
    return ::ioctl(descriptor, TIOCSSERIAL, &line) == 0 && ::ioctl(descriptor, TIOCGSERIAL, &line) == 0
        && (line.flags & ASYNC_LOW_LATENCY) != 0;
}

}  // namespace

void SerialMode::read(QPlcDriverSettings &keys)
{
    direction = Direction(
        keys.choice(QStringLiteral("rs485"),
                    {QStringLiteral("no"), QStringLiteral("rts-on-send"), QStringLiteral("rts-after-send")}));
    for (const auto &[key, time] :
         {std::pair{QStringLiteral("rs485-before"), &before}, {QStringLiteral("rs485-after"), &after}}) {
        *time = std::chrono::duration_cast<std::chrono::milliseconds>(keys.duration(key, 0ms, 0ms, 100ms));
        if (direction == Untouched && keys.has(key))
            keys.addError(key,
                          QStringLiteral("%1 needs a direction; write 'rs485 = rts-on-send', or remove it").arg(key));
    }
    isLowLatency = keys.truth(QStringLiteral("low-latency"), false);
}

QString SerialMode::apply(int descriptor) const
{
    if (direction != Untouched && !setDirection(descriptor, *this))
        return QStringLiteral("it does not switch the direction of RS-485 (TIOCSRS485); write 'rs485 = no' for an "
                              "adapter that does it by itself, or take another adapter");
    if (isLowLatency && !setLowLatency(descriptor))
        return QStringLiteral(
            "it has no low latency (ASYNC_LOW_LATENCY); remove 'low-latency', or take another adapter");
    return {};
}

}  // namespace qplc
