// SPDX-License-Identifier: Apache-2.0
#include "StopQuestion.h"

#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>

namespace qplc {

StopQuestion::StopQuestion(PlantSelection *selection, WindowContext *context, QWidget *parent)
    : NoticeLine(context, parent)
    , m_selection(selection)
{
    setObjectName(QStringLiteral("StopQuestion"));
    connect(selection, &PlantSelection::changed, this, &StopQuestion::follow);
    hide();
}

/// What is asked is true of what a person controls now, or is not asked any more.
void StopQuestion::follow()
{
    if (!m_asked.isEmpty() && m_asked != m_selection->plantsToStop())
        answer({});
}

void StopQuestion::ask(const QString &how)
{
    const QVector<Plant *> plants = m_selection->plantsToStop();
    if (!m_asked.isEmpty() && m_asked == plants) {
        answer(plants, how);
        return;
    }
    m_asked = plants;
    QStringList names;
    for (const Plant *plant : plants)
        names << plant->name();
    qDeleteAll(m_buttons);
    m_buttons.clear();
    addChoice(tr("Stop all"), plants, BarButton::Primary);
    for (Plant *plant : plants)
        addChoice(tr("Stop %1").arg(plant->name()), {plant}, BarButton::Outlined);
    addChoice(tr("Stop none"), {}, BarButton::Quiet);
    say(tr("You control %1. Which one do you want to stop? Press STOP again to stop all.")
            .arg(names.join(QStringLiteral(", "))));
}

void StopQuestion::addChoice(const QString &text, const QVector<Plant *> &plants, BarButton::Kind kind)
{
    auto *button = new BarButton(kind, context(), this);
    button->setText(text);
    connect(button, &QAbstractButton::clicked, this, [this, plants] { answer(plants, tr("STOP")); });
    row()->addWidget(button, 0, Qt::AlignVCenter);
    button->show();
    m_buttons << button;
}

void StopQuestion::answer(const QVector<Plant *> &plants, const QString &how)
{
    m_asked.clear();
    say({});
    if (!plants.isEmpty())
        Q_EMIT answered(plants, how);
}

}  // namespace qplc
