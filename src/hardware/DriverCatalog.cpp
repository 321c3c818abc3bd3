// SPDX-License-Identifier: Apache-2.0
#include "DriverCatalog.h"

namespace qplc {

DriverCatalog &DriverCatalog::instance()
{
    static DriverCatalog catalog;
    return catalog;
}

/// A line for each kind of this library.
DriverCatalog::DriverCatalog() = default;

}  // namespace qplc
