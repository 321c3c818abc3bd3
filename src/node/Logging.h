// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QLoggingCategory>
#include <QtCore/QStringList>

// Abnormal events are warnings and shown by default. Debug levels, for example QT_LOGGING_RULES="qtplc.control.debug=true":
Q_DECLARE_LOGGING_CATEGORY(lcMaster)   // qtplc.master: states, nodes
Q_DECLARE_LOGGING_CATEGORY(lcSlave)    // qtplc.slave: states
Q_DECLARE_LOGGING_CATEGORY(lcAudit)    // qtplc.audit: who came, was refused, commanded, with identity and address
Q_DECLARE_LOGGING_CATEGORY(lcControl)  // qtplc.control: every control message, byte by byte
Q_DECLARE_LOGGING_CATEGORY(
    lcCyclic)  // qtplc.cyclic: every cyclic frame, byte by byte, out of a ring (some are left out when there are too many)

namespace qplc {

/// \a text of the other side, fit to be shown: control characters have become '?'.
QString printable(QString text);

/// "a, b and 3 more": the first eight of \a names.
QString firstOf(const QStringList &names);

}  // namespace qplc
