// SPDX-License-Identifier: Apache-2.0
#include "SysfsAnalogOutput.h"

#include "SysfsText.h"

#include <algorithm>
#include <cerrno>
#include <cmath>

namespace qplc {

bool SysfsAnalogOutput::open(const SysfsFolder *device)
{
    m_device = device;
    m_factor
        = SysfsText::iioUnit(m_channel) * device->firstNumber(SysfsText::iioFiles("out_", m_channel, "scale"), 1.0);
    m_offset = device->firstNumber(SysfsText::iioFiles("out_", m_channel, "offset"), 0.0);
    m_hasPowerDown = device->has("out_" + m_channel + "_powerdown");
    m_file = "out_" + m_channel + "_raw";
    errno = ENOENT;
    return device->has(m_file) && m_factor != 0.0;
}

/// A chip that is powered down gets its value first, so that its output does not jump.
bool SysfsAnalogOutput::set(double value)
{
    if (std::isnan(value))
        return true;
    const double limited = std::clamp(value, m_range.lowest, m_range.highest);
    const double number = std::round(limited / m_factor - m_offset);
    return writeIfOther("out_" + m_channel + "_raw", QByteArray::number(qint64(std::clamp(number, -1e15, 1e15))))
        && (!m_hasPowerDown || writeIfOther("out_" + m_channel + "_powerdown", "0"));
}

bool SysfsAnalogOutput::writeIfOther(const QByteArray &file, const QByteArray &text)
{
    QByteArray present;
    m_file = file;
    return m_device->read(file, &present) && (present.trimmed() == text || m_device->write(file, text));
}

}  // namespace qplc
