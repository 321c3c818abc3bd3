// SPDX-License-Identifier: Apache-2.0
#include "ModelsLogging.h"

Q_LOGGING_CATEGORY(lcModels, "qtplc.models")
