// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Kite.h"
#include "LineBatch.h"
#include "ObjMesh.h"
#include "OrbitCamera.h"
#include "SceneEntity.h"
#include "View3DSettings.h"

namespace qplc {

/// What a text stands at.
struct SceneLabel
{
    QVector3D place;
    QString text;
    QColor color;
    std::optional<QVector3D> begin = {};  // of the arrow that the text names, if it says nothing else
};

/// Everything that the lines of a scene depend on.
struct SceneInput
{
    KiteState state;
    View3DShow show;
    QPlcTheme theme;
    float size = 100;       // [m]
    float downwind = 0;     // [deg]
    float bodyScale = 1;    // how much larger than it is the body is drawn
    float vectorUnit = 16;  // length of a vector of unit size [m]
    QVector3D bridle;       // where the tether ends, in the model [m]
    std::vector<SceneEntity> entities;
};

inline const QColor windColor(0x2f, 0x7f, 0xe0);   // of the relative wind
inline const QColor forceColor(0xd8, 0x3a, 0x34);  // of the aerodynamic force

/// How much larger than it is a body has to be drawn to be seen: 1 when the camera is near.
float visibleBodyScale(const CameraPose &pose, const QVector3D &body, float radius);
/// Sizes of vectors: a relative wind of 30 m/s is 1 long, and a force of \a reference.
float windVectorLength(float speed);
float forceVectorLength(float force, float reference);
/// The largest force seen so far, in round steps: the force that is 1 long [N].
float forceReference(float force, float before);

/// Ground and axes of the earth: what stays while the kite flies.
void drawGround(LineBatch *lines, const SceneInput &input);
/// Small earth, tether, plumb line, axes, vectors, lines of the model.
void drawKiteScene(LineBatch *lines, const SceneInput &input, const ObjMesh &model, float forceUnit);
void drawTrail(LineBatch *lines, const FlightTrail &trail, const ColorScale &scale, float width);
/// Names of axes and vectors.
std::vector<SceneLabel> sceneLabels(const SceneInput &input, float forceUnit);

}  // namespace qplc
