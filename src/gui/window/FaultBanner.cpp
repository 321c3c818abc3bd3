// SPDX-License-Identifier: Apache-2.0
#include "FaultBanner.h"

#include "WatchPlants.h"

#include <QtGui/QPainter>

namespace qplc {

namespace {

/// "Winch (loss=5%)" for everybody in the plant who injects faults.
QStringList injectors(const Plant &plant)
{
    QStringList all;
    if (!plant.status().master.faults.isEmpty())
        all << FaultBanner::tr("the master (%1)").arg(plant.status().master.faults);
    for (const NodeStatus &node : plant.status().nodes) {
        if (!node.info.faultPlan.isEmpty())
            all << QStringLiteral("%1 (%2)").arg(node.info.name, node.info.faultPlan);
    }
    return all;
}

}  // namespace

FaultBanner::FaultBanner(WindowContext *context, QWidget *parent)
    : QWidget(parent)
    , m_context(context)
{
    setObjectName(QStringLiteral("FaultBanner"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    connect(context, &WindowContext::themeChanged, this, QOverload<>::of(&QWidget::update));
    watchPlants(context->plants(), this, &FaultBanner::follow, &Plant::statusChanged);
}

void FaultBanner::follow()
{
    QStringList sentences;
    for (const Plant *plant : m_context->plants()->all()) {
        const QStringList who = injectors(*plant);
        if (!who.isEmpty())
            sentences
                << tr("%1: faults are injected on purpose by %2").arg(plant->name(), who.join(QStringLiteral(", ")));
    }
    m_text = sentences.join(QStringLiteral("; "));
    setToolTip(m_text);
    setAccessibleName(m_text);
    setVisible(!m_text.isEmpty());
    update();
}

void FaultBanner::paintEvent(QPaintEvent * /*event*/)
{
    const Theme &theme = m_context->theme();
    QPainter painter(this);
    painter.fillRect(rect(), theme.warning);
    QFont used = font();
    used.setBold(true);
    painter.setFont(used);
    painter.setPen(theme.window);
    const QRect place = rect().adjusted(12, 0, -12, 0);
    painter.drawText(place, Qt::AlignLeft | Qt::AlignVCenter,
                     QFontMetrics(used).elidedText(m_text, Qt::ElideRight, place.width()));
}

}  // namespace qplc
