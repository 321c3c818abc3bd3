// SPDX-License-Identifier: Apache-2.0
#include "HeldPlantConfiguration.h"

#include "ExportedNode.h"
#include "IniText.h"

#include <QtCore/QRegularExpression>

namespace qplc_export {

namespace {

const char *const settingsTable = R"(
[plant.port]
type = Int32
min = 0
max = 65535
initial = 50000
description = port where the master listens; 0: a free one
[plant.listen]
type = String(64)
description = address where the master listens; empty: 127.0.0.1
[plant.keys]
type = String(512)
description = file with keys of nodes and persons; empty: no security
[plant.access]
type = String(512)
description = file with their rights; empty: those of the roles
[plant.start_timeout]
type = Real64
unit = s
initial = 30
min = 0.001
max = 3600
description = longest wait for the nodes of the plant
[plant.longest_wait]
type = Real64
unit = s
initial = 5
min = 0.001
max = 3600
description = longest wait of a cycle for its nodes
)";

QStringList listOf(const QString &text)
{
    QStringList names;
    const QStringList parts = text.split(QLatin1Char(','));
    for (const QString &part : parts)
        names << part.trimmed();
    return names;
}

/// "30 s", "500 ms": in seconds
bool readSeconds(const QString &text, double *seconds)
{
    static const QRegularExpression form(QStringLiteral("^([0-9.]+(?:[eE][-+]?[0-9]+)?)\\s*(s|ms|us)$"));
    const QRegularExpressionMatch match = form.match(text);
    bool isNumber = false;
    const double number = match.captured(1).toDouble(&isNumber);
    const QString unit = match.captured(2);
    *seconds = number * (unit == QLatin1String("s") ? 1.0 : unit == QLatin1String("ms") ? 1e-3 : 1e-6);
    return isNumber;
}

}  // namespace

bool HeldPlantConfiguration::read(const QByteArray &text, const QPlcSignalTable &table, QString *error)
{
    *this = HeldPlantConfiguration();
    manifest.profile = QPlcProfile::Simulation;
    const QPlcSignalTable known = QPlcSignalTable::fromIni(settingsTable);
    for (const QPlcSignalDefinition &setting : known)
        settings.append(setting);
    const auto take = [&](const IniLine &line, QString *reason) {
        return line.section == QLatin1String("plant") ? readPlant(line.key, line.value, table, reason)
                                                      : readHost(line.key, line.value, table, reason);
    };
    const IniForm form{
        {QStringLiteral("plant"), QStringLiteral("host")},
        QStringLiteral("KEY = VALUE"),
        {QStringLiteral("critical"), QStringLiteral("required"), QStringLiteral("gives"), QStringLiteral("gets")},
        take};
    if (!readIni(text, QStringLiteral("configuration of the plant"), form, error))
        return false;
    if (manifest.isEmpty())
        *error = QStringLiteral("the configuration of the plant names no node; write critical = NODE, ... in [plant]");
    else if (gives.isEmpty() && gets.isEmpty())
        *error = QStringLiteral("the configuration of the plant has no signals for the host; write gets = SIGNAL, ... "
                                "or gives = SIGNAL, ... in [host]");
    else
        return true;
    return false;
}

bool HeldPlantConfiguration::readSetting(const QString &key, const QString &text, QPlcValue *value,
                                         QString *error) const
{
    QStringList keys;
    for (const QPlcSignalDefinition &setting : settings) {
        keys << setting.name.mid(int(qstrlen(ExportedNode::SettingPrefix)));
        if (keys.last() != key)
            continue;
        double seconds = 0.0;
        if (setting.unit != QLatin1String("s"))
            *value = setting.type.isString() ? QPlcValue(text.toUtf8().constData()).convertedTo(setting.type)
                                             : setting.valueFromText(text);
        else if (readSeconds(text, &seconds))
            *value = QPlcValue(seconds);
        if (value->isValid() && setting.isInRange(*value))
            return true;
        if (setting.unit == QLatin1String("s"))
            *error = QStringLiteral("%1 = %2: use 1 ms to 3600 s, with the unit, for example 5 s").arg(key, text);
        else if (setting.type.isString())
            *error = QStringLiteral("%1 = %2: the text is longer than %3 bytes")
                         .arg(key, text)
                         .arg(setting.type.capacity());
        else
            *error = QStringLiteral("%1 = %2: use a whole number, %3").arg(key, text, setting.rangeText());
        return false;
    }
    *error = QStringLiteral("unknown key '%1'; use %2").arg(key, keys.join(QStringLiteral(", ")));
    return false;
}

bool HeldPlantConfiguration::readPlant(const QString &key, const QString &value, const QPlcSignalTable &table,
                                       QString *error)
{
    if (key == QLatin1String("critical"))
        return addNodes(value, QPlcManifest::Critical, error);
    if (key == QLatin1String("required"))
        return addNodes(value, QPlcManifest::Required, error);
    if (key == QLatin1String("time_signal")) {
        timeSignal = value;
        if (!table.contains(value))
            *error = table.unknownSignalText(value);
        return table.contains(value);
    }
    if (key == QLatin1String("profile")) {
        const bool isPlant = value == QLatin1String("Plant");
        manifest.profile = isPlant ? QPlcProfile::Plant : QPlcProfile::Simulation;
        if (!isPlant && value != QLatin1String("Simulation"))
            *error = QStringLiteral("profile = %1: use Simulation or Plant").arg(value);
        return error->isEmpty();
    }
    QPlcValue read;
    if (!readSetting(key, value, &read, error)) {
        error->replace(QLatin1String("use port"), QLatin1String("use critical, required, time_signal, profile, port"));
        return false;
    }
    for (QPlcSignalDefinition &setting : settings) {
        if (setting.name == QLatin1String(ExportedNode::SettingPrefix) + key)
            setting.initial = read.convertedTo(setting.type);
    }
    return true;
}

bool HeldPlantConfiguration::readHost(const QString &key, const QString &value, const QPlcSignalTable &table,
                                      QString *error)
{
    const bool isGiven = key == QLatin1String("gives");
    if (!isGiven && key != QLatin1String("gets")) {
        *error = QStringLiteral("unknown key '%1'; use gives or gets").arg(key);
        return false;
    }
    const QStringList names = listOf(value);
    for (const QString &name : names) {
        if (!table.contains(name))
            *error = table.unknownSignalText(name);
        else if (gives.contains(name) || gets.contains(name))
            *error = QStringLiteral("signal '%1' is named twice; the host either gives it or gets it").arg(name);
        else if (name == timeSignal && isGiven)
            *error = QStringLiteral("the master writes '%1' (time_signal); the host cannot give it").arg(name);
        if (!error->isEmpty())
            return false;
        (isGiven ? gives : gets) << name;
    }
    return true;
}

bool HeldPlantConfiguration::addNodes(const QString &names, QPlcManifest::Need need, QString *error)
{
    const QStringList all = listOf(names);
    for (const QString &name : all) {
        if (name.isEmpty() || manifest.find(name)) {
            *error = name.isEmpty() ? QStringLiteral("the name of a node is missing")
                                    : QStringLiteral("node '%1' is named twice").arg(name);
            return false;
        }
        QPlcManifest::Node node;
        node.name = name;
        node.need = need;
        manifest.nodes << node;
    }
    return true;
}

}  // namespace qplc_export
