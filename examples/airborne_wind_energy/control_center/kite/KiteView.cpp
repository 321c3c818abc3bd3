// SPDX-License-Identifier: Apache-2.0
#include "KiteView.h"

#include "KiteOverlay.h"
#include "KiteScene.h"
#include "KiteSettingsEditor.h"
#include "WindWindowView.h"
#include <QPlcScene3D.h>

/// In a static library nothing else needs the resource.
static void initModel()
{
    Q_INIT_RESOURCE(kite);
}

namespace awe {

namespace {

const QVector3D modelBridle(0.1f, 0, -4.6f);  // where the lines of our model meet [m]

}  // namespace

KiteView::KiteView(QWidget *parent)
    : QPlcView3D(parent)
{
    setAccessibleName(tr("3D view: the kite in space"));
    addPart(QStringLiteral("smallEarth"), tr("Small earth"));
    addPart(QStringLiteral("vectors"), tr("Wind and force"));
    addPart(QStringLiteral("tether"), tr("Tether"));
    initModel();
    setDefaultModel(QStringLiteral(":/kite/kite.obj"));
}

QJsonObject KiteView::settings() const
{
    QJsonObject all = QPlcView3D::settings();
    const QJsonObject kite = m_kite.settings().toJson();
    for (auto entry = kite.begin(); entry != kite.end(); ++entry)
        all.insert(entry.key(), entry.value());
    return all;
}

void KiteView::applySettings(const QJsonObject &settings)
{
    QJsonObject others;
    m_kite.setSettings(KiteSettings::fromJson(settings, &others));
    QPlcView3D::applySettings(others);
}

QStringList KiteView::shownSignals() const
{
    return {m_kite.settings().position};
}

void KiteView::take(const KiteSettings &settings)
{
    m_kite.setSettings(settings);
    redraw();
    Q_EMIT settingsEdited();
}

bool KiteView::addSignals(const QStringList &references)
{
    if (references.isEmpty())
        return false;
    KiteSettings settings = m_kite.settings();
    settings.color = references.first();
    take(settings);
    return true;
}

void KiteView::contextChanged()
{
    m_kite.setContext(context());
    QPlcView3D::contextChanged();
}

QString KiteView::problem() const
{
    return m_kite.problem();
}

QWidget *KiteView::createFallback()
{
    auto *window = new WindWindowView(&m_kite, context(), this);
    window->setObjectName(QStringLiteral("windWindow"));
    window->setWindowTitle(tr("wind window"));
    return window;
}

QWidget *KiteView::createBodyEditor()
{
    auto *editor = new KiteSettingsEditor(m_kite.settings());
    connect(editor, &KiteSettingsEditor::edited, this, [this, editor] { take(editor->settings()); });
    return editor;
}

void KiteView::prepareScene(QPlcScene3D *scene)
{
    m_state = m_kite.state();
    scene->bodyName = tr("kite");
    scene->position = m_state.position;
    scene->orientation = m_state.body;
    scene->course = m_state.course.value_or(QQuaternion());
    if (m_state.tetherLength)
        scene->extent = float(*m_state.tetherLength);
    if (m_state.wind)
        scene->heading = scene->compassArrow = m_state.downwind();
    scene->isStale = m_state.isStale && !m_state.pastTime;
    scene->note = stateText(m_state);
    if (m_state.force)
        m_forceUnit = forceReference(m_state.force->length(), m_forceUnit);
}

void KiteView::drawScene(QPlcScene3D *scene)
{
    m_kite.readTrail(&m_trail);
    m_scale = m_kite.colorScale(m_trail);
    drawTrail(scene, m_trail, m_scale, 1.3f * float(scene->theme.curveWidth));
    if (isPartShown(QStringLiteral("axes")))
        drawWindAxes(scene, m_state);
    if (isPartShown(QStringLiteral("smallEarth")))
        drawSmallEarth(scene);
    drawMast(scene, m_state);
    if (isPartShown(QStringLiteral("tether")))
        drawTether(scene, m_state, showsDefaultModel() ? modelBridle : QVector3D());
    if (isPartShown(QStringLiteral("vectors")))
        drawVectors(scene, m_state, m_forceUnit);
}

void KiteView::paintOver(QPainter *painter, const QRectF &area, const QPlcScene3D &scene)
{
    if (!m_kite.colorTitle().isEmpty())
        drawColorBar(painter, area.topLeft(), m_scale, m_kite.colorTitle(), scene.theme);
    if (width() >= 320 && height() >= 200)
        drawReadout(painter, area, m_state, scene.theme);
}

}  // namespace awe
