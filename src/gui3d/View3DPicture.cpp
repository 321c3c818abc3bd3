// SPDX-License-Identifier: Apache-2.0
#include "View3DPicture.h"

#include "OpenGlProbe.h"
#include "QPlcPanelContext.h"
#include "QPlcView3D.h"
#include "SceneDrawing.h"
#include "View3DEditor.h"
#include "View3DOverlay.h"
#include "gui/panel/DrawNow.h"

#include <QtWidgets/QLabel>

#include <cmath>

namespace qplc {

namespace {

constexpr int firstPictureTime = 20'000;  // [ms] that a slow driver gets
constexpr double margin = 8.0;            // [px]
constexpr float headingTurn = 20.0f;      // [deg] that the heading turns before the cameras do

}  // namespace

View3DPicture::View3DPicture(QPlcView3D *view)
    : QObject(view)
    , m_view(view)
    , m_scene(std::make_shared<QPlcScene3D>())
    , m_shownScene(m_scene)
{
    m_frame.setSingleShot(true);
    m_frame.setTimerType(Qt::PreciseTimer);
    m_watchdog.setSingleShot(true);
    view->installEventFilter(this);
    QPlcPanelContext *context = view->context();
    for (const auto change : {&QPlcPanelContext::signalsChanged, &QPlcPanelContext::timeChanged})
        connect(context, change, this, &View3DPicture::want);
    connect(context, &QPlcPanelContext::plantStateChanged, this, &View3DPicture::want);
    connect(context, &QPlcPanelContext::valuesChanged, this, [this, context] {
        if (!context->shownTime())
            want();
    });
    connect(context, &QPlcPanelContext::themeChanged, this, [this] {
        m_isGroundDue = true;
        m_view->update();
        want();
    });
    connect(&m_frame, &QTimer::timeout, this, [this] {
        if (m_isDue)
            draw();
    });
    connect(&m_watchdog, &QTimer::timeout, this, [this] { endWithout(tr("OpenGL draws nothing here.")); });
}

View3DPicture::~View3DPicture() = default;

void View3DPicture::setSettings(const View3DSettings &settings)
{
    m_settings = settings;
    m_isGroundDue = true;
    if (m_loadedModel != settings.model)
        loadModel();
    if (m_fallback)
        m_fallback->update();
    want();
}

void View3DPicture::setDefaultModel(const QString &file)
{
    m_defaultModel = file;
    loadModel();
}

void View3DPicture::loadModel()
{
    m_loadedModel = m_settings.model;
    m_modelError.clear();
    m_model = ObjMesh();
    if (!m_settings.model.isEmpty())
        m_model = ObjMesh::fromFile(m_settings.model, &m_modelError);
    m_showsDefaultModel = m_model.isEmpty() && !m_defaultModel.isEmpty();
    if (m_showsDefaultModel) {
        QString error;
        m_model = ObjMesh::fromFile(m_defaultModel, &error);
        Q_ASSERT_X(error.isEmpty(), "QPlcView3D::setDefaultModel", qPrintable(error));
    }
    if (m_renderer)
        m_renderer->mesh()->setMesh(m_model);
}

void View3DPicture::shown()
{
    if (!m_renderer && m_openGlError.isEmpty())
        start();
    want();
}

void View3DPicture::start()
{
    const OpenGlProbe &probe = OpenGlProbe::instance();
    if (!probe.error.isEmpty())
        return endWithout(probe.error);
    m_renderer.reset(SceneRenderer::acquire());
    m_renderer->mesh()->setMesh(m_model);
    connect(m_renderer.get(), &SceneRenderer::pictureReady, this, &View3DPicture::takePicture);
}

void View3DPicture::endWithout(const QString &reason)
{
    m_openGlError = reason;
    m_watchdog.stop();
    m_renderer.reset();
    m_view->update();
    m_fallback = m_view->createFallback();
    if (!m_fallback)
        return;
    m_reason = new QLabel(tr("%1 This is the %2 instead.").arg(reason, m_fallback->windowTitle()), m_view);
    m_reason->setObjectName(QStringLiteral("openGlError"));
    m_reason->setFont(m_view->context()->theme().labelFont);
    m_reason->setToolTip(m_reason->text());
    placeFallback();
    m_fallback->show();
    m_reason->show();
}

void View3DPicture::placeFallback()
{
    const int line = m_reason->sizeHint().height() + 4;
    m_reason->setGeometry(int(margin), m_view->height() - line, m_view->width() - 2 * int(margin), line);
    m_fallback->setGeometry(0, 0, m_view->width(), m_view->height() - line);
}

void View3DPicture::resized()
{
    if (m_fallback)
        placeFallback();
    want();
}

QSize View3DPicture::deviceSize() const
{
    const double ratio = m_view->devicePixelRatioF();
    return (QSizeF(m_view->size()) * ratio).toSize().expandedTo({1, 1});
}

void View3DPicture::want()
{
    m_isDue = true;
    if (!m_frame.isActive())
        draw();
}

bool View3DPicture::eventFilter(QObject *view, QEvent *event)
{
    if (event->type() == DrawNow::Kind && m_renderer) {
        m_frame.stop();
        if (m_isDue)
            draw();
        if (m_isDue || m_renderer->isBusy())
            static_cast<DrawNow *>(event)->setPending();
    }
    return QObject::eventFilter(view, event);
}

void View3DPicture::draw()
{
    if (!m_renderer || m_renderer->isBusy() || !m_view->isVisible() || m_view->window()->isMinimized())
        return;
    m_isDue = false;
    m_sinceWish.start();
    if (!m_view->problem().isEmpty())
        return m_view->update();
    prepare();
    m_renderer->setSize(deviceSize(), m_view->devicePixelRatioF());
    m_renderer->setBackground(m_scene->theme.surface);
    m_renderer->setCamera(m_pose.eye, m_pose.target, m_pose.up, projectionMatrix(m_pose, m_view->size(), m_size));
    drawScene();
    if (m_picture.isNull())
        m_watchdog.start(firstPictureTime);
    m_renderer->request();
}

/// All that the picture depends on.
void View3DPicture::prepare()
{
    m_scene = std::make_shared<QPlcScene3D>();
    m_scene->theme = m_view->context()->theme();
    m_scene->bodyName = tr("model");
    m_view->prepareScene(m_scene.get());
    const QVector3D position = m_scene->position.value_or(QVector3D());
    const float size = roundSceneSize(m_scene->extent.value_or(position.length()), m_size);
    m_isGroundDue = m_isGroundDue || size != m_size;
    m_scene->size = m_size = size;
    turn();
    m_missing.clear();
    m_entities = SceneEntity::read(
        m_settings.entities, position, [this](const QString &name) { return m_view->vectorOf(name); }, &m_missing);
    m_scene->bodyRadius = m_model.isEmpty() ? 0.02f * size : m_model.radius();
    m_pose = m_settings.camera.pose({size, *m_scene->heading, position, m_scene->course, m_scene->bodyRadius});
    m_scene->bodyScale
        = m_settings.bodyScale > 0 ? float(m_settings.bodyScale) : visibleBodyScale(m_pose, position, m_model.radius());
}

/// The cameras turn with the heading, but not with each degree.
void View3DPicture::turn()
{
    const std::optional<float> wanted = m_scene->heading;
    const float turned = wanted && m_heading ? std::remainder(*wanted - *m_heading, 360.0f) : 0.0f;
    if (wanted && (!m_heading || std::abs(turned) > headingTurn))
        m_heading = wanted;
    m_scene->heading = m_heading.value_or(0.0f);
}

void View3DPicture::drawScene()
{
    if (m_isGroundDue) {
        LineBatch ground;
        drawGround(&ground, *m_scene, m_settings);
        m_renderer->ground()->setLines(ground);
        m_isGroundDue = false;
    }
    drawBody(m_scene.get(), m_settings, m_model);
    drawEntities(m_scene.get(), m_entities);
    m_view->drawScene(m_scene.get());
    m_renderer->lines()->setLines(m_scene->content().lines);
    Qt3DCore::QTransform *transform = m_renderer->mesh()->transform();
    transform->setTranslation(m_scene->position.value_or(QVector3D()));
    transform->setRotation(m_scene->orientation.value_or(QQuaternion()));
    transform->setScale(m_scene->position ? m_scene->bodyScale : 0.0f);
}

void View3DPicture::takePicture(const QImage &picture, double windowTime, double pictureTime)
{
    m_watchdog.stop();
    m_picture = picture.convertToFormat(QImage::Format_RGB32);
    m_shownPose = m_pose;
    m_shownScene = m_scene;
    m_pacer.frameDone(windowTime, pictureTime);
    m_view->update();
    Q_EMIT pictureDrawn(windowTime, pictureTime);
    const double rest = m_pacer.interval() - double(m_sinceWish.nsecsElapsed()) * 1e-6;
    m_frame.start(std::max(1, int(rest)));
}

bool View3DPicture::isRoomy() const
{
    return m_view->width() >= 320 && m_view->height() >= 200;
}

QString View3DPicture::note() const
{
    if (!m_modelError.isEmpty())
        return m_modelError;
    if (!m_missing.isEmpty())
        return tr("There is no vector '%1' at the moment").arg(m_missing.first());
    if (!m_shownScene->note.isEmpty())
        return m_shownScene->note;
    return isRoomy() && m_shownScene->bodyScale > 1.05f
        ? tr("%1 drawn × %2").arg(m_shownScene->bodyName).arg(double(m_shownScene->bodyScale), 0, 'g', 2)
        : QString();
}

void View3DPicture::paint()
{
    QPainter painter(m_view);
    const QPlcTheme theme = m_view->context()->theme();
    const QRectF area = m_view->rect();
    painter.fillRect(area, theme.surface);
    if (m_fallback)
        return;
    painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
    const QString problem = m_openGlError.isEmpty() ? m_view->problem() : m_openGlError;
    if (!problem.isEmpty())
        return drawHint(&painter, area, problem, theme);
    if (m_picture.isNull())
        return drawHint(&painter, area, tr("The first picture is being drawn ..."), theme);
    painter.drawImage(area, m_picture);
    if (m_shownScene->isStale) {
        QColor veil = theme.surface;
        veil.setAlpha(140);
        painter.fillRect(area, veil);
    }
    painter.setFont(theme.labelFont);
    if (isRoomy())
        drawLabels(&painter, m_shownScene->content().labels, m_shownPose, area.size(), theme);
    paintCorners(&painter);
}

void View3DPicture::paintCorners(QPainter *painter)
{
    const QRectF all = m_view->rect();
    const QRectF area = all.adjusted(margin, 0.5 * margin, -margin, -0.5 * margin);
    const QPlcTheme theme = m_view->context()->theme();
    m_view->paintOver(painter, area, *m_shownScene);
    QRectF scaleArea = area;
    scaleArea.setTop(all.top());
    drawScale(painter, scaleArea, m_shownPose, cameraTitle(m_settings.camera.preset), theme);
    const double line = QFontMetricsF(painter->font()).height();
    if (isRoomy()) {
        const QPointF place = area.bottomRight() + QPointF(-24, -line - 26);
        drawCompass(painter, place, m_shownPose, m_shownScene->compassArrow, theme);
    }
    const bool isPast = m_view->context()->shownTime().has_value();
    const bool isWarning = !m_modelError.isEmpty() || m_shownScene->isStale;
    painter->setPen(isWarning ? theme.warning : isPast ? theme.accent : theme.mutedText);
    painter->drawText(QRectF(area.left(), area.bottom() - line, area.width(), line), Qt::AlignRight, note());
    if (m_view->hasFocus()) {
        painter->setBrush(Qt::NoBrush);
        painter->setPen(QPen(theme.accent, 1.0));
        painter->drawRect(all.adjusted(0.5, 0.5, -0.5, -0.5));
    }
}

}  // namespace qplc
