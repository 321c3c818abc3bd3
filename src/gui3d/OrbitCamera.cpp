// SPDX-License-Identifier: Apache-2.0
#include "OrbitCamera.h"

#include <QtCore/QtMath>

#include <algorithm>
#include <array>
#include <cmath>

namespace qplc {

namespace {

/// Of a scene that is 1 m large, with the heading 0.
struct PresetPose
{
    const char *text;
    QVector3D target;
    float yaw;  // from the target to the eye [deg]
    float pitch;
    float distance;
};

const std::array<PresetPose, OrbitCamera::presets> presetPoses = {{
    {"ground station", {0.45f, 0, 0.35f}, 180, 9, 1.75f},
    {"side", {0.42f, 0, 0.36f}, -90, 7, 1.65f},
    {"top", {0.45f, 0, 0}, 180, 90, 1.9f},
    {"downwind", {0.42f, 0, 0.34f}, 0, 14, 2.0f},
    {"chase", {0, 0, 0}, 180, 24, 4.4f},
}};

QVector3D direction(float yaw, float pitch)
{
    const float y = qDegreesToRadians(yaw);
    const float p = qDegreesToRadians(pitch);
    return {std::cos(p) * std::cos(y), std::cos(p) * std::sin(y), std::sin(p)};
}

}  // namespace

QMatrix4x4 CameraPose::viewMatrix() const
{
    QMatrix4x4 matrix;
    matrix.lookAt(eye, target, up);
    return matrix;
}

float CameraPose::heightAtTarget() const
{
    return 2.0f * distance() * std::tan(qDegreesToRadians(0.5f * fieldOfView));
}

QMatrix4x4 projectionMatrix(const CameraPose &pose, const QSizeF &size, float sceneSize)
{
    const float aspect = float(size.width() / std::max(1.0, size.height()));
    const float nearest = std::max(0.02f * pose.distance(), 0.05f);
    const float farthest = pose.eye.length() + pose.distance() + 6.0f * sceneSize;
    QMatrix4x4 matrix;
    matrix.perspective(CameraPose::fieldOfView, aspect, nearest, farthest);
    return matrix;
}

std::optional<QPointF> projected(const CameraPose &pose, const QVector3D &point, const QSizeF &size)
{
    const QVector4D clip = projectionMatrix(pose, size, 1.0f) * pose.viewMatrix() * QVector4D(point, 1.0f);
    if (clip.w() <= 0.0f)
        return std::nullopt;
    return QPointF((0.5 + 0.5 * double(clip.x() / clip.w())) * size.width(),
                   (0.5 - 0.5 * double(clip.y() / clip.w())) * size.height());
}

QString OrbitCamera::presetText(Preset preset)
{
    return QLatin1String(presetPoses[std::size_t(preset)].text);
}

OrbitCamera::Preset OrbitCamera::presetOf(const QString &text)
{
    for (int i = 0; i < presets; ++i) {
        if (text == presetText(Preset(i)))
            return Preset(i);
    }
    return GroundStation;
}

bool OrbitCamera::isMoved() const
{
    return yaw != 0.0f || pitch != 0.0f || zoom != 1.0f || !pan.isNull();
}

void OrbitCamera::drag(const QPointF &pixels, double height)
{
    // Half a turn for a drag over the height of the picture.
    const float perPixel = float(180.0 / std::max(1.0, height));
    const float base = presetPoses[std::size_t(preset)].pitch;
    yaw = std::remainder(yaw - float(pixels.x()) * perPixel, 360.0f);
    pitch = std::clamp(base + pitch + float(pixels.y()) * perPixel, -88.0f, 90.0f) - base;
}

void OrbitCamera::dragSideways(const QPointF &pixels, double height)
{
    // In the camera's own frame: a course of half a turn makes that of the chase camera the
    // earth's.
    const CameraPose unit = pose({1.0f, 0, {}, QQuaternion::fromAxisAndAngle(0, 0, 1, 180), 1.0f});
    const QVector3D right = QVector3D::crossProduct(unit.target - unit.eye, unit.up).normalized();
    const float perPixel = unit.heightAtTarget() / float(std::max(1.0, height));
    const QVector3D way = perPixel * (float(pixels.y()) * unit.up - float(pixels.x()) * right);
    for (int i = 0; i < 3; ++i)
        pan[i] = std::clamp(pan[i] + way[i], -3.0f, 3.0f);
}

void OrbitCamera::zoomBy(double factor)
{
    zoom = std::clamp(zoom * float(factor), 0.1f, 40.0f);
}

CameraPose OrbitCamera::pose(const Scene &scene) const
{
    const PresetPose &base = presetPoses[std::size_t(preset)];
    const float size = isBodyFixed() ? scene.bodySize : scene.size;
    // The camera's own frame: x along the heading, or along the course with z outwards.
    const QQuaternion frame = isBodyFixed() ? scene.course * QQuaternion::fromAxisAndAngle(0, 0, 1, 180)
                                            : QQuaternion::fromAxisAndAngle(0, 0, 1, scene.heading);
    const QVector3D origin = isBodyFixed() ? scene.body : QVector3D();
    const QVector3D target = size * (base.target + pan);
    const QVector3D back = direction(base.yaw + yaw, base.pitch + pitch);
    const QVector3D up = direction(base.yaw + yaw + 180.0f, 90.0f - base.pitch - pitch);
    const QVector3D eye = target + (size * base.distance / zoom) * back;
    return {origin + frame.rotatedVector(eye), origin + frame.rotatedVector(target), frame.rotatedVector(up)};
}

float roundSceneSize(float length, float before)
{
    if (!std::isfinite(length) || length <= 0.0f)
        return before > 0.0f ? before : 100.0f;
    if (length <= before && length > 0.5f * before)
        return before;
    for (const float size : {20.0f, 50.0f, 100.0f, 150.0f})
        if (length <= size)
            return size;
    return 100.0f * std::ceil(length / 100.0f);
}

}  // namespace qplc
