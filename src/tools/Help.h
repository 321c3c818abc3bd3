// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Commands.h"

namespace tools {

/// The help of qtplc as a whole: its commands and the options of all.
QString generalHelp();
/// The help of one command: use, explanation, options, examples.
QString helpOf(const Command &command);

}  // namespace tools
