// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FramePacer.h"
#include "ObjMesh.h"
#include "OrbitCamera.h"
#include "QPlcScene3D.h"
#include "SceneEntity.h"
#include "SceneRenderer.h"
#include "View3DSettings.h"

#include <QtWidgets/QWidget>

class QLabel;
class QPlcView3D;

namespace qplc {

/// What a 3D view shows: pictures of a scene with names above, drawn when something has changed;
/// or, without OpenGL, why there are none.
class View3DPicture : public QObject
{
    Q_OBJECT
public:
    /// \param view  on which it paints, and its parent
    explicit View3DPicture(QPlcView3D *view);
    ~View3DPicture() override;

    void setSettings(const View3DSettings &settings);
    void setDefaultModel(const QString &file);
    bool showsDefaultModel() const { return m_showsDefaultModel; }
    void shown();
    void resized();
    void paint();
    /// A new picture is wanted.
    void want();
    /// Of the view: DrawNow is pending until the picture is that of what is shown.
    bool eventFilter(QObject *view, QEvent *event) override;
    QString openGlError() const { return m_openGlError; }
    /// Null before the first picture was wanted.
    SceneRenderer *renderer() { return m_renderer.get(); }

Q_SIGNALS:
    void pictureDrawn(double windowTime, double pictureTime);

private:
    void start();
    void endWithout(const QString &reason);
    void placeFallback();
    void loadModel();
    void draw();
    void prepare();
    void turn();
    void drawScene();
    void takePicture(const QImage &picture, double windowTime, double pictureTime);
    void paintCorners(QPainter *painter);
    /// Large enough for names.
    bool isRoomy() const;
    QString note() const;
    QSize deviceSize() const;

    QPlcView3D *m_view;
    View3DSettings m_settings;
    ObjMesh m_model;
    QString m_defaultModel;  // file; empty: none
    bool m_showsDefaultModel = false;
    QString m_modelError;
    QString m_loadedModel;
    QString m_openGlError;
    std::unique_ptr<SceneRenderer, SceneRenderer::GiveBack> m_renderer;
    QWidget *m_fallback = nullptr;
    QLabel *m_reason = nullptr;

    // What the next picture is made of, and what the one that is shown was.
    QStringList m_missing;  // signals of entities
    std::shared_ptr<QPlcScene3D> m_scene;
    std::vector<SceneEntity> m_entities;
    CameraPose m_pose;
    float m_size = 100.0f;
    std::optional<float> m_heading;
    bool m_isGroundDue = true;
    QImage m_picture;
    CameraPose m_shownPose;
    std::shared_ptr<QPlcScene3D> m_shownScene;

    FramePacer m_pacer;
    QTimer m_frame;     // runs while the next picture has to wait
    QTimer m_watchdog;  // for the first picture
    QElapsedTimer m_sinceWish;
    bool m_isDue = false;
};

}  // namespace qplc
