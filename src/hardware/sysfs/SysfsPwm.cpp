// SPDX-License-Identifier: Apache-2.0
#include "SysfsPwm.h"

#include "SysfsText.h"

#include <cerrno>
#include <chrono>
#include <cmath>
#include <thread>

namespace qplc {

namespace {

using namespace std::chrono_literals;

// The kernel makes the files of a channel for root; a rule of udev gives them to us a moment later.
constexpr auto PauseOfAccess = 10ms;
constexpr int TriesOfAccess = 50;

}  // namespace

bool SysfsPwm::open(const SysfsFolder *chip)
{
    m_chip = chip;
    m_isSetUp = false;
    m_file = m_name;
    if (!m_chip->has(m_name)) {
        m_file = "export";
        if (!m_chip->write(m_file, m_name.mid(3)) && errno != EBUSY)  // EBUSY: the kernel has it already
            return false;
        m_file = m_name;
        if (!m_chip->has(m_name)) {
            errno = ENOENT;
            return false;
        }
    }
    return waitForAccess();
}

bool SysfsPwm::waitForAccess() const
{
    m_file = m_name + "/duty_cycle";
    for (int tries = TriesOfAccess; !m_chip->isWritable(m_file); --tries) {
        if (errno != EACCES || tries == 0)
            return false;
        std::this_thread::sleep_for(PauseOfAccess);
    }
    return true;
}

bool SysfsPwm::set(double duty)
{
    if (!m_isSetUp && !setUp())
        return false;
    const double limited = duty > 0.0 ? std::min(duty, 1.0) : 0.0;
    return setNumber("duty_cycle", std::llround(limited * double(m_settings.period))) && setNumber("enable", 1);
}

bool SysfsPwm::readDuty(double *duty) const
{
    qint64 period = 0;
    qint64 on = 0;
    qint64 isEnabled = 0;
    if (!read("period", &period) || !read("duty_cycle", &on) || !read("enable", &isEnabled))
        return false;
    *duty = isEnabled != 0 && period > 0 ? double(on) / double(period) : 0.0;
    return true;
}

/// A channel that already runs with these settings continues without a gap, for example after a
/// restart of the program. The kernel refuses a polarity before a period is set, and a period that
/// is shorter than the time on.
bool SysfsPwm::setUp()
{
    qint64 period = 0;
    qint64 on = 0;
    if (!read("period", &period) || !read("duty_cycle", &on))
        return false;
    if (period != m_settings.period) {
        if (on > m_settings.period && !write("duty_cycle", 0))
            return false;
        if (!write("period", m_settings.period))
            return false;
    }
    m_isSetUp = setPolarity();
    return m_isSetUp;
}

bool SysfsPwm::setPolarity()
{
    const QByteArray wanted = m_settings.isInversed ? "inversed" : "normal";
    QByteArray present;
    m_file = m_name + "/polarity";
    if (!m_chip->has(m_file) && !m_settings.isInversed)
        return true;  // the chip has one polarity
    if (!m_chip->read(m_file, &present))
        return false;
    if (present.trimmed() == wanted)
        return true;
    if (!setNumber("enable", 0))
        return false;
    m_file = m_name + "/polarity";
    return m_chip->write(m_file, wanted);
}

bool SysfsPwm::read(const char *file, qint64 *number) const
{
    QByteArray text;
    m_file = m_name + '/' + file;
    if (!m_chip->read(m_file, &text))
        return false;
    const std::optional<double> value = SysfsText::number(text);
    if (!value || *value < 0.0 || *value > 1e15) {
        errno = EBADMSG;
        return false;
    }
    *number = qint64(*value);
    return true;
}

bool SysfsPwm::write(const char *file, qint64 number)
{
    m_file = m_name + '/' + file;
    return m_chip->write(m_file, QByteArray::number(number));
}

bool SysfsPwm::setNumber(const char *file, qint64 number)
{
    qint64 present = 0;
    return read(file, &present) && (present == number || write(file, number));
}

}  // namespace qplc
