// SPDX-License-Identifier: Apache-2.0
#include "View3DPicture.h"

#include "Kite.h"
#include "OpenGlProbe.h"
#include "QPlcWidget.h"
#include "View3DEditor.h"
#include "View3DOverlay.h"
#include "kite/WindWindowView.h"

#include <QtWidgets/QLabel>

namespace qplc {

namespace {

constexpr int firstPictureTime = 20'000;  // [ms] that a slow driver gets
constexpr double margin = 8.0;            // [px]
constexpr float windTurn = 20.0f;         // [deg] that the wind turns before the cameras do
const QString kiteModel = QStringLiteral(":/qtplc/gui3d/kite.obj");
const QVector3D kiteBridle(0.1f, 0, -4.6f);  // where the lines of our model meet [m]

}  // namespace

View3DPicture::View3DPicture(KiteSignals *kite, QPlcWidget *widget)
    : QObject(widget)
    , m_kite(kite)
    , m_widget(widget)
    , m_context(widget->context())
{
    m_frame.setSingleShot(true);
    m_frame.setTimerType(Qt::PreciseTimer);
    m_watchdog.setSingleShot(true);
    connect(kite, &KiteSignals::changed, this, &View3DPicture::want);
    connect(m_context, &QPlcPanelContext::themeChanged, this, [this] {
        m_isGroundDue = true;
        m_widget->update();
        want();
    });
    connect(&m_frame, &QTimer::timeout, this, [this] {
        if (m_isDue)
            draw();
    });
    connect(&m_watchdog, &QTimer::timeout, this, [this] { showWindWindow(tr("OpenGL draws nothing here.")); });
    loadModel();
}

View3DPicture::~View3DPicture() = default;

void View3DPicture::setSettings(const View3DSettings &settings)
{
    m_settings = settings;
    m_isGroundDue = true;
    if (m_loadedModel != settings.model)
        loadModel();
    if (m_windWindow)
        m_windWindow->update();
    want();
}

void View3DPicture::loadModel()
{
    m_loadedModel = m_settings.model;
    m_modelError.clear();
    QString error;
    if (!m_settings.model.isEmpty())
        m_model = ObjMesh::fromFile(m_settings.model, &m_modelError);
    if (m_settings.model.isEmpty() || !m_modelError.isEmpty())
        m_model = ObjMesh::fromFile(kiteModel, &error);
    m_input.bridle = m_settings.model.isEmpty() || !m_modelError.isEmpty() ? kiteBridle : QVector3D();
    if (m_renderer)
        m_renderer->mesh()->setMesh(m_model);
}

void View3DPicture::shown()
{
    if (!m_renderer && !m_windWindow)
        start();
    want();
}

void View3DPicture::start()
{
    const OpenGlProbe &probe = OpenGlProbe::instance();
    if (!probe.error.isEmpty())
        return showWindWindow(probe.error);
    m_renderer.reset(SceneRenderer::acquire());
    m_renderer->mesh()->setMesh(m_model);
    connect(m_renderer.get(), &SceneRenderer::pictureReady, this, &View3DPicture::takePicture);
}

void View3DPicture::showWindWindow(const QString &reason)
{
    m_openGlError = reason;
    m_watchdog.stop();
    m_renderer.reset();
    m_windWindow = new WindWindowView(m_kite, m_context, m_widget);
    m_windWindow->setObjectName(QStringLiteral("windWindow"));
    m_reason = new QLabel(tr("%1 This is the wind window instead.").arg(reason), m_widget);
    m_reason->setObjectName(QStringLiteral("openGlError"));
    m_reason->setFont(theme().labelFont);
    m_reason->setToolTip(m_reason->text());
    placeWindWindow();
    m_windWindow->show();
    m_reason->show();
}

void View3DPicture::placeWindWindow()
{
    const int line = m_reason->sizeHint().height() + 4;
    m_reason->setGeometry(int(margin), m_widget->height() - line, m_widget->width() - 2 * int(margin), line);
    m_windWindow->setGeometry(0, 0, m_widget->width(), m_widget->height() - line);
}

void View3DPicture::resized()
{
    if (m_windWindow)
        placeWindWindow();
    want();
}

QPlcTheme View3DPicture::theme() const
{
    return m_context->theme();
}

QSize View3DPicture::deviceSize() const
{
    const double ratio = m_widget->devicePixelRatioF();
    return (QSizeF(m_widget->size()) * ratio).toSize().expandedTo({1, 1});
}

void View3DPicture::want()
{
    m_isDue = true;
    if (!m_frame.isActive())
        draw();
}

void View3DPicture::draw()
{
    if (!m_renderer || m_renderer->isBusy() || !m_widget->isVisible() || m_widget->window()->isMinimized())
        return;
    m_isDue = false;
    m_sinceWish.start();
    if (!m_kite->problem().isEmpty())
        return m_widget->update();
    updateInput();
    m_renderer->setSize(deviceSize(), m_widget->devicePixelRatioF());
    m_renderer->setBackground(m_input.theme.surface);
    m_renderer->setCamera(m_pose.eye, m_pose.target, m_pose.up,
                          projectionMatrix(m_pose, m_widget->size(), m_input.size));
    drawScene();
    if (m_picture.isNull())
        m_watchdog.start(firstPictureTime);
    m_renderer->request();
}

void View3DPicture::updateInput()
{
    const KiteState state = m_kite->state();
    const QVector3D position = state.position.value_or(QVector3D());
    const float length = float(state.tetherLength.value_or(double(position.length())));
    const float size = roundSceneSize(length, m_input.size);
    const bool isTurned = std::abs(wrappedAngle(double(state.downwind() - m_input.downwind))) > double(windTurn);
    m_isGroundDue = m_isGroundDue || size != m_input.size;
    m_input.size = size;
    if (state.wind && (!m_hasWind || isTurned)) {
        m_input.downwind = state.downwind();
        m_hasWind = true;
    }
    m_input.state = state;
    m_input.show = m_settings.show;
    m_input.theme = theme();
    m_missing.clear();
    m_input.entities = SceneEntity::read(
        m_settings.entities, position, [this](const QString &name) { return m_kite->vectorOf(name); }, &m_missing);
    const OrbitCamera::Scene scene
        = {m_input.size, m_input.downwind, position, state.course.value_or(QQuaternion()), m_model.radius()};
    m_pose = m_settings.camera.pose(scene);
    m_input.bodyScale
        = m_settings.bodyScale > 0 ? float(m_settings.bodyScale) : visibleBodyScale(m_pose, position, m_model.radius());
    m_input.vectorUnit = 2.2f * m_input.bodyScale * m_model.radius();
    if (state.force)
        m_forceUnit = forceReference(state.force->length(), m_forceUnit);
}

void View3DPicture::drawScene()
{
    if (m_isGroundDue) {
        m_lines.clear();
        drawGround(&m_lines, m_input);
        m_renderer->ground()->setLines(m_lines);
        m_isGroundDue = false;
    }
    m_kite->readTrail(&m_trail);
    m_scale = m_kite->colorScale(m_trail);
    m_lines.clear();
    drawTrail(&m_lines, m_trail, m_scale, 1.3f * float(m_input.theme.curveWidth));
    drawKiteScene(&m_lines, m_input, m_model, m_forceUnit);
    m_renderer->lines()->setLines(m_lines);
    Qt3DCore::QTransform *transform = m_renderer->mesh()->transform();
    transform->setTranslation(m_input.state.position.value_or(QVector3D()));
    transform->setRotation(m_input.state.body.value_or(QQuaternion()));
    transform->setScale(m_input.state.position ? m_input.bodyScale : 0.0f);  // no position, no kite
}

void View3DPicture::takePicture(const QImage &picture, double windowTime, double pictureTime)
{
    m_watchdog.stop();
    m_picture = picture.convertToFormat(QImage::Format_RGB32);
    m_shownPose = m_pose;
    m_shownInput = m_input;
    m_pacer.frameDone(windowTime, pictureTime);
    m_widget->update();
    Q_EMIT pictureDrawn(windowTime, pictureTime);
    const double rest = m_pacer.interval() - double(m_sinceWish.nsecsElapsed()) * 1e-6;
    m_frame.start(std::max(1, int(rest)));
}

bool View3DPicture::isRoomy() const
{
    return m_widget->width() >= 320 && m_widget->height() >= 200;
}

QString View3DPicture::note() const
{
    if (!m_modelError.isEmpty())
        return m_modelError;
    if (!m_missing.isEmpty())
        return tr("There is no vector '%1' at the moment").arg(m_missing.first());
    const QString state = stateText(m_shownInput.state);
    if (!state.isEmpty())
        return state;
    return isRoomy() && m_shownInput.bodyScale > 1.05f
        ? tr("kite drawn × %1").arg(double(m_shownInput.bodyScale), 0, 'g', 2)
        : QString();
}

void View3DPicture::paint()
{
    QPainter painter(m_widget);
    if (m_windWindow)
        return painter.fillRect(m_widget->rect(), theme().surface);  // below the line that says why
    painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
    const QRectF area = m_widget->rect();
    const QPlcTheme colors = theme();
    painter.fillRect(area, colors.surface);
    const QString problem = m_kite->problem();
    if (!problem.isEmpty())
        return drawHint(&painter, area, problem, colors);
    if (m_picture.isNull())
        return drawHint(&painter, area, tr("The first picture is being drawn ..."), colors);
    painter.drawImage(area, m_picture);
    if (m_shownInput.state.isStale && !m_shownInput.state.pastTime) {
        QColor veil = colors.surface;
        veil.setAlpha(140);
        painter.fillRect(area, veil);
    }
    painter.setFont(theme().labelFont);
    if (isRoomy())
        drawLabels(&painter, sceneLabels(m_shownInput, m_forceUnit), m_shownPose, area.size(), colors);
    paintCorners(&painter);
}

void View3DPicture::paintCorners(QPainter *painter)
{
    const QRectF all = m_widget->rect();
    const QRectF area = all.adjusted(margin, 0.5 * margin, -margin, -0.5 * margin);
    const QPlcTheme colors = theme();
    if (!m_kite->colorTitle().isEmpty())
        drawColorBar(painter, area.topLeft(), m_scale, m_kite->colorTitle(), colors);
    if (isRoomy())
        drawReadout(painter, area, m_shownInput.state, colors);
    QRectF scaleArea = area;
    scaleArea.setTop(all.top());
    drawScale(painter, scaleArea, m_shownPose, cameraTitle(m_settings.camera.preset), colors);
    const double line = QFontMetricsF(painter->font()).height();
    if (isRoomy()) {
        const std::optional<float> wind
            = m_shownInput.state.wind ? std::optional<float>(m_shownInput.state.downwind()) : std::nullopt;
        drawCompass(painter, area.bottomRight() + QPointF(-24, -line - 26), m_shownPose, wind, colors);
    }
    const bool isWarning = !m_modelError.isEmpty() || m_shownInput.state.isStale;
    painter->setPen(isWarning ? colors.warning : m_shownInput.state.pastTime ? colors.accent : colors.mutedText);
    painter->drawText(QRectF(area.left(), area.bottom() - line, area.width(), line), Qt::AlignRight, note());
    if (m_widget->hasFocus()) {
        painter->setBrush(Qt::NoBrush);
        painter->setPen(QPen(colors.accent, 1.0));
        painter->drawRect(all.adjusted(0.5, 0.5, -0.5, -0.5));
    }
}

}  // namespace qplc
