// SPDX-License-Identifier: Apache-2.0
// Without libgpiod.
#include "GpioChip.h"

namespace qplc {

std::unique_ptr<GpioChip> openKernelGpioChip(const QString &device, QString *error)
{
    *error = QStringLiteral("this QtPLC was built without libgpiod and cannot open '%1'; install libgpiod-dev and "
                            "build it again. Only 'fake:NAME' works")
                 .arg(device);
    return nullptr;
}

}  // namespace qplc
