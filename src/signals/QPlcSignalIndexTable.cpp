// SPDX-License-Identifier: Apache-2.0
#include "QPlcSignalIndexTable.h"

#include "ProgramScope.h"

#include <mutex>

namespace {

struct ProgramTable
{
    std::mutex mutex;
    QPlcSignalTable table;
    QString lastErrorString;
};

ProgramTable &programTable()
{
    return qplc::ProgramScope::current().the<ProgramTable>();
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
        ProgramTable &program = programTable();
        const std::lock_guard<std::mutex> lock(program.mutex);
        program.lastErrorString = errorString();
    }
    if (!m_errors.isEmpty())
        return false;
    setCurrent(table);
    return true;
}

QString QPlcSignalIndexTable::lastErrorString()
{
    ProgramTable &program = programTable();
    const std::lock_guard<std::mutex> lock(program.mutex);
    return program.lastErrorString;
}

QPlcSignalTable QPlcSignalIndexTable::current()
{
    ProgramTable &program = programTable();
    const std::lock_guard<std::mutex> lock(program.mutex);
    return program.table;
}

void QPlcSignalIndexTable::setCurrent(const QPlcSignalTable &table)
{
    ProgramTable &program = programTable();
    QPlcSignalTable previous;  // is destroyed after the lock
    const std::lock_guard<std::mutex> lock(program.mutex);
    previous = program.table;
    program.table = table;
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
