// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QStringList>

namespace qplc {

/// A class of devices for which the kernel has drivers, and how one of them is named: by the name
/// that its driver gives it, its label, or its place on its bus ("1-0048"), but not by a number,
/// which may be another one after the next start.
struct SysfsClass
{
    enum Kind : quint8 { Iio, Hwmon, Counter, Thermometer, Pwm };

    Kind kind;
    QString prefix;    // "iio", of "iio:ads1015"
    QString what;      // "IIO device"
    QString folder;    // in /sys
    QString pattern;   // of the folders of devices
    QString whenNone;  // what to do when there is none

    /// \return null if no class has this prefix
    static const SysfsClass *of(const QString &prefix);
    /// "iio:ads1015" and more: what a key `device` may be.
    static QString examples();

    /// \param root  "/sys" \param name  of the device \return its folder; empty, with the reason
    /// and the remedy in \a error
    QString find(const QString &root, const QString &name, QString *error) const;
    /// Whether \a name is a number that the kernel has given.
    bool isNumbered(const QString &name) const;

private:
    QStringList namesOf(const QString &device) const;
    static const SysfsClass *begin();
    static const SysfsClass *end();
};

}  // namespace qplc
