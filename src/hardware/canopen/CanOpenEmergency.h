// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hardware/can/CanFrame.h"

#include <QtCore/QString>

#include <array>

namespace qplc {

/// An emergency message (EMCY) of CiA 301: a device tells that an error has come, or is gone.
struct CanOpenEmergency
{
    static constexpr int Size = 8;                   // [byte] of a frame
    static constexpr quint16 GenericError = 0x1000;  // of a device that does not tell more

    quint16 code = 0;                      // 00xx: an error is gone
    quint8 errorRegister = 0;              // object 1001h: all errors that there are
    std::array<quint8, 5> manufacturer{};  // of the manufacturer

    /// \pre the frame has Size bytes
    static CanOpenEmergency fromFrame(const CanFrame &frame) noexcept;
    /// As the bytes of a frame, the first one as the lowest.
    static CanOpenEmergency fromBits(quint64 bits) noexcept;
    quint64 toBits() const noexcept;
    /// The bytes of the manufacturer, the first one as the lowest.
    quint64 manufacturerBits() const noexcept { return toBits() >> 24; }

    /// Whether an error has come; else one is gone, and errorRegister tells what remains.
    bool isError() const noexcept { return (code & 0xFF00) != 0; }
    /// "emergency 2310 (continuous over-current, at the output side), error register 03 (generic,
    /// current), bytes of the manufacturer 00 00 00 00 00"
    QString text() const;
};

/// What a code means by CiA 301 and CiA 402, or by its class: "voltage".
QString emergencyText(quint16 code);
/// The errors of an error register: "generic, current"; "none"
QString errorRegisterText(quint8 errorRegister);

}  // namespace qplc
