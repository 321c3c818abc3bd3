// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hardware/RawNumber.h"

#include <QtCore/QByteArray>

#include <optional>
#include <vector>

namespace qplc {

/// How the kernel stores a value in the buffer of an IIO device.
struct IioElement
{
    RawNumber number;
    bool isBigEndian = false;
    int storage = 0;     // bytes of a value: 1, 2, 4 or 8
    int repetition = 1;  // values of the element
    int shift = 0;       // bits below the number

    /// \param text  of the kernel: "le:s12/16>>4", "be:u24/32X2>>0" \return no value if the text
    ///              contradicts itself, or is another one
    static std::optional<IioElement> fromText(const QByteArray &text);

    int bytes() const { return storage * repetition; }
    /// The bits of the first value. \param bytes  of the element
    quint64 bits(const quint8 *bytes) const noexcept;
};

/// Where the values stand in a scan: the bytes that an IIO device has measured at one instant.
/// Elements come in the order of their indices, each at a multiple of its own size, and the scan is
/// as long as a multiple of the largest one.
class IioScan
{
public:
    static constexpr int MostBytes = 4096;
    /// Index of the timestamp, which comes behind all others.
    static constexpr int Last = 1 << 30;

    void clear();
    /// \param index  not negative \return a number for value() and integer()
    int add(int index, const IioElement &element);
    /// After the last add(). \return why there is no such scan, and what to do; null if it is right
    const char *layOut();

    /// After layOut() [bytes].
    int size() const { return m_size; }
    const IioElement &element(int number) const { return m_places[std::size_t(number)].element; }
    /// \param scan  size() bytes
    double value(int number, const quint8 *scan) const noexcept;
    /// Of an element of integers.
    qint64 integer(int number, const quint8 *scan) const noexcept;

private:
    struct Place
    {
        int index;
        IioElement element;
        int offset;  // [bytes]
    };

    quint64 bitsOf(const Place &place, const quint8 *scan) const noexcept
    {
        return place.element.bits(scan + place.offset);
    }

    std::vector<Place> m_places;
    int m_size = 0;
};

}  // namespace qplc
