// SPDX-License-Identifier: Apache-2.0
#include "QPlcSignalIndexTable.h"

#include <mutex>

namespace {

struct ProcessTable
{
    std::mutex mutex;
    QPlcSignalTable table;
    QString lastErrorString;
};

// Made at the first use and never destroyed: nodes in static storage may ask for it until the very
// end.
ProcessTable &processTable()
{
    static ProcessTable *const table = new ProcessTable;
    return *table;
}

}  // namespace

bool QPlcSignalIndexTable::initializeFromIniFile(const QString &fileName)
{
    return take(QPlcSignalTable::fromIniFile(fileName, &m_errors));
}

bool QPlcSignalIndexTable::initializeFromIni(const QByteArray &text, const QString &fileName)
{
    return take(QPlcSignalTable::fromIni(text, &m_errors, fileName));
}

bool QPlcSignalIndexTable::take(const QPlcSignalTable &table)
{
    {
        const std::lock_guard<std::mutex> lock(processTable().mutex);
        processTable().lastErrorString = errorString();
    }
    if (!m_errors.isEmpty())
        return false;
    setCurrent(table);
    return true;
}

QString QPlcSignalIndexTable::lastErrorString()
{
    const std::lock_guard<std::mutex> lock(processTable().mutex);
    return processTable().lastErrorString;
}

QPlcSignalTable QPlcSignalIndexTable::current()
{
    ProcessTable &process = processTable();
    const std::lock_guard<std::mutex> lock(process.mutex);
    return process.table;
}

void QPlcSignalIndexTable::setCurrent(const QPlcSignalTable &table)
{
    ProcessTable &process = processTable();
    QPlcSignalTable previous;  // is destroyed after the lock
    const std::lock_guard<std::mutex> lock(process.mutex);
    previous = process.table;
    process.table = table;
}

QString QPlcSignalIndexTable::name(QPlcSignalIndex index)
{
    const QPlcSignalTable table = current();
    return index < table.size() ? table.at(index).name : QString();
}

QPlcSignalType QPlcSignalIndexTable::type(QPlcSignalIndex index)
{
    const QPlcSignalTable table = current();
    return index < table.size() ? table.at(index).type : QPlcSignalType();
}
