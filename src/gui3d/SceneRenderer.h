// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SceneNodes.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QTimer>
#include <QtGui/QImage>

#include <memory>
#include <vector>

class QOffscreenSurface;

namespace Qt3DCore {
class QAspectEngine;
}
namespace Qt3DRender {
class QCamera;
class QClearBuffers;
class QRenderCapture;
class QRenderCaptureReply;
class QRenderSurfaceSelector;
class QTexture2D;
}  // namespace Qt3DRender

namespace qplc {

/// Draws a scene with Qt 3D into pictures, which a widget paints as any other picture.
///
/// No window of its own: a native window inside of a window hides what should be above it, is no
/// part of pictures of the window, and breaks when its parent becomes another one. Pictures come
/// when they are wanted and not otherwise. They are drawn by a thread of Qt 3D; the thread of the
/// window puts the scene together.
class SceneRenderer : public QObject
{
    Q_OBJECT
public:
    /// One that nobody has, or a new one. Ends with giveBack(), never with delete: the textures of
    /// Qt 3D 5.15 may end in the thread of the window while their context belongs to that of Qt 3D,
    /// which ends the program. Renderers are used again, and rest without any cost.
    static SceneRenderer *acquire();
    /// Nothing of it is connected any more, and what was on its way comes to nobody.
    static void giveBack(SceneRenderer *renderer);
    struct GiveBack
    {
        void operator()(SceneRenderer *renderer) const { giveBack(renderer); }
    };

    /// \param size  device pixels, at least 1 x 1
    void setSize(const QSize &size, double pixelRatio);
    void setBackground(const QColor &color);
    void setCamera(const QVector3D &eye, const QVector3D &target, const QVector3D &up, const QMatrix4x4 &projection);
    LineEntity *ground() { return m_ground; }
    LineEntity *lines() { return m_lines; }
    MeshEntity *mesh() { return m_mesh; }

    /// Wants a picture of what is set now; nothing while one is on its way.
    void request();
    bool isBusy() const { return m_reply != nullptr; }
    /// All nodes of the scene and its frame graph: the same number whatever is drawn.
    int nodeCount() const;

Q_SIGNALS:
    /// \param windowTime   that the thread of the window was busy with it [ms]
    /// \param pictureTime  since request() [ms]
    void pictureReady(const QImage &picture, double windowTime, double pictureTime);

private:
    SceneRenderer();
    ~SceneRenderer() override;
    static std::vector<SceneRenderer *> &resting();
    static std::vector<SceneRenderer *> &all();
    static void finishAll();

    void makeFrameGraph();
    void makeTarget(Qt3DCore::QNode *selector);
    void pump();
    void finish();
    void takePicture();

    std::unique_ptr<QOffscreenSurface> m_surface;
    std::unique_ptr<Qt3DCore::QAspectEngine> m_engine;
    Qt3DCore::QEntity *m_root;
    SceneMaterial *m_lineMaterial;
    LineEntity *m_ground;
    LineEntity *m_lines;
    MeshEntity *m_mesh;
    Qt3DRender::QCamera *m_camera;
    Qt3DRender::QRenderSurfaceSelector *m_selector = nullptr;
    Qt3DRender::QTexture2D *m_colors = nullptr;
    Qt3DRender::QTexture2D *m_depths = nullptr;
    Qt3DRender::QClearBuffers *m_clear = nullptr;
    Qt3DRender::QRenderCapture *m_capture = nullptr;
    Qt3DRender::QRenderCaptureReply *m_reply = nullptr;
    QTimer m_pump;
    QElapsedTimer m_sinceRequest;
    double m_windowTime = 0;  // [ms]
};

}  // namespace qplc
