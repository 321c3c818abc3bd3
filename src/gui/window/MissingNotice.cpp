// SPDX-License-Identifier: Apache-2.0
#include "MissingNotice.h"

#include "WatchPlants.h"

namespace qplc {

MissingNotice::MissingNotice(WindowContext *context, QWidget *parent)
    : NoticeLine(context, parent)
{
    setObjectName(QStringLiteral("MissingNotice"));
    watchPlants(context->plants(), this, &MissingNotice::follow, &Plant::stateChanged, &Plant::statusChanged);
}

void MissingNotice::follow()
{
    QStringList sentences;
    for (const Plant *plant : context()->plants()->all()) {
        const messages::State &master = plant->status().master;
        if (plant->isConnected() && !plant->status().isLatched() && !master.missing.isEmpty())
            sentences << tr("%1: %2").arg(plant->name(), master.missing);
    }
    say(sentences.join(QStringLiteral(". ")));
}

}  // namespace qplc
