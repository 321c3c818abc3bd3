// SPDX-License-Identifier: Apache-2.0
#include "InsecureNotice.h"

#include "WatchPlants.h"

namespace qplc {

InsecureNotice::InsecureNotice(WindowContext *context, QWidget *parent)
    : NoticeLine(context, parent)
{
    setObjectName(QStringLiteral("InsecureNotice"));
    watchPlants(context->plants(), this, &InsecureNotice::follow, &Plant::stateChanged);
}

void InsecureNotice::follow()
{
    QStringList names;
    for (const Plant *plant : context()->plants()->all()) {
        if (plant->isConnected() && plant->isInsecure())
            names << plant->name();
    }
    setToolTip(names.isEmpty() ? QString() : tr("Start the master with --security psk instead of --insecure-network."));
    say(names.isEmpty() ? QString()
                        : tr("Without security: everybody in the network can read and command %1.")
                              .arg(names.join(QStringLiteral(", "))));
}

}  // namespace qplc
