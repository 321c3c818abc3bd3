// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "McapWriter.h"

namespace qplc {

/// What a recorder asks of the disk. A test has others, which are full or stall.
class Disk
{
public:
    virtual ~Disk();
    /// See mcap::FileSink::create().
    virtual std::unique_ptr<mcap::FileSink> create(const QString &file, QString *error) = 0;
    /// [byte] that are free where \a folder is
    virtual std::uint64_t freeBytes(const QString &folder) = 0;

    /// That of the computer. \threadsafe yes
    static Disk &machine();
};

}  // namespace qplc
