// SPDX-License-Identifier: Apache-2.0
#include "SceneDrawing.h"

#include "Kite.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace qplc {

namespace {

constexpr int tetherPoints = 25;
constexpr float visibleShare = 0.085f;  // of the height of the picture: a smaller body is drawn larger

QColor faded(QColor color, double opacity)
{
    color.setAlphaF(std::clamp(opacity, 0.0, 1.0) * color.alphaF());
    return color;
}

std::array<QColor, 3> axisColors(const QPlcTheme &theme)
{
    if (theme.isDark)
        return {QColor(0xe8, 0x83, 0x7a), QColor(0x7f, 0xc9, 0x8b), QColor(0x86, 0xb4, 0xf0)};
    return {QColor(0xb5, 0x45, 0x3c), QColor(0x2f, 0x80, 0x3f), QColor(0x2f, 0x5f, 0xb0)};
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

/// Meridians and parallels of the quarter sphere downwind.
void addSmallEarth(LineBatch *lines, const SceneInput &input, float radius)
{
    const QColor thin = faded(input.theme.accent, input.theme.isDark ? 0.28 : 0.30);
    const QColor edge = faded(input.theme.accent, 0.6);
    const auto at = [&](int azimuth, int elevation) {
        return positionOf({input.downwind + float(azimuth), float(elevation), radius});
    };
    for (int azimuth = -90; azimuth <= 90; azimuth += 15) {
        for (int elevation = 0; elevation < 90; elevation += 6)
            lines->addLine(at(azimuth, elevation), at(azimuth, elevation + 6), std::abs(azimuth) == 90 ? edge : thin,
                           1);
    }
    for (int elevation = 0; elevation < 90; elevation += 15) {
        for (int azimuth = -90; azimuth < 90; azimuth += 6)
            lines->addLine(at(azimuth, elevation), at(azimuth + 6, elevation), elevation == 0 ? edge : thin, 1);
    }
}

QVector3D bridlePoint(const SceneInput &input)
{
    const QVector3D inModel = input.bodyScale * input.bridle;
    return *input.state.position + (input.state.body ? input.state.body->rotatedVector(inModel) : QVector3D());
}

void addTether(LineBatch *lines, const SceneInput &input)
{
    const QVector3D end = bridlePoint(input);
    // A body that is drawn larger than it is has its bridle nearer: the tether hangs no more for that.
    const float slack = float(input.state.tetherLength.value_or(0.0)) - input.state.position->length();
    const float length = end.length() + std::max(0.0f, slack);
    for (int i = 1; i < tetherPoints; ++i) {
        lines->addLine(tetherPoint(end, length, i - 1, tetherPoints), tetherPoint(end, length, i, tetherPoints),
                       input.theme.text, 1.4f);
    }
}

/// A dotted line down to the ground, where a cross lies: depth for the eye.
void addPlumbLine(LineBatch *lines, const SceneInput &input)
{
    const QVector3D top = *input.state.position;
    const QVector3D foot(top.x(), top.y(), 0);
    const QColor color = faded(input.theme.mutedText, 0.6);
    constexpr int dots = 24;
    for (int i = 0; i < dots; ++i)
        lines->addLine(foot + (top - foot) * (float(i) / dots), foot + (top - foot) * ((float(i) + 0.45f) / dots),
                       color, 1);
    const float arm = 0.025f * input.size;
    lines->addLine(foot - QVector3D(arm, 0, 0), foot + QVector3D(arm, 0, 0), color, 1.4f);
    lines->addLine(foot - QVector3D(0, arm, 0), foot + QVector3D(0, arm, 0), color, 1.4f);
}

void addBodyAxes(LineBatch *lines, const SceneInput &input)
{
    const std::array<QColor, 3> colors = axisColors(input.theme);
    const float length = 0.55f * input.vectorUnit;
    for (int i = 0; i < 3; ++i) {
        QVector3D axis;
        axis[i] = length;
        const QVector3D end = *input.state.position + input.state.body->rotatedVector(axis);
        lines->addArrow(*input.state.position, end, colors[std::size_t(i)], 1.3f, 0.12f * length);
    }
}

void addWindAxes(LineBatch *lines, const SceneInput &input)
{
    const QVector3D along = positionOf({input.downwind, 0, 0.28f * input.size});
    const QVector3D across = positionOf({input.downwind + 90, 0, 0.1f * input.size});
    lines->addArrow({}, along, input.theme.accent, 2.2f, 0.03f * input.size);
    lines->addArrow({}, across, faded(input.theme.accent, 0.7), 1.2f, 0.02f * input.size);
}

std::optional<QVector3D> windVector(const SceneInput &input)
{
    const std::optional<QVector3D> wind = input.state.relativeWind();
    if (!wind || !input.state.position)
        return std::nullopt;
    return input.vectorUnit * windVectorLength(wind->length()) * wind->normalized();
}

std::optional<QVector3D> forceVector(const SceneInput &input, float forceUnit)
{
    const std::optional<QVector3D> force = input.state.force;
    if (!force || !input.state.position)
        return std::nullopt;
    return input.vectorUnit * forceVectorLength(force->length(), forceUnit) * force->normalized();
}

void addVectors(LineBatch *lines, const SceneInput &input, float forceUnit)
{
    const float head = 0.12f * input.vectorUnit;
    if (const auto wind = windVector(input))
        lines->addArrow(*input.state.position, *input.state.position + *wind, windColor, 2.4f, head);
    if (const auto force = forceVector(input, forceUnit))
        lines->addArrow(*input.state.position, *input.state.position + *force, forceColor, 2.4f, head);
}

void addModelLines(LineBatch *lines, const SceneInput &input, const ObjMesh &model)
{
    const auto toEarth = [&input](const QVector3D &point) {
        return *input.state.position + input.state.body->rotatedVector(input.bodyScale * point);
    };
    for (const auto &line : model.lines)
        lines->addLine(toEarth(line.first), toEarth(line.second), faded(input.theme.text, 0.8), 1.0f);
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

void drawGround(LineBatch *lines, const SceneInput &input)
{
    if (input.show.ground) {
        const float radius = 1.6f * input.size;
        const float step = input.size / 5.0f;
        const QColor color = mixedColor(input.theme.line, input.theme.mutedText, 0.25);
        for (int i = -8; i <= 8; ++i) {
            const float off = float(i) * step;
            const float half = std::sqrt(std::max(0.0f, radius * radius - off * off));
            addGridLine(lines, {off, -half, 0}, {off, half, 0}, radius, color);
            addGridLine(lines, {-half, off, 0}, {half, off, 0}, radius, color);
        }
    }
    if (input.show.axes) {
        const std::array<QColor, 3> colors = axisColors(input.theme);
        for (int i = 0; i < 3; ++i) {
            QVector3D end;
            end[i] = 0.11f * input.size;
            lines->addArrow({}, end, colors[std::size_t(i)], 1.6f, 0.02f * input.size);
        }
    }
}

void drawKiteScene(LineBatch *lines, const SceneInput &input, const ObjMesh &model, float forceUnit)
{
    drawEntities(lines, input.entities, input.theme.text, input.size);
    if (input.show.axes && input.state.wind)
        addWindAxes(lines, input);
    if (!input.state.position)
        return;
    if (input.show.smallEarth)
        addSmallEarth(lines, input, input.state.position->length());
    if (input.show.ground)
        addPlumbLine(lines, input);
    if (input.show.tether)
        addTether(lines, input);
    if (input.state.body) {
        addModelLines(lines, input, model);
        if (input.show.axes)
            addBodyAxes(lines, input);
    }
    if (input.show.vectors)
        addVectors(lines, input, forceUnit);
}

void drawTrail(LineBatch *lines, const FlightTrail &trail, const ColorScale &scale, float width)
{
    const std::vector<FlightTrail::Point> &points = trail.points();
    QColor before;
    for (std::size_t i = 0; i < points.size(); ++i) {
        QColor color = scale.color(double(points[i].value));
        color.setAlphaF(0.15 + 0.85 * double(i + 1) / double(points.size()));
        if (points[i].isJoined)
            lines->addLine(points[i - 1].position, points[i].position, before, color, width);
        before = color;
    }
}

namespace {

/// Thin letters need more contrast than arrows.
QColor textColor(const QColor &arrow, const QPlcTheme &theme)
{
    return theme.isDark ? arrow.lighter(135) : arrow.darker(115);
}

}  // namespace

std::vector<SceneLabel> sceneLabels(const SceneInput &input, float forceUnit)
{
    std::vector<SceneLabel> labels;
    const std::array<QColor, 3> colors = axisColors(input.theme);
    if (input.show.axes) {
        const float length = 0.13f * input.size;
        const QVector3D begin;
        labels.push_back({{length, 0, 0}, KiteText::tr("east"), colors[0], begin});
        labels.push_back({{0, length, 0}, KiteText::tr("north"), colors[1], begin});
        labels.push_back({{0, 0, length}, KiteText::tr("up"), colors[2], begin});
        if (input.state.wind)
            labels.push_back({positionOf({input.downwind, 0, 0.31f * input.size}),
                              KiteText::tr("wind %1 m/s").arg(double(input.state.wind->length()), 0, 'f', 1),
                              input.theme.accent});
    }
    for (const SceneEntity &entity : input.entities) {
        if (!entity.name.isEmpty())
            labels.push_back({entity.to, entity.name, entity.color.isValid() ? entity.color : input.theme.text});
    }
    if (!input.state.position || !input.show.vectors)
        return labels;
    const auto place = [&input](const QVector3D &vector) { return *input.state.position + 1.12f * vector; };
    if (const auto wind = windVector(input))
        labels.push_back({place(*wind),
                          KiteText::tr("%1 m/s").arg(double(input.state.relativeWind()->length()), 0, 'f', 0),
                          textColor(windColor, input.theme)});
    if (const auto force = forceVector(input, forceUnit))
        labels.push_back({place(*force), KiteText::tr("%1 N").arg(double(input.state.force->length()), 0, 'f', 0),
                          textColor(forceColor, input.theme)});
    return labels;
}

}  // namespace qplc
