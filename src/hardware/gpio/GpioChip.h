// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "GpioLine.h"

#include <memory>

namespace qplc {

/// A GPIO chip: that of the kernel, by libgpiod 1.6 or 2 (whichever was there when this was built),
/// or a fake one. Lines live no longer than their chip.
class GpioChip
{
public:
    GpioChip() = default;
    virtual ~GpioChip() = default;
    GpioChip(const GpioChip &) = delete;
    GpioChip &operator=(const GpioChip &) = delete;

    /// \param device name ("gpiochip0"), path ("/dev/gpiochip0") or label ("pinctrl-bcm2711") of a
    ///         chip, or "fake:NAME"
    /// \return null, with the reason and the remedy in \a error
    static std::unique_ptr<GpioChip> open(const QString &device, QString *error);

    /// Whether a line exists and nobody has it. \return false, with the reason and the remedy in \a
    /// error
    virtual bool isFree(const QString &line, QString *error) = 0;
    /// Takes a line. \return null, with the reason and the remedy in \a error
    virtual std::unique_ptr<GpioLine> request(const GpioLineRequest &request, QString *error) = 0;

protected:
    // ---- sentences that all chips have ----
    static QString noSuchLine(const QString &device, const QString &line, quint64 lines);
    static QString busyLine(const QString &device, const QString &line, const QString &consumer);
    static QString refused(const QString &device, const GpioLineRequest &request, int errorNumber);
};

/// A chip of the kernel. \return null, with the reason and the remedy in \a error
std::unique_ptr<GpioChip> openKernelGpioChip(const QString &device, QString *error);
/// Why the kernel's chip \a device was not opened, and what helps.
QString gpioChipErrorText(const QString &device, int errorNumber);
/// How we are called where others see who has a line.
const char *gpioConsumer();

}  // namespace qplc
