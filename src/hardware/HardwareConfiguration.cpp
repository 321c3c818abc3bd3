// SPDX-License-Identifier: Apache-2.0
#include "HardwareConfiguration.h"

#include "DriverSettingsData.h"
#include "hardware/fake/FakeMemory.h"
#include "signals/MessageText.h"

#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>

#include <algorithm>

namespace qplc {

namespace {

const QString nodeSection = QStringLiteral("node");
const QStringList partNames{QStringLiteral("read"), QStringLiteral("write"), QStringLiteral("safe")};

}  // namespace

HardwareConfiguration::HardwareConfiguration(const QByteArray &text, const QString &fileName)
    : ConfigurationFile(fileName)
{
    if (fileName.endsWith(QLatin1String(".json"), Qt::CaseInsensitive))
        readJson(text);
    else
        readIni(text, QStringLiteral("[node] or the name of a device in brackets"));
    interpret();
}

// ---- text ----

void HardwareConfiguration::readJson(const QByteArray &text)
{
    QJsonParseError error{};
    const QJsonDocument document = QJsonDocument::fromJson(text, &error);
    if (error.error != QJsonParseError::NoError) {
        const QByteArray before = text.left(error.offset);
        addError(before.count('\n') + 1, error.offset - before.lastIndexOf('\n') - 1,
                 QStringLiteral("this is not JSON: %1").arg(error.errorString()));
        return;
    }
    const QJsonObject sections = document.object();
    for (auto section = sections.begin(); section != sections.end(); ++section) {
        if (section->isObject())
            readJsonSection(section.key(), section->toObject(), false);
        else
            addError(0, 0,
                     QStringLiteral("%1 is not an object; write \"%2\": {\"driver\": ...}")
                         .arg(quoted(section.key()), section.key()));
    }
}

void HardwareConfiguration::readJsonSection(const QString &name, const QJsonObject &object, bool isPart)
{
    addSection(name, 0, 0);
    const int own = sections().size() - 1;
    for (auto entry = object.begin(); entry != object.end(); ++entry) {
        if (entry->isObject() && !isPart)
            readJsonSection(name + QLatin1Char('.') + entry.key(), entry->toObject(), true);
        else if (entry->isString() || entry->isDouble() || entry->isBool())
            addEntry(own, {entry.key(), entry->toVariant().toString(), 0, 0});
        else
            addError(0, 0,
                     QStringLiteral("%1 of section %2 is not a text, number or truth value")
                         .arg(quoted(entry.key()), quoted(name)));
    }
}

// ---- meaning ----

void HardwareConfiguration::interpret()
{
    for (const ConfigurationSection &section : sections()) {
        if (section.name == nodeSection)
            readNode(section);
        else if (!section.name.contains(QLatin1Char('.')))
            readDriver(section);
    }
    for (const ConfigurationSection &section : sections()) {
        const int dot = section.name.lastIndexOf(QLatin1Char('.'));
        if (dot >= 0)
            readPart(section, section.name.left(dot), section.name.mid(dot + 1));
    }
    if (m_drivers.isEmpty() && errors().isEmpty())
        addError(0, 0,
                 QStringLiteral("there is no device; begin a section for each of them: [drive], driver = can, ..."));
}

void HardwareConfiguration::readNode(const ConfigurationSection &section)
{
    for (const ConfigurationEntry &entry : section.entries) {
        if (entry.key == QLatin1String("name")) {
            m_nodeName = entry.value;
        } else if (entry.key == QLatin1String("safeStop")) {
            for (const QString &text : entry.value.split(QLatin1Char(','))) {
                const QString name = text.trimmed();
                const int dot = name.indexOf(QLatin1Char('.'));
                if (dot <= 0 || dot + 1 == name.size())
                    addError(
                        entry,
                        QStringLiteral("%1 is not a channel of a device; write for example 'buttons.emergencyStop'")
                            .arg(quoted(name)));
                else
                    m_safeStops.append({name.left(dot), name.mid(dot + 1), entry});
            }
        } else {
            addError(
                entry,
                QStringLiteral("%1 is not a key of [node]; its keys are 'name' and 'safeStop'").arg(quoted(entry.key)));
        }
    }
}

void HardwareConfiguration::readDriver(const ConfigurationSection &section)
{
    Driver driver;
    driver.name = section.name;
    driver.entry.line = section.line;
    for (const ConfigurationEntry &entry : section.entries) {
        if (entry.key == QLatin1String("driver")) {
            driver.kind = entry.value;
            driver.entry = entry;
        } else {
            driver.keys.append(entry);
        }
    }
    if (driver.kind.isEmpty())
        addError(driver.entry,
                 QStringLiteral("section %1 has no driver; add for example 'driver = can'").arg(quoted(section.name)));
    m_drivers.append(driver);
}

void HardwareConfiguration::readPart(const ConfigurationSection &section, const QString &name, const QString &part)
{
    const auto driver
        = std::find_if(m_drivers.begin(), m_drivers.end(), [&](const Driver &other) { return other.name == name; });
    if (driver == m_drivers.end() || !partNames.contains(part)) {
        QStringList known;
        for (const Driver &other : qAsConst(m_drivers)) {
            for (const QString &partName : partNames)
                known << other.name + QLatin1Char('.') + partName;
        }
        addError(section.line, 2,
                 QStringLiteral("section %1 belongs to no device, or is not one of its parts read, write and safe%2")
                     .arg(quoted(section.name), didYouMean(closeNames(section.name, known))));
        return;
    }
    for (const ConfigurationEntry &entry : section.entries) {
        if (part == QLatin1String("safe"))
            readSafeValue(&*driver, entry);
        else
            readWire(&*driver, part == QLatin1String("read") ? QPlcChannel::Read : QPlcChannel::Write, entry);
    }
}

void HardwareConfiguration::readWire(Driver *driver, QPlcChannel::Direction direction, const ConfigurationEntry &entry)
{
    Wire wire;
    wire.direction = direction;
    wire.entry = entry;
    QString error;
    if (!ConfigurationTerm::fromText(entry.key, &wire.target, &error)
        || !ConfigurationTerm::fromText(entry.value, &wire.source, &error))
        addError(entry, error);
    else if (wire.target.factor != 1.0 || wire.target.offset != 0.0)
        addError(entry,
                 QStringLiteral("factor and offset of %1 belong to the right side of '='").arg(quoted(entry.key)));
    else if ((direction == QPlcChannel::Read ? wire.source : wire.target).element >= 0)
        addError(entry, QStringLiteral("a channel has no elements: leave the brackets out"));
    else
        driver->wires.append(wire);
}

void HardwareConfiguration::readSafeValue(Driver *driver, const ConfigurationEntry &entry)
{
    SafeValue safe{entry.key, 0.0, entry};
    if (finiteNumberFromText(entry.value, &safe.value))
        driver->safeValues.append(safe);
    else
        addError(entry,
                 QStringLiteral("%1 is not a number; write the safe value of %2 in the unit of the device")
                     .arg(quoted(entry.value), quoted(entry.key)));
}

// ---- settings ----

bool HardwareConfiguration::hasRealDevices() const
{
    const auto isFake = [](const ConfigurationEntry &entry) {
        return (entry.key == QLatin1String("device") || entry.key == QLatin1String("root"))
            && FakeMemory::isFake(entry.value);
    };
    return std::any_of(m_drivers.begin(), m_drivers.end(), [&](const Driver &driver) {
        return std::none_of(driver.keys.begin(), driver.keys.end(), isFake);
    });
}

std::unique_ptr<QPlcDriverSettings> HardwareConfiguration::settings(const Driver &driver)
{
    auto data = std::make_unique<QPlcDriverSettings::Private>();
    data->name = driver.name;
    data->fileName = fileName();
    data->entries = driver.keys;
    data->section = driver.entry;
    data->errors = errorList();
    data->warnings = &m_warnings;
    data->claims = &m_claims;
    for (const Wire &wire : driver.wires)
        data->usedChannels << (wire.direction == QPlcChannel::Read ? wire.source : wire.target).name;
    for (const SafeValue &safe : driver.safeValues)
        data->usedChannels << safe.channel;
    return std::unique_ptr<QPlcDriverSettings>(new QPlcDriverSettings(std::move(data)));
}

void HardwareConfiguration::checkUse(const QPlcDriverSettings &settings)
{
    QPlcDriverSettings::Private &data = *settings.d;
    for (const ConfigurationEntry &entry : data.entries) {
        if (!data.used.contains(entry.key))
            data.addError(entry,
                          QStringLiteral("%1 is not a key of this driver%2")
                              .arg(quoted(entry.key), didYouMean(closeNames(entry.key, data.asked))));
    }
}

bool HardwareConfiguration::isExcused(const QPlcDriverSettings &settings, const QString &channel)
{
    const QPlcDriverSettings::Private &data = *settings.d;
    // "register.speed" is that of 'speed', "frame.Drive" that of 'Drive.Speed'.
    const auto isOfChannel = [&channel](const QString &key) {
        const QString name = key.section(QLatin1Char('.'), 1);
        return !name.isEmpty() && (channel == name || channel.startsWith(name + QLatin1Char('.')));
    };
    return data.hasErrorsElsewhere || std::any_of(data.failedKeys.begin(), data.failedKeys.end(), isOfChannel);
}

void HardwareConfiguration::addWarning(const ConfigurationEntry &entry, const QString &message)
{
    m_warnings.append({fileName(), entry.line, entry.column, message});
}

}  // namespace qplc
