// SPDX-License-Identifier: Apache-2.0
#include "DriverCatalog.h"

#include "gpio/GpioDriver.h"

namespace qplc {

DriverCatalog &DriverCatalog::instance()
{
    static DriverCatalog catalog;
    return catalog;
}

/// A line for each kind of this library.
DriverCatalog::DriverCatalog()
{
    add(QStringLiteral("gpio"), {QStringLiteral("switches and lamps at the lines of a GPIO chip"), [] {
                                     return std::make_unique<GpioDriver>();
                                 }});
}

}  // namespace qplc
