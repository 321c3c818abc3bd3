// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <memory>

namespace qplc {

/// How a device on an SPI bus is talked to.
struct SpiSettings
{
    int mode = 0;             // 0 ... 3: polarity (2) and phase (1) of the clock
    quint32 speed = 1000000;  // [Hz] of the clock
};

/// One device on an SPI bus: `/dev/spidevB.C` (bus B, chip select C), or a fake one.
class SpiBus
{
public:
    SpiBus() = default;
    virtual ~SpiBus() = default;
    SpiBus(const SpiBus &) = delete;
    SpiBus &operator=(const SpiBus &) = delete;

    /// A device of the kernel. \return null, with the reason and the remedy in \a error
    static std::unique_ptr<SpiBus> open(const QString &device, const SpiSettings &settings, QString *error);

    /// Sends \a count bytes and receives as many at the same time, all with one chip select. Waits
    /// for the bus. \return false, with errno
    virtual bool transfer(const quint8 *sent, quint8 *received, int count) noexcept = 0;
};

}  // namespace qplc
