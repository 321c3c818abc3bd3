// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArrayList>

#include <optional>

namespace qplc {

/// What files of sysfs say, and which file says what.
struct SysfsText
{
    /// The number that is alone in \a text; nothing: it is none, or not finite.
    static std::optional<double> number(const QByteArray &text);
    /// A count of \a bits; with \a isSigned its highest bit is the sign. Nothing: it is no whole
    /// number of 64 bits.
    static std::optional<double> count(const QByteArray &text, int bits, bool isSigned);

    /// What the file `w1_slave` of a thermometer on a 1-wire bus says.
    struct Thermometer
    {
        /// Null: the temperature is right. Else why it is none, and what to do.
        const char *problem = nullptr;
        double temperature = 0.0;  // [degC]
    };
    static Thermometer thermometer(const QByteArray &text);

    /// Files of an IIO device that may have the attribute of a channel, that of the channel alone
    /// first: "in_voltage0_scale", "in_voltage_scale", "in_scale", "scale" for "voltage0".
    /// \param direction  "in_" or "out_"
    static QByteArrayList iioFiles(const QByteArray &direction, const QByteArray &channel, const QByteArray &attribute);
    /// What the unit of the kernel is in SI units; of degrees, [rad]; of temperatures, [degC].
    static double iioUnit(const QByteArray &channel);
    static double hwmonUnit(const QByteArray &channel);
};

}  // namespace qplc
