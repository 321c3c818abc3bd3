// SPDX-License-Identifier: Apache-2.0
#include "TableExport.h"

#include <algorithm>

namespace qplc {

TableExport::Column TableExport::Column::of(const QPlcPast &past, const QString &name, double gain, double offset)
{
    const auto [store, channel] = PastRows::of(past);
    return Column{store, channel, gain, offset, name, past.unit, past};
}

TableExport::TableExport(Format format, std::vector<Column> columns, Time begin, Time end)
    : m_format(format)
    , m_columns(std::move(columns))
    , m_begin(begin)
    , m_end(end)
{
    for (const Column &column : m_columns) {
        const auto known = std::find_if(m_readers.begin(), m_readers.end(), [&](const Reader &each) {
            return each.store == column.store && each.shift == column.shift && each.end == column.end;
        });
        m_readerOf.push_back(std::size_t(known - m_readers.begin()));
        if (known == m_readers.end())
            m_readers.push_back({column.store, column.store->rowAt(std::max(begin - column.shift, column.begin)),
                                 column.shift, column.end});
    }
    Time first = begin;
    if (findTime(&first))
        m_begin = first;
}

QByteArray TableExport::header() const
{
    TableText text(m_format);
    text.addText(QStringLiteral("UTC"));
    text.addTitle(QStringLiteral("time"), QStringLiteral("s"));
    for (const Column &column : m_columns) {
        text.addTitle(column.name, column.unit);
        if (column.hasQuality)
            text.addTitle(column.name + QStringLiteral(".quality"), QString());
    }
    text.endRow();
    return text.take();
}

bool TableExport::hasRow(const Reader &reader) const
{
    return reader.row < reader.store->endRow() && reader.time() <= m_end && reader.store->time(reader.row) < reader.end;
}

bool TableExport::findTime(Time *time) const
{
    bool isFound = false;
    for (const Reader &reader : m_readers) {
        if (!hasRow(reader))
            continue;
        const Time next = reader.time();
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
    TableText text(m_format);
    for (Reader &reader : m_readers)  // rows that have been overwritten since are gone
        reader.row = std::max(reader.row, reader.store->firstRow());
    Time time = 0;
    for (int i = 0; i < mostRows && findTime(&time); ++i) {
        appendRow(time, &text);
        for (Reader &reader : m_readers)
            reader.row += hasRow(reader) && reader.time() == time ? 1 : 0;
        ++m_rows;
    }
    return text.take();
}

/// The store has kinds; how long a value has been held, its rows say.
int TableExport::qualityOf(const SignalStore &store, int channel, SignalStore::Row row)
{
    const auto kindOf = [&](SignalStore::Row each) { return store.greatestMark(channel, each, each + 1); };
    switch (kindOf(row)) {
    case QPlcQuality::Safe:
        return QPlcQuality(QPlcQuality::Safe).toByte();
    case QPlcQuality::Invalid:
        return QPlcQuality(QPlcQuality::Invalid).toByte();
    case QPlcQuality::Held:
        break;
    default:
        return QPlcQuality(QPlcQuality::Good).toByte();
    }
    int held = 1;
    while (held < QPlcQuality::MaximumHeldCycles && row > store.firstRow() && kindOf(row - 1) == QPlcQuality::Held) {
        --row;
        ++held;
    }
    return held;
}

void TableExport::appendRow(Time time, TableText *text) const
{
    text->addMoment(time);
    text->addSeconds(time - m_begin);
    for (std::size_t i = 0; i < m_columns.size(); ++i) {
        const Column &column = m_columns[i];
        const Reader &reader = m_readers[m_readerOf[i]];
        if (hasRow(reader) && reader.time() == time) {
            const double value = double(reader.store->value(column.channel, reader.row));
            text->addNumber(float(column.gain * value + column.offset));
            if (column.hasQuality)
                text->addNumber(qualityOf(*reader.store, column.channel, reader.row));
        } else {
            text->addNothing();
            if (column.hasQuality)
                text->addNothing();
        }
    }
    text->endRow();
}

}  // namespace qplc
