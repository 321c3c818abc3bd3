// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "GpioChip.h"
#include "hardware/fake/FakeMemory.h"

namespace qplc {

/// A chip that is played: see FakeMemory. It has as many lines as the file has bytes; a byte is a
/// line, with electrical levels (active-low has been applied).
class FakeGpioChip : public GpioChip
{
public:
    enum Bit : quint8 {
        Pulled = 1,    ///< level from outside; written by whoever plays the device
        Driven = 2,    ///< level that the driver puts out
        IsOutput = 4,  ///< the driver drives the line
        IsTorn = 8     ///< nothing outside is at the line: it has the level of its pull resistor, without one it floats
    };

    static std::unique_ptr<FakeGpioChip> open(const QString &device, QString *error);

    bool isFree(const QString &line, QString *error) override;
    std::unique_ptr<GpioLine> request(const GpioLineRequest &request, QString *error) override;

private:
    QString m_device;
    FakeMemory m_memory;
};

}  // namespace qplc
