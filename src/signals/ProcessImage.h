// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PayloadLayout.h"
#include "QPlcQuality.h"
#include "QPlcSignalTable.h"

#include <memory>

namespace qplc {

/// All values of a signal table in one block of memory, 64-byte aligned, packed in table order at
/// fixed offsets; behind them, aligned too, the quality of each value (a byte of QPlcQuality), in
/// table order.
///
/// Frames are cut from it and pasted into it by copy runs; neighbours in the table that are
/// neighbours in a frame are one run, so a table that lists the signals by writer makes each frame
/// one copy. No thread rule of its own: one thread at a time.
class ProcessImage
{
public:
    ProcessImage() = default;
    /// Every signal has its initial value, which is Invalid.
    explicit ProcessImage(const QPlcSignalTable &table);

    const QPlcSignalTable &table() const { return m_table; }
    char *data() { return m_bytes.get(); }
    const char *data() const { return m_bytes.get(); }
    /// Bytes of all values, without the padding behind them.
    quint32 size() const { return m_size; }
    quint32 offset(QPlcSignalIndex index) const { return m_offsets[index]; }
    /// Bytes of values, padding and qualities: all that data() points to.
    quint32 totalSize() const { return m_qualityOffset + quint32(m_offsets.size()); }
    quint32 qualityOffset(QPlcSignalIndex index) const { return m_qualityOffset + index; }

    QPlcValue value(QPlcSignalIndex index) const;
    /// \return false, and no change, when \a value cannot be converted to the type of the signal
    bool setValue(QPlcSignalIndex index, const QPlcValue &value);
    QPlcQuality quality(QPlcSignalIndex index) const
    {
        return QPlcQuality::fromByte(quint8(data()[qualityOffset(index)]));
    }
    void setQuality(QPlcSignalIndex index, QPlcQuality quality)
    {
        data()[qualityOffset(index)] = char(quality.toByte());
    }
    /// Gives every signal its initial value, which is Invalid.
    void reset();

    /// Runs that cut a frame of \a layout out of this image, with qualities where it has them; \a
    /// layout is made from the table of the image.
    std::vector<CopyRun> gatherRuns(const PayloadLayout &layout) const;
    /// As above, values and qualities of those fields only that are \a wanted; a field behind the
    /// end of \a wanted is not.
    std::vector<CopyRun> gatherRuns(const PayloadLayout &layout, const std::vector<bool> &wanted) const;
    /// Runs that paste the values of a frame of \a layout into this image, but for the signals that
    /// are \a held (by index; those behind its end are not).
    std::vector<CopyRun> scatterRuns(const PayloadLayout &layout, const std::vector<bool> &held = {}) const;

    /// Folds the bytes of all values into \a digest: an order-dependent 64-bit hash, equal for
    /// equal images on all machines.
    quint64 digest(quint64 digest) const noexcept;

private:
    struct AlignedDelete
    {
        void operator()(char *bytes) const;
    };
    QPlcSignalTable m_table;
    std::unique_ptr<char[], AlignedDelete> m_bytes;
    std::vector<quint32> m_offsets;
    quint32 m_size = 0;
    quint32 m_qualityOffset = 0;
};

}  // namespace qplc
