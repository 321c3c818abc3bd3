// SPDX-License-Identifier: Apache-2.0
#include "DisconMapping.h"

#include <QtCore/QFile>

#include <algorithm>
#include <array>

namespace qplc_export {

namespace {

constexpr int LastRecord = 3300;  // of the longest array that hosts use
constexpr qint64 LongestFile = 1 << 20;
// With these the host speaks to the library itself.
constexpr std::array<int, 8> reserved{1, 2, 3, 49, 50, 51, 62, 64};

bool readRecord(const QString &text, int *record, QString *error)
{
    bool isNumber = false;
    *record = text.trimmed().toInt(&isNumber);
    if (isNumber && *record >= 1 && *record <= LastRecord)
        return true;
    *error = QStringLiteral("'%1' is not a record; use a number from 1 to %2").arg(text.trimmed()).arg(LastRecord);
    return false;
}

bool readNumber(const QString &text, double *value, QString *error)
{
    bool isNumber = false;
    *value = text.trimmed().toDouble(&isNumber);
    if (isNumber && qIsFinite(*value))
        return true;
    *error = QStringLiteral("'%1' is not a number").arg(text.trimmed());
    return false;
}

/// "47", "47 * 0.5"
bool readEntry(const QString &text, DisconMapping::Entry *entry, QString *error)
{
    const QStringList factors = text.split(QLatin1Char('*'));
    if (!readRecord(factors.first(), &entry->record, error))
        return false;
    if (factors.size() > 2) {
        *error = QStringLiteral("'%1' has several factors; use RECORD * FACTOR").arg(text.trimmed());
        return false;
    }
    if (factors.size() == 1)
        return true;
    if (!readNumber(factors.last(), &entry->factor, error))
        return false;
    if (entry->factor == 0.0)
        *error = QStringLiteral("with the factor '%1', nothing is left of the value").arg(factors.last().trimmed());
    return entry->factor != 0.0;
}

}  // namespace

bool DisconMapping::read(const QString &fileName, ExportedNode &node, QString *error)
{
    *this = DisconMapping();
    if (fileName.isEmpty()) {
        *error = QStringLiteral("the host names no file; name the one that maps records to signals (OpenFAST: "
                                "DLL_InFile)");
        return false;
    }
    QFile file(fileName);
    if (!file.open(QIODevice::ReadOnly) || file.size() > LongestFile) {
        *error = QStringLiteral("the file '%1', which maps records to signals, cannot be read: %2")
                     .arg(fileName, file.isOpen() ? QStringLiteral("it is longer than 1 MiB") : file.errorString());
        return false;
    }
    QStringList sections{QStringLiteral("read"), QStringLiteral("write"), QStringLiteral("constant")};
    if (node.plant())
        sections << QStringLiteral("plant");
    const auto take = [&](const IniLine &line, QString *reason) { return addLine(line, node, reason); };
    if (!readIni(file.readAll(), fileName, {sections, QStringLiteral("SIGNAL = RECORD"), {}, take}, error))
        return false;
    if (!m_inputs.empty() || !m_outputs.empty())
        return true;
    *error
        = QStringLiteral("%1: no signal has a record; write them into the sections [read] and [write]").arg(fileName);
    return false;
}

bool DisconMapping::addLine(const IniLine &line, ExportedNode &node, QString *error)
{
    if (line.section == QLatin1String("constant"))
        return addConstant(line.key, line.value, error);
    if (line.section == QLatin1String("plant"))
        return node.setSetting(line.key, line.value, error);
    return addSignal(line.section == QLatin1String("read"), line.key, line.value, node, error);
}

bool DisconMapping::addSignal(bool isInput, const QString &name, const QString &records, const ExportedNode &node,
                              QString *error)
{
    const QPlcNodeRunner &runner = node.runner();
    const QPlcSignalIndex index = runner.indexOf(name);
    if (index == QPlcInvalidSignalIndex) {
        *error = runner.errorString();
        return false;
    }
    if (isInput != runner.isInput(index)) {
        *error = QStringLiteral("the node %1 signal '%2'; move it to the section %3")
                     .arg(isInput ? QStringLiteral("writes") : QStringLiteral("reads"), name,
                          isInput ? QStringLiteral("[write]") : QStringLiteral("[read]"));
        return false;
    }
    const QPlcSignalType type = node.signal(index).type;
    const QStringList entries = records.split(QLatin1Char(','));
    if (type.isString() || entries.size() != type.count()) {
        *error = type.isString()
            ? QStringLiteral("signal '%1' has the type %2; records are numbers").arg(name, type.name())
            : QStringLiteral("signal '%1' of type %2 needs %3 records, separated by commas")
                  .arg(name, type.name())
                  .arg(type.count());
        return false;
    }
    for (int element = 0; element < entries.size(); ++element) {
        Entry entry{0, 1.0, index, element};
        if (!readEntry(entries.at(element), &entry, error) || (!isInput && !mayWrite(entry.record, error)))
            return false;
        (isInput ? m_inputs : m_outputs).push_back(entry);
    }
    return true;
}

bool DisconMapping::addConstant(const QString &record, const QString &value, QString *error)
{
    Constant constant;
    if (!readRecord(record, &constant.record, error) || !mayWrite(constant.record, error)
        || !readNumber(value, &constant.value, error))
        return false;
    m_constants.push_back(constant);
    return true;
}

bool DisconMapping::mayWrite(int record, QString *error) const
{
    const auto isTaken = [record](const auto &other) { return other.record == record; };
    if (std::find(reserved.begin(), reserved.end(), record) != reserved.end())
        *error = QStringLiteral("record %1 belongs to the host; only read it").arg(record);
    else if (std::any_of(m_outputs.begin(), m_outputs.end(), isTaken)
             || std::any_of(m_constants.begin(), m_constants.end(), isTaken))
        *error = QStringLiteral("record %1 is written twice").arg(record);
    else
        return true;
    return false;
}

}  // namespace qplc_export
