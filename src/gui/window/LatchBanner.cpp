// SPDX-License-Identifier: Apache-2.0
#include "LatchBanner.h"

#include "WatchPlants.h"

#include <QtGui/QPainter>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>

namespace qplc {

LatchBanner::LatchBanner(WindowContext *context, QWidget *parent)
    : QWidget(parent)
    , m_context(context)
    , m_label(new QLabel(this))
    , m_reset(new BarButton(BarButton::Outlined, context))
{
    setObjectName(QStringLiteral("LatchBanner"));
    m_label->setTextFormat(Qt::PlainText);
    m_label->setWordWrap(true);
    m_label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_reset->setText(Plant::actionText(Plant::Reset));
    connect(m_reset, &QAbstractButton::clicked, this, [this] {
        if (m_plant)
            Q_EMIT resetRequested(m_plant);
    });
    auto *row = new QHBoxLayout(this);
    row->setContentsMargins(18, 6, 8, 6);
    row->setSpacing(12);
    row->addWidget(m_label, 1);
    row->addWidget(m_reset, 0, Qt::AlignVCenter);
    PlantList *plants = context->plants();
    connect(plants, &PlantList::selectionChanged, this, &LatchBanner::follow);
    connect(context, &WindowContext::themeChanged, this, &LatchBanner::colour);
    colour();
    watchPlants(plants, this, &LatchBanner::follow, &Plant::stateChanged, &Plant::statusChanged);
}

void LatchBanner::follow()
{
    PlantList *plants = m_context->plants();
    m_plant.clear();
    m_text.clear();
    const auto isLatched
        = [](const Plant *plant) { return plant && plant->isConnected() && plant->status().isLatched(); };
    if (isLatched(plants->selected()))
        m_plant = plants->selected();
    for (Plant *plant : plants->all()) {
        if (!m_plant && isLatched(plant))
            m_plant = plant;
    }
    m_reset->setDetail(m_plant == plants->selected() ? tr("F7") : QString());  // the key resets the selected plant
    if (m_plant) {
        const messages::State &master = m_plant->status().master;
        const QString what
            = master.state == messages::MasterState::SafeStop ? tr("%1 has stopped safely") : tr("%1 cannot run");
        m_text = what.arg(m_plant->name());
        if (!master.reason.isEmpty())
            m_text += tr(": %1").arg(master.reason);
        m_text += master.remains.isEmpty() ? tr(". Reset it, then initialize and start.")
                                           : tr(". Before a reset: %1.").arg(master.remains);
        m_reset->setEnabled(master.remains.isEmpty());
        m_reset->setAccessibleName(tr("Reset %1").arg(m_plant->name()));
    }
    m_label->setText(m_text);
    setAccessibleName(m_text);
    setVisible(!m_text.isEmpty());
}

void LatchBanner::colour()
{
    QPalette colours = m_label->palette();
    colours.setColor(QPalette::WindowText, m_context->theme().text);
    m_label->setPalette(colours);
    update();
}

void LatchBanner::paintEvent(QPaintEvent * /*event*/)
{
    const Theme &theme = m_context->theme();
    QPainter painter(this);
    QColor tint = theme.alarm;
    tint.setAlphaF(0.16);
    painter.fillRect(rect(), theme.surface);
    painter.fillRect(rect(), tint);
    painter.fillRect(QRect(0, 0, 6, height()), theme.alarm);
    painter.fillRect(QRect(0, height() - 1, width(), 1), theme.alarm);
}

}  // namespace qplc
