// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <memory>

class QPlcDriverSettings;

namespace qplc {

class ModbusLink;

/// The way to a device that the keys `device`, `response-timeout`, `baud`, `parity`, `stop-bits`
/// and those of SerialMode describe; null after an error that \a settings was told.
std::unique_ptr<ModbusLink> makeModbusLink(QPlcDriverSettings &settings);

}  // namespace qplc
