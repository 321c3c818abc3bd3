// SPDX-License-Identifier: Apache-2.0
#include "EvictionQuestion.h"

#include "gui/panel/PanelAction.h"

#include <QtWidgets/QApplication>
#include <QtWidgets/QBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QPushButton>

namespace qplc {

EvictionQuestion::EvictionQuestion(QWidget *parent)
    : QFrame(parent)
    , m_text(new QLabel(this))
    , m_act(new QPushButton(this))
    , m_cancel(new QPushButton(tr("Cancel"), this))
{
    setFrameShape(QFrame::StyledPanel);
    m_text->setTextFormat(Qt::PlainText);
    m_text->setWordWrap(true);  // it must not make a table wider
    m_act->setObjectName(QStringLiteral("act"));
    m_cancel->setObjectName(QStringLiteral("cancel"));
    auto *column = new QVBoxLayout(this);
    auto *buttons = new QHBoxLayout;
    buttons->addStretch();
    buttons->addWidget(m_cancel);
    buttons->addWidget(m_act);
    column->addWidget(m_text);
    column->addLayout(buttons);
    m_pause.setSingleShot(true);
    connect(&m_pause, &QTimer::timeout, this, [this] { m_act->setEnabled(true); });
    connect(m_cancel, &QPushButton::clicked, this, &EvictionQuestion::end);
    connect(m_act, &QPushButton::clicked, this, [this] {
        m_eviction.carryOut();
        end();
    });
    addPanelAction(this, m_cancel->text(), {Qt::Key_Escape}, [this] { end(); });
    hide();
}

void EvictionQuestion::ask(const NodeEviction &eviction)
{
    m_eviction = eviction;
    m_text->setText(eviction.question());
    m_act->setText(eviction.title());
    m_act->setEnabled(false);
    m_pause.start(QApplication::doubleClickInterval());
    show();
    m_cancel->setFocus(Qt::OtherFocusReason);
}

void EvictionQuestion::follow()
{
    if (isHidden())
        return;
    const bool isTrue = m_eviction.obstacle().isEmpty() && m_eviction.question() == m_text->text();
    if (!isTrue)
        end();
}

void EvictionQuestion::end()
{
    m_pause.stop();
    hide();
    Q_EMIT ended();
}

}  // namespace qplc
