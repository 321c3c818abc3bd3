// SPDX-License-Identifier: Apache-2.0
#include "GpioChip.h"

#include "FakeGpioChip.h"
#include "hardware/fake/FakeMemory.h"

#include <QtCore/QDir>

#include <cerrno>

namespace qplc {

namespace {

QString permissionRemedy()
{
    return QStringLiteral("add the user to the group of the device: 'sudo usermod -aG gpio USER', and log in again; "
                          "where there is no group gpio, a udev rule makes one: SUBSYSTEM==\"gpio\", GROUP=\"gpio\", "
                          "MODE=\"0660\"");
}

QString chipsThatExist()
{
    const QStringList chips
        = QDir(QStringLiteral("/dev")).entryList({QStringLiteral("gpiochip*")}, QDir::System, QDir::Name);
    return chips.isEmpty()
        ? QStringLiteral("this computer has none: load the driver of the chip, or plug it in")
        : QStringLiteral("there are %1; 'gpiodetect' shows their labels").arg(chips.join(QStringLiteral(", ")));
}

}  // namespace

std::unique_ptr<GpioChip> GpioChip::open(const QString &device, QString *error)
{
    if (FakeMemory::isFake(device))
        return FakeGpioChip::open(device, error);
    return openKernelGpioChip(device, error);
}

QString GpioChip::noSuchLine(const QString &device, const QString &line, quint64 lines)
{
    return QStringLiteral("%1 has no line '%2'; it has %3 lines, from 0 on, and 'gpioinfo' shows their names")
        .arg(device, line)
        .arg(lines);
}

QString GpioChip::busyLine(const QString &device, const QString &line, const QString &consumer)
{
    return QStringLiteral("line %1 of %2 is used by '%3'; stop that, or take another line")
        .arg(line, device, consumer.isEmpty() ? QStringLiteral("the kernel") : consumer);
}

QString GpioChip::refused(const QString &device, const GpioLineRequest &request, int errorNumber)
{
    QString remedy = QStringLiteral("see 'gpioinfo', and the log of the kernel ('dmesg')");
    if (errorNumber == EACCES || errorNumber == EPERM)
        remedy = permissionRemedy();
    else if (errorNumber == EINVAL || errorNumber == ENOTSUP || errorNumber == ENXIO)
        remedy = QStringLiteral("the chip may not be able to do %1")
                     .arg(request.isOutput ? QStringLiteral("open-drain, or outputs on this line")
                              : request.wantsEdges
                              ? QStringLiteral("edges (debounce needs them, too), or pull-up and pull-down")
                              : QStringLiteral("pull-up and pull-down"));
    return QStringLiteral("cannot take line %1 of %2 as %3: %4; %5")
        .arg(request.line, device, request.isOutput ? QStringLiteral("output") : QStringLiteral("input"),
             qt_error_string(errorNumber), remedy);
}

QString gpioChipErrorText(const QString &device, int errorNumber)
{
    const bool isForbidden = errorNumber == EACCES || errorNumber == EPERM;
    return QStringLiteral("cannot open the GPIO chip '%1': %2; %3")
        .arg(device, qt_error_string(errorNumber), isForbidden ? permissionRemedy() : chipsThatExist());
}

const char *gpioConsumer()
{
    return "qtplc";
}

}  // namespace qplc
