// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Leases.h"
#include "QPlcMasterNode.h"
#include "node/cycle/MasterCycle.h"
#include "node/cycle/NodeRegistry.h"
#include "node/cycle/ProfileDefaults.h"
#include "node/statistics/EventLog.h"

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
