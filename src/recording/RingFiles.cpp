// SPDX-License-Identifier: Apache-2.0
#include "RingFiles.h"

#include "node/cycle/RingMemory.h"

#include <QtCore/QDir>
#include <QtCore/QFile>

namespace qplc {

QStringList ringsOfMasters()
{
    const QDir folder(QFile::decodeName(RingMemory::folder()));
    QStringList files;
    const QStringList names = folder.entryList(QDir::Files, QDir::Time);
    for (const QString &name : names) {
        const QString file = folder.filePath(name);
        if (RingMemory::useOf(QFile::encodeName(file)) == RingMemory::Alive)
            files << file;
    }
    return files;
}

}  // namespace qplc
