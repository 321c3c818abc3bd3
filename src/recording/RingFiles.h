// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QStringList>

namespace qplc {

/// The rings of the masters of this user that run cycles on this computer, the newest first.
QStringList ringsOfMasters();
/// All rings of this user that nobody records, also those of masters that have ended: the oldest
/// first.
QStringList ringsToRecord();
/// Wants that the last seconds of \a ring stay, whether or not somebody records.
/// \return false: it is no ring
bool markRing(const QString &ring, QString *error);

}  // namespace qplc
