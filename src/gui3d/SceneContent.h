// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LineBatch.h"

#include <QtCore/QString>

#include <optional>

namespace qplc {

/// What a text stands at.
struct SceneLabel
{
    QVector3D place;
    QString text;
    QColor color;
    std::optional<QVector3D> begin = {};  // of the arrow that the text names, if it says nothing else
};

/// Everything that was added to a scene.
struct SceneContent
{
    LineBatch lines;
    std::vector<SceneLabel> labels;
};

}  // namespace qplc
