// SPDX-License-Identifier: Apache-2.0
#include "InsecureNotice.h"

#include <QtGui/QPainter>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>

namespace qplc {

InsecureNotice::InsecureNotice(WindowContext *context, QWidget *parent)
    : QWidget(parent)
    , m_context(context)
    , m_label(new QLabel(this))
{
    setObjectName(QStringLiteral("InsecureNotice"));
    m_label->setWordWrap(true);
    auto *row = new QHBoxLayout(this);
    row->setContentsMargins(14, 4, 6, 4);
    row->addWidget(m_label, 1);
    PlantList *plants = context->plants();
    connect(plants, &PlantList::added, this, &InsecureNotice::listenTo);
    connect(plants, &PlantList::removed, this, &InsecureNotice::follow);
    for (int place = 0; place < plants->size(); ++place)
        listenTo(plants->at(place));
    follow();
}

void InsecureNotice::listenTo(Plant *plant)
{
    connect(plant, &Plant::stateChanged, this, &InsecureNotice::follow);
    follow();
}

void InsecureNotice::follow()
{
    QStringList names;
    for (int place = 0; place < m_context->plants()->size(); ++place) {
        const Plant *plant = m_context->plants()->at(place);
        if (plant->isConnected() && plant->isInsecure())
            names << plant->name();
    }
    m_label->setText(names.isEmpty() ? QString()
                                     : tr("Without security: everybody in the network can read and command %1.")
                                           .arg(names.join(QStringLiteral(", "))));
    setAccessibleName(m_label->text());
    setToolTip(names.isEmpty() ? QString() : tr("Start the master with --security psk instead of --insecure-network."));
    setVisible(!names.isEmpty());
}

QString InsecureNotice::text() const
{
    return isHidden() ? QString() : m_label->text();
}

void InsecureNotice::paintEvent(QPaintEvent * /*event*/)
{
    const Theme &theme = m_context->theme();
    QPainter painter(this);
    painter.fillRect(rect(), theme.surface);
    painter.fillRect(QRect(0, 0, 4, height()), theme.warning);
    painter.fillRect(QRect(0, height() - 1, width(), 1), theme.line);
}

}  // namespace qplc
