// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QString>
#include <QtGui/QVector3D>

#include <utility>
#include <vector>

namespace qplc {

/// A model of triangles and lines from a Wavefront OBJ file. A value type.
///
/// Elements v (with a colour behind the coordinates, where there is one), vn, f and l are read;
/// others (materials, textures, groups) are skipped. Polygons are taken as convex. Vertices without
/// normals get those of their faces.
struct ObjMesh
{
    struct Vertex
    {
        QVector3D position;
        QVector3D normal;  // unit vector
        QVector3D color;   // red, green, blue, 0 ... 1
    };

    std::vector<Vertex> triangles;                       // three for each
    std::vector<std::pair<QVector3D, QVector3D>> lines;  // ends

    static constexpr int mostTriangles = 500'000;

    /// \return an empty mesh, and in \a error line and reason, when the text is no such file
    static ObjMesh fromText(const QByteArray &text, QString *error);
    /// The same for a file of at most 64 MiB; the error names the file too.
    static ObjMesh fromFile(const QString &path, QString *error);
    bool isEmpty() const { return triangles.empty() && lines.empty(); }
    /// Largest distance of a vertex from the origin [m].
    float radius() const;
};

}  // namespace qplc
