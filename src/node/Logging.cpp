// SPDX-License-Identifier: Apache-2.0
#include "Logging.h"

Q_LOGGING_CATEGORY(lcMaster, "qtplc.master", QtInfoMsg)
Q_LOGGING_CATEGORY(lcSlave, "qtplc.slave", QtInfoMsg)
Q_LOGGING_CATEGORY(lcAudit, "qtplc.audit", QtInfoMsg)
Q_LOGGING_CATEGORY(lcControl, "qtplc.control", QtWarningMsg)
Q_LOGGING_CATEGORY(lcCyclic, "qtplc.cyclic", QtWarningMsg)
