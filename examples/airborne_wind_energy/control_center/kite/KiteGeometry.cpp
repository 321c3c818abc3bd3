// SPDX-License-Identifier: Apache-2.0
#include "KiteGeometry.h"

#include <QtCore/QtMath>

#include <algorithm>
#include <cmath>

namespace awe {

namespace {

QQuaternion turnY(float angle)
{
    return QQuaternion::fromAxisAndAngle(0, 1, 0, angle);
}

QQuaternion turnZ(float angle)
{
    return QQuaternion::fromAxisAndAngle(0, 0, 1, angle);
}

}  // namespace

SkyPosition skyPosition(const QVector3D &position)
{
    const float horizontal = std::hypot(position.x(), position.y());
    return {float(qRadiansToDegrees(std::atan2(position.y(), position.x()))),
            float(qRadiansToDegrees(std::atan2(position.z(), horizontal))), position.length()};
}

QVector3D positionOf(const SkyPosition &sky)
{
    const float azimuth = qDegreesToRadians(sky.azimuth);
    const float elevation = qDegreesToRadians(sky.elevation);
    return sky.distance
        * QVector3D(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                    std::sin(elevation));
}

double wrappedAngle(double angle)
{
    const double rest = std::remainder(angle, 360.0);
    return rest <= -180.0 ? rest + 360.0 : rest;
}

float downwindAzimuth(const QVector3D &wind)
{
    return skyPosition(wind).azimuth;
}

QQuaternion courseOrientation(const QVector3D &positionOrientation, float yaw)
{
    return turnZ(positionOrientation.z()) * turnY(positionOrientation.y()) * turnZ(yaw);
}

QQuaternion bodyOrientation(const QVector3D &positionOrientation, const QVector3D &controlOrientation)
{
    return courseOrientation(positionOrientation, controlOrientation.z()) * turnY(controlOrientation.y());
}

QVector3D positionOrientation(const QVector3D &position)
{
    const SkyPosition sky = skyPosition(position);
    return {0, 90.0f - sky.elevation, sky.azimuth};
}

QPointF windWindowPoint(float azimuth, float elevation, float downwind)
{
    const QVector3D sight = positionOf({azimuth - downwind, elevation, 1.0f});
    const double off = std::hypot(double(sight.y()), double(sight.z()));
    const double angle = qRadiansToDegrees(std::atan2(off, double(sight.x())));
    if (off < 1e-9)
        return {0.0, angle};  // downwind, or upwind: there up is as good as any side
    return {-angle * double(sight.y()) / off, angle * double(sight.z()) / off};
}

QPointF windWindowDirection(const QVector3D &position, const QVector3D &direction, float downwind)
{
    const QVector3D along = QVector3D::dotProduct(direction, position.normalized()) * position.normalized();
    const QVector3D across = direction - along;
    if (across.length() < 1e-3f * direction.length() || position.isNull())
        return {};
    const auto onPaper = [downwind](const QVector3D &point) {
        const SkyPosition sky = skyPosition(point);
        return windWindowPoint(sky.azimuth, sky.elevation, downwind);
    };
    const QVector3D step = 0.005f * position.length() * across.normalized();
    const QPointF way = onPaper(position + step) - onPaper(position - step);
    const double length = std::hypot(way.x(), way.y());
    return length > 0.0 ? way / length : QPointF();
}

QVector3D tetherPoint(const QVector3D &kite, float length, int index, int count)
{
    const float s = float(index) / float(count - 1);
    const float distance = kite.length();
    // A flat parabola over the chord d with sag f is d + 8/3 f^2/d long; a sag of 1.5 % of the
    // distance is the weight of a taut tether.
    const float slack = std::max(0.0f, length - distance);
    const float sag = std::max(0.015f * distance, std::sqrt(0.375f * slack * distance));
    return s * kite - QVector3D(0, 0, 4.0f * sag * s * (1.0f - s));
}

}  // namespace awe
