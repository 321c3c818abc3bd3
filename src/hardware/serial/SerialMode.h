// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <chrono>

class QPlcDriverSettings;

namespace qplc {

/// What a serial line does beside its rate and format, by calls of Linux that many adapters do not
/// know: keys `rs485`, `rs485-before`, `rs485-after`, `low-latency`.
struct SerialMode
{
    /// Of the driver of RS-485 on two wires: which level of RTS lets it send.
    enum Direction : quint8 {
        Untouched,    // RS-232, RS-422, or the adapter switches by itself
        RtsOnSend,    // high while it sends
        RtsAfterSend  // low while it sends
    };

    Direction direction = Untouched;
    std::chrono::milliseconds before{0};  // from RTS to the first bit
    std::chrono::milliseconds after{0};   // from the last bit to RTS
    bool isLowLatency = false;            // received bytes do not wait for more of them

    void read(QPlcDriverSettings &keys);
    /// \param descriptor  of an open line \return empty; or what it cannot do, and a remedy
    QString apply(int descriptor) const;
};

/// Sets any rate [bit/s], also those without a constant in termios. \return whether the line has it
/// now, up to 2 %
bool setSerialRate(int descriptor, int baud);

}  // namespace qplc
