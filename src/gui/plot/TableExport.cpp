// SPDX-License-Identifier: Apache-2.0
#include "TableExport.h"

#include <QtCore/QDateTime>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace qplc {

namespace {

using Time = SignalStore::Time;

/// Exact, whatever the size: "12.345", with nine digits at most.
void appendSeconds(Time time, QByteArray *text)
{
    *text += QByteArray::number(qint64(time / SignalStore::Second));
    QByteArray fraction = QByteArray::number(qint64(time % SignalStore::Second)).rightJustified(9, '0');
    while (fraction.endsWith('0'))
        fraction.chop(1);
    if (!fraction.isEmpty())
        *text += '.' + fraction;
}

void appendMoment(Time time, QByteArray *text)
{
    const QDateTime moment = QDateTime::fromSecsSinceEpoch(time / SignalStore::Second, Qt::UTC);
    *text += moment.toString(QStringLiteral("yyyy-MM-ddTHH:mm:ss.")).toLatin1();
    *text += QByteArray::number(qint64(time % SignalStore::Second / 1000)).rightJustified(6, '0') + 'Z';
}

void appendNumber(float value, QByteArray *text)
{
    if (std::isnan(value))
        return;
    char digits[32];
    const std::to_chars_result result = std::to_chars(digits, digits + sizeof digits, value);
    text->append(digits, int(result.ptr - digits));
}

}  // namespace

TableExport::Column TableExport::Column::of(const QPlcPast &past, const QString &name, double gain, double offset)
{
    const auto [store, channel] = PastRows::of(past);
    return {store, channel, gain, offset, name, past.unit, past};
}

TableExport::TableExport(Format format, std::vector<Column> columns, Time begin, Time end)
    : m_format(format)
    , m_columns(std::move(columns))
    , m_begin(begin)
    , m_end(end)
{
    for (const Column &column : m_columns) {
        const auto known = std::find_if(m_readers.begin(), m_readers.end(),
                                        [&](const Reader &each) { return each.store == column.store; });
        m_readerOf.push_back(std::size_t(known - m_readers.begin()));
        if (known == m_readers.end())
            m_readers.push_back({column.store, column.store->rowAt(begin)});
    }
    Time first = begin;
    if (findTime(&first))
        m_begin = first;
}

QByteArray TableExport::field(const QString &text) const
{
    if (m_format == Tsv)
        return QString(text).replace(QLatin1Char('\t'), QLatin1Char(' ')).toUtf8();
    const bool needsQuotes = std::any_of(text.begin(), text.end(), [](QChar c) {
        return c == QLatin1Char(',') || c == QLatin1Char('"') || c == QLatin1Char('\r') || c == QLatin1Char('\n');
    });
    if (!needsQuotes)
        return text.toUtf8();
    QByteArray quoted = text.toUtf8();
    return '"' + quoted.replace("\"", "\"\"") + '"';
}

QByteArray TableExport::header() const
{
    const char separator = m_format == Csv ? ',' : '\t';
    QByteArray line = QByteArrayLiteral("UTC") + separator + QByteArrayLiteral("time [s]");
    for (const Column &column : m_columns) {
        const bool hasUnit = !column.unit.isEmpty();
        line += separator + field(hasUnit ? QStringLiteral("%1 [%2]").arg(column.name, column.unit) : column.name);
    }
    return line + (m_format == Csv ? "\r\n" : "\n");
}

bool TableExport::hasRow(const Reader &reader) const
{
    return reader.row < reader.store->endRow() && reader.store->time(reader.row) <= m_end;
}

bool TableExport::findTime(Time *time) const
{
    bool isFound = false;
    for (const Reader &reader : m_readers) {
        if (!hasRow(reader))
            continue;
        const Time next = reader.store->time(reader.row);
        *time = isFound ? std::min(*time, next) : next;
        isFound = true;
    }
    return isFound;
}

bool TableExport::isAtEnd() const
{
    Time time = 0;
    return !findTime(&time);
}

QByteArray TableExport::next(int mostRows)
{
    QByteArray text;
    for (Reader &reader : m_readers)  // rows that have been overwritten since are gone
        reader.row = std::max(reader.row, reader.store->firstRow());
    Time time = 0;
    for (int i = 0; i < mostRows && findTime(&time); ++i) {
        appendRow(time, &text);
        for (Reader &reader : m_readers)
            reader.row += hasRow(reader) && reader.store->time(reader.row) == time ? 1 : 0;
        ++m_rows;
    }
    return text;
}

void TableExport::appendRow(Time time, QByteArray *text) const
{
    const char separator = m_format == Csv ? ',' : '\t';
    appendMoment(time, text);
    *text += separator;
    appendSeconds(time - m_begin, text);
    for (std::size_t i = 0; i < m_columns.size(); ++i) {
        const Column &column = m_columns[i];
        const Reader &reader = m_readers[m_readerOf[i]];
        *text += separator;
        if (hasRow(reader) && reader.store->time(reader.row) == time) {
            const double value = double(reader.store->value(column.channel, reader.row));
            appendNumber(float(column.gain * value + column.offset), text);
        }
    }
    *text += m_format == Csv ? "\r\n" : "\n";
}

}  // namespace qplc
