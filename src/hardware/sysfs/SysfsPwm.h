// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SysfsOutput.h"

namespace qplc {

/// A channel of a PWM chip in sysfs.
class SysfsPwm final : public SysfsOutput
{
public:
    struct Settings
    {
        qint64 period = 0;  // [ns]
        bool isInversed = false;
    };

    /// \param name  "pwm0"
    SysfsPwm(const QByteArray &name, const Settings &settings)
        : m_name(name)
        , m_settings(settings)
    {
    }

    /// Asks the kernel for the channel.
    bool open(const SysfsFolder *chip) override;
    /// Sets what differs, and switches the channel on. \param duty  0 ... 1; lower values and NaN
    /// count as 0, higher ones as 1
    bool set(double duty) override;
    /// Reads the present duty: 0 while the channel is switched off. \return false, with errno and
    /// file()
    bool readDuty(double *duty) const;

    QByteArray file() const override { return m_file; }

private:
    bool waitForAccess() const;
    bool setUp();
    bool read(const char *file, qint64 *number) const;
    bool write(const char *file, qint64 number);
    bool setNumber(const char *file, qint64 number);
    bool setPolarity();

    const QByteArray m_name;
    const Settings m_settings;
    const SysfsFolder *m_chip = nullptr;
    bool m_isSetUp = false;
    mutable QByteArray m_file;
};

}  // namespace qplc
