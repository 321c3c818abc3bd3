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

/// One picture of a QPlcView3D: where the body is, what the cameras look at, and lines, arrows and
/// names in space.
///
/// \code
/// class BuoyView : public QPlcView3D
/// {
/// protected:
///     void drawScene(QPlcScene3D *scene) override
///     {
///         QPlcView3D::drawScene(scene);
///         if (scene->position)
///             scene->addLine({}, *scene->position, scene->theme.text, 1.4f);  // its chain
///         scene->addName({0, 0, -5}, "anchor", scene->theme.mutedText);
///     }
/// };
/// \endcode
///
/// Places are in metres: x to the east, y to the north, z upwards. Azimuths are in degrees, from x
/// towards y. The axes of a body are those of its model.
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI3D_EXPORT QPlcScene3D
{
public:
    /// Makes an empty scene.
    QPlcScene3D();
    /// Destroys the scene and all that was added.
    ~QPlcScene3D();

    // -- QPlcView3D::prepareScene() sets what cameras and picture depend on --

    /// Place of the body [m]; not set: there is no body.
    std::optional<QVector3D> position;
    /// Rotation from axes of the body to axes of the earth; not set: it is not known, and no axes
    /// of the body are drawn.
    std::optional<QQuaternion> orientation;
    /// Rotation of the axes of the camera `chase` to axes of the earth: it looks along its -x, with
    /// its z upwards in the picture.
    QQuaternion course;
    /// Distance from the origin that the cameras show [m]; not set: that of the body.
    std::optional<float> extent;
    /// Azimuth along which the cameras look [deg]; not set: as before, at first 0.
    std::optional<float> heading;
    /// Azimuth of an arrow in the compass [deg]; not set: no arrow.
    std::optional<float> compassArrow;
    /// Name of the body, for the note that it is drawn larger than it is.
    QString bodyName;
    /// What people have to know about the picture: "at 12:03:04.5".
    QString note;
    /// The values are stale: the picture is drawn below a veil.
    bool isStale = false;

    // -- QPlcView3D::drawScene() finds these --

    /// Colours and fonts of the window.
    QPlcTheme theme;
    float size = 100.0f;      ///< size of the scene: the extent, rounded [m]
    float bodyScale = 1.0f;   ///< factor by which the body is drawn larger than it is
    float bodyRadius = 1.0f;  ///< radius of the body without that factor [m]

    /// Adds a line.
    /// \param from,  to its ends [m]
    /// \param width  [px]
    void addLine(const QVector3D &from, const QVector3D &to, const QColor &color, float width);
    /// Adds a line whose colour changes along its way.
    /// \param from,  to its ends [m]
    /// \param width  [px]
    void addLine(const QVector3D &from, const QVector3D &to, const QColor &fromColor, const QColor &toColor,
                 float width);
    /// Adds a line with a head at its end. An arrow without a length is left out.
    /// \param from,  to its ends [m]
    /// \param width  of the line [px]
    /// \param head  length of the head [m]
    void addArrow(const QVector3D &from, const QVector3D &to, const QColor &color, float width, float head);
    /// Adds a text at a place. It moves down if it would cover another one.
    /// \param place  [m]
    /// \param arrowBegin  begin of the arrow that the text names: the text is left out when the
    ///     arrow points at the viewer
    void addName(const QVector3D &place, const QString &text, const QColor &color,
                 std::optional<QVector3D> arrowBegin = std::nullopt);

    /// Returns what was added. Only for QPlcView3D.
    qplc::SceneContent &content() const { return *d; }

private:
    std::unique_ptr<qplc::SceneContent> d;
};
