// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "I2cBus.h"

namespace qplc {

/// A device on a bus of the kernel, by its i2c-dev. All calls are SMBus calls, which every adapter
/// has, also those without plain I2C transfers.
class KernelI2cBus : public I2cBus
{
public:
    static std::unique_ptr<KernelI2cBus> open(const QString &device, int address, QString *error);
    ~KernelI2cBus() override;

    bool read(quint8 first, quint8 *bytes, int count) noexcept override;
    bool write(quint8 first, const quint8 *bytes, int count) noexcept override;

private:
    bool call(bool isRead, quint8 reg, quint32 size, void *data) noexcept;

    int m_descriptor = -1;
    unsigned long m_abilities = 0;  // I2C_FUNC_...
};

}  // namespace qplc
