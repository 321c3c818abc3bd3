// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace qplc {

/// Which rows of a channel are not like the others: stretches of rows with a mark, a small number
/// above 0.
///
/// Rows without a mark cost nothing. At most \a MostStretches are kept: before them, what lies
/// between two marked stretches counts as marked, so that a mark is never lost. One thread.
class RowMarks
{
public:
    using Row = std::uint64_t;
    using Mark = std::uint8_t;

    static constexpr Mark None = 0;
    static constexpr std::size_t MostStretches = 512;

    bool isEmpty() const { return m_stretches.empty(); }
    /// \param row  after all that have a mark \param mark  not None
    void mark(Row row, Mark mark);
    /// Rows before \a row are gone.
    void forgetBefore(Row row);
    void clear() { m_stretches.clear(); }

    /// The greatest mark of rows \a begin ... \a end - 1.
    Mark greatest(Row begin, Row end) const;
    std::size_t memory() const { return m_stretches.capacity() * sizeof(Stretch); }

private:
    struct Stretch
    {
        Row begin;
        std::uint32_t rows;
        Mark mark;
        Row end() const { return begin + rows; }
    };

    void joinOldest();

    std::vector<Stretch> m_stretches;  // in the order of rows
};

}  // namespace qplc
