// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcMasterNode.h"

#include <QtCore/QJsonObject>

namespace qplc {

/// What a master answers to those who ask: pure reading of its public face.

/// Fields of the message State.
QJsonObject stateFields(const QPlcMasterNode &master, quint64 session);
/// Fields of the message Signals, for \a names or, when empty, all. \return false with the first unknown name in \a error
bool signalFields(const QPlcMasterNode &master, const QStringList &names, QJsonObject *fields, QString *error);
QString clockName(QPlcClock clock);

}  // namespace qplc
