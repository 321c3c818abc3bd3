// SPDX-License-Identifier: Apache-2.0
#include "Disk.h"

#include <QtCore/QFile>

#include <sys/statvfs.h>

namespace qplc {

namespace {

class MachineDisk final : public Disk
{
public:
    std::unique_ptr<mcap::FileSink> create(const QString &file, QString *error) override
    {
        return mcap::FileSink::create(file, error);
    }
    std::uint64_t freeBytes(const QString &folder) override
    {
        struct statvfs status = {};
        return ::statvfs(QFile::encodeName(folder).constData(), &status) == 0
            ? std::uint64_t(status.f_bavail) * status.f_frsize
            : 0;
    }
};

}  // namespace

Disk::~Disk() = default;

Disk &Disk::machine()
{
    static MachineDisk disk;
    return disk;
}

}  // namespace qplc
