// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QStringList>

namespace qplc {

/// The rings of the masters of this user that run cycles on this computer, the newest first.
QStringList ringsOfMasters();

}  // namespace qplc
