// SPDX-License-Identifier: Apache-2.0
// What a trigger looks for, in layouts.
#include "Trigger.h"

#include <QtCore/QLatin1String>

#include <algorithm>
#include <array>
#include <cmath>

namespace qplc {

namespace {

constexpr std::array<const char *, 7> kindNames = {"rising", "falling", "either", "above", "below", "enters", "leaves"};
constexpr std::array<const char *, 3> modeNames = {"auto", "normal", "single"};

template<std::size_t count>
int indexOf(const std::array<const char *, count> &names, const QString &name, int otherwise)
{
    const auto found
        = std::find_if(names.begin(), names.end(), [&](const char *each) { return name == QLatin1String(each); });
    return found == names.end() ? otherwise : int(found - names.begin());
}

double number(const QJsonObject &object, const char *key, double otherwise)
{
    const double value = object.value(QLatin1String(key)).toDouble(otherwise);
    return std::isfinite(value) ? value : otherwise;
}

}  // namespace

bool Trigger::Settings::operator==(const Settings &other) const
{
    return kind == other.kind && level == other.level && upperLevel == other.upperLevel
        && hysteresis == other.hysteresis && mode == other.mode && preShare == other.preShare
        && holdOff == other.holdOff;
}

std::vector<double> Trigger::Settings::levels() const
{
    const bool hasWindow = kind == EntersWindow || kind == LeavesWindow;
    return hasWindow ? std::vector<double>{level, upperLevel} : std::vector<double>{level};
}

QStringList Trigger::Settings::keys()
{
    return {QStringLiteral("kind"),       QStringLiteral("mode"),       QStringLiteral("level"),
            QStringLiteral("upperLevel"), QStringLiteral("hysteresis"), QStringLiteral("pre"),
            QStringLiteral("holdOff")};
}

QJsonObject Trigger::Settings::toJson() const
{
    const Settings standard;
    QJsonObject object;
    const auto insert = [&](const char *key, double value, double usual) {
        if (value != usual)
            object.insert(QLatin1String(key), value);
    };
    if (kind != standard.kind)
        object.insert(QLatin1String("kind"), QLatin1String(kindNames[std::size_t(kind)]));
    if (mode != standard.mode)
        object.insert(QLatin1String("mode"), QLatin1String(modeNames[std::size_t(mode)]));
    insert("level", level, standard.level);
    insert("upperLevel", upperLevel, standard.upperLevel);
    insert("hysteresis", hysteresis, standard.hysteresis);
    insert("pre", preShare, standard.preShare);
    insert("holdOff", holdOff, standard.holdOff);
    return object;
}

Trigger::Settings Trigger::Settings::fromJson(const QJsonObject &object)
{
    Settings settings;
    settings.kind = Kind(indexOf(kindNames, object.value(QLatin1String("kind")).toString(), settings.kind));
    settings.mode = Mode(indexOf(modeNames, object.value(QLatin1String("mode")).toString(), settings.mode));
    settings.level = number(object, "level", settings.level);
    settings.upperLevel = number(object, "upperLevel", settings.upperLevel);
    settings.hysteresis = std::max(number(object, "hysteresis", settings.hysteresis), 0.0);
    settings.preShare = std::clamp(number(object, "pre", settings.preShare), 0.0, 1.0);
    settings.holdOff = std::max(number(object, "holdOff", settings.holdOff), 0.0);
    return settings;
}

}  // namespace qplc
