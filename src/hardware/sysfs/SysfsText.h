// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArrayList>

#include <optional>

namespace qplc {

/// Reads the texts of files in sysfs, and knows their names and units.
struct SysfsText
{
    /// Returns the number in \a text, or no value if the text is not one finite number.
    static std::optional<double> number(const QByteArray &text);
    /// Returns a count of \a bits, or no value if the text is not a whole number of 64 bits. With
    /// \a isSigned, the highest bit is the sign.
    static std::optional<double> count(const QByteArray &text, int bits, bool isSigned);

    /// The content of the file `w1_slave` of a thermometer on a 1-wire bus.
    struct Thermometer
    {
        const char *problem = nullptr;  // why there is no temperature, and what to do; null if there is one
        double temperature = 0.0;       // [degC]; valid without a problem
    };
    static Thermometer thermometer(const QByteArray &text);

    /// Returns the files of an IIO device that may have the attribute of a channel. The file of the
    /// channel alone comes first: "in_voltage0_scale", "in_voltage_scale", "in_scale", "scale" for
    /// "voltage0".
    /// \param direction  "in_" or "out_"
    static QByteArrayList iioFiles(const QByteArray &direction, const QByteArray &channel, const QByteArray &attribute);
    /// Returns the factor from the unit of the kernel to SI units, [rad] and [degC].
    static double iioUnit(const QByteArray &channel);
    static double hwmonUnit(const QByteArray &channel);
};

}  // namespace qplc
