// SPDX-License-Identifier: Apache-2.0
#include "KiteScene.h"

#include "KiteText.h"
#include <QPlcScene3D.h>

#include <algorithm>
#include <cmath>

namespace awe {

namespace {

constexpr int tetherPoints = 25;
const QColor windColor(0x2f, 0x7f, 0xe0);   // of the relative wind
const QColor forceColor(0xd8, 0x3a, 0x34);  // of the aerodynamic force

QColor faded(QColor color, double opacity)
{
    color.setAlphaF(opacity * color.alphaF());
    return color;
}

/// Thin letters need more contrast than arrows.
QColor textColor(const QColor &arrow, const QPlcTheme &theme)
{
    return theme.isDark ? arrow.lighter(135) : arrow.darker(115);
}

QVector3D bridlePoint(const QPlcScene3D &scene, const QVector3D &bridle)
{
    const QVector3D inBody = scene.bodyScale * bridle;
    return *scene.position + (scene.orientation ? scene.orientation->rotatedVector(inBody) : QVector3D());
}

/// An arrow at the kite. \param length  1 is about as long as the kite is large
void addVector(QPlcScene3D *scene, const QVector3D &direction, float length, const QColor &color, const QString &name)
{
    const float unit = 2.2f * scene->bodyScale * scene->bodyRadius;
    const QVector3D vector = unit * length * direction.normalized();
    scene->addArrow(*scene->position, *scene->position + vector, color, 2.4f, 0.12f * unit);
    scene->addName(*scene->position + 1.12f * vector, name, textColor(color, scene->theme));
}

}  // namespace

float windVectorLength(float speed)
{
    return speed / 30.0f;
}

float forceVectorLength(float force, float reference)
{
    return force / reference;
}

float forceReference(float force, float before)
{
    if (!(force > before))
        return before;
    return float(ColorScale::around(0.0, double(force)).maximum);
}

void drawTrail(QPlcScene3D *scene, const FlightTrail &trail, const ColorScale &scale, float width)
{
    const std::vector<FlightTrail::Point> &points = trail.points();
    QColor before;
    for (std::size_t i = 0; i < points.size(); ++i) {
        QColor color = scale.color(double(points[i].value));
        color.setAlphaF(0.15 + 0.85 * double(i + 1) / double(points.size()));
        if (points[i].isJoined)
            scene->addLine(points[i - 1].position, points[i].position, before, color, width);
        before = color;
    }
}

void drawWindAxes(QPlcScene3D *scene, const KiteState &kite)
{
    if (!kite.wind)
        return;
    const float downwind = *scene->heading;
    const QVector3D along = positionOf({downwind, 0, 0.28f * scene->size});
    const QVector3D across = positionOf({downwind + 90, 0, 0.1f * scene->size});
    scene->addArrow({}, along, scene->theme.accent, 2.2f, 0.03f * scene->size);
    scene->addArrow({}, across, faded(scene->theme.accent, 0.7), 1.2f, 0.02f * scene->size);
    scene->addName(positionOf({downwind, 0, 0.31f * scene->size}),
                   KiteText::tr("wind %1 m/s").arg(double(kite.wind->length()), 0, 'f', 1), scene->theme.accent);
}

void drawMast(QPlcScene3D *scene, const KiteState &kite)
{
    if (!kite.mastTop)
        return;
    const QVector3D top = *kite.mastTop;
    scene->addLine({top.x(), top.y(), 0.0f}, top, scene->theme.text, 3.0f);
    scene->addName(top, KiteText::tr("mast"), scene->theme.mutedText);
}

void drawSmallEarth(QPlcScene3D *scene)
{
    if (!scene->position)
        return;
    const QColor thin = faded(scene->theme.accent, scene->theme.isDark ? 0.28 : 0.30);
    const QColor edge = faded(scene->theme.accent, 0.6);
    const auto at = [scene](int azimuth, int elevation) {
        return positionOf({*scene->heading + float(azimuth), float(elevation), scene->position->length()});
    };
    for (int azimuth = -90; azimuth <= 90; azimuth += 15) {
        for (int elevation = 0; elevation < 90; elevation += 6)
            scene->addLine(at(azimuth, elevation), at(azimuth, elevation + 6), std::abs(azimuth) == 90 ? edge : thin,
                           1);
    }
    for (int elevation = 0; elevation < 90; elevation += 15) {
        for (int azimuth = -90; azimuth < 90; azimuth += 6)
            scene->addLine(at(azimuth, elevation), at(azimuth + 6, elevation), elevation == 0 ? edge : thin, 1);
    }
}

void drawTether(QPlcScene3D *scene, const KiteState &kite, const QVector3D &bridle)
{
    if (!scene->position)
        return;
    const QVector3D end = bridlePoint(*scene, bridle);
    if (!kite.tetherNodes.empty()) {
        QVector3D before;  // the winch
        for (const QVector3D &node : kite.tetherNodes) {
            scene->addLine(before, node, scene->theme.text, 1.4f);
            before = node;
        }
        scene->addLine(before, end, scene->theme.text, 1.4f);
        return;
    }
    // A body that is drawn larger than it is has its bridle nearer: the tether hangs no more for
    // that.
    const float slack = float(kite.tetherLength.value_or(0.0)) - scene->position->length();
    const float length = end.length() + std::max(0.0f, slack);
    for (int i = 1; i < tetherPoints; ++i) {
        scene->addLine(tetherPoint(end, length, i - 1, tetherPoints), tetherPoint(end, length, i, tetherPoints),
                       scene->theme.text, 1.4f);
    }
}

void drawVectors(QPlcScene3D *scene, const KiteState &kite, float forceUnit)
{
    if (!scene->position)
        return;
    if (const std::optional<QVector3D> wind = kite.relativeWind())
        addVector(scene, *wind, windVectorLength(wind->length()), windColor,
                  KiteText::tr("%1 m/s").arg(double(wind->length()), 0, 'f', 0));
    if (const std::optional<QVector3D> &force = kite.force)
        addVector(scene, *force, forceVectorLength(force->length(), forceUnit), forceColor,
                  KiteText::tr("%1 N").arg(double(force->length()), 0, 'f', 0));
}

}  // namespace awe
