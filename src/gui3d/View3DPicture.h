// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FramePacer.h"
#include "SceneDrawing.h"
#include "SceneRenderer.h"

#include <QtWidgets/QWidget>

class QLabel;
class QPlcWidget;

namespace qplc {

/// What a 3D view shows: pictures of a scene with labels above, drawn when something has changed; or the wind window.
class View3DPicture : public QObject
{
    Q_OBJECT
public:
    /// \param kite    outlives this
    /// \param widget  on which it paints, and its parent
    View3DPicture(KiteSignals *kite, QPlcWidget *widget);
    ~View3DPicture() override;

    void setSettings(const View3DSettings &settings);
    void shown();
    void resized();
    void paint();
    QString openGlError() const { return m_openGlError; }
    /// Null before the first picture was wanted.
    SceneRenderer *renderer() { return m_renderer.get(); }

Q_SIGNALS:
    void pictureDrawn(double windowTime, double pictureTime);

private:
    void start();
    void showWindWindow(const QString &reason);
    void placeWindWindow();
    void loadModel();
    void want();
    void draw();
    void updateInput();
    void drawScene();
    void takePicture(const QImage &picture, double windowTime, double pictureTime);
    void paintCorners(QPainter *painter);
    /// Large enough for labels.
    bool isRoomy() const;
    QString note() const;
    QSize deviceSize() const;
    QPlcTheme theme() const;

    KiteSignals *m_kite;
    QPlcWidget *m_widget;
    QPlcPanelContext *m_context;
    View3DSettings m_settings;
    ObjMesh m_model;
    QString m_modelError;
    QString m_loadedModel;
    QString m_openGlError;
    std::unique_ptr<SceneRenderer, SceneRenderer::GiveBack> m_renderer;
    QWidget *m_windWindow = nullptr;
    QLabel *m_reason = nullptr;

    // What the next picture is made of, and what the one that is shown was.
    QStringList m_missing;  // signals of entities
    SceneInput m_input;
    float m_forceUnit = 500;  // [N] that is a vector of length 1
    FlightTrail m_trail;
    ColorScale m_scale;
    LineBatch m_lines;
    CameraPose m_pose;
    bool m_isGroundDue = true;
    bool m_hasWind = false;
    QImage m_picture;
    CameraPose m_shownPose;
    SceneInput m_shownInput;

    FramePacer m_pacer;
    QTimer m_frame;     // runs while the next picture has to wait
    QTimer m_watchdog;  // for the first picture
    QElapsedTimer m_sinceWish;
    bool m_isDue = false;
};

}  // namespace qplc
