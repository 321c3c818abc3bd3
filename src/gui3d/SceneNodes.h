// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LineBatch.h"
#include "ObjMesh.h"

#include <Qt3DCore/QEntity>
#include <Qt3DCore/QTransform>
#include <Qt3DRender/QAttribute>
#include <Qt3DRender/QBuffer>
#include <Qt3DRender/QGeometryRenderer>
#include <Qt3DRender/QMaterial>
#include <Qt3DRender/QParameter>

namespace qplc {

/// Draws with two shaders of ours; the frame graph draws pass "solid" before pass "lines".
class SceneMaterial : public Qt3DRender::QMaterial
{
    Q_OBJECT
public:
    enum Kind { Solid, Lines };
    explicit SceneMaterial(Kind kind, Qt3DCore::QNode *parent);
    /// Of the picture [px], and device pixels for a pixel of line width.
    void setViewport(const QSize &size, double pixelRatio);

private:
    Qt3DRender::QParameter *m_viewport = nullptr;
};

/// An entity whose vertices are changed in place: nodes and buffers are made once.
class BufferEntity : public Qt3DCore::QEntity
{
    Q_OBJECT
public:
    BufferEntity(SceneMaterial *material, Qt3DCore::QNode *parent);

protected:
    void addAttribute(const char *name, uint size, uint offset, uint stride);
    void addIndices();
    Qt3DRender::QBuffer *m_vertexData;
    Qt3DRender::QBuffer *m_indexData = nullptr;
    Qt3DRender::QGeometry *m_geometry;
    Qt3DRender::QGeometryRenderer *m_renderer;
    QVector<Qt3DRender::QAttribute *> m_attributes;
    Qt3DRender::QAttribute *m_indices = nullptr;
};

class LineEntity : public BufferEntity
{
    Q_OBJECT
public:
    LineEntity(SceneMaterial *material, Qt3DCore::QNode *parent);
    void setLines(const LineBatch &lines);

private:
    int m_indexedLines = 0;
};

class MeshEntity : public BufferEntity
{
    Q_OBJECT
public:
    MeshEntity(SceneMaterial *material, Qt3DCore::QNode *parent);
    void setMesh(const ObjMesh &mesh);
    Qt3DCore::QTransform *transform() { return m_transform; }

private:
    Qt3DCore::QTransform *m_transform;
};

}  // namespace qplc
