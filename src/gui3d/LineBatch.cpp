// SPDX-License-Identifier: Apache-2.0
#include "LineBatch.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

LineBatch::Vertex vertexAt(const QVector3D &at, const QVector3D &other, const QColor &color, float side, float way,
                           float width)
{
    return {{at.x(), at.y(), at.z()},
            {other.x(), other.y(), other.z()},
            {float(color.redF()), float(color.greenF()), float(color.blueF()), float(color.alphaF())},
            {side, way, width}};
}

}  // namespace

void LineBatch::addLine(const QVector3D &a, const QVector3D &b, const QColor &colorA, const QColor &colorB, float width)
{
    for (const float side : {1.0f, -1.0f})
        m_vertices.push_back(vertexAt(a, b, colorA, side, 1, width));
    for (const float side : {1.0f, -1.0f})
        m_vertices.push_back(vertexAt(b, a, colorB, side, -1, width));
}

void LineBatch::addArrow(const QVector3D &from, const QVector3D &to, const QColor &color, float width, float head)
{
    const QVector3D way = to - from;
    if (way.isNull())
        return;
    const QVector3D along = way.normalized();
    const QVector3D helper = std::abs(along.z()) < 0.9f ? QVector3D(0, 0, 1) : QVector3D(1, 0, 0);
    const QVector3D side = QVector3D::crossProduct(along, helper).normalized();
    const QVector3D other = QVector3D::crossProduct(along, side);
    const float length = std::min(head, 0.6f * way.length());
    addLine(from, to, color, width);
    for (int i = 0; i < 8; ++i) {
        const float angle = float(i) * float(M_PI) / 4.0f;
        const QVector3D out = std::cos(angle) * side + std::sin(angle) * other;
        addLine(to, to - length * along + 0.3f * length * out, color, width);
    }
}

QByteArray LineBatch::vertexBytes() const
{
    return QByteArray(reinterpret_cast<const char *>(m_vertices.data()), int(m_vertices.size() * sizeof(Vertex)));
}

QByteArray LineBatch::indexBytes(int lines)
{
    QByteArray bytes(lines * 6 * int(sizeof(quint32)), Qt::Uninitialized);
    auto *index = reinterpret_cast<quint32 *>(bytes.data());
    for (quint32 first = 0; first < 4 * quint32(lines); first += 4) {
        for (const quint32 corner : {0u, 1u, 2u, 2u, 1u, 3u})
            *index++ = first + corner;
    }
    return bytes;
}

}  // namespace qplc
