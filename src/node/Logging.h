// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "signals/MessageText.h"  // printable()

#include <QtCore/QLoggingCategory>

// Abnormal events are warnings and shown by default. Debug levels, for example
// QT_LOGGING_RULES="qtplc.control.debug=true":
Q_DECLARE_LOGGING_CATEGORY(lcMaster)   // qtplc.master: states, nodes
Q_DECLARE_LOGGING_CATEGORY(lcSlave)    // qtplc.slave: states
Q_DECLARE_LOGGING_CATEGORY(lcAudit)    // qtplc.audit: who came, was refused, commanded, with identity and address
Q_DECLARE_LOGGING_CATEGORY(lcControl)  // qtplc.control: every control message, byte by byte
Q_DECLARE_LOGGING_CATEGORY(
    // qtplc.cyclic: every cyclic frame, byte by byte, out of a ring (some are left out when there
    // are too many)
    lcCyclic)
