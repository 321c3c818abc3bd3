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

/// A panel with a body in space, whose place signals give: its model, the ground, axes, marks,
/// lines and arrows.
///
/// \code
/// QPlcControlCenter controlCenter;
/// controlCenter.addPanel<QPlcView3D>();
/// \endcode
///
/// Dragging turns the camera around its target, with Shift it moves the camera sideways, with Ctrl
/// (or Alt, or the wheel) it changes the distance. A double click or key 0 restores the preset.
/// Keys 1 to 5 are the presets: ground station, side, top, downwind, and chase, whose camera is
/// fixed to the body. Arrow keys turn, + and - zoom.
///
/// The panel draws with Qt 3D when something has changed, at most 30 times a second, less where
/// OpenGL is slow, and never while it is hidden. Without OpenGL (or with the environment variable
/// QTPLC_OPENGL=off) the panel says why. A body that would be too small is drawn larger; a note
/// says by how much.
///
/// Settings; a missing one has its default:
/// \code{.json}
/// {
///     "position": "buoyPosition", "orientation": "buoyOrientation",
///     "model": "/home/me/buoy.obj", "bodyScale": 0,
///     "camera": "ground station", "view": {"yaw": 0, "pitch": 0, "zoom": 1, "pan": [0, 0, 0]},
///     "ground": true, "axes": true,
///     "entities": [
///         {"at": [0, 0, 5], "name": "mast"},
///         {"at": "buoyPosition", "to": [0, 0, 0], "color": "#009e73"},
///         {"vector": "windForce", "scale": 0.02, "color": "#d55e00", "name": "wind"}
///     ]
/// }
/// \endcode
/// - `position`: a signal with three elements [m], x to the east, y to the north, z upwards.
///   Default empty: there is no body.
/// - `orientation`: a signal with roll, pitch and yaw [deg], or with the four elements w, x, y, z
///   of a quaternion, which turns axes of the body into those of the earth. Default empty.
/// - `model`: a Wavefront OBJ file in metres; vertices may have colours (v x y z r g b).
/// - `bodyScale`: factor by which the body is drawn larger; 0: as much as is needed.
/// - `view`: movement of the camera from its preset: angles in degrees, `pan` as a share of the
///   scene.
/// - `entities`: a mark `at` a place, a line from there `to` another one, or an arrow along a
///   `vector` times `scale` (default 1). Places and vectors are three numbers, or the name of a
///   signal with three elements. An entity without a place is at the body.
///
/// A subclass draws more: it overrides prepareScene() and drawScene(), and calls those of this
/// class first.
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI3D_EXPORT QPlcView3D : public QPlcWidget
{
    Q_OBJECT
public:
    /// Returns "3D view", the name of this kind of panel in layouts.
    static QString typeName() { return QStringLiteral("3D view"); }

    /// Makes a view with default settings.
    explicit QPlcView3D(QWidget *parent = nullptr);
    ~QPlcView3D() override;

    QString kind() const override { return typeName(); }
    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QWidget *createSettingsEditor() override;
    QStringList shownSignals() const override;
    /// Makes the first signal of \a references the position of the body.
    bool addSignals(const QStringList &references) override;

    /// Returns why the panel draws no pictures; empty: it does, or nothing was drawn yet.
    QString openGlError() const;

    QSize minimumSizeHint() const override;
    QSize sizeHint() const override;

Q_SIGNALS:
    /// Emitted when a new picture was drawn.
    /// \param windowTime  time that it took in the thread of the window [ms]
    /// \param pictureTime  time from the request to the picture [ms]
    void pictureDrawn(double windowTime, double pictureTime);

protected:
    /// Sets what the next picture depends on: where the body is, and what the cameras look at. The
    /// default reads the signals `position` and `orientation` of the settings.
    /// \param scene  owned by the view; valid during the call
    virtual void prepareScene(QPlcScene3D *scene);
    /// Adds lines, arrows and names to the picture, when the cameras are known. The view draws
    /// body, ground, axes and entities by itself. The default adds nothing.
    /// \param scene  owned by the view; valid during the call
    virtual void drawScene(QPlcScene3D *scene);
    /// Paints over the picture. The default does nothing.
    /// \param area  place of the picture in the panel, without its margin [px]
    /// \param scene  scene of the picture
    virtual void paintOver(QPainter *painter, const QRectF &area, const QPlcScene3D &scene);
    /// Returns why there is nothing to draw, for people; empty: there is something.
    virtual QString problem() const;
    /// Returns what the panel shows without OpenGL, as a child of it; null (the default): only the
    /// reason. The windowTitle() of the widget names it.
    virtual QWidget *createFallback() { return nullptr; }
    /// Returns the part of the settings editor for position and orientation; null (the default):
    /// two lines for signals. The caller owns it.
    virtual QWidget *createBodyEditor() { return nullptr; }

    /// Adds a part of the picture that people can switch off. Call it in the constructor.
    /// \param key  in the settings
    /// \param title  what people read
    void addPart(const QString &key, const QString &title);
    /// Returns true if people want to see a part: `ground`, `axes`, or one of addPart().
    bool isPartShown(const QString &key) const;
    /// Sets the model that is drawn if the settings name none, or one that cannot be read. Call it
    /// in the constructor.
    /// \param file  a Wavefront OBJ file; may be a resource of the program
    void setDefaultModel(const QString &file);
    /// Returns true if the body is drawn with the default model.
    bool showsDefaultModel() const;
    /// Returns three elements of a signal at the time that the window shows; not set if there is no
    /// usable value.
    std::optional<QVector3D> vectorOf(const QString &reference) const;
    /// Draws again because something has changed that does not come from context().
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

    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};

/// The factory of this panel.
///
/// \ingroup panels
using QPlcView3DFactory = QPlcWidgetFactoryOf<QPlcView3D>;
