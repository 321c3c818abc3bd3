// SPDX-License-Identifier: Apache-2.0
#include "QPlcView3D.h"

#include "QPlcPanelContext.h"
#include "QPlcScene3D.h"
#include "View3DEditor.h"
#include "View3DPicture.h"
#include "gui/panel/DragEscape.h"

#include <QtCore/QTimer>
#include <QtGui/QMouseEvent>
#include <QtWidgets/QAction>

#include <cmath>
#include <functional>

using namespace qplc;

struct QPlcView3D::Private
{
    explicit Private(QPlcView3D *widget)
        : q(widget)
        , picture(new View3DPicture(widget))
    {
    }

    void makeActions();
    void addAction(const QString &text, const QKeySequence &key, const std::function<void()> &perform);
    void moveCamera(const OrbitCamera &camera);
    void choosePreset(OrbitCamera::Preset preset);
    void takeEdit(const View3DSettings &wanted);

    QPlcView3D *q;
    QVector<View3DPart> parts;
    View3DPicture *picture;
    View3DSettings settings;
    QPointF lastMouse;
    bool isDragged = false;
    QTimer wheelEnd;  // a turn of the wheel is one step for undo

    static constexpr float keyStep = 18.0f;  // [px] that an arrow key stands for
};

QPlcView3D::QPlcView3D(QWidget *parent)
    : QPlcWidget(parent)
    , d(std::make_unique<Private>(this))
{
    d->parts = {{QStringLiteral("ground"), tr("Ground")}, {QStringLiteral("axes"), tr("Axes")}};
    setAccessibleName(tr("3D view"));
    setFocusPolicy(Qt::StrongFocus);
    new DragEscape(this, this);
    d->wheelEnd.setSingleShot(true);
    d->wheelEnd.setInterval(400);
    connect(&d->wheelEnd, &QTimer::timeout, this, &QPlcView3D::settingsEdited);
    connect(d->picture, &View3DPicture::pictureDrawn, this, &QPlcView3D::pictureDrawn);
    d->makeActions();
}

QPlcView3D::~QPlcView3D() = default;

void QPlcView3D::Private::addAction(const QString &text, const QKeySequence &key, const std::function<void()> &perform)
{
    auto *action = new QAction(text, q);
    action->setShortcut(key);
    action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    q->QWidget::addAction(action);
    QObject::connect(action, &QAction::triggered, q, perform);
}

void QPlcView3D::Private::makeActions()
{
    for (int i = 0; i < OrbitCamera::presets; ++i) {
        const auto preset = OrbitCamera::Preset(i);
        addAction(tr("Camera: %1").arg(cameraTitle(preset)), QKeySequence(Qt::Key_1 + i),
                  [this, preset] { choosePreset(preset); });
    }
    addAction(tr("Camera as it was"), QKeySequence(Qt::Key_0), [this] { choosePreset(settings.camera.preset); });
    addAction(tr("Nearer"), QKeySequence(Qt::Key_Plus), [this] {
        OrbitCamera camera = settings.camera;
        camera.zoomBy(1.2);
        moveCamera(camera);
        wheelEnd.start();
    });
    addAction(tr("Farther"), QKeySequence(Qt::Key_Minus), [this] {
        OrbitCamera camera = settings.camera;
        camera.zoomBy(1 / 1.2);
        moveCamera(camera);
        wheelEnd.start();
    });
}

void QPlcView3D::Private::moveCamera(const OrbitCamera &camera)
{
    settings.camera = camera;
    picture->setSettings(settings);
}

void QPlcView3D::Private::choosePreset(OrbitCamera::Preset preset)
{
    OrbitCamera camera;
    camera.preset = preset;
    moveCamera(camera);
    Q_EMIT q->settingsEdited();
}

void QPlcView3D::Private::takeEdit(const View3DSettings &wanted)
{
    settings = wanted;
    picture->setSettings(settings);
    Q_EMIT q->settingsEdited();
}

