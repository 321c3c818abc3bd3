// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QStringList>

namespace qplc {

/// A class of devices for which the kernel has drivers. A device is named by the name that its
/// driver gives it, by its label, or by its place on its bus ("1-0048"). The number of the kernel
/// ("iio:device0") is not a name, because it may change at the next start.
struct SysfsClass
{
    enum Kind : quint8 { Iio, Hwmon, Counter, Thermometer, Pwm };

    Kind kind;
    QString prefix;       // "iio", of "iio:ads1015"
    QString what;         // "IIO device"
    QString folder;       // in /sys
    QString pattern;      // of the folders of devices
    QString whenMissing;  // what to do when the kernel has no device of this class

    /// \return null if no class has this prefix
    static const SysfsClass *of(const QString &prefix);
    /// Examples of the key `device`: "iio:ads1015, ...".
    static QString examples();

    /// \param root  "/sys" \param name  of the device \return its folder; empty if it was not
    /// found, with the reason and the remedy in \a error
    QString find(const QString &root, const QString &name, QString *error) const;
    /// Whether \a name is a number that the kernel has given.
    bool isNumbered(const QString &name) const;

private:
    QStringList namesOf(const QString &device) const;
    static const SysfsClass *begin();
    static const SysfsClass *end();
};

}  // namespace qplc
