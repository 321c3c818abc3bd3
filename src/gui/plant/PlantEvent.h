// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QDateTime>
#include <QtCore/QMetaType>
#include <QtCore/QString>

namespace qplc {

/// Something that happened to a plant: a line of the event log. A value type.
struct PlantEvent
{
    enum Severity { Information, Warning, Error };

    QDateTime time;
    Severity severity = Information;
    QString source;  // a plant, or "plant/node"
    QString text;
    bool isAcknowledged = false;
    /// What lasts has a name, the same one (of the same source) when it ends.
    enum Stage { Once, Begins, Ends };
    Stage stage = Once;
    QString alarm{};
    bool isStateChange = false;  // the plant starts, stops, or changes its state otherwise
    bool isNote = false;         // a person has written it
};

}  // namespace qplc

Q_DECLARE_METATYPE(qplc::PlantEvent)
