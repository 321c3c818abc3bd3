// SPDX-License-Identifier: Apache-2.0
#include "QPlcScene3D.h"

#include "SceneContent.h"

QPlcScene3D::QPlcScene3D()
    : d(std::make_unique<qplc::SceneContent>())
{
}

QPlcScene3D::~QPlcScene3D() = default;

void QPlcScene3D::addLine(const QVector3D &from, const QVector3D &to, const QColor &color, float width)
{
    d->lines.addLine(from, to, color, width);
}

void QPlcScene3D::addLine(const QVector3D &from, const QVector3D &to, const QColor &fromColor, const QColor &toColor,
                          float width)
{
    d->lines.addLine(from, to, fromColor, toColor, width);
}

void QPlcScene3D::addArrow(const QVector3D &from, const QVector3D &to, const QColor &color, float width, float head)
{
    d->lines.addArrow(from, to, color, width, head);
}

void QPlcScene3D::addName(const QVector3D &place, const QString &text, const QColor &color,
                          std::optional<QVector3D> arrowBegin)
{
    d->labels.push_back({place, text, color, arrowBegin});
}
