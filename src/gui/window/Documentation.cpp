// SPDX-License-Identifier: Apache-2.0
#include "Documentation.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QDir>
#include <QtCore/QFileInfo>

#include <dlfcn.h>

namespace qplc {

namespace {

const QString firstPage = QStringLiteral("control-center.md");

QString folderAbove(const QString &start)
{
    constexpr int most = 6;  // build/dev/src/gui, lib/x86_64-linux-gnu
    QDir folder(start);
    for (int level = 0; level < most; ++level) {
        for (const QString &place : {QStringLiteral(QTPLC_DOCUMENTS), QStringLiteral("docs")}) {
            if (QFileInfo::exists(folder.filePath(place + QLatin1Char('/') + firstPage)))
                return QDir::cleanPath(folder.filePath(place));
        }
        if (!folder.cdUp())
            break;
    }
    return {};
}

}  // namespace

QString documentationFolder(const QStringList &folders)
{
    for (const QString &start : folders) {
        const QString found = folderAbove(start);
        if (!found.isEmpty())
            return found;
    }
    return {};
}

QStringList documentationStarts()
{
    QStringList folders;
    Dl_info library;
    if (dladdr(reinterpret_cast<const void *>(&documentationFolder), &library) != 0 && library.dli_fname)
        folders << QFileInfo(QString::fromLocal8Bit(library.dli_fname)).canonicalPath();
    return folders << QCoreApplication::applicationDirPath();
}

}  // namespace qplc
