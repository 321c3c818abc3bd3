// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SysfsFolder.h"

namespace qplc {

/// A value that the kernel puts out. The first set() changes the device, open() does not.
class SysfsOutput
{
public:
    SysfsOutput() = default;
    virtual ~SysfsOutput() = default;
    SysfsOutput(const SysfsOutput &) = delete;
    SysfsOutput &operator=(const SysfsOutput &) = delete;

    /// \param device  its folder; it stays open as long as the output is used
    /// \return false, with errno and file()
    virtual bool open(const SysfsFolder *device) = 0;
    /// Writes the files whose content differs. \return false, with errno and file()
    virtual bool set(double value) = 0;
    /// The file that was used last, in the folder of the device.
    virtual QByteArray file() const = 0;
};

}  // namespace qplc