QJsonObject QPlcView3D::settings() const
{
    return settingsWith(d->settings.toJson());
}

void QPlcView3D::applySettings(const QJsonObject &settings)
{
    QJsonObject others;
    d->settings = View3DSettings::fromJson(settings, d->parts, &others);
    QPlcWidget::applySettings(others);
    d->picture->setSettings(d->settings);
}

QWidget *QPlcView3D::createSettingsEditor()
{
    auto *editor = new View3DEditor(d->settings, d->parts, createBodyEditor());
    connect(editor, &View3DEditor::edited, this, [this, editor] { d->takeEdit(editor->settings()); });
    return editor;
}

bool QPlcView3D::addSignals(const QStringList &references)
{
    if (references.isEmpty())
        return false;
    View3DSettings wanted = d->settings;
    wanted.position = references.first();
    d->takeEdit(wanted);
    return true;
}

void QPlcView3D::addPart(const QString &key, const QString &title)
{
    d->parts.append({key, title});
}

bool QPlcView3D::isPartShown(const QString &key) const
{
    return d->settings.isShown(key);
}

void QPlcView3D::setDefaultModel(const QString &file)
{
    d->picture->setDefaultModel(file);
}

bool QPlcView3D::showsDefaultModel() const
{
    return d->picture->showsDefaultModel();
}

void QPlcView3D::redraw()
{
    d->picture->want();
    update();
}

std::optional<QVector3D> QPlcView3D::vectorOf(const QString &reference) const
{
    const QPlcPanelContext::Signal signal = context()->shown(reference);
    if (!signal || signal.element >= 0 || signal.definition.type.count() < 3 || !signal.quality.isUsable())
        return std::nullopt;
    const QVector3D vector(float(signal.number(0)), float(signal.number(1)), float(signal.number(2)));
    const bool isNumber = std::isfinite(vector.x()) && std::isfinite(vector.y()) && std::isfinite(vector.z());
    return isNumber ? std::optional<QVector3D>(vector) : std::nullopt;
}

namespace {

/// Roll, pitch and yaw [deg], or a quaternion.
std::optional<QQuaternion> orientationOf(const QPlcPanelContext::Signal &signal)
{
    const int count = signal ? signal.definition.type.count() : 0;
    const auto at = [&signal](int element) { return float(signal.number(element)); };
    if ((count != 3 && count != 4) || signal.element >= 0 || !signal.quality.isUsable() || std::isnan(at(0)))
        return std::nullopt;
    if (count == 4)
        return QQuaternion(at(0), at(1), at(2), at(3)).normalized();
    return QQuaternion::fromAxisAndAngle(0, 0, 1, at(2)) * QQuaternion::fromAxisAndAngle(0, 1, 0, at(1))
        * QQuaternion::fromAxisAndAngle(1, 0, 0, at(0));
}

}  // namespace

QString QPlcView3D::problem() const
{
    if (context()->plants().isEmpty())
        return tr("No plant is connected.");
    const QPlcPanelContext::Signal position = context()->signal(d->settings.position);
    if (d->settings.position.isEmpty() || (position && position.definition.type.count() >= 3))
        return {};
    return position ? tr("%1 is not a position: choose a signal with three elements.").arg(d->settings.position)
                    : position.problem;
}

void QPlcView3D::prepareScene(QPlcScene3D *scene)
{
    if (d->settings.position.isEmpty())
        return;
    scene->position = vectorOf(d->settings.position);
    if (scene->position && d->settings.orientation.isEmpty())
        scene->orientation = QQuaternion();
    else if (scene->position)
        scene->orientation = orientationOf(context()->shown(d->settings.orientation));
    scene->course = scene->orientation.value_or(QQuaternion());
    const QPlcPanelContext::Plant plant = context()->plant(context()->signal(d->settings.position).plant);
    scene->isStale = plant.isStale && !context()->shownTime();
    if (scene->isStale)
        scene->note = tr("stale, %1").arg(QPlcPanelContext::ageText(plant.age));
    else if (!scene->position)
        scene->note = tr("no position");
}

