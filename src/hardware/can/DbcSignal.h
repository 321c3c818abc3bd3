// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hardware/RawNumber.h"

#include <QtCore/QMap>
#include <QtCore/QString>
#include <QtCore/QVector>

#include <bitset>

namespace qplc {

/// Where a value lies in a CAN frame and what it means, as the line SG_ of a DBC file says it: bits
/// <-> raw integer <-> physical value.
///
/// The physical value is raw * factor + offset, [unit]. A float is its bits as they are.
/// Bits are numbered as DBC does: bit 0 is the least significant one of byte 0, bit 8 that of byte
/// 1. start() is the least significant bit of an Intel value and the most significant bit of a
///    Motorola one.
struct DbcSignal
{
    enum ByteOrder : quint8 { Intel, Motorola };
    enum Kind : quint8 { Unsigned, Signed, Float32, Float64 };
    /// Values of a multiplexor, the first and the last one included.
    struct Range
    {
        quint64 first = 0;
        quint64 last = 0;
    };
    using Bits = std::bitset<512>;  // of the longest frame
    using Fit = RawNumber::Fit;
    static constexpr Fit Fits = RawNumber::Fits;
    static constexpr Fit Saturated = RawNumber::Saturated;
    static constexpr Fit NoNumber = RawNumber::NoNumber;

    QString name;
    int start = 0;
    int length = 1;  // 1 ... 64
    ByteOrder byteOrder = Intel;
    Kind kind = Unsigned;
    double factor = 1.0;  // not 0
    double offset = 0.0;
    double minimum = 0.0;  // as the file says it; both 0: nothing said
    double maximum = 0.0;
    QString unit;
    bool isMultiplexor = false;  // says which of the others are in the frame
    QVector<Range> pages;        // values of its multiplexor with which it is in the frame; empty: it always is
    int multiplexor = -1;        // index in DbcMessage::content of its multiplexor; -1: none, or not known yet
    double initial = 0.0;        // raw, before anybody has written
    QMap<qint64, QString> valueNames;

    bool isFloat() const { return kind == Float32 || kind == Float64; }
    bool isMultiplexed() const { return !pages.isEmpty(); }
    /// Whether it is in the frame with this value of its multiplexor.
    bool isOnPage(quint64 value) const noexcept;
    /// The bits of a frame that it takes. \pre neededBytes() <= 64
    Bits places() const;
    /// Of the bits, and of what the file says.
    RawNumber::Limits limits() const;
    /// Bytes that a frame needs to hold the value.
    int neededBytes() const;

    /// The bits, the last one at bit 0. \param data  at least neededBytes()
    quint64 bits(const quint8 *data) const noexcept;
    /// Puts the lowest bits of \a value to their place; those around it stay.
    void setBits(quint8 *data, quint64 value) const noexcept;

    /// The bits as an integer with a sign. \pre kind is Signed
    qint64 signedRaw(const quint8 *data) const noexcept;

    /// The physical value.
    double decode(const quint8 *data) const noexcept;
    /// Puts the raw value that is nearest to \a value to its place.
    Fit encode(quint8 *data, double value) const noexcept;
    /// As encode(), for a raw value.
    Fit encodeRaw(quint8 *data, double raw) const noexcept;
};

}  // namespace qplc
