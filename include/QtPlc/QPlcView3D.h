// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGui3DGlobal.h"
#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// A kite in space: model, tether, ground, the small earth on which it flies, axes of earth, wind and body, the path of the last seconds coloured by a signal, the relative wind in blue and the
/// aerodynamic force in red.
///
/// ```cpp
/// controlCenter.addAvailableWidget(QPlcWidget::registerFactory(new QPlcView3DFactory));
/// ```
///
/// Dragging turns the camera about what it looks at, with Shift it moves sideways, with Ctrl (or Alt, or the wheel) it comes nearer; a double click or key 0 goes back to the preset. Keys 1 ... 5 are the presets:
/// ground station, side, top, downwind, and chase, whose camera is fixed to the body and follows its course. Arrow keys turn, + and - zoom.
///
/// Drawn with Qt 3D into pictures: when something has changed, at most 30 times a second, less where OpenGL is slow, and never while hidden. Where there is no OpenGL (or with the environment variable
/// QTPLC_OPENGL=off) it says so in a line and shows the wind window. A body that is too small to be seen is drawn larger than it is; a note says how much.
///
/// Settings; what is missing has its default, as shown here but for `model`, `minimum`, `maximum` and `entities`:
/// ```json
/// {"position": "bodyPosition_earth", "velocity": "bodyVelocity_earth", "wind": "windVelocity_earth",
///  "controlOrientation": "bodyControlOrientation", "positionOrientation": "bodyPositionOrientation",
///  "force": "aerodynamicForce_earth", "tetherLength": "tetherLength",
///  "color": "power", "minimum": 0, "maximum": 4000, "trail": 30,
///  "camera": "ground station", "view": {"yaw": 0, "pitch": 0, "zoom": 1, "pan": [0, 0, 0]}, "model": "/home/me/kite.obj", "bodyScale": 0,
///  "ground": true, "smallEarth": true, "axes": true, "vectors": true, "tether": true,
///  "entities": [{"at": [0, 0, 5], "name": "mast"}, {"at": "buoyPosition", "to": [0, 0, 0], "color": "#009e73"},
///               {"vector": "tetherForce_earth", "scale": 0.02, "color": "#d55e00", "name": "tether"}]}
/// ```
/// `view` is how far the camera was moved from its preset: angles in degrees, `pan` as a share of the scene. `model` is a Wavefront OBJ file in metres, x to the tail, y along the span, z out of the top
/// side; vertices may have colours (v x y z r g b). `entities` are
/// things of one's own, without any C++: a mark `at` a place, a line from there `to` another one, or an arrow along a `vector` times `scale` (1). Places and vectors are three numbers, or the name of a
/// signal with three elements, in the axes of the earth [m]; what says no place is at the kite. `bodyScale` is how much larger than it is the body is drawn, 0: as large as it takes to see it.
///
/// Threads: the thread of the window.
class QTPLC_GUI3D_EXPORT QPlcView3D : public QPlcWidget
{
    Q_OBJECT
public:
    static QString typeName() { return QStringLiteral("3D view"); }

    explicit QPlcView3D(QWidget *parent = nullptr);
    ~QPlcView3D() override;

    QString kind() const override { return typeName(); }
    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QWidget *createSettingsEditor() override;
    QStringList shownSignals() const override;
    /// The path takes its colours from the first one.
    bool addSignals(const QStringList &references) override;

    /// Why there is a wind window instead; empty: there is none.
    QString openGlError() const;

    QSize minimumSizeHint() const override;
    QSize sizeHint() const override;

Q_SIGNALS:
    /// A new picture has been drawn. \param windowTime  that the thread of the window was busy with it [ms] \param pictureTime  from the wish to the picture [ms]
    void pictureDrawn(double windowTime, double pictureTime);

protected:
    void contextChanged() override;
    void paintEvent(QPaintEvent *event) override;
    void showEvent(QShowEvent *event) override;
    void resizeEvent(QResizeEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    void mouseMoveEvent(QMouseEvent *event) override;
    void mouseReleaseEvent(QMouseEvent *event) override;
    void mouseDoubleClickEvent(QMouseEvent *event) override;
    void wheelEvent(QWheelEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;

private:
    struct Private;
    std::unique_ptr<Private> d;
};

using QPlcView3DFactory = QPlcWidgetFactoryOf<QPlcView3D>;