void QPlcView3D::drawScene(QPlcScene3D * /*scene*/) {}

void QPlcView3D::paintOver(QPainter * /*painter*/, const QRectF & /*area*/, const QPlcScene3D & /*scene*/) {}

QString QPlcView3D::openGlError() const
{
    return d->picture->openGlError();
}

QSize QPlcView3D::minimumSizeHint() const
{
    return {120, 90};
}

QSize QPlcView3D::sizeHint() const
{
    return {480, 360};
}

QStringList QPlcView3D::shownSignals() const
{
    return d->settings.position.isEmpty() ? QStringList() : QStringList(d->settings.position);
}

void QPlcView3D::contextChanged()
{
    redraw();
}

void QPlcView3D::paintEvent(QPaintEvent * /*event*/)
{
    d->picture->paint();
}

void QPlcView3D::showEvent(QShowEvent *event)
{
    QPlcWidget::showEvent(event);
    d->picture->shown();
}

void QPlcView3D::resizeEvent(QResizeEvent *event)
{
    QPlcWidget::resizeEvent(event);
    d->picture->resized();
}

void QPlcView3D::mousePressEvent(QMouseEvent *event)
{
    d->lastMouse = event->localPos();
    d->isDragged = false;
    event->accept();
}

void QPlcView3D::mouseMoveEvent(QMouseEvent *event)
{
    if (!(event->buttons() & (Qt::LeftButton | Qt::MiddleButton)))
        return QPlcWidget::mouseMoveEvent(event);
    const QPointF way = event->localPos() - d->lastMouse;
    d->lastMouse = event->localPos();
    OrbitCamera camera = d->settings.camera;
    if (event->modifiers() & Qt::ShiftModifier || event->buttons() & Qt::MiddleButton)
        camera.dragSideways(way, height());
    else if (event->modifiers() & (Qt::ControlModifier | Qt::AltModifier))  // window managers take Alt
        camera.zoomBy(std::pow(2.0, -way.y() / 100.0));
    else
        camera.drag(way, height());
    d->isDragged = true;
    d->moveCamera(camera);
}

void QPlcView3D::mouseReleaseEvent(QMouseEvent *event)
{
    if (d->isDragged)
        Q_EMIT settingsEdited();
    d->isDragged = false;
    event->accept();
}

void QPlcView3D::mouseDoubleClickEvent(QMouseEvent *event)
{
    d->choosePreset(d->settings.camera.preset);
    event->accept();
}

void QPlcView3D::wheelEvent(QWheelEvent *event)
{
    OrbitCamera camera = d->settings.camera;
    // With Alt, some desktops turn the wheel by 90 degrees.
    const int turn = event->angleDelta().y() != 0 ? event->angleDelta().y() : event->angleDelta().x();
    camera.zoomBy(std::pow(1.2, double(turn) / 120.0));
    d->moveCamera(camera);
    d->wheelEnd.start();
    event->accept();
}

void QPlcView3D::keyPressEvent(QKeyEvent *event)
{
    QPointF way;
    switch (event->key()) {
    case Qt::Key_Left:
        way = {Private::keyStep, 0};
        break;
    case Qt::Key_Right:
        way = {-Private::keyStep, 0};
        break;
    case Qt::Key_Up:
        way = {0, Private::keyStep};
        break;
    case Qt::Key_Down:
        way = {0, -Private::keyStep};
        break;
    default:
        return QPlcWidget::keyPressEvent(event);
    }
    OrbitCamera camera = d->settings.camera;
    if (event->modifiers() & Qt::ShiftModifier)
        camera.dragSideways(way, 480);
    else
        camera.drag(way, 480);
    d->moveCamera(camera);
    d->wheelEnd.start();
}
