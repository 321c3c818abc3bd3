// SPDX-License-Identifier: Apache-2.0
#include "TestedPlant.h"

namespace soak {

TestedPlant::~TestedPlant() = default;

}  // namespace soak
