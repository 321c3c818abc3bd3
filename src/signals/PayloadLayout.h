// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Fnv1a.h"
#include "QPlcSignalTable.h"

#include <cstring>
#include <vector>

namespace qplc {

/// A piece of memory that is copied as a whole.
struct CopyRun
{
    quint32 from = 0;  // [byte]
    quint32 to = 0;    // [byte]
    quint32 size = 0;  // [byte], > 0
};

/// Copies all \a runs; the fixed sizes of single numbers become single moves.
inline void copyRuns(const std::vector<CopyRun> &runs, const char *from, char *to) noexcept
{
    for (const CopyRun &run : runs) {
        switch (run.size) {
        case 1:
            to[run.to] = from[run.from];
            break;
        case 4:
            std::memcpy(to + run.to, from + run.from, 4);
            break;
        case 8:
            std::memcpy(to + run.to, from + run.from, 8);
            break;
        case 12:
            std::memcpy(to + run.to, from + run.from, 12);
            break;
        default:
            std::memcpy(to + run.to, from + run.from, run.size);
        }
    }
}

/// The values of one direction of one node, packed in the registered order, without indices.
class PayloadLayout
{
public:
    struct Field
    {
        QPlcSignalIndex signal = QPlcInvalidSignalIndex;  // in the table that the layout was made from
        quint32 offset = 0;                               // [byte] in the payload
        QPlcSignalType type;
    };

    /// Whether a byte for the quality of each value follows behind all values, in the order of the
    /// fields.
    enum Qualities : quint8 { WithoutQualities, WithQualities };

    PayloadLayout() = default;
    /// \pre every index is in \a table and occurs once
    PayloadLayout(const QPlcSignalTable &table, const QVector<QPlcSignalIndex> &signalIndices,
                  Qualities qualities = WithoutQualities);

    const std::vector<Field> &fields() const { return m_fields; }
    quint32 size() const { return m_size; }  // [byte]
    bool hasQualities() const { return m_size > m_valueSize; }
    /// Bytes of the values alone; there the qualities begin.
    quint32 valueSize() const { return m_valueSize; }
    /// FNV-1a-64 of "name:type@offset\n" of all fields in order, and of "qualities@offset\n" where
    /// they follow.
    quint64 hash() const { return m_hash; }

    /// Borders of the parts into which the payload is split so that no part is longer than \a
    /// maximum bytes and no value is torn (one that is longer itself is a part of its own;
    /// qualities may be parted anywhere): part i is [borders[i], borders[i+1]). An empty payload is
    /// one empty part.
    std::vector<quint32> partBorders(quint32 maximum) const;

private:
    std::vector<Field> m_fields;
    quint32 m_valueSize = 0;
    quint32 m_size = 0;
    quint64 m_hash = fnv1a64Start;
};

}  // namespace qplc
