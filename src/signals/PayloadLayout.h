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

    PayloadLayout() = default;
    /// \pre every index is in \a table and occurs once
    PayloadLayout(const QPlcSignalTable &table, const QVector<QPlcSignalIndex> &signalIndices);

    const std::vector<Field> &fields() const { return m_fields; }
    quint32 size() const { return m_size; }  // [byte]
    /// FNV-1a-64 of "name:type@offset\n" of all fields in order.
    quint64 hash() const { return m_hash; }

    /// Borders of the parts into which the payload is split so that no part is longer than \a maximum bytes and no
    /// signal is torn (one that is longer itself is a part of its own): part i is [borders[i], borders[i+1]). An empty
    /// payload is one empty part.
    std::vector<quint32> partBorders(quint32 maximum) const;

    /// The field of the first real value in \a payload that is NaN or infinite; null when all are finite.
    const Field *firstNotFinite(const char *payload) const noexcept
    {
        for (const RealRun &run : m_realRuns) {
            if (!isFinite(run.scalar, payload + run.offset, run.size))
                return firstNotFiniteField(payload);
        }
        return nullptr;
    }

private:
    /// Real values of one type that lie side by side.
    struct RealRun
    {
        QPlcSignalType::Scalar scalar;
        quint32 offset;  // [byte]
        quint32 size;    // [byte]
    };
    static bool isFinite(QPlcSignalType::Scalar scalar, const char *bytes, quint32 size) noexcept;
    const Field *firstNotFiniteField(const char *payload) const noexcept;
    void addRealRun(const Field &field);

    std::vector<Field> m_fields;
    std::vector<RealRun> m_realRuns;
    quint32 m_size = 0;
    quint64 m_hash = fnv1a64Start;
};

}  // namespace qplc
