// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "EventLog.h"
#include "Leases.h"
#include "MasterCycle.h"
#include "NodeRegistry.h"
#include "ProfileDefaults.h"
#include "QPlcMasterNode.h"

#include <QtCore/QJsonObject>

namespace qplc {

/// What a master answers to those who ask: reading only.

/// Fields of the message State.
QJsonObject stateFields(const QPlcMasterNode &master, const ChosenProfile &profile, quint64 session);
/// Fields of the message Signals, for \a names or, when empty, all; the values are those of one cycle.
/// \return false with the first name that is unknown, or comes twice, in \a refusal
bool signalFields(const MasterCycle &cycle, const NodeRegistry &registry, const Leases &leases,
                  const QStringList &names, QJsonObject *fields, Refusal *refusal);
/// Fields of the message Events.
QJsonObject eventFields(const std::vector<JournalEvent> &events);
/// Fields of the message Schedule.
QJsonObject scheduleFields(const QPlcSchedule &schedule);
QString clockName(QPlcClock clock);

}  // namespace qplc
