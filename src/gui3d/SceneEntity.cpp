// SPDX-License-Identifier: Apache-2.0
#include "SceneEntity.h"

#include <QtCore/QJsonObject>

#include <cmath>

namespace qplc {

namespace {

constexpr float width = 2.0f;       // [px]
constexpr float markSize = 0.015f;  // of the scene
constexpr float headSize = 0.03f;

/// Reads places and vectors, and remembers what is not there.
class Reader
{
public:
    Reader(const SceneEntity::VectorOf &vectorOf, QStringList *missing)
        : m_vectorOf(vectorOf)
        , m_missing(*missing)
    {
    }

    std::optional<QVector3D> vector(const QJsonValue &value) const
    {
        if (value.isArray())
            return numbers(value.toArray());
        const QString reference = value.toString();
        const std::optional<QVector3D> found = reference.isEmpty() ? std::nullopt : m_vectorOf(reference);
        if (!found && !reference.isEmpty() && !m_missing.contains(reference))
            m_missing.append(reference);
        return found;
    }

private:
    static std::optional<QVector3D> numbers(const QJsonArray &array)
    {
        QVector3D vector;
        for (int i = 0; i < 3; ++i) {
            if (array.size() != 3 || !array.at(i).isDouble())
                return std::nullopt;
            vector[i] = float(array.at(i).toDouble());
        }
        return vector;
    }

    const SceneEntity::VectorOf &m_vectorOf;
    QStringList &m_missing;
};

std::optional<SceneEntity> entityOf(const QJsonObject &json, const QVector3D &body, const Reader &reader)
{
    const QJsonValue at = json.value(QStringLiteral("at"));
    const QJsonValue to = json.value(QStringLiteral("to"));
    const QJsonValue vector = json.value(QStringLiteral("vector"));
    const std::optional<QVector3D> from = at.isUndefined() ? std::optional<QVector3D>(body) : reader.vector(at);
    SceneEntity entity;
    entity.name = json.value(QStringLiteral("name")).toString();
    entity.color = QColor(json.value(QStringLiteral("color")).toString());
    entity.kind = !vector.isUndefined() ? SceneEntity::Arrow
        : !to.isUndefined()             ? SceneEntity::Line
                                        : SceneEntity::Mark;
    const std::optional<QVector3D> end = entity.kind == SceneEntity::Arrow ? reader.vector(vector)
        : entity.kind == SceneEntity::Line                                 ? reader.vector(to)
                                                                           : from;
    if (!from || !end)
        return std::nullopt;
    entity.from = *from;
    const float scale = float(json.value(QStringLiteral("scale")).toDouble(1.0));
    entity.to = entity.kind == SceneEntity::Arrow ? *from + scale * *end : *end;
    return entity;
}

}  // namespace

std::vector<SceneEntity> SceneEntity::read(const QJsonArray &entities, const QVector3D &body, const VectorOf &vectorOf,
                                           QStringList *missing)
{
    std::vector<SceneEntity> all;
    const Reader reader(vectorOf, missing);
    for (const QJsonValue &each : entities) {
        const std::optional<SceneEntity> entity
            = each.isObject() ? entityOf(each.toObject(), body, reader) : std::nullopt;
        if (entity)
            all.push_back(*entity);
    }
    return all;
}

void drawEntities(QPlcScene3D *scene, const std::vector<SceneEntity> &entities)
{
    for (const SceneEntity &entity : entities) {
        const QColor color = entity.color.isValid() ? entity.color : scene->theme.text;
        if (entity.kind == SceneEntity::Arrow)
            scene->addArrow(entity.from, entity.to, color, width, headSize * scene->size);
        if (entity.kind == SceneEntity::Line)
            scene->addLine(entity.from, entity.to, color, width);
        for (int axis = 0; entity.kind == SceneEntity::Mark && axis < 3; ++axis) {
            QVector3D arm;
            arm[axis] = markSize * scene->size;
            scene->addLine(entity.from - arm, entity.from + arm, color, width);
        }
        if (!entity.name.isEmpty())
            scene->addName(entity.to, entity.name, color);
    }
}

}  // namespace qplc
