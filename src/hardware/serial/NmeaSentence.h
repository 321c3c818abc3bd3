// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QVector>

namespace qplc {

/// A sentence of NMEA 0183: `$WIMWV,214.8,R,5.1,M,A*2B`.
class NmeaSentence
{
public:
    /// [byte] from '$' to the checksum. The standard says 80; there are instruments that send more.
    static constexpr int MaximumLength = 250;

    enum Result : quint8 {
        Good,
        TooLong,
        NoSentence,     ///< it does not begin with '$' or '!' and letters, or has bytes that are no text
        WrongChecksum,  ///< or one that is not a number, or something behind it
    };

    /// \param line  without its end \param sentence  undefined unless the result is Good
    static Result parse(const QByteArray &line, NmeaSentence *sentence);
    /// Exclusive or of what is between '$' and '*'.
    static quint8 checksum(const char *bytes, int size);

    /// Who talks: "WI" for weather instruments; "P" for what a manufacturer has made up.
    QByteArray talker() const { return m_talker; }
    /// "MWV"
    QByteArray type() const { return m_type; }
    bool hasChecksum() const { return m_hasChecksum; }

    /// Those behind the type.
    int fieldCount() const { return m_fields.size(); }
    /// Empty for one that is not there.
    QByteArray field(int index) const { return m_fields.value(index); }
    /// Whether a field is exactly \a letter.
    bool isLetter(int index, char letter) const;
    /// \return false if the field is empty or not a number
    bool number(int index, double *number) const;

private:
    QByteArray m_talker;
    QByteArray m_type;
    QVector<QByteArray> m_fields;
    bool m_hasChecksum = false;
};

}  // namespace qplc
