// SPDX-License-Identifier: Apache-2.0
#include "Plant.h"

namespace soak {

Plant::~Plant() = default;

}  // namespace soak
