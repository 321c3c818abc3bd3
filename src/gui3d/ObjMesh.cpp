// SPDX-License-Identifier: Apache-2.0
#include "ObjMesh.h"

#include "QPlcView3D.h"

#include <QtCore/QFile>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr qint64 largestFile = 64 * 1024 * 1024;
const QVector3D defaultColor(0.8f, 0.8f, 0.78f);

class ObjReader
{
public:
    ObjMesh read(const QByteArray &text, QString *error)
    {
        int number = 0;
        for (const QByteArray &line : text.split('\n')) {
            ++number;
            if (!readLine(line.simplified())) {
                *error = QPlcView3D::tr("line %1: %2").arg(number).arg(m_error);
                return {};
            }
        }
        if (m_mesh.isEmpty())
            *error = QPlcView3D::tr("it has neither faces nor lines");
        return m_mesh;
    }

private:
    struct Corner
    {
        std::size_t position;
        std::size_t normal;  // npos: none
    };
    static constexpr std::size_t npos = std::size_t(-1);

    bool fail(const QString &error)
    {
        m_error = error;
        return false;
    }

    bool readLine(const QByteArray &line)
    {
        const QList<QByteArray> words = line.split(' ');
        const QByteArray &kind = words.first();
        if (kind == "v")
            return readPosition(words);
        if (kind == "vn")
            return readVector(words, 1, &m_normals.emplace_back());
        if (kind == "f")
            return readFace(words);
        if (kind == "l")
            return readLineElement(words);
        return true;
    }

    bool readVector(const QList<QByteArray> &words, int first, QVector3D *vector)
    {
        for (int i = 0; i < 3; ++i) {
            bool isNumber = false;
            (*vector)[i] = words.value(first + i).toFloat(&isNumber);
            if (!isNumber || !std::isfinite((*vector)[i]))
                return fail(QPlcView3D::tr("'%1' is not a number").arg(QString::fromLatin1(words.value(first + i))));
        }
        return true;
    }

    bool readPosition(const QList<QByteArray> &words)
    {
        m_colors.push_back(defaultColor);
        if (words.size() >= 7 && !readVector(words, 4, &m_colors.back()))
            return false;
        return readVector(words, 1, &m_positions.emplace_back());
    }

    bool readIndex(const QByteArray &word, std::size_t count, std::size_t *index)
    {
        bool isNumber = false;
        const qint64 number = word.toLongLong(&isNumber);
        const qint64 place = number < 0 ? qint64(count) + number : number - 1;
        if (!isNumber || number == 0 || place < 0 || place >= qint64(count))
            return fail(QPlcView3D::tr("there is no vertex '%1'").arg(QString::fromLatin1(word)));
        *index = std::size_t(place);
        return true;
    }

    bool readCorner(const QByteArray &word, Corner *corner)
    {
        const QList<QByteArray> parts = word.split('/');
        corner->normal = npos;
        if (!readIndex(parts.first(), m_positions.size(), &corner->position))
            return false;
        return parts.value(2).isEmpty() || readIndex(parts.at(2), m_normals.size(), &corner->normal);
    }

    bool readFace(const QList<QByteArray> &words)
    {
        std::vector<Corner> corners(std::size_t(words.size() - 1));
        if (corners.size() < 3)
            return fail(QPlcView3D::tr("a face has at least three corners"));
        for (std::size_t i = 0; i < corners.size(); ++i) {
            if (!readCorner(words.at(int(i) + 1), &corners[i]))
                return false;
        }
        if (m_mesh.triangles.size() / 3 + corners.size() - 2 > std::size_t(ObjMesh::mostTriangles))
            return fail(QPlcView3D::tr("more than %1 triangles").arg(ObjMesh::mostTriangles));
        for (std::size_t i = 2; i < corners.size(); ++i)
            addTriangle(corners[0], corners[i - 1], corners[i]);
        return true;
    }

    void addTriangle(const Corner &a, const Corner &b, const Corner &c)
    {
        const QVector3D flat
            = QVector3D::normal(m_positions[a.position], m_positions[b.position], m_positions[c.position]);
        for (const Corner &corner : {a, b, c}) {
            const QVector3D normal = corner.normal == npos ? flat : m_normals[corner.normal].normalized();
            m_mesh.triangles.push_back({m_positions[corner.position], normal, m_colors[corner.position]});
        }
    }

    bool readLineElement(const QList<QByteArray> &words)
    {
        Corner before{};
        for (int i = 1; i < words.size(); ++i) {
            Corner corner{};
            if (!readCorner(words.at(i), &corner))
                return false;
            if (i > 1)
                m_mesh.lines.emplace_back(m_positions[before.position], m_positions[corner.position]);
            before = corner;
        }
        return true;
    }

    ObjMesh m_mesh;
    std::vector<QVector3D> m_positions;
    std::vector<QVector3D> m_colors;
    std::vector<QVector3D> m_normals;
    QString m_error;
};

}  // namespace

ObjMesh ObjMesh::fromText(const QByteArray &text, QString *error)
{
    return ObjReader().read(text, error);
}

ObjMesh ObjMesh::fromFile(const QString &path, QString *error)
{
    QFile file(path);
    QString reason;
    ObjMesh mesh;
    if (!file.open(QIODevice::ReadOnly))
        reason = file.errorString();
    else if (file.size() > largestFile)
        reason = QPlcView3D::tr("it is larger than %1 MiB").arg(largestFile / (1024 * 1024));
    else
        mesh = fromText(file.readAll(), &reason);
    if (!reason.isEmpty())
        *error = QPlcView3D::tr("The model %1 cannot be read: %2").arg(path, reason);
    return mesh;
}

float ObjMesh::radius() const
{
    float radius = 0;
    for (const Vertex &vertex : triangles)
        radius = std::max(radius, vertex.position.length());
    for (const auto &line : lines)
        radius = std::max({radius, line.first.length(), line.second.length()});
    return radius;
}

}  // namespace qplc
