// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

namespace qplc {

/// The files of one kind of device in /dev.
struct DeviceFiles
{
    QString what;         // "the I2C bus"
    QString pattern;      // "i2c-*"
    QString group;        // that may use them: "i2c"
    QString whenMissing;  // what to do when /dev has no such file

    /// "/dev/i2c-1" of "i2c-1".
    static QString path(const QString &device);
    /// What helps against EACCES (the user may not open it) and EPERM (systemd does not let a
    /// service open it).
    static QString permissionRemedy(const QString &group, int errorNumber);
    /// Why \a device was not opened, and what helps. \param errorNumber  errno
    QString errorText(const QString &device, int errorNumber) const;
};

}  // namespace qplc
