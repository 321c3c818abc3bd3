// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGui3DGlobal.h"
#include "QPlcTheme.h"

#include <QtGui/QQuaternion>
#include <QtGui/QVector3D>

#include <memory>
#include <optional>

namespace qplc {
struct SceneContent;
}

/// One picture of a QPlcView3D: where the body is, what the cameras look at, and lines, arrows and names in space.
///
/// ```cpp
/// void BuoyView::drawScene(QPlcScene3D *scene)
/// {
///     scene->addLine({}, *scene->position, scene->theme.text, 1.4f);  // its chain
///     scene->addName({0, 0, -5}, tr("anchor"), scene->theme.mutedText);
/// }
/// ```
/// Places are in metres, x to the east, y to the north, z upwards. Azimuths are in degrees and grow from x to y.
/// The axes of a body are those of its model.
///
/// Threads: the thread of the window.
class QTPLC_GUI3D_EXPORT QPlcScene3D
{
public:
    QPlcScene3D();
    ~QPlcScene3D();

    // -- QPlcView3D::prepareScene() sets what cameras and picture depend on --

    std::optional<QVector3D> position;       ///< of the body [m]; none: no body is drawn
    std::optional<QQuaternion> orientation;  ///< turns axes of the body into those of the earth
    QQuaternion course;                      ///< the frame of the camera `chase`, which looks along -x with z outwards
    std::optional<float> extent;             ///< the cameras show so much about the origin [m]; none: the body
    std::optional<float> heading;            ///< azimuth along which the cameras look; none: as before, at first 0
    std::optional<float> compassArrow;       ///< azimuth of an arrow in the compass; none: no arrow
    QString bodyName;                        ///< for the note that the body is drawn larger than it is
    QString note;                            ///< what is special about the picture, for people: "at 12:03:04.5"
    bool isStale = false;                    ///< the picture is old: it is drawn below a veil

    // -- QPlcView3D::drawScene() finds these --

    QPlcTheme theme;
    float size = 100.0f;      ///< of the scene [m]: extent in round steps
    float bodyScale = 1.0f;   ///< how much larger than it is the body is drawn
    float bodyRadius = 1.0f;  ///< of the body as it is [m]

    /// Adds a line. \param width  [px]
    void addLine(const QVector3D &from, const QVector3D &to, const QColor &color, float width);
    /// Adds a line whose colour changes on its way.
    void addLine(const QVector3D &from, const QVector3D &to, const QColor &fromColor, const QColor &toColor,
                 float width);
    /// Adds a line with a head at its end; without a length it is left out. \param head  length of the head [m]
    void addArrow(const QVector3D &from, const QVector3D &to, const QColor &color, float width, float head);
    /// Adds a text at a place. It moves down where it would lie on another one.
    /// \param arrowBegin  of the arrow that the text names: nobody reads it when the arrow points at the viewer
    void addName(const QVector3D &place, const QString &text, const QColor &color,
                 std::optional<QVector3D> arrowBegin = std::nullopt);

    /// What was added. For QPlcView3D.
    qplc::SceneContent &content() const { return *d; }

private:
    std::unique_ptr<qplc::SceneContent> d;
};
