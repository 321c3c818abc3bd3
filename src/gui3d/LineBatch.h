// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtGui/QColor>
#include <QtGui/QVector3D>

#include <vector>

namespace qplc {

/// Many lines that are drawn at once, each with colours and a width in pixels. A line is four
/// vertices, which the shader moves apart.
class LineBatch
{
public:
    /// As the shader gets it.
    struct Vertex
    {
        float position[3];
        float otherEnd[3];
        float color[4];  // red, green, blue, opacity
        float side[3];   // -1 or 1 of who looks along the line; 1 at its begin, -1 at its end; width [px]
    };

    void clear() { m_vertices.clear(); }
    void addLine(const QVector3D &a, const QVector3D &b, const QColor &color, float width)
    {
        addLine(a, b, color, color, width);
    }
    void addLine(const QVector3D &a, const QVector3D &b, const QColor &colorA, const QColor &colorB, float width);
    /// A line with a head. Nothing becomes of one without a length. \param head length of the head
    /// [m]
    void addArrow(const QVector3D &from, const QVector3D &to, const QColor &color, float width, float head);

    int lines() const { return int(m_vertices.size() / 4); }
    const std::vector<Vertex> &vertices() const { return m_vertices; }
    /// The vertices as bytes.
    QByteArray vertexBytes() const;
    /// Two triangles for each of so many lines, as 32-bit indices.
    static QByteArray indexBytes(int lines);

private:
    std::vector<Vertex> m_vertices;
};

}  // namespace qplc
