// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

/// How far the value of a plc signal can be trusted: one byte that travels beside the value.
///
/// | byte      | kind    | the value is                                                                                  |
/// |-----------|---------|-----------------------------------------------------------------------------------------------|
/// | 0         | Good    | of this cycle, and within the limits of the signal table                                       |
/// | 1 ... 252 | Held    | the last good one, that many cycles old (252: or older); `hold` of the table says how long     |
/// | 253       | Safe    | the safe one of the table (`safe`): there has been no good one for longer than `hold` cycles   |
/// | 254       | Invalid | the initial one: nobody has written the signal yet                                             |
///
/// 255 is reserved, and read as Invalid. A value type; thread-safe as such.
class QTPLC_EXPORT QPlcQuality
{
public:
    enum Kind : quint8 { Good, Held, Safe, Invalid };

    /// Greatest age that a held value can tell [cycles].
    static constexpr int MaximumHeldCycles = 252;

    /// Invalid: nothing is known of the value.
    constexpr QPlcQuality() = default;
    /// \pre not Held, which has an age: held()
    constexpr QPlcQuality(Kind kind)
        : m_byte(kind == Good       ? 0
                     : kind == Safe ? SafeByte
                                    : InvalidByte)
    {
    }
    /// \param cycles  age of the value: below 1 it is Good, above MaximumHeldCycles that
    static constexpr QPlcQuality held(qint64 cycles)
    {
        return fromByte(quint8(cycles < 0 ? 0 : cycles > MaximumHeldCycles ? MaximumHeldCycles : cycles));
    }
    static constexpr QPlcQuality fromByte(quint8 byte)
    {
        QPlcQuality quality;
        quality.m_byte = byte > InvalidByte ? quint8(InvalidByte) : byte;
        return quality;
    }

    constexpr quint8 toByte() const { return m_byte; }
    constexpr Kind kind() const
    {
        return m_byte == 0 ? Good : m_byte == SafeByte ? Safe : m_byte == InvalidByte ? Invalid : Held;
    }
    /// Age of the value [cycles]: 0 when it is Good, and when it has none (Safe, Invalid).
    constexpr int heldCycles() const { return m_byte <= MaximumHeldCycles ? m_byte : 0; }
    constexpr bool isGood() const { return m_byte == 0; }
    /// Good or Held: the value came from the writer of the signal, and is not too old.
    constexpr bool isUsable() const { return m_byte <= MaximumHeldCycles; }
    /// "good", "held 3", "safe", "invalid"
    QString toString() const;

    friend constexpr bool operator==(QPlcQuality a, QPlcQuality b) { return a.m_byte == b.m_byte; }
    friend constexpr bool operator!=(QPlcQuality a, QPlcQuality b) { return !(a == b); }

private:
    static constexpr quint8 SafeByte = 253;
    static constexpr quint8 InvalidByte = 254;

    quint8 m_byte = InvalidByte;
};

Q_DECLARE_METATYPE(QPlcQuality)
