// SPDX-License-Identifier: Apache-2.0
#include "SetterSettings.h"

#include "SetterView.h"

namespace qplc {

namespace {

using Limit = std::optional<double> SetterSettings::*;
constexpr std::pair<const char *, Limit> limits[] = {{"minimum", &SetterSettings::minimum},
                                                     {"maximum", &SetterSettings::maximum},
                                                     {"on", &SetterSettings::on},
                                                     {"pressed", &SetterSettings::pressed}};

}  // namespace

SetterSettings SetterSettings::fromJson(const QJsonObject &settings)
{
    SetterSettings of;
    of.signal = SignalReference::fromString(settings.value(QStringLiteral("signal")).toString());
    const QString style = settings.value(QStringLiteral("style")).toString();
    if (SetterView::styles().contains(style))
        of.style = style;
    for (const auto &[key, limit] : limits) {
        const QJsonValue value = settings.value(QLatin1String(key));
        if (value.isDouble())
            of.*limit = value.toDouble();
    }
    of.generator = settings.value(QStringLiteral("generator")).toObject();
    return of;
}

QJsonObject SetterSettings::toJson() const
{
    QJsonObject json;
    if (signal.isValid())
        json.insert(QStringLiteral("signal"), signal.toString());
    if (style != SetterView::styles().first())
        json.insert(QStringLiteral("style"), style);
    for (const auto &[key, limit] : limits) {
        if (this->*limit)
            json.insert(QLatin1String(key), *(this->*limit));
    }
    if (!generator.isEmpty())
        json.insert(QStringLiteral("generator"), generator);
    return json;
}

QJsonObject SetterSettings::unknownOf(QJsonObject settings)
{
    for (const char *key : {"signal", "style", "generator"})
        settings.remove(QLatin1String(key));
    for (const auto &limit : limits)
        settings.remove(QLatin1String(limit.first));
    return settings;
}

}  // namespace qplc
