// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QPointF>
#include <QtGui/QQuaternion>
#include <QtGui/QVector3D>

namespace awe {

// Where a kite is and how it stands, for the eye: single precision is enough. Frames as in the
// example's plant: the earth's is x east, y north, z up with the ground station in its origin; the
// body's is x_b to the tail, y_b along the span, z_b out of the top side. Angles are in degrees. An
// azimuth grows from x to y: seen from the ground station, to the left.

/// A position as a ground station sees it: on the "small earth", the sphere about it on which the
/// kite flies.
struct SkyPosition
{
    float azimuth = 0;    // [deg] -180 ... 180
    float elevation = 0;  // [deg] -90 ... 90
    float distance = 0;   // [m]
};

/// The position of the winch itself is azimuth 0, elevation 0.
SkyPosition skyPosition(const QVector3D &position);
QVector3D positionOf(const SkyPosition &sky);
/// An angle within -180 < angle <= 180 [deg].
double wrappedAngle(double angle);
/// Azimuth to which the wind blows [deg]; 0 without a horizontal part.
float downwindAzimuth(const QVector3D &wind);

/// Body to earth: Rz(azimuth) Ry(90 - elevation) Rz(yaw) Ry(pitch).
/// \param positionOrientation (0, 90 - elevation, azimuth) [deg], as the signal
///         bodyPositionOrientation
/// \param controlOrientation   (0, pitch, yaw) [deg], as the signal bodyControlOrientation
QQuaternion bodyOrientation(const QVector3D &positionOrientation, const QVector3D &controlOrientation);
/// The same without pitch: x_b lies in the small earth, z_b looks away from the ground station.
QQuaternion courseOrientation(const QVector3D &positionOrientation, float yaw);
/// As bodyPositionOrientation, from a position.
QVector3D positionOrientation(const QVector3D &position);

/// The sky flat on paper, as somebody at the ground station sees it who looks downwind: the
/// downwind direction at the horizon is (0, 0), x grows to the right, y upwards. The distance from
/// there is the true angle to the wind [deg]: the half circle of 90 deg is the edge of the wind
/// window. \param downwind azimuth to which the wind blows [deg]
QPointF windWindowPoint(float azimuth, float elevation, float downwind);
/// The direction on paper in which something moves or looks, as a unit vector; (0, 0) when it moves
/// along the line of sight.
QPointF windWindowDirection(const QVector3D &position, const QVector3D &direction, float downwind);

/// A tether from the ground station to the kite: a straight line for a taut one, a parabola of the
/// same length below for a slack one.
/// \param length  what is reeled out [m]
/// \param index, count  the point, 0 (ground station) ... count - 1 (kite), count >= 2
QVector3D tetherPoint(const QVector3D &kite, float length, int index, int count);

}  // namespace awe
