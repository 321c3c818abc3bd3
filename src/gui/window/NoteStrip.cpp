// SPDX-License-Identifier: Apache-2.0
#include "NoteStrip.h"

#include "BarButton.h"

#include <QtWidgets/QApplication>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>

namespace qplc {

NoteStrip::NoteStrip(PlantSelection *selection, WindowContext *context, QWidget *parent)
    : EntryStrip(context, parent)
    , m_selection(selection)
{
    setObjectName(QStringLiteral("NoteStrip"));
    line()->setObjectName(QStringLiteral("note"));
    line()->setAccessibleName(tr("Note"));
    line()->setMaxLength(int(messages::Note::longest));
    line()->setPlaceholderText(tr("What has happened: \"gust\", \"new gains\""));
    auto *write = new BarButton(BarButton::Quiet, context);
    write->setText(tr("Write"));
    write->setDetail(tr("Enter"));
    auto *cancel = new BarButton(BarButton::Quiet, context);
    cancel->setText(tr("Cancel"));
    cancel->setDetail(tr("Esc"));
    row()->addWidget(write);
    row()->addWidget(cancel);
    connect(write, &QAbstractButton::clicked, this, &NoteStrip::accept);
    connect(cancel, &QAbstractButton::clicked, this, &NoteStrip::leave);
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
        label()->setText(m_plantName.isEmpty() ? tr("Note for the event log") : tr("Note for %1").arg(m_plantName));
        m_focusBefore = QApplication::focusWidget();
        line()->clear();
        showError({});
        if (plant) {
            connect(plant, &Plant::commandDone, this, [this](int command) {
                if (command == m_command)
                    leave();
            });
            connect(plant, &Plant::commandFailed, this, [this](int command, const QString &sentence) {
                if (command == m_command)
                    fail(sentence);
            });
        }
        show();
    }
    line()->setFocus(Qt::ShortcutFocusReason);
}

void NoteStrip::accept()
{
    const QString text = line()->text().simplified();
    if (text.isEmpty())
        return leave();
    if (m_command != 0)
        return;  // is on its way
    if (m_plantName.isEmpty()) {
        PlantEvent event{QDateTime::currentDateTime(), PlantEvent::Information, m_plant ? m_plant->name() : tr("Note"),
                         text};
        event.isNote = true;
        context()->events()->append(event);
        return leave();
    }
    const QString obstacle = m_plant ? obstacleOf(m_plant)
                                     : tr("%1 is no longer in this window. Escape forgets the note.").arg(m_plantName);
    if (obstacle.isEmpty())
        m_command = m_plant->note(text);
    else
        fail(obstacle);
}

void NoteStrip::leave()
{
    const bool hadFocus = isAncestorOf(QApplication::focusWidget());
    m_command = 0;
    hide();
    if (hadFocus && m_focusBefore)
        m_focusBefore->setFocus(Qt::OtherFocusReason);
}

void NoteStrip::fail(const QString &sentence)
{
    m_command = 0;
    showError(sentence);
}

}  // namespace qplc
