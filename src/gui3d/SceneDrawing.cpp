// SPDX-License-Identifier: Apache-2.0
#include "SceneDrawing.h"

#include "QPlcView3D.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace qplc {

namespace {

constexpr float visibleShare = 0.085f;  // of the height of the picture: a smaller body is drawn larger

QColor faded(QColor color, double opacity)
{
    color.setAlphaF(std::clamp(opacity, 0.0, 1.0) * color.alphaF());
    return color;
}

QColor mixedColor(const QColor &a, const QColor &b, double share)
{
    const auto mix = [share](double from, double to) { return from + (to - from) * share; };
    return QColor::fromRgbF(mix(a.redF(), b.redF()), mix(a.greenF(), b.greenF()), mix(a.blueF(), b.blueF()));
}

std::array<QColor, 3> axisColors(const QPlcTheme &theme)
{
    if (theme.isDark)
        return {QColor(0xe8, 0x83, 0x7a), QColor(0x7f, 0xc9, 0x8b), QColor(0x86, 0xb4, 0xf0)};
    return {QColor(0xb5, 0x45, 0x3c), QColor(0x2f, 0x80, 0x3f), QColor(0x2f, 0x5f, 0xb0)};
}

QVector3D alongAxis(int axis, float length)
{
    QVector3D end;
    end[axis] = length;
    return end;
}

/// A line of the grid, which fades away from the origin.
void addGridLine(LineBatch *lines, const QVector3D &from, const QVector3D &to, float radius, const QColor &color)
{
    constexpr int parts = 8;
    const auto opacity = [radius](const QVector3D &point) { return 1.0 - double(point.length() / radius); };
    for (int i = 0; i < parts; ++i) {
        const QVector3D a = from + (to - from) * (float(i) / parts);
        const QVector3D b = from + (to - from) * (float(i + 1) / parts);
        lines->addLine(a, b, faded(color, opacity(a)), faded(color, opacity(b)), 1.0f);
    }
}

/// A dotted line down to the ground, where a cross lies: depth for the eye.
void addPlumbLine(QPlcScene3D *scene)
{
    const QVector3D top = *scene->position;
    const QVector3D foot(top.x(), top.y(), 0);
    const QColor color = faded(scene->theme.mutedText, 0.6);
    constexpr int dots = 24;
    for (int i = 0; i < dots; ++i)
        scene->addLine(foot + (top - foot) * (float(i) / dots), foot + (top - foot) * ((float(i) + 0.45f) / dots),
                       color, 1);
    const float arm = 0.025f * scene->size;
    scene->addLine(foot - QVector3D(arm, 0, 0), foot + QVector3D(arm, 0, 0), color, 1.4f);
    scene->addLine(foot - QVector3D(0, arm, 0), foot + QVector3D(0, arm, 0), color, 1.4f);
}

void addBodyAxes(QPlcScene3D *scene)
{
    const std::array<QColor, 3> colors = axisColors(scene->theme);
    const float length = 1.21f * scene->bodyScale * scene->bodyRadius;
    for (int i = 0; i < 3; ++i) {
        const QVector3D end = *scene->position + scene->orientation->rotatedVector(alongAxis(i, length));
        scene->addArrow(*scene->position, end, colors[std::size_t(i)], 1.3f, 0.12f * length);
    }
}

void addModelLines(QPlcScene3D *scene, const ObjMesh &model)
{
    const auto toEarth = [scene](const QVector3D &point) {
        return *scene->position + scene->orientation->rotatedVector(scene->bodyScale * point);
    };
    for (const auto &line : model.lines)
        scene->addLine(toEarth(line.first), toEarth(line.second), faded(scene->theme.text, 0.8), 1.0f);
}

void addAxisNames(QPlcScene3D *scene)
{
    const std::array<QColor, 3> colors = axisColors(scene->theme);
    const QString names[] = {QPlcView3D::tr("east"), QPlcView3D::tr("north"), QPlcView3D::tr("up")};
    for (int i = 0; i < 3; ++i)
        scene->addName(alongAxis(i, 0.13f * scene->size), names[i], colors[std::size_t(i)], QVector3D());
}

}  // namespace

float visibleBodyScale(const CameraPose &pose, const QVector3D &body, float radius)
{
    if (radius <= 0.0f)
        return 1.0f;
    const float distance = (body - pose.eye).length();
    const float height = pose.heightAtTarget() * distance / std::max(0.001f, pose.distance());
    return std::max(1.0f, visibleShare * height / radius);
}

void drawGround(LineBatch *lines, const QPlcScene3D &scene, const View3DSettings &settings)
{
    if (settings.isShown(QStringLiteral("ground"))) {
        const float radius = 1.6f * scene.size;
        const float step = scene.size / 5.0f;
        const QColor color = mixedColor(scene.theme.line, scene.theme.mutedText, 0.25);
        for (int i = -8; i <= 8; ++i) {
            const float off = float(i) * step;
            const float half = std::sqrt(std::max(0.0f, radius * radius - off * off));
            addGridLine(lines, {off, -half, 0}, {off, half, 0}, radius, color);
            addGridLine(lines, {-half, off, 0}, {half, off, 0}, radius, color);
        }
    }
    if (settings.isShown(QStringLiteral("axes"))) {
        const std::array<QColor, 3> colors = axisColors(scene.theme);
        for (int i = 0; i < 3; ++i)
            lines->addArrow({}, alongAxis(i, 0.11f * scene.size), colors[std::size_t(i)], 1.6f, 0.02f * scene.size);
    }
}

void drawBody(QPlcScene3D *scene, const View3DSettings &settings, const ObjMesh &model)
{
    const bool hasAxes = settings.isShown(QStringLiteral("axes"));
    if (hasAxes)
        addAxisNames(scene);
    if (!scene->position)
        return;
    if (settings.isShown(QStringLiteral("ground")))
        addPlumbLine(scene);
    if (!scene->orientation)
        return;
    addModelLines(scene, model);
    if (hasAxes)
        addBodyAxes(scene);
}

}  // namespace qplc
