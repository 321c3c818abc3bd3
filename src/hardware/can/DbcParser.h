// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DbcFile.h"

namespace qplc {

/// Reads the statements of a DBC file into messages. \return empty when there are errors
QVector<DbcMessage> parseDbc(const QString &text, const QString &fileName, QVector<QPlcParseError> *errors);

}  // namespace qplc
