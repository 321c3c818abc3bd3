// SPDX-License-Identifier: Apache-2.0
#include "SceneRenderer.h"

#include <Qt3DCore/QAspectEngine>
#include <Qt3DRender/QCamera>
#include <Qt3DRender/QCameraLens>
#include <Qt3DRender/QCameraSelector>
#include <Qt3DRender/QClearBuffers>
#include <Qt3DRender/QFilterKey>
#include <Qt3DRender/QRenderAspect>
#include <Qt3DRender/QRenderCapture>
#include <Qt3DRender/QRenderPassFilter>
#include <Qt3DRender/QRenderSettings>
#include <Qt3DRender/QRenderSurfaceSelector>
#include <Qt3DRender/QRenderTarget>
#include <Qt3DRender/QRenderTargetOutput>
#include <Qt3DRender/QRenderTargetSelector>
#include <Qt3DRender/QTexture>
#include <Qt3DRender/QViewport>
#include <QtCore/QCoreApplication>
#include <QtCore/QThread>
#include <QtGui/QOffscreenSurface>

#include <algorithm>

namespace qplc {

using namespace Qt3DRender;

namespace {

constexpr int pumpInterval = 4;      // [ms]
constexpr int lastPicture = 3000;    // [ms] that the end of the program waits for a picture
constexpr int framesUntilQuiet = 3;  // the thread of Qt 3D is done with a frame when another one has come and gone

QRenderPassFilter *makePassFilter(const char *pass, Qt3DCore::QNode *parent)
{
    auto *filter = new QRenderPassFilter(parent);
    auto *key = new QFilterKey(filter);
    key->setName(QStringLiteral("pass"));
    key->setValue(QString::fromLatin1(pass));
    filter->addMatch(key);
    return filter;
}

QTexture2D *makeOutput(QRenderTarget *target, QRenderTargetOutput::AttachmentPoint point,
                       QAbstractTexture::TextureFormat format)
{
    auto *output = new QRenderTargetOutput(target);
    output->setAttachmentPoint(point);
    auto *texture = new QTexture2D(output);
    texture->setFormat(format);
    texture->setSize(1, 1);
    texture->setGenerateMipMaps(false);
    output->setTexture(texture);
    target->addOutput(output);
    return texture;
}

}  // namespace

std::vector<SceneRenderer *> &SceneRenderer::resting()
{
    static auto *all = new std::vector<SceneRenderer *>;  // until the end of the process, without an end of its own
    return *all;
}

std::vector<SceneRenderer *> &SceneRenderer::all()
{
    static auto *all = new std::vector<SceneRenderer *>;
    return *all;
}

/// At the end of the program: OpenGL goes with the connection to the screen, and must not be in use
/// then.
void SceneRenderer::finishAll()
{
    for (SceneRenderer *renderer : all())
        renderer->finish();
    all().clear();
    resting().clear();
}

SceneRenderer *SceneRenderer::acquire()
{
    std::vector<SceneRenderer *> &free = resting();
    const auto idle = std::find_if(free.begin(), free.end(), [](SceneRenderer *each) { return !each->isBusy(); });
    if (idle == free.end())
        return new SceneRenderer;
    SceneRenderer *renderer = *idle;
    free.erase(idle);
    return renderer;
}

void SceneRenderer::giveBack(SceneRenderer *renderer)
{
    QObject::disconnect(renderer, &SceneRenderer::pictureReady, nullptr, nullptr);
    resting().push_back(renderer);
}

SceneRenderer::SceneRenderer()
    : m_surface(std::make_unique<QOffscreenSurface>())
    , m_engine(std::make_unique<Qt3DCore::QAspectEngine>())
    , m_root(new Qt3DCore::QEntity)
    , m_lineMaterial(new SceneMaterial(SceneMaterial::Lines, m_root))
    , m_ground(new LineEntity(m_lineMaterial, m_root))
    , m_lines(new LineEntity(m_lineMaterial, m_root))
    , m_mesh(new MeshEntity(new SceneMaterial(SceneMaterial::Solid, m_root), m_root))
    , m_camera(new QCamera(m_root))
{
    m_surface->create();
    m_engine->registerAspect(new QRenderAspect(QRenderAspect::Threaded));
    m_engine->setRunMode(Qt3DCore::QAspectEngine::Manual);
    makeFrameGraph();
    m_engine->setRootEntity(Qt3DCore::QEntityPtr(m_root));
    m_pump.setTimerType(Qt::PreciseTimer);
    connect(&m_pump, &QTimer::timeout, this, &SceneRenderer::pump);
    if (all().empty())
        qAddPostRoutine(&SceneRenderer::finishAll);
    all().push_back(this);
}

SceneRenderer::~SceneRenderer() = default;

void SceneRenderer::makeFrameGraph()
{
    auto *settings = new QRenderSettings(m_root);
    settings->setRenderPolicy(QRenderSettings::OnDemand);
    m_selector = new QRenderSurfaceSelector(settings);
    m_selector->setSurface(m_surface.get());
    auto *targetSelector = new QRenderTargetSelector(m_selector);
    auto *viewport = new QViewport(targetSelector);
    auto *cameraSelector = new QCameraSelector(viewport);
    cameraSelector->setCamera(m_camera);
    m_clear = new QClearBuffers(cameraSelector);
    m_clear->setBuffers(QClearBuffers::ColorDepthBuffer);
    makePassFilter("solid", m_clear);
    m_capture = new QRenderCapture(makePassFilter("lines", cameraSelector));
    makeTarget(targetSelector);
    settings->setActiveFrameGraph(m_selector);
    m_root->addComponent(settings);
}

void SceneRenderer::makeTarget(Qt3DCore::QNode *selector)
{
    auto *target = new QRenderTarget(selector);
    m_colors = makeOutput(target, QRenderTargetOutput::Color0, QAbstractTexture::RGBA8_UNorm);
    m_depths = makeOutput(target, QRenderTargetOutput::Depth, QAbstractTexture::D24);
    static_cast<QRenderTargetSelector *>(selector)->setTarget(target);
}

void SceneRenderer::setSize(const QSize &size, double pixelRatio)
{
    m_lineMaterial->setViewport(size, pixelRatio);
    if (m_selector->externalRenderTargetSize() == size)
        return;
    m_selector->setExternalRenderTargetSize(size);
    for (QTexture2D *texture : {m_colors, m_depths})
        texture->setSize(size.width(), size.height());
}

void SceneRenderer::setBackground(const QColor &color)
{
    m_clear->setClearColor(color);
}

void SceneRenderer::setCamera(const QVector3D &eye, const QVector3D &target, const QVector3D &up,
                              const QMatrix4x4 &projection)
{
    m_camera->setPosition(eye);
    m_camera->setViewCenter(target);
    m_camera->setUpVector(up);
    m_camera->lens()->setProjectionType(QCameraLens::CustomProjection);
    m_camera->lens()->setProjectionMatrix(projection);
}

void SceneRenderer::request()
{
    if (m_reply)
        return;
    m_windowTime = 0;
    m_sinceRequest.start();
    m_reply = m_capture->requestCapture();
    connect(m_reply, &QRenderCaptureReply::completed, this, &SceneRenderer::takePicture);
    m_pump.start(pumpInterval);
    pump();
}

void SceneRenderer::pump()
{
    QElapsedTimer busy;
    busy.start();
    m_engine->processFrame();
    m_windowTime += double(busy.nsecsElapsed()) * 1e-6;
}

/// One that was never asked for a picture has no OpenGL yet, and is not to begin now.
void SceneRenderer::finish()
{
    if (!m_sinceRequest.isValid())
        return;
    QElapsedTimer clock;
    clock.start();
    while (isBusy() && clock.elapsed() < lastPicture) {
        pump();
        QThread::msleep(1);
    }
    for (int frame = 0; frame < framesUntilQuiet && !isBusy(); ++frame)
        m_engine->processFrame();
}

void SceneRenderer::takePicture()
{
    m_pump.stop();
    const QImage picture = m_reply->image();
    m_reply->deleteLater();
    m_reply = nullptr;
    Q_EMIT pictureReady(picture, m_windowTime, double(m_sinceRequest.nsecsElapsed()) * 1e-6);
}

int SceneRenderer::nodeCount() const
{
    return m_root->findChildren<Qt3DCore::QNode *>().size();
}

}  // namespace qplc
