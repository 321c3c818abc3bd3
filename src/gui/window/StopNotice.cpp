// SPDX-License-Identifier: Apache-2.0
#include "StopNotice.h"

#include "WatchPlants.h"

#include <QtWidgets/QLabel>

namespace qplc {

StopNotice::StopNotice(WindowContext *context, QWidget *parent)
    : NoticeLine(context, parent)
{
    setObjectName(QStringLiteral("StopNotice"));
    label()->setTextFormat(Qt::PlainText);
    label()->setTextInteractionFlags(Qt::TextSelectableByMouse);
    hide();
    watchPlants(context->plants(), this, &StopNotice::follow, &Plant::stateChanged, &Plant::statusChanged);
}

void StopNotice::follow()
{
    QStringList sentences;
    for (const Plant *plant : context()->plants()->all()) {
        if (plant->isConnected() && plant->status().master.stopped && !plant->status().isRunning())
            sentences << sentenceOf(*plant);
    }
    const QString all = sentences.join(QLatin1Char('\n'));
    if (all != text())
        say(all);
}

/// "Stopped by you (Esc Esc), 13:45:36. Start again: F5"
QString StopNotice::sentenceOf(const Plant &plant) const
{
    const messages::StopEntry &stop = *plant.status().master.stopped;
    const QDateTime time = QDateTime::fromMSecsSinceEpoch(qint64(stop.time / 1'000'000));
    const QString who = stop.yours ? tr("you") : stop.whoever;
    const QString how = stop.how.isEmpty() ? QString() : tr(" (%1)").arg(stop.how);
    const QString what = tr("Stopped by %1%2, %3.").arg(who, how, time.toString(QStringLiteral("HH:mm:ss")));
    const QString keys = plant.status().master.armingRequired ? tr("F4, F9, F5") : tr("F5");
    const bool isOneOfSeveral = context()->plants()->size() > 1;
    return isOneOfSeveral ? tr("%1: %2 Start again: choose %1, then %3").arg(plant.name(), what, keys)
                          : tr("%1 Start again: %2").arg(what, keys);
}

}  // namespace qplc
