// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Kite.h"
#include "OrbitCamera.h"

#include <QtCore/QJsonArray>

namespace qplc {

/// What of the scene is seen. A value type.
struct View3DShow
{
    bool ground = true;
    bool smallEarth = true;
    bool axes = true;
    bool vectors = true;
    bool tether = true;
};

/// What makes a 3D view what it is, and its JSON. A value type; what has its default is not written.
struct View3DSettings
{
    KiteSettings kite;
    OrbitCamera camera;
    View3DShow show;
    QString model;         // OBJ file; empty: the kite
    QJsonArray entities;   // of the user's own: see SceneEntity
    double bodyScale = 0;  // how much larger than it is the body is drawn; 0: large enough to be seen

    static constexpr double largestBodyScale = 100.0;

    /// What is missing, or of another kind, has its default. \param rest  takes what was no key of this
    static View3DSettings fromJson(const QJsonObject &json, QJsonObject *rest);
    QJsonObject toJson() const;
};

}  // namespace qplc
