// SPDX-License-Identifier: Apache-2.0
#include "ControlBar.h"

#include "ElidedLabel.h"
#include "QPlcSignalControl.h"
#include "QPlcTheme.h"

#include <QtCore/QTimer>
#include <QtWidgets/QAction>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QToolButton>

namespace qplc {

namespace {

/// Who it is, in a word or two.
QString headline(const QPlcSignalControl &control)
{
    switch (control.state()) {
    case QPlcSignalControl::Mine:
        return ControlBar::tr("You");
    case QPlcSignalControl::Free:
        return ControlBar::tr("Nobody");
    case QPlcSignalControl::Lost:
        return ControlBar::tr("Lost");
    case QPlcSignalControl::Offline:
    case QPlcSignalControl::Missing:
        return ControlBar::tr("No plant");
    case QPlcSignalControl::Written:
    case QPlcSignalControl::Other:
    case QPlcSignalControl::Unwritable:
        break;
    }
    return control.who();
}

}  // namespace

ControlBar::ControlBar(QPlcSignalControl *control, Size size, QWidget *parent)
    : QWidget(parent)
    , m_control(control)
    , m_size(size)
    , m_text(new ElidedLabel(this))
    , m_take(new QAction(tr("Take control"), this))
    , m_giveBack(new QAction(tr("Give back"), this))
    , m_takeOver(new QAction(tr("Take over"), this))
    , m_leave(new QAction(tr("No"), this))
{
    auto *row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(4);
    auto *column = new QVBoxLayout;
    column->setSpacing(0);
    if (size == Large) {
        m_headline = new ElidedLabel(this);
        QFont font = m_headline->font();
        font.setPointSizeF(font.pointSizeF() * 1.6);
        font.setBold(true);
        m_headline->setFont(font);
        column->addWidget(m_headline);
        m_text->setMostLines(3);
    }
    column->addWidget(m_text);
    row->addLayout(column, 1);
    makeActions();
    for (QAction *action : {m_take, m_giveBack, m_takeOver, m_leave})
        addButton(action);
    connect(control, &QPlcSignalControl::changed, this, [this] { ask(false); });
    connect(control, &QPlcSignalControl::failed, this, &ControlBar::say);
    refresh();
}

void ControlBar::makeActions()
{
    m_take->setShortcut(tr("Ctrl+T"));
    m_giveBack->setShortcut(tr("Ctrl+B"));
    for (QAction *action : {m_take, m_giveBack}) {
        action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
        action->setToolTip(
            QStringLiteral("%1 (%2)").arg(action->text(), action->shortcut().toString(QKeySequence::NativeText)));
    }
    connect(m_take, &QAction::triggered, this, &ControlBar::take);
    connect(m_giveBack, &QAction::triggered, this, [this] {
        say({});
        m_control->giveBack();
        Q_EMIT handled();
    });
    connect(m_takeOver, &QAction::triggered, this, [this] {
        ask(false);
        m_control->take(QPlcSignalControl::AlsoFromOthers);
        Q_EMIT handled();
    });
    connect(m_leave, &QAction::triggered, this, [this] {
        ask(false);
        Q_EMIT handled();
    });
}

QToolButton *ControlBar::addButton(QAction *action)
{
    auto *button = new QToolButton(this);
    button->setDefaultAction(action);
    button->setToolButtonStyle(Qt::ToolButtonTextOnly);
    button->setFocusPolicy(Qt::StrongFocus);
    layout()->addWidget(button);
    connect(action, &QAction::changed, button, [button, action] { button->setVisible(action->isVisible()); });
    return button;
}

void ControlBar::take()
{
    say({});
    if (m_control->state() == QPlcSignalControl::Other) {
        ask(true);
        return;
    }
    m_control->take();
    Q_EMIT handled();
}

void ControlBar::ask(bool asks)
{
    m_isAsking = asks;
    if (asks)
        m_sentence.clear();
    refresh();
}

void ControlBar::say(const QString &sentence)
{
    constexpr int readingTime = 6000;  // [ms] then who has control is worth more
    m_sentence = sentence;
    refresh();
    if (!sentence.isEmpty())
        QTimer::singleShot(readingTime, this, [this, sentence] {
            if (m_sentence == sentence)
                say({});
        });
}

void ControlBar::setTheme(const QPlcTheme &theme)
{
    m_plain = theme.text;
    m_held = theme.held;
    m_alarm = theme.alarm;
    m_muted = theme.mutedText;
    refresh();
}

QColor ControlBar::color() const
{
    switch (m_control->state()) {
    case QPlcSignalControl::Mine:
    case QPlcSignalControl::Other:
        return m_held;
    case QPlcSignalControl::Lost:
        return m_alarm;
    default:
        return m_size == Large ? m_plain : m_muted;
    }
}

void ControlBar::refresh()
{
    const bool isFreeSetter = m_size == Small && m_control->state() == QPlcSignalControl::Free;
    m_take->setVisible(!m_isAsking && !isFreeSetter && m_control->mayTake());
    m_giveBack->setVisible(!m_isAsking && m_control->mayGiveBack());
    m_takeOver->setVisible(m_isAsking);
    m_leave->setVisible(m_isAsking);
    const QString question = tr("Held by %1: take over?").arg(m_control->who());
    const QString sentence = m_isAsking ? question : m_sentence.isEmpty() ? m_control->text() : m_sentence;
    const QString plants = m_control->plantNames();
    m_text->showText(plants.isEmpty() ? sentence : tr("%1: %2").arg(plants, sentence));
    if (m_headline)
        m_headline->showText(headline(*m_control));
    if (m_plain.isValid()) {
        (m_headline ? m_headline : m_text)->setColor(color());
        if (m_headline)
            m_text->setColor(m_muted);
    }
}

}  // namespace qplc
