// SPDX-License-Identifier: Apache-2.0
#include "WindWindow.h"

#include "KiteSettingsEditor.h"
#include "WindWindowDrawing.h"

namespace awe {

WindWindow::WindWindow(QWidget *parent)
    : QPlcWidget(parent)
{
    setAccessibleName(tr("Wind window: the kite as seen from the ground station"));
    setFocusPolicy(Qt::ClickFocus);
    connect(context(), &QPlcPanelContext::changed, this, QOverload<>::of(&QWidget::update));
}

QJsonObject WindWindow::settings() const
{
    return settingsWith(m_kite.settings().toJson());
}

void WindWindow::applySettings(const QJsonObject &settings)
{
    QJsonObject others;
    m_kite.setSettings(KiteSettings::fromJson(settings, &others));
    QPlcWidget::applySettings(others);
}

QWidget *WindWindow::createSettingsEditor()
{
    auto *editor = new KiteSettingsEditor(m_kite.settings());
    connect(editor, &KiteSettingsEditor::edited, this, [this, editor] {
        m_kite.setSettings(editor->settings());
        update();
        Q_EMIT settingsEdited();
    });
    return editor;
}

bool WindWindow::addSignals(const QStringList &references)
{
    if (references.isEmpty())
        return false;
    KiteSettings settings = m_kite.settings();
    settings.color = references.first();
    m_kite.setSettings(settings);
    update();
    Q_EMIT settingsEdited();
    return true;
}

QSize WindWindow::minimumSizeHint() const
{
    return {120, 90};
}

QSize WindWindow::sizeHint() const
{
    return {420, 260};
}

QStringList WindWindow::shownSignals() const
{
    return {m_kite.settings().position};
}

void WindWindow::contextChanged()
{
    m_kite.setContext(context());
}

void WindWindow::paintEvent(QPaintEvent * /*event*/)
{
    QPainter painter(this);
    drawWindWindow(&painter, size(), m_kite, context()->theme());
}

}  // namespace awe
