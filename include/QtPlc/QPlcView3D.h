// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGui3DGlobal.h"
#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

#include <QtGui/QVector3D>

#include <optional>

class QPlcScene3D;

namespace qplc {
class View3DPicture;
}

/// A body in space, as signals say where it is: its model, the ground, axes, marks, lines and arrows.
///
/// ```cpp
/// controlCenter.addPanel<QPlcView3D>();
/// ```
///
/// Dragging turns the camera about what it looks at. With Shift it moves sideways, with Ctrl (or Alt, or the
/// wheel) it comes nearer. A double click or key 0 goes back to the preset. Keys 1 ... 5 are the presets: ground
/// station, side, top, downwind, and chase, whose camera is fixed to the body. Arrow keys turn, + and - zoom.
///
/// Drawn with Qt 3D into pictures: when something has changed, at most 30 times a second, less where OpenGL is
/// slow, and never while hidden. Where there is no OpenGL (or with the environment variable QTPLC_OPENGL=off)
/// the panel says why. A body that is too small to be seen is drawn larger than it is; a note says how much.
///
/// Settings; what is missing has its default:
/// ```json
/// {"position": "buoyPosition", "orientation": "buoyOrientation",
///  "model": "/home/me/buoy.obj", "bodyScale": 0, "camera": "ground station",
///  "view": {"yaw": 0, "pitch": 0, "zoom": 1, "pan": [0, 0, 0]}, "ground": true, "axes": true,
///  "entities": [{"at": [0, 0, 5], "name": "mast"}, {"at": "buoyPosition", "to": [0, 0, 0], "color": "#009e73"},
///               {"vector": "windForce", "scale": 0.02, "color": "#d55e00", "name": "wind"}]}
/// ```
/// - `position`: a signal with three elements [m], x to the east, y to the north, z upwards. `orientation`: a
///   signal with roll, pitch and yaw [deg], or with the four elements w, x, y, z of a quaternion, that turns
///   axes of the body into those of the earth. Both are empty by default: there is no body.
/// - `model`: a Wavefront OBJ file in metres; vertices may have colours (v x y z r g b). `bodyScale`: how much
///   larger than it is the body is drawn; 0: as large as it takes to see it.
/// - `view`: how far the camera was moved from its preset: angles in degrees, `pan` as a share of the scene.
/// - `entities`: a mark `at` a place, a line from there `to` another one, or an arrow along a `vector` times
///   `scale` (1). Places and vectors are three numbers, or the name of a signal with three elements. What says
///   no place is at the body.
///
/// A subclass draws more: it overrides prepareScene() and drawScene(), and calls them of this class first. The
/// kite of the example is such a panel.
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
    /// The first one is the position from then on.
    bool addSignals(const QStringList &references) override;

    /// Returns why there are no pictures; empty: there are, or none was wanted yet.
    QString openGlError() const;

    QSize minimumSizeHint() const override;
    QSize sizeHint() const override;

Q_SIGNALS:
    /// A new picture has been drawn. \param windowTime  that the thread of the window was busy with it [ms]
    /// \param pictureTime  from the wish to the picture [ms]
    void pictureDrawn(double windowTime, double pictureTime);

protected:
    /// Says what the next picture depends on: where the body is, and what the cameras look at.
    virtual void prepareScene(QPlcScene3D *scene);
    /// Adds lines, arrows and names to the picture, after the cameras are known.
    virtual void drawScene(QPlcScene3D *scene);
    /// Paints beside the picture, above it. \param area  without the margin \param scene  of the picture
    virtual void paintOver(QPainter *painter, const QRectF &area, const QPlcScene3D &scene);
    /// Returns why there is nothing to draw, for people; empty: there is.
    virtual QString problem() const;
    /// Returns what the panel shows where there is no OpenGL, as a child of this; null: only the reason. Its
    /// windowTitle() says what it is.
    virtual QWidget *createFallback() { return nullptr; }
    /// Returns what stands in the settings instead of the lines for position and orientation; null: these.
    virtual QWidget *createBodyEditor() { return nullptr; }

    /// Lets people switch a part of the picture off. Call it in the constructor.
    /// \param key  in the settings; \param title  for people
    void addPart(const QString &key, const QString &title);
    /// Returns whether people want to see a part: `ground`, `axes`, or one of addPart().
    bool isPartShown(const QString &key) const;
    /// Sets the model that is drawn when the settings name none, or one that cannot be read. Call it in the
    /// constructor. \param file  may be a resource of the program
    void setDefaultModel(const QString &file);
    /// Returns whether the body is drawn by the default model.
    bool showsDefaultModel() const;
    /// Returns three elements of a signal at the time that the window shows; none where there is no usable value.
    std::optional<QVector3D> vectorOf(const QString &reference) const;
    /// Draws again: something has changed that does not come from the context.
    void redraw();

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
    friend class qplc::View3DPicture;

    struct Private;
    std::unique_ptr<Private> d;
};

using QPlcView3DFactory = QPlcWidgetFactoryOf<QPlcView3D>;
