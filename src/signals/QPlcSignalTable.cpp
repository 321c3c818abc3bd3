// SPDX-License-Identifier: Apache-2.0
#include "QPlcSignalTable.h"

#include "Fnv1a.h"
#include "MemoryNeed.h"
#include "MessageText.h"
#include "SignalRules.h"
#include "TableReader.h"

using qplc::quoted;

namespace {

constexpr qint64 largestFile = 64 * 1024 * 1024;  // [byte] a thousand for each of the most signals

// The definition as the table keeps it: values in the types of the signal where they can be
// converted, and an initial value.
QPlcSignalDefinition completed(QPlcSignalDefinition signal)
{
    const auto convert = [](QPlcValue *value, QPlcSignalType type) {
        const QPlcValue converted = value->convertedTo(type);
        if (converted.isValid())
            *value = converted;
    };
    convert(&signal.minimum, qplc::elementType(signal.type));
    convert(&signal.maximum, qplc::elementType(signal.type));
    convert(&signal.initial, signal.type);
    convert(&signal.safe, signal.type);
    if (!signal.initial.isValid())
        signal.initial = QPlcValue(signal.type);
    if (QPlcSignalType::fromName(signal.typeName) != signal.type)
        signal.typeName = signal.type.name();
    return signal;
}

}  // namespace

QPlcSignalTable QPlcSignalTable::fromIni(const QByteArray &text, QVector<QPlcParseError> *errors,
                                         const QString &fileName)
{
    return read({text, fileName, qplc::TableReader::UnknownKeys::Refused}, errors);
}

QPlcSignalTable QPlcSignalTable::read(qplc::TableReader reader, QVector<QPlcParseError> *errors)
{
    const QVector<QPlcSignalDefinition> definitions = reader.read();
    const QVector<QPlcParseError> found = reader.errors();
    if (errors)
        *errors = found;
    QPlcSignalTable table;
    if (!found.isEmpty())
        return table;
    table.m_signals.reserve(definitions.size());
    table.m_indices.reserve(definitions.size());
    table.m_safetyHashes.reserve(definitions.size());
    for (const QPlcSignalDefinition &definition : definitions)
        table.add(definition);
    return table;
}

QPlcSignalTable QPlcSignalTable::fromMaster(const QByteArray &text, QVector<QPlcParseError> *errors)
{
    QPlcSignalTable table
        = read({text, QStringLiteral("table of the master"), qplc::TableReader::UnknownKeys::Ignored}, errors);
    table.m_isFromMaster = !table.isEmpty();
    return table;
}

QPlcSignalTable QPlcSignalTable::fromIniFile(const QString &fileName, QVector<QPlcParseError> *errors)
{
    QByteArray text;
    if (!qplc::IniParser::readFile(fileName, QStringLiteral("a signal table"), largestFile, &text, errors))
        return QPlcSignalTable();
    const qplc::MemoryNeed need("the signal table", quint64(text.size()), "use a table with fewer signals");
    return fromIni(text, errors, fileName);
}

QByteArray QPlcSignalTable::toIni() const
{
    QByteArray text;
    for (const QPlcSignalDefinition &signal : m_signals) {
        if (!text.isEmpty())
            text += '\n';
        text += qplc::iniSection(signal).toUtf8();
    }
    return text;
}

bool QPlcSignalTable::append(const QPlcSignalDefinition &definition, QString *error)
{
    const QPlcSignalDefinition signal = completed(definition);
    QString reason;
    if (contains(signal.name))
        reason = QStringLiteral("there is one already; rename or remove one");
    else if (size() == MaximumSignals)
        reason = QStringLiteral("is one too many; a table has at most %1").arg(MaximumSignals);
    else
        for (const qplc::Complaint &complaint : qplc::complaintsAbout(signal))
            reason += (reason.isEmpty() ? QString() : QStringLiteral("; ")) + complaint.text;
    if (error)
        *error = reason.isEmpty() ? QString() : QStringLiteral("signal %1: %2").arg(quoted(signal.name), reason);
    if (!reason.isEmpty())
        return false;
    add(signal);
    m_isFromMaster = false;
    return true;
}

void QPlcSignalTable::add(const QPlcSignalDefinition &definition)
{
    m_indices.insert(definition.name, QPlcSignalIndex(m_signals.size()));
    m_signals.append(definition);
    const QString text = definition.name + QLatin1Char(':') + definition.type.name() + QLatin1Char(':')
        + definition.unit + QLatin1Char('\n');
    const QByteArray safety = qplc::safetyLine(definition);
    m_safetyHashes.append(qplc::fnv1a64(safety));
    m_hash = qplc::fnv1a64(text.toUtf8() + safety, m_hash);
}

QStringList QPlcSignalTable::closeNames(const QString &name, int count) const
{
    QStringList names;
    names.reserve(m_signals.size());
    for (const QPlcSignalDefinition &signal : m_signals)
        names.append(signal.name);
    return qplc::closeNames(name, names, count);
}

QString QPlcSignalTable::unknownSignalText(const QString &name) const
{
    const QString text = QStringLiteral("unknown signal ") + quoted(name);
    if (isEmpty())
        return text + QStringLiteral("; the signal table is empty, read one first");
    const QStringList close = closeNames(name);
    return close.isEmpty() ? text + QStringLiteral("; the signal table has none like it, add it there")
                           : text + qplc::didYouMean(close);
}
