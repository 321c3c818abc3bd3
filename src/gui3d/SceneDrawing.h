// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ObjMesh.h"
#include "OrbitCamera.h"
#include "QPlcScene3D.h"
#include "SceneContent.h"
#include "View3DSettings.h"

namespace qplc {

/// How much larger than it is a body has to be drawn to be seen: 1 when the camera is near.
float visibleBodyScale(const CameraPose &pose, const QVector3D &body, float radius);
/// Ground and axes of the earth: what stays while the body moves. Only the parts that \a settings
/// show.
void drawGround(LineBatch *lines, const QPlcScene3D &scene, const View3DSettings &settings);
/// Names of the axes of the earth, a plumb line below the body, its axes, and the lines of its
/// model.
void drawBody(QPlcScene3D *scene, const View3DSettings &settings, const ObjMesh &model);

}  // namespace qplc
