// SPDX-License-Identifier: Apache-2.0
#include "NoteStrip.h"

#include "BarButton.h"

#include <QtGui/QKeyEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QApplication>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>

namespace qplc {

NoteStrip::NoteStrip(PlantSelection *selection, WindowContext *context, QWidget *parent)
    : QWidget(parent)
    , m_selection(selection)
    , m_context(context)
    , m_label(new QLabel)
    , m_line(new QLineEdit)
    , m_error(new QLabel)
{
    setObjectName(QStringLiteral("NoteStrip"));
    m_label->setBuddy(m_line);
    m_label->setTextFormat(Qt::PlainText);
    m_line->setObjectName(QStringLiteral("note"));
    m_line->setAccessibleName(tr("Note"));
    m_line->setMaxLength(int(messages::Note::longest));
    m_line->setPlaceholderText(tr("What has happened: \"gust\", \"new gains\""));
    m_error->setWordWrap(true);
    m_error->setTextFormat(Qt::PlainText);
    m_error->hide();
    auto *write = new BarButton(BarButton::Quiet, context);
    write->setText(tr("Write"));
    write->setDetail(tr("Enter"));
    auto *cancel = new BarButton(BarButton::Quiet, context);
    cancel->setText(tr("Cancel"));
    cancel->setDetail(tr("Esc"));
    auto *row = new QHBoxLayout;
    row->setSpacing(10);
    row->addWidget(m_label);
    row->addWidget(m_line, 1);
    row->addWidget(write);
    row->addWidget(cancel);
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(14, 8, 6, 8);
    column->setSpacing(2);
    column->addLayout(row);
    column->addWidget(m_error);
    connect(m_line, &QLineEdit::returnPressed, this, &NoteStrip::accept);
    connect(m_line, &QLineEdit::textEdited, m_error, &QWidget::hide);
    connect(write, &QAbstractButton::clicked, this, &NoteStrip::accept);
    connect(cancel, &QAbstractButton::clicked, this, &NoteStrip::close);
    hide();
}

QString NoteStrip::obstacleOf(const Plant *plant)
{
    if (plant->recording())
        return tr("%1 is a recording: its files stay as they are, so nobody can write notes into it. "
                  "Write notes while a plant runs.")
            .arg(plant->name());
    if (plant->feed())
        return {};
    if (!plant->isConnected())
        return tr("%1 is not connected, so its master cannot take a note. Try again when it is back.")
            .arg(plant->name());
    if (!plant->may(QPlcMessage::Note))
        return tr("The role %1 may not write notes. Connect as an operator.").arg(plant->role());
    return {};
}

/// Unsent text belongs to the plant in which it was begun.
void NoteStrip::open()
{
    if (isHidden()) {
        Plant *plant = m_selection->plant();
        const QString obstacle = plant ? obstacleOf(plant) : QString();
        if (!obstacle.isEmpty()) {
            Q_EMIT refused(obstacle);
            return;
        }
        if (m_plant)
            m_plant->disconnect(this);
        m_plant = plant;
        m_plantName = plant && !plant->feed() ? plant->name() : QString();
        m_command = 0;
        m_label->setText(m_plantName.isEmpty() ? tr("Note for the event log") : tr("Note for %1").arg(m_plantName));
        m_focusBefore = QApplication::focusWidget();
        m_line->clear();
        m_error->hide();
        if (plant) {
            connect(plant, &Plant::commandDone, this, [this](int command) {
                if (command == m_command)
                    close();
            });
            connect(plant, &Plant::commandFailed, this, [this](int command, const QString &sentence) {
                if (command == m_command)
                    showError(sentence);
            });
        }
        show();
    }
    m_line->setFocus(Qt::ShortcutFocusReason);
}

void NoteStrip::accept()
{
    const QString text = m_line->text().simplified();
    if (text.isEmpty())
        return close();
    if (m_command != 0)
        return;  // is on its way
    if (m_plantName.isEmpty()) {
        PlantEvent event{QDateTime::currentDateTime(), PlantEvent::Information, m_plant ? m_plant->name() : tr("Note"),
                         text};
        event.isNote = true;
        m_context->events()->append(event);
        return close();
    }
    const QString obstacle = m_plant ? obstacleOf(m_plant)
                                     : tr("%1 is no longer in this window. Escape forgets the note.").arg(m_plantName);
    if (obstacle.isEmpty())
        m_command = m_plant->note(text);
    else
        showError(obstacle);
}

void NoteStrip::close()
{
    const bool hadFocus = isAncestorOf(QApplication::focusWidget());
    m_command = 0;
    hide();
    if (hadFocus && m_focusBefore)
        m_focusBefore->setFocus(Qt::OtherFocusReason);
}

/// The text can be sent again.
void NoteStrip::showError(const QString &sentence)
{
    m_command = 0;
    QPalette alarm = palette();
    alarm.setColor(QPalette::WindowText, m_context->theme().alarm);
    m_error->setPalette(alarm);
    m_error->setText(sentence);
    m_error->show();
}

QString NoteStrip::error() const
{
    return m_error->isHidden() ? QString() : m_error->text();
}

void NoteStrip::keyPressEvent(QKeyEvent *event)
{
    if (event->key() == Qt::Key_Escape)
        close();
    else
        QWidget::keyPressEvent(event);
}

void NoteStrip::paintEvent(QPaintEvent * /*event*/)
{
    QPainter painter(this);
    painter.fillRect(rect(), m_context->theme().surface);
    painter.fillRect(QRect(0, height() - 1, width(), 1), m_context->theme().line);
}

}  // namespace qplc
