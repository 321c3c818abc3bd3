// SPDX-License-Identifier: Apache-2.0
#include "SetterView.h"

#include "gui/models/ValueFormat.h"

#include <QtGui/QKeyEvent>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QToolButton>

#include <cmath>

namespace qplc {

namespace {

/// A value that is typed: Enter sends it once, Esc takes the typing back, and nothing is
/// overwritten while it is edited. Keys and buttons step by 1 % and 10 % of the range. The number
/// is in the unit of the signal table, without a prefix: one that changed while it is typed would
/// make 4 kN out of 4 N.
class NumberView : public SetterView
{
public:
    NumberView(SetterTarget *target, QWidget *parent)
        : SetterView(target, parent)
        , m_edit(new QLineEdit(this))
        , m_unit(new QLabel(this))
    {
        auto *row = new QHBoxLayout(this);
        row->setContentsMargins(0, 0, 0, 0);
        row->setSpacing(2);
        m_edit->setAccessibleName(tr("New value"));
        m_edit->setMinimumWidth(50);
        m_edit->setAlignment(Qt::AlignRight);
        m_edit->installEventFilter(this);
        setFocusProxy(m_edit);
        makeButtons();
        connect(m_edit, &QLineEdit::textEdited, this, [this] { setEdited(true); });
        refresh();
    }

    void refresh() override
    {
        const bool mayWrite = target().control().mayWrite();
        if (!mayWrite) {
            m_sent.clear();
            setEdited(false);
        }
        m_unit->setText(target().unit());
        m_unit->setVisible(!target().unit().isEmpty());
        m_edit->setReadOnly(!mayWrite);
        m_edit->setEnabled(mayWrite);
        for (QToolButton *button : qAsConst(m_steps)) {
            button->setVisible(target().isNumber());
            button->setEnabled(mayWrite);
        }
        m_apply->setEnabled(mayWrite && m_isEdited);
        showValue();
    }

    void showActual() override
    {
        if (m_sent.isEmpty())
            showValue();
    }

protected:
    bool eventFilter(QObject *watched, QEvent *event) override
    {
        const auto stepsOf = [](int key) {
            return key == Qt::Key_Up      ? 1
                : key == Qt::Key_Down     ? -1
                : key == Qt::Key_PageUp   ? 10
                : key == Qt::Key_PageDown ? -10
                                          : 0;
        };
        if (watched == m_edit && event->type() == QEvent::KeyPress) {
            const auto *press = static_cast<QKeyEvent *>(event);
            const bool isEnter = press->key() == Qt::Key_Return || press->key() == Qt::Key_Enter;
            if (isEnter && !press->isAutoRepeat())
                apply();
            else if (press->key() == Qt::Key_Escape && m_isEdited)
                revert();
            else if (stepsOf(press->key()) != 0)
                step(stepsOf(press->key()));
            else if (!isEnter)
                return false;
            return true;
        }
        return SetterView::eventFilter(watched, event);
    }

private:
    void makeButtons()
    {
        const auto makeStep = [this](int steps, const QString &text, const QString &tip) {
            auto *button = new QToolButton(this);
            button->setText(text);
            button->setToolTip(tip);
            button->setAccessibleName(tip);
            button->setAutoRepeat(true);
            button->setFocusPolicy(Qt::NoFocus);  // the keys of the field do the same
            connect(button, &QToolButton::clicked, this, [this, steps] { step(steps); });
            m_steps.append(button);
            layout()->addWidget(button);
        };
        makeStep(-10, QStringLiteral("−−"), tr("10 % less (Page down)"));
        makeStep(-1, QStringLiteral("−"), tr("1 % less (Down)"));
        layout()->addWidget(m_edit);
        layout()->addWidget(m_unit);
        makeStep(1, QStringLiteral("+"), tr("1 % more (Up)"));
        makeStep(10, QStringLiteral("++"), tr("10 % more (Page up)"));
        m_apply = new QToolButton(this);
        m_apply->setText(tr("Set"));
        m_apply->setToolTip(tr("Send this value (Enter)"));
        m_apply->setFocusPolicy(Qt::TabFocus);
        connect(m_apply, &QToolButton::clicked, this, &NumberView::apply);
        layout()->addWidget(m_apply);
    }

    void apply()
    {
        if (!target().control().mayWrite() || !target().signal())
            return;
        const QString text = m_edit->text().trimmed();
        if (target().isNumber()) {
            applyNumber(text);
            return;
        }
        QString error;
        const QPlcValue value = QPlcValue::fromString(target().signal().definition.type, text, &error);
        if (!value.isValid()) {
            Q_EMIT said(error);
            return;
        }
        m_sent = text;
        setEdited(false);
        target().sendOnce(value);
    }

    void applyNumber(const QString &text)
    {
        QString error;
        const std::optional<qint64> named = target().signal().definition.valueNames.valueOf(text);
        const QPlcValue typed = named ? QPlcValue(double(*named))
                                      : QPlcValue::fromString(QPlcSignalType(QPlcSignalType::Real64), text, &error);
        if (!typed.isValid() || !typed.isFinite()) {
            Q_EMIT said(error.isEmpty() ? tr("'%1' is not a number").arg(text) : error);
            return;
        }
        QString message;
        const double number = target().clamped(typed.toReal(), &message);
        if (!target().sendOnce(number)) {
            Q_EMIT said(tr("'%1' is not a value of this signal").arg(text));
            return;
        }
        m_sent = numberText(number);
        setEdited(false);
        showValue();
        m_edit->selectAll();
        Q_EMIT said(message);
    }

    void revert()
    {
        setEdited(false);
        showValue();
        m_edit->selectAll();
    }

    void step(int steps)
    {
        if (!target().control().mayWrite() || !target().isNumber())
            return;
        bool isNumber = false;
        double value = m_edit->text().toDouble(&isNumber);
        if (!isNumber)
            value = std::isnan(target().actualNumber()) ? target().neutral() : target().actualNumber();
        const double next = value + steps * target().smallStep(value);
        QString message;
        const double allowed
            = target().clamped(std::abs(next) < 1e-9 * target().smallStep(value) ? 0.0 : next, &message);
        m_edit->setText(numberText(allowed));
        setEdited(true);
        if (!message.isEmpty())
            Q_EMIT said(message);
    }

    void setEdited(bool edited)
    {
        if (edited == m_isEdited)
            return;
        m_isEdited = edited;
        QFont font = m_edit->font();
        font.setBold(edited);
        m_edit->setFont(font);
        m_apply->setEnabled(edited && target().control().mayWrite());
        Q_EMIT said(edited ? tr("Not sent yet: Enter sends, Esc takes it back") : QString());
    }

    void showValue()
    {
        if (m_isEdited)
            return;
        const QString actual = target().isNumber() ? numberText(target().actualNumber()) : target().actual().toString();
        const QString text = m_sent.isEmpty() ? actual : m_sent;
        if (text != m_edit->text())
            m_edit->setText(text);
    }

    QLineEdit *m_edit;
    QLabel *m_unit;
    QToolButton *m_apply = nullptr;
    QVector<QToolButton *> m_steps;
    bool m_isEdited = false;
    QString m_sent;  // last text that was sent while this window may write; empty: the actual value is shown
};

}  // namespace

SetterView *createNumberView(SetterTarget *target, QWidget *parent)
{
    return new NumberView(target, parent);
}

}  // namespace qplc
