// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plant/PlantList.h"

#include <QtCore/QStringList>
#include <QtCore/QVector>

namespace qplc {

/// Who has taken over which signals of the plants of a window: one fact for each holder. A value
/// type.
struct ControlFact
{
    enum Kind {
        Mine,   // this window
        Lost,   // a holder that is gone: the signals stay at their neutral values
        Others  // a person or program elsewhere
    };

    Kind kind = Others;
    QString holder;          // "anna@lab"; of a lost one: who it was
    QStringList references;  // with the plant where there are several

    /// "You control"
    QString headline() const;
    /// "You control bodyControlYawSpeed, tetherSpeed"
    QString sentence() const;
    /// What a person can do.
    QString remedy() const;

    /// Mine first, then the lost ones, then those of others; in each of them in the order of plants
    /// and tables.
    static QVector<ControlFact> of(const PlantList &plants);
};

/// Gives back all that this window holds; where that is nothing, all that is lost, so that its
/// nodes write it again.
void giveBackControl(const PlantList &plants);

}  // namespace qplc
