// SPDX-License-Identifier: Apache-2.0
#include "TableReader.h"

#include "MessageText.h"
#include "QPlcSignalTable.h"

#include <algorithm>

namespace qplc {

// ---- ErrorCollector ----

void ErrorCollector::add(int line, int column, const QString &message)
{
    if (++m_count <= MaximumErrors)
        m_errors.append({m_file, line, column, message});
}

QVector<QPlcParseError> ErrorCollector::errors() const
{
    QVector<QPlcParseError> result = m_errors;
    std::stable_sort(result.begin(), result.end(), [](const QPlcParseError &a, const QPlcParseError &b) {
        return a.line != b.line ? a.line < b.line : a.column < b.column;
    });
    if (m_count > MaximumErrors)
        result.append({m_file, 0, 0, QStringLiteral("and %1 more errors").arg(m_count - MaximumErrors)});
    return result;
}

// ---- TableReader ----

TableReader::TableReader(const QByteArray &text, const QString &fileName, UnknownKeys unknownKeys)
    : m_parser(text)
    , m_unknownKeys(unknownKeys)
    , m_errors(fileName)
{
}

QVector<QPlcSignalDefinition> TableReader::read()
{
    for (IniItem item = m_parser.next(); item.kind != IniItem::End; item = m_parser.next()) {
        if (item.kind == IniItem::Section)
            openSection(item);
        if (!item.error.isEmpty())
            m_errors.add(item.line, item.errorColumn, item.error);
        if (item.kind == IniItem::Entry)
            addEntry(item);
        m_hasBrokenLine = m_hasBrokenLine || item.kind == IniItem::Broken;
    }
    closeSection();
    if (m_signals.isEmpty() && m_errors.count() == 0)
        m_errors.add(0, 0, QStringLiteral("the table has no signal; write at least '[name]' and 'type = Real'"));
    return m_signals;
}

void TableReader::openSection(const IniItem &item)
{
    closeSection();
    m_state = item.error.isEmpty() ? State::Open : State::Wrong;
    m_signal = QPlcSignalDefinition();
    m_signal.name = item.name;
    m_signal.line = item.line;
    m_nameColumn = item.column;
    m_hasBrokenLine = false;
    m_entries.fill(Entry());
    if (item.name.isEmpty())
        return;
    const auto first = m_firstLines.constFind(item.name);
    if (first == m_firstLines.constEnd())
        m_firstLines.insert(item.name, item.line);
    else
        m_errors.add(item.line, item.column,
                     QStringLiteral("duplicate signal %1 (first at line %2); rename or remove one")
                         .arg(quoted(item.name))
                         .arg(first.value()));
}

void TableReader::addEntry(const IniItem &item)
{
    if (m_state == State::BeforeFirst) {
        m_errors.add(
            item.line, item.column,
            QStringLiteral("the key %1 stands before the first signal; write [name] above it").arg(quoted(item.name)));
        return;
    }
    const int key = signalKeyNames().indexOf(item.name);
    if (key < 0 && m_unknownKeys == UnknownKeys::Ignored)
        return;
    if (key < 0) {
        const QStringList close = closeNames(item.name, signalKeyNames());
        m_errors.add(item.line, item.column,
                     QStringLiteral("unknown key ") + quoted(item.name)
                         + (close.isEmpty()
                                ? QStringLiteral("; the keys are ") + signalKeyNames().join(QStringLiteral(", "))
                                : didYouMean(close)));
        m_hasBrokenLine = m_hasBrokenLine || close.contains(signalKeyNames().at(int(SignalKey::Type)));
        return;
    }
    Entry &target = m_entries[std::size_t(key)];
    if (target.line != 0)
        m_errors.add(
            item.line, item.column,
            QStringLiteral("duplicate key %1 (first at line %2); remove one").arg(quoted(item.name)).arg(target.line));
    else
        target = {item.line, item.column, item.valueColumn, !item.error.isEmpty(), item.value};
}

void TableReader::closeSection()
{
    if (m_state == State::BeforeFirst)
        return;
    m_signal.unit = entry(SignalKey::Unit).value;
    m_signal.description = entry(SignalKey::Description).value;
    readType();
    if (m_signal.type.isValid())
        readValues();
    for (const Complaint &complaint : complaintsAbout(m_signal))
        complain(complaint);
    if (m_signals.size() == QPlcSignalTable::MaximumSignals)
        m_errors.add(m_signal.line, m_nameColumn,
                     QStringLiteral("the signal %1 is one too many; a table has at most %2")
                         .arg(quoted(m_signal.name))
                         .arg(QPlcSignalTable::MaximumSignals));
    if (m_signals.size() <= QPlcSignalTable::MaximumSignals)
        m_signals.append(m_signal);
}

void TableReader::readType()
{
    const SignalKey key = SignalKey::Type;
    const Entry &type = entry(key);
    if (type.line == 0) {
        if (m_state == State::Open && !m_hasBrokenLine)
            m_errors.add(m_signal.line, m_nameColumn,
                         QStringLiteral("the signal %1 has no type; write 'type = Real' or another below it")
                             .arg(quoted(m_signal.name)));
        return;
    }
    if (type.isWrong)
        return;
    QString error;
    m_signal.type = QPlcSignalType::fromName(type.value, &error);
    m_signal.typeName = type.value;
    if (!m_signal.type.isValid())
        m_errors.add(type.line, type.valueColumn, error);
}

void TableReader::readValues()
{
    const QPlcSignalType element = elementType(m_signal.type);
    readValue(SignalKey::Minimum, element, &m_signal.minimum);
    readValue(SignalKey::Maximum, element, &m_signal.maximum);
    readValue(SignalKey::Safe, m_signal.type, &m_signal.safe);
    m_signal.initial = QPlcValue(m_signal.type);
    readValue(SignalKey::Initial, m_signal.type, &m_signal.initial);
    QPlcValue hold;
    readValue(SignalKey::Hold, QPlcValue(0).type(), &hold);
    if (hold.isValid())
        m_signal.hold = hold.toInt();
    readNames();
    readWriters();
    readNan();
    readSlope();
    readVolatile();
}

void TableReader::readNames()
{
    Entry &source = entry(SignalKey::Values);
    if (source.line == 0 || source.isWrong)
        return;
    QString error;
    m_signal.valueNames = QPlcValueNames::fromText(source.value, &error);
    if (error.isEmpty())
        return;
    source.isWrong = true;
    m_errors.add(source.line, source.valueColumn, error);
}

void TableReader::readWriters()
{
    const Entry &source = entry(SignalKey::Writer);
    if (source.line == 0 || source.isWrong)
        return;
    for (const QString &name : source.value.split(QLatin1Char('>')))
        m_signal.writers.append(name.trimmed());
}

void TableReader::readNan()
{
    Entry &source = entry(SignalKey::Nan);
    if (source.line == 0 || source.isWrong)
        return;
    m_signal.nanAllowed = source.value == nanAllowedText();
    if (m_signal.nanAllowed)
        return;
    source.isWrong = true;
    m_errors.add(source.line, source.valueColumn,
                 QStringLiteral("'nan' cannot be %1; write 'nan = %2', or remove the line")
                     .arg(quoted(source.value), nanAllowedText()));
}

void TableReader::readSlope()
{
    Entry &source = entry(SignalKey::Slope);
    if (source.line == 0 || source.isWrong)
        return;
    m_signal.slope = slopeFromText(source.value);
    if (m_signal.slope > 0.0)
        return;
    source.isWrong = true;
    m_errors.add(source.line, source.valueColumn,
                 QStringLiteral("%1 is not a slope; write a positive number, as in 'slope = 5 per second'")
                     .arg(quoted(source.value)));
}

void TableReader::readVolatile()
{
    Entry &source = entry(SignalKey::Volatile);
    if (source.line == 0 || source.isWrong)
        return;
    m_signal.isVolatile = source.value == volatileText();
    if (m_signal.isVolatile)
        return;
    source.isWrong = true;
    m_errors.add(source.line, source.valueColumn,
                 QStringLiteral("'volatile' cannot be %1; write 'volatile = %2', or remove the line")
                     .arg(quoted(source.value), volatileText()));
}

// Leaves `value` as it is when there is no such key or its text is no such value.
void TableReader::readValue(SignalKey key, QPlcSignalType type, QPlcValue *value)
{
    Entry &source = entry(key);
    if (source.line == 0 || source.isWrong)
        return;
    QString error;
    const QPlcValue read = QPlcValue::fromString(type, source.value, &error);
    if (read.isValid()) {
        *value = read;
        return;
    }
    source.isWrong = true;
    m_errors.add(source.line, source.valueColumn, error);
}

void TableReader::complain(const Complaint &complaint)
{
    if (complaint.key == SignalKey::Name) {
        if (m_state == State::Open)
            m_errors.add(m_signal.line, m_nameColumn, complaint.text);
        return;
    }
    const Entry &source = entry(complaint.key);
    const bool isReportedAlready = source.isWrong || complaint.key == SignalKey::Type;
    if (isReportedAlready)
        return;
    if (source.line != 0)
        m_errors.add(source.line, source.valueColumn, complaint.text);
    else
        m_errors.add(m_signal.line, m_nameColumn, complaint.text);
}

}  // namespace qplc
