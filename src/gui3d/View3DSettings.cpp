// SPDX-License-Identifier: Apache-2.0
#include "View3DSettings.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

float number(const QJsonObject &json, const char *key, float otherwise, float smallest, float largest)
{
    return std::clamp(float(json.value(QLatin1String(key)).toDouble(double(otherwise))), smallest, largest);
}

/// Short in files: a hundredth of a degree is as good as any.
double rounded(float value)
{
    return std::round(double(value) * 1000.0) / 1000.0;
}

OrbitCamera cameraFrom(const QString &preset, const QJsonObject &view)
{
    OrbitCamera camera;
    camera.preset = OrbitCamera::presetOf(preset);
    camera.yaw = number(view, "yaw", 0, -360, 360);
    camera.pitch = number(view, "pitch", 0, -180, 180);
    camera.zoom = number(view, "zoom", 1, 0.1f, 40);
    const QJsonArray pan = view.value(QStringLiteral("pan")).toArray();
    for (int i = 0; i < 3; ++i)
        camera.pan[i] = std::clamp(float(pan.at(i).toDouble()), -3.0f, 3.0f);
    return camera;
}

QJsonObject viewJson(const OrbitCamera &camera)
{
    QJsonObject view;
    if (rounded(camera.yaw) != 0)
        view.insert(QStringLiteral("yaw"), rounded(camera.yaw));
    if (rounded(camera.pitch) != 0)
        view.insert(QStringLiteral("pitch"), rounded(camera.pitch));
    if (rounded(camera.zoom) != 1)
        view.insert(QStringLiteral("zoom"), rounded(camera.zoom));
    if (!camera.pan.isNull())
        view.insert(QStringLiteral("pan"),
                    QJsonArray{rounded(camera.pan.x()), rounded(camera.pan.y()), rounded(camera.pan.z())});
    return view;
}

}  // namespace

void View3DSettings::setShown(const QString &part, bool isShown)
{
    hidden.removeAll(part);
    if (!isShown)
        hidden << part;
}

View3DSettings View3DSettings::fromJson(const QJsonObject &json, const QVector<View3DPart> &parts, QJsonObject *rest)
{
    View3DSettings settings;
    *rest = json;
    settings.position = rest->take(QStringLiteral("position")).toString();
    settings.orientation = rest->take(QStringLiteral("orientation")).toString();
    const QString preset = rest->take(QStringLiteral("camera")).toString();
    settings.camera = cameraFrom(preset, rest->take(QStringLiteral("view")).toObject());
    settings.model = rest->take(QStringLiteral("model")).toString();
    settings.entities = rest->take(QStringLiteral("entities")).toArray();
    settings.bodyScale = std::clamp(rest->take(QStringLiteral("bodyScale")).toDouble(), 0.0, largestBodyScale);
    for (const View3DPart &part : parts)
        settings.setShown(part.key, rest->take(part.key).toBool(true));
    return settings;
}

QJsonObject View3DSettings::toJson() const
{
    QJsonObject json;
    const std::pair<const char *, QString> texts[]
        = {{"position", position}, {"orientation", orientation}, {"model", model}};
    for (const auto &text : texts) {
        if (!text.second.isEmpty())
            json.insert(QLatin1String(text.first), text.second);
    }
    if (camera.preset != OrbitCamera::GroundStation)
        json.insert(QStringLiteral("camera"), OrbitCamera::presetText(camera.preset));
    const QJsonObject view = viewJson(camera);
    if (!view.isEmpty())
        json.insert(QStringLiteral("view"), view);
    if (!entities.isEmpty())
        json.insert(QStringLiteral("entities"), entities);
    if (bodyScale > 0)
        json.insert(QStringLiteral("bodyScale"), bodyScale);
    for (const QString &part : hidden)
        json.insert(part, false);
    return json;
}

}  // namespace qplc
