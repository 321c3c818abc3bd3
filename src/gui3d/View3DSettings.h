// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "OrbitCamera.h"

#include <QtCore/QJsonArray>
#include <QtCore/QJsonObject>
#include <QtCore/QStringList>
#include <QtCore/QVector>

namespace qplc {

/// A part of the picture that people may switch off.
struct View3DPart
{
    QString key;  // in settings
    QString title;
};

/// What makes a 3D view what it is, and its JSON. A value type; what has its default is not
/// written.
struct View3DSettings
{
    QString position;     // signal; empty: there is no body
    QString orientation;  // signal; empty: as the model is
    OrbitCamera camera;
    QStringList hidden;    // keys of parts
    QString model;         // OBJ file; empty: that of the view
    QJsonArray entities;   // of the user's own: see SceneEntity
    double bodyScale = 0;  // how much larger than it is the body is drawn; 0: large enough to be seen

    static constexpr double largestBodyScale = 100.0;

    bool isShown(const QString &part) const { return !hidden.contains(part); }
    void setShown(const QString &part, bool isShown);

    /// What is missing, or of another kind, has its default. \param rest takes what was no key of
    /// this
    static View3DSettings fromJson(const QJsonObject &json, const QVector<View3DPart> &parts, QJsonObject *rest);
    QJsonObject toJson() const;
};

}  // namespace qplc
