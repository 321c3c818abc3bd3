// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PastRows.h"
#include "TextTable.h"
#include "gui/store/SignalStore.h"

#include <QtCore/QByteArray>
#include <QtCore/QString>

#include <limits>
#include <vector>

namespace qplc {

/// Rows of curves as text, a piece at a time (see TableText). Numbers have as many digits as 32
/// bits hold.
///
/// Each row has the moment (UTC, ISO 8601), the seconds since the first row, and a value for each
/// column, nothing where there is none. Columns of several stores are one table: each time of any
/// of them is a row. As in tables of recordings, a column can be followed by the qualities of its
/// values: 0 Good, 1 to 252 Held for so many rows, 253 Safe, 254 Invalid.
class TableExport : public TextTable
{
public:
    using Time = SignalStore::Time;

    using Format = TableText::Format;
    static constexpr Format Csv = TableText::Csv;
    static constexpr Format Tsv = TableText::Tsv;
    struct Column
    {
        const SignalStore *store;  // outlives the export, or
        int channel;
        double gain;
        double offset;
        QString name;
        QString unit;
        QPlcPast owner{};  // of the store, until the table goes
        bool hasQuality = false;
        Time shift = 0;  // from the times of the store to those of the table [ns]
        // Of the store: only these times [ns]
        Time begin = std::numeric_limits<Time>::min();
        Time end = std::numeric_limits<Time>::max();

        static Column of(const QPlcPast &past, const QString &name, double gain = 1.0, double offset = 0.0);
    };

    /// Rows from \a begin up to and with \a end.
    TableExport(Format format, std::vector<Column> columns, Time begin, Time end);

    /// "UTC,time [s],kite.elevation [deg]"
    QByteArray header() const override;
    bool isAtEnd() const override;
    QByteArray next(int mostRows) override;
    std::int64_t rows() const override { return m_rows; }

private:
    /// A store with the next row of it.
    struct Reader
    {
        const SignalStore *store;
        SignalStore::Row row;
        Time shift;
        Time end;  // first one of the store that is not in the table

        Time time() const { return store->time(row) + shift; }
    };

    bool hasRow(const Reader &reader) const;
    bool findTime(Time *time) const;
    void appendRow(Time time, TableText *text) const;
    static int qualityOf(const SignalStore &store, int channel, SignalStore::Row row);

    Format m_format;
    std::vector<Column> m_columns;
    std::vector<Reader> m_readers;
    std::vector<std::size_t> m_readerOf;  // of each column
    Time m_begin;                         // of the first row
    Time m_end;
    std::int64_t m_rows = 0;
};

}  // namespace qplc
