// SPDX-License-Identifier: Apache-2.0
#include "DeviceFiles.h"

#include <QtCore/QDir>

#include <cerrno>

namespace qplc {

QString DeviceFiles::path(const QString &device)
{
    return device.startsWith(QLatin1Char('/')) ? device : QStringLiteral("/dev/") + device;
}

QString DeviceFiles::permissionRemedy(const QString &group, int errorNumber)
{
    return errorNumber == EPERM
        ? QStringLiteral("a service may open only kinds of devices that the kernel knew when it was started: 'sudo "
                         "systemctl restart qtplc-hardware@NAME'; if that does not help, DeviceAllow= of its unit "
                         "lacks them")
        : QStringLiteral("add the user to the group of the device: 'sudo usermod -aG %1 USER', and log in again")
              .arg(group);
}

QString DeviceFiles::errorText(const QString &device, int errorNumber) const
{
    const QStringList names = QDir(QStringLiteral("/dev")).entryList({pattern}, QDir::System, QDir::Name);
    QString remedy = QStringLiteral("close what uses it");
    if (errorNumber == EACCES || errorNumber == EPERM)
        remedy = permissionRemedy(group, errorNumber);
    else if (names.isEmpty())
        remedy = whenMissing;
    else if (errorNumber == ENOENT || errorNumber == ENODEV || errorNumber == ENXIO)
        remedy = QStringLiteral("there are %1").arg(names.join(QStringLiteral(", ")));
    return QStringLiteral("cannot open %1 '%2': %3; %4").arg(what, device, qt_error_string(errorNumber), remedy);
}

}  // namespace qplc
