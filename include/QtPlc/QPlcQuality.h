// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

/// The quality of the value of a signal: one byte that travels beside the value and says where the
/// value comes from.
///
/// | byte     | kind    | the value is                                                            |
/// |----------|---------|-------------------------------------------------------------------------|
/// | 0        | Good    | of this cycle, and within the limits of the signal table                |
/// | 1 to 252 | Held    | the last good value, that many cycles old (252: or older)               |
/// | 253      | Safe    | the safe value: there was no good one for longer than `hold` cycles     |
/// | 254      | Invalid | the initial value: nothing has written the signal yet                   |
///
/// The byte 255 is reserved and is read as Invalid. `hold` and `safe` are keys of the signal table
/// (QPlcSignalTable).
///
/// \code
/// QPlcMasterNode master;
/// if (!master.signalQuality("windSpeed").isUsable())
///     qWarning("no measurement: %s", qPrintable(master.signalQuality("windSpeed").toString()));
/// \endcode
///
/// \threadsafe a value type of one byte: each thread may use its own copy
///
/// \ingroup signals
class QTPLC_EXPORT QPlcQuality
{
public:
    /// Where a value comes from.
    enum Kind : quint8 {
        Good,    ///< the writer has sent it in this cycle, and it is within its limits
        Held,    ///< the last good value, kept because no new one came
        Safe,    ///< the safe value of the signal, because the held one became too old
        Invalid  ///< the initial value: no good one came yet
    };

    /// Largest age of a held value that the byte can carry [cycles]. An older value has this age,
    /// too.
    static constexpr int MaximumHeldCycles = 252;

    /// Makes an Invalid quality.
    constexpr QPlcQuality() = default;
    /// Makes a quality of a kind without an age.
    /// \pre \a kind is not Held; use held() for that. Held gives Invalid
    constexpr QPlcQuality(Kind kind)
        : m_byte(kind == Good       ? 0
                     : kind == Safe ? SafeByte
                                    : InvalidByte)
    {
    }
    /// Returns the quality of a held value.
    /// \param cycles  age of the value; 0 or less gives Good, more than MaximumHeldCycles gives
    ///     MaximumHeldCycles
    static constexpr QPlcQuality held(qint64 cycles)
    {
        return fromByte(quint8(cycles < 0 ? 0 : cycles > MaximumHeldCycles ? MaximumHeldCycles : cycles));
    }
    /// Returns the quality that a byte of a frame stands for: see the table above. 255 gives
    /// Invalid.
    static constexpr QPlcQuality fromByte(quint8 byte)
    {
        QPlcQuality quality;
        quality.m_byte = byte > InvalidByte ? quint8(InvalidByte) : byte;
        return quality;
    }

    /// Returns the byte that stands for this quality in a frame, 0 to 254.
    constexpr quint8 toByte() const { return m_byte; }
    /// Returns the kind, without the age.
    constexpr Kind kind() const
    {
        return m_byte == 0 ? Good : m_byte == SafeByte ? Safe : m_byte == InvalidByte ? Invalid : Held;
    }
    /// Returns the age of a held value [cycles], 1 to 252; 0 for all other kinds.
    constexpr int heldCycles() const { return m_byte <= MaximumHeldCycles ? m_byte : 0; }
    /// Returns true if the value is of this cycle and within its limits.
    constexpr bool isGood() const { return m_byte == 0; }
    /// Returns true for Good and Held: the value comes from the writer of the signal, and it is not
    /// too old.
    constexpr bool isUsable() const { return m_byte <= MaximumHeldCycles; }
    /// Returns "good", "held 3", "safe" or "invalid".
    QString toString() const;

    /// Returns true if kind and age are the same.
    friend constexpr bool operator==(QPlcQuality a, QPlcQuality b) { return a.m_byte == b.m_byte; }
    /// Returns true if kind or age differ.
    friend constexpr bool operator!=(QPlcQuality a, QPlcQuality b) { return !(a == b); }

private:
    static constexpr quint8 SafeByte = 253;
    static constexpr quint8 InvalidByte = 254;

    quint8 m_byte = InvalidByte;
};

Q_DECLARE_METATYPE(QPlcQuality)
