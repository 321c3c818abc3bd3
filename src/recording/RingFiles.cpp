// SPDX-License-Identifier: Apache-2.0
#include "RingFiles.h"

#include "node/cycle/RingMemory.h"

#include <QtCore/QDir>
#include <QtCore/QFile>

namespace qplc {

namespace {

template<typename Condition>
QStringList ringsThat(Condition condition, QDir::SortFlags order)
{
    const QDir folder(QFile::decodeName(RingMemory::folder()));
    QStringList files;
    const QStringList names = folder.entryList({QStringLiteral("qtplc-ring-*")}, QDir::Files, order);
    for (const QString &name : names) {
        const QString file = folder.filePath(name);
        if (condition(RingMemory::useOf(QFile::encodeName(file))))
            files << file;
    }
    return files;
}

}  // namespace

QStringList ringsOfMasters()
{
    return ringsThat([](RingMemory::Use use) { return use == RingMemory::Alive; }, QDir::Time);
}

bool markRing(const QString &ring, QString *error)
{
    RingMemory memory;
    if (!memory.open(QFile::encodeName(ring), error))
        return false;
    memory.header()->wishes.fetch_add(1);
    return true;
}

QStringList ringsToRecord()
{
    const auto isFree = [](RingMemory::Use use) {
        return use == RingMemory::Alive || use == RingMemory::DeadAndRecorded || use == RingMemory::Dead;
    };
    return ringsThat(isFree, QDir::Time | QDir::Reversed);
}

}  // namespace qplc
