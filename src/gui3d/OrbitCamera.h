// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QPointF>
#include <QtCore/QString>
#include <QtGui/QMatrix4x4>
#include <QtGui/QQuaternion>
#include <QtGui/QVector3D>

#include <optional>

namespace qplc {

/// Where a camera stands in the earth frame, and where it looks. A value type.
struct CameraPose
{
    static constexpr float fieldOfView = 42.0f;  // vertical [deg]

    QVector3D eye;
    QVector3D target;
    QVector3D up;  // perpendicular to the line of sight

    float distance() const { return (target - eye).length(); }
    QMatrix4x4 viewMatrix() const;
    /// Height of what is seen at the distance of the target [m].
    float heightAtTarget() const;
};

/// From a point to pixels from the top left; nothing when it is behind the eye.
std::optional<QPointF> projected(const CameraPose &pose, const QVector3D &point, const QSizeF &size);
/// Near and far planes do not cut what is seen of a scene of this size [m].
QMatrix4x4 projectionMatrix(const CameraPose &pose, const QSizeF &size, float sceneSize);

/// A camera that a person turns about a point: one of the presets, and what was changed of it by
/// hand. A value type.
///
/// The four earth-fixed presets stand about the origin and grow with the scene; the chase camera is
/// fixed to the body and follows its course.
struct OrbitCamera
{
    enum Preset { GroundStation, Side, Top, Downwind, Chase };
    static constexpr int presets = 5;

    /// "ground station"; for settings.
    static QString presetText(Preset preset);
    /// GroundStation when \a text is none.
    static Preset presetOf(const QString &text);

    Preset preset = GroundStation;
    float yaw = 0;    // [deg] more than the preset
    float pitch = 0;  // [deg]
    float zoom = 1;   // > 1: nearer
    QVector3D pan;    // of the target, as a share of the scene

    bool isBodyFixed() const { return preset == Chase; }
    bool isMoved() const;
    /// What a person drags \a pixels with, on a picture that is \a height high.
    void drag(const QPointF &pixels, double height);
    void dragSideways(const QPointF &pixels, double height);
    void zoomBy(double factor);

    /// What the pose depends on.
    struct Scene
    {
        float size = 100;       // in round steps [m]
        float heading = 0;      // azimuth along which the presets look [deg]
        QVector3D body;         // position [m], earth
        QQuaternion course;     // of the body, without pitch
        float bodySize = 4.6f;  // radius of the model [m]
    };
    CameraPose pose(const Scene &scene) const;
};

/// The smallest of 20, 50, 100, 150, 200, 300, 400, ... that holds \a length; \a before is kept
/// while it fits well.
float roundSceneSize(float length, float before);

}  // namespace qplc
