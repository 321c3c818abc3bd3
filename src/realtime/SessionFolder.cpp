// SPDX-License-Identifier: Apache-2.0
#include "SessionFolder.h"

#include <cerrno>
#include <sys/stat.h>
#include <unistd.h>

namespace qplc {

QByteArray SessionFolder::path(const char *name)
{
    const QByteArray session = qgetenv("XDG_RUNTIME_DIR");
    if (session.startsWith('/'))
        return session + '/' + name;
    return QByteArray("/tmp/") + name + '-' + QByteArray::number(quint64(::getuid()));
}

bool SessionFolder::make(const QByteArray &path)
{
    if (::mkdir(path.constData(), S_IRWXU) != 0 && errno != EEXIST)
        return false;
    struct stat status = {};
    if (::lstat(path.constData(), &status) != 0)
        return false;
    const bool isOurs
        = S_ISDIR(status.st_mode) && status.st_uid == ::getuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
    errno = isOurs ? 0 : EPERM;
    return isOurs;
}

}  // namespace qplc
