// SPDX-License-Identifier: Apache-2.0
#include "KiteSettings.h"

#include <QtCore/QJsonValue>

#include <algorithm>

namespace awe {

namespace {

struct TextKey
{
    const char *key;
    QString KiteSettings::*member;
};

constexpr TextKey textKeys[] = {
    {"position", &KiteSettings::position},
    {"velocity", &KiteSettings::velocity},
    {"wind", &KiteSettings::wind},
    {"controlOrientation", &KiteSettings::controlOrientation},
    {"positionOrientation", &KiteSettings::positionOrientation},
    {"force", &KiteSettings::force},
    {"tetherLength", &KiteSettings::tetherLength},
    {"tetherNode", &KiteSettings::tetherNode},
    {"mastTop", &KiteSettings::mastTop},
    {"color", &KiteSettings::color},
};

struct LimitKey
{
    const char *key;
    std::optional<double> KiteSettings::*member;
};

constexpr LimitKey limitKeys[] = {{"minimum", &KiteSettings::minimum}, {"maximum", &KiteSettings::maximum}};

}  // namespace

KiteSettings KiteSettings::fromJson(const QJsonObject &json, QJsonObject *rest)
{
    KiteSettings settings;
    *rest = json;
    for (const TextKey &each : textKeys) {
        const QJsonValue value = rest->take(QLatin1String(each.key));
        settings.*each.member = value.toString(settings.*each.member);
    }
    for (const LimitKey &each : limitKeys) {
        const QJsonValue value = rest->take(QLatin1String(each.key));
        if (value.isDouble())
            settings.*each.member = value.toDouble();
    }
    settings.trail = std::clamp(rest->take(QLatin1String("trail")).toDouble(settings.trail), 0.0, longestTrail);
    return settings;
}

QJsonObject KiteSettings::toJson() const
{
    const KiteSettings defaults;
    QJsonObject json;
    for (const TextKey &each : textKeys) {
        if (this->*each.member != defaults.*each.member)
            json.insert(QLatin1String(each.key), this->*each.member);
    }
    for (const LimitKey &each : limitKeys) {
        if (this->*each.member)
            json.insert(QLatin1String(each.key), *(this->*each.member));
    }
    if (trail != defaults.trail)
        json.insert(QStringLiteral("trail"), trail);
    return json;
}

}  // namespace awe
