// SPDX-License-Identifier: Apache-2.0
#include "SetterView.h"

#include "gui/models/ValueFormat.h"

#include <QtCore/QEvent>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QPushButton>

namespace qplc {

namespace {

/// A value (`pressed`; the maximum, or 1, unless set) as long as a button is held, by mouse or
/// space bar; neutral when it is released, hidden, loses the focus, or may not write any more.
class MomentaryView : public SetterView
{
public:
    MomentaryView(SetterTarget *target, QWidget *parent)
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

    ~MomentaryView() override
    {
        target().endAction();
        m_button->disconnect(this);  // it is released when it loses the focus, which is later
    }

    void refresh() override
    {
        m_button->setEnabled((target().control().mayWrite() && target().isNumber()) || m_button->isDown());
        const QString unit = target().signal() ? target().signal().definition.unit : QString();
        const SiPrefix prefix = SiPrefix::fitting(unit, pressedValue());
        m_button->setText(tr("Hold: %1 %2").arg(numberText(prefix.shown(pressedValue())), prefix.unit()).trimmed());
    }

    void applySettings(const QJsonObject &settings) override
    {
        const QJsonValue pressed = settings.value(QStringLiteral("pressed"));
        m_pressed = pressed.isDouble() ? std::make_optional(pressed.toDouble()) : std::nullopt;
        refresh();
    }

protected:
    bool eventFilter(QObject *watched, QEvent *event) override
    {
        const bool isGone = event->type() == QEvent::FocusOut || event->type() == QEvent::Hide
            || event->type() == QEvent::WindowDeactivate;
        if (watched == m_button && isGone && target().isActing()) {
            m_button->setDown(false);
            target().endAction();
        }
        return SetterView::eventFilter(watched, event);
    }

private:
    double pressedValue() const { return m_pressed.value_or(target().maximum().value_or(1.0)); }

    void press()
    {
        if (target().beginAction(pressedValue()))
            Q_EMIT said(QString());
        else
            m_button->setDown(false);
    }

    void release() { target().endAction(); }

    QPushButton *m_button;
    std::optional<double> m_pressed;
};

}  // namespace

SetterView *createMomentaryView(SetterTarget *target, QWidget *parent)
{
    return new MomentaryView(target, parent);
}

}  // namespace qplc
