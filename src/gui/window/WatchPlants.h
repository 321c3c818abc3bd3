// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plant/PlantList.h"

namespace qplc {

/// Calls \a follow now, whenever a plant comes or goes, and with each of \a changes of any plant,
/// as long as \a receiver lives.
template<typename Receiver, typename... Changes>
void watchPlants(PlantList *plants, Receiver *receiver, void (Receiver::*follow)(), Changes... changes)
{
    const auto listen = [=](Plant *plant) { (QObject::connect(plant, changes, receiver, follow), ...); };
    QObject::connect(plants, &PlantList::added, receiver, [=](Plant *plant) {
        listen(plant);
        (receiver->*follow)();
    });
    QObject::connect(plants, &PlantList::removed, receiver, follow);
    for (Plant *plant : plants->all())
        listen(plant);
    (receiver->*follow)();
}

}  // namespace qplc
