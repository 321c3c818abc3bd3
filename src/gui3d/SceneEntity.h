// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcScene3D.h"

#include <QtCore/QJsonArray>
#include <QtCore/QString>
#include <QtCore/QStringList>

#include <functional>
#include <optional>
#include <vector>

namespace qplc {

/// Something of a user's own in the scene: a mark, a line or an arrow between places that signals
/// tell. A value type.
struct SceneEntity
{
    enum Kind { Mark, Line, Arrow };

    Kind kind = Mark;
    QVector3D from;  // [m]
    QVector3D to;    // [m]; that of a mark means nothing
    QColor color;    // invalid: that of texts
    QString name;

    /// What is known of a signal now; nothing when it is not there, or has less than three
    /// elements.
    using VectorOf = std::function<std::optional<QVector3D>(const QString &reference)>;

    /// Entities that can be drawn now. What is no entity is left out; a place is the name of a
    /// signal or three numbers.
    /// \param entities of the settings \param body where things are that say no place [m] \param
    ///         missing takes the names of signals that are not there
    static std::vector<SceneEntity> read(const QJsonArray &entities, const QVector3D &body, const VectorOf &vectorOf,
                                         QStringList *missing);
};

/// Draws them with their names.
void drawEntities(QPlcScene3D *scene, const std::vector<SceneEntity> &entities);

}  // namespace qplc
