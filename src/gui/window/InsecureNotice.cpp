// SPDX-License-Identifier: Apache-2.0
#include "InsecureNotice.h"

namespace qplc {

InsecureNotice::InsecureNotice(WindowContext *context, QWidget *parent)
    : NoticeLine(context, parent)
{
    setObjectName(QStringLiteral("InsecureNotice"));
    PlantList *plants = context->plants();
    connect(plants, &PlantList::added, this, &InsecureNotice::listenTo);
    connect(plants, &PlantList::removed, this, &InsecureNotice::follow);
    for (int place = 0; place < plants->size(); ++place)
        listenTo(plants->at(place));
    follow();
}

void InsecureNotice::listenTo(Plant *plant)
{
    connect(plant, &Plant::stateChanged, this, &InsecureNotice::follow);
    follow();
}

void InsecureNotice::follow()
{
    QStringList names;
    for (int place = 0; place < context()->plants()->size(); ++place) {
        const Plant *plant = context()->plants()->at(place);
        if (plant->isConnected() && plant->isInsecure())
            names << plant->name();
    }
    setToolTip(names.isEmpty() ? QString() : tr("Start the master with --security psk instead of --insecure-network."));
    say(names.isEmpty() ? QString()
                        : tr("Without security: everybody in the network can read and command %1.")
                              .arg(names.join(QStringLiteral(", "))));
}

}  // namespace qplc
