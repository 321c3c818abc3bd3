// SPDX-License-Identifier: Apache-2.0
#include "MomentaryView.h"

#include "gui/models/ValueFormat.h"

#include <QtCore/QEvent>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QPushButton>

namespace qplc {

MomentaryView::MomentaryView(SetterTarget *target, QWidget *parent)
    : SetterView(target, parent)
    , m_button(new QPushButton(this))
{
    auto *row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->addWidget(m_button);
    m_button->setAccessibleName(tr("Value while held"));
    m_button->installEventFilter(this);
    setFocusProxy(m_button);
    connect(m_button, &QPushButton::pressed, this, &MomentaryView::press);
    connect(m_button, &QPushButton::released, this, &MomentaryView::release);
    connect(&target->control(), &QPlcSignalControl::holdLost, this, [this] {
        m_button->setDown(false);
        Q_EMIT said(tr("Control was lost while the button was held"));
    });
    refresh();
}

MomentaryView::~MomentaryView()
{
    target().endAction();
    m_button->disconnect(this);  // it is released when it loses the focus, which is later
}

double MomentaryView::pressedValue() const
{
    return m_pressed.value_or(target().maximum().value_or(1.0));
}

void MomentaryView::refresh()
{
    m_button->setEnabled((target().control().mayWrite() && target().isNumber()) || m_button->isDown());
    const QString unit = target().signal() ? target().signal().definition.unit : QString();
    const SiPrefix prefix = SiPrefix::fitting(unit, pressedValue());
    m_button->setText(tr("Hold: %1 %2").arg(numberText(prefix.shown(pressedValue())), prefix.unit()).trimmed());
}

void MomentaryView::press()
{
    if (target().beginAction(pressedValue()))
        Q_EMIT said(QString());
    else
        m_button->setDown(false);
}

void MomentaryView::release()
{
    target().endAction();
}

bool MomentaryView::eventFilter(QObject *watched, QEvent *event)
{
    const bool isGone = event->type() == QEvent::FocusOut || event->type() == QEvent::Hide
        || event->type() == QEvent::WindowDeactivate;
    if (watched == m_button && isGone && target().isActing()) {
        m_button->setDown(false);
        target().endAction();
    }
    return SetterView::eventFilter(watched, event);
}

QJsonObject MomentaryView::settings() const
{
    return m_pressed ? QJsonObject{{QStringLiteral("pressed"), *m_pressed}} : QJsonObject();
}

void MomentaryView::applySettings(const QJsonObject &settings)
{
    const QJsonValue pressed = settings.value(QStringLiteral("pressed"));
    m_pressed = pressed.isDouble() ? std::make_optional(pressed.toDouble()) : std::nullopt;
    refresh();
}

}  // namespace qplc
