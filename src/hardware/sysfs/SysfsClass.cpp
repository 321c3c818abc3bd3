// SPDX-License-Identifier: Apache-2.0
#include "SysfsClass.h"

#include "SysfsFolder.h"
#include "signals/MessageText.h"

#include <QtCore/QDir>
#include <QtCore/QFileInfo>
#include <QtCore/QRegularExpression>

#include <algorithm>
#include <iterator>

namespace qplc {

namespace {

const SysfsClass sysfsClasses[] = {
    {SysfsClass::Iio, QStringLiteral("iio"), QStringLiteral("IIO device"), QStringLiteral("bus/iio/devices"),
     QStringLiteral("iio:device*"),
     QStringLiteral("load the driver of the chip, and describe the chip to the kernel (dtoverlay= on a Raspberry Pi)")},
    {SysfsClass::Hwmon, QStringLiteral("hwmon"), QStringLiteral("hwmon device"), QStringLiteral("class/hwmon"),
     QStringLiteral("hwmon*"),
     QStringLiteral("load the driver of the chip, and describe the chip to the kernel (dtoverlay= on a Raspberry Pi)")},
    {SysfsClass::Counter, QStringLiteral("counter"), QStringLiteral("counter"), QStringLiteral("bus/counter/devices"),
     QStringLiteral("counter*"),
     QStringLiteral("load the driver of the chip; the kernel needs to be 5.2 or later, with CONFIG_COUNTER")},
    {SysfsClass::Thermometer, QStringLiteral("w1"), QStringLiteral("1-wire device"), QStringLiteral("bus/w1/devices"),
     QStringLiteral("*-*"),
     QStringLiteral("load the driver of the bus ('dtoverlay=w1-gpio' on a Raspberry Pi), and look at the wires")},
    {SysfsClass::Pwm, QStringLiteral("pwm"), QStringLiteral("PWM chip"), QStringLiteral("class/pwm"),
     QStringLiteral("pwmchip*"),
     QStringLiteral("load the driver of the chip, and describe the chip to the kernel (dtoverlay=pwm on a Raspberry "
                    "Pi)")},
};

/// The place of a device on its bus: "1-0048". The link of a class leads to the device, and that of
/// a bus into its folder.
QString placeOf(const QString &folder)
{
    const QFileInfo device(folder + QStringLiteral("/device"));
    if (device.exists())
        return QFileInfo(device.canonicalFilePath()).fileName();
    return QFileInfo(QFileInfo(QFileInfo(folder).canonicalFilePath()).path()).fileName();
}

}  // namespace

const SysfsClass *SysfsClass::begin()
{
    return std::begin(sysfsClasses);
}

const SysfsClass *SysfsClass::end()
{
    return std::end(sysfsClasses);
}

const SysfsClass *SysfsClass::of(const QString &prefix)
{
    const auto found = std::find_if(begin(), end(), [&](const SysfsClass &other) { return other.prefix == prefix; });
    return found == end() ? nullptr : found;
}

QString SysfsClass::examples()
{
    return QStringLiteral("iio:ads1015, hwmon:ina219, counter:NAME, w1:28-00000a1b2c3d or pwm:fe20c000.pwm");
}

bool SysfsClass::isNumbered(const QString &name) const
{
    if (kind == Thermometer)
        return false;
    const QString stem = QString(pattern).remove(QLatin1Char('*'));
    static const QRegularExpression digits(QStringLiteral("^\\d+$"));
    return name.startsWith(stem) && digits.match(name.mid(stem.size())).hasMatch();
}

/// All names of the device whose folder is \a device, the usual one first.
QStringList SysfsClass::namesOf(const QString &device) const
{
    if (kind == Thermometer)
        return {QFileInfo(device).fileName()};
    QStringList names;
    SysfsFolder files;
    if (kind != Pwm && files.open(device)) {
        for (const char *file : {"name", "label"}) {
            QByteArray text;
            if (files.read(file, &text) && !text.trimmed().isEmpty())
                names << QString::fromUtf8(text.trimmed());
        }
    }
    names << placeOf(device);
    names.removeDuplicates();
    return names;
}

QString SysfsClass::find(const QString &root, const QString &name, QString *error) const
{
    QStringList found;
    QStringList known;
    QStringList places;
    const QString all = root + QLatin1Char('/') + folder + QLatin1Char('/');
    for (const QString &entry : QDir(all).entryList({pattern}, QDir::Dirs | QDir::NoDotAndDotDot, QDir::Name)) {
        const QStringList names = namesOf(all + entry);
        known << prefix + QLatin1Char(':') + names.first();
        if (!names.contains(name))
            continue;
        found << all + entry;
        places << prefix + QLatin1Char(':') + names.last();
    }
    if (found.size() == 1)
        return found.first();
    if (found.size() > 1)
        *error = QStringLiteral("%1 %2s are called '%3'; name one by its place: %4")
                     .arg(found.size())
                     .arg(what, name, firstOf(places));
    else if (known.isEmpty())
        *error = QStringLiteral("there is no %1 '%2:%3': the kernel has none in %4; %5")
                     .arg(what, prefix, name, all, whenMissing);
    else
        *error = QStringLiteral("there is no %1 '%2:%3'%4").arg(what, prefix, name, knownAre(known));
    return {};
}

}  // namespace qplc
