// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SysfsOutput.h"

namespace qplc {

/// An output of an IIO device: a converter from digital to analog.
class SysfsAnalogOutput final : public SysfsOutput
{
public:
    struct Range
    {
        double lowest = 0.0;  // in SI units
        double highest = 0.0;
    };

    /// \param channel  "voltage0"
    SysfsAnalogOutput(const QByteArray &channel, const Range &range)
        : m_channel(channel)
        , m_range(range)
    {
    }

    bool open(const SysfsFolder *device) override;
    /// \param value  is limited to the range; NaN leaves the output unchanged
    bool set(double value) override;
    QByteArray file() const override { return m_file; }

private:
    bool writeIfOther(const QByteArray &file, const QByteArray &text);

    const QByteArray m_channel;
    const Range m_range;
    const SysfsFolder *m_device = nullptr;
    double m_factor = 1.0;  // value = (number + offset) * factor
    double m_offset = 0.0;
    bool m_hasPowerDown = false;
    QByteArray m_file;
};

}  // namespace qplc
