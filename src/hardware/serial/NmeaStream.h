// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NmeaSentence.h"

namespace qplc {

/// Finds the sentences of NMEA 0183 in what comes from a serial line, in whatever pieces it comes.
/// Other bytes are thrown away; lines that are not sentences are counted.
class NmeaStream
{
public:
    /// Forgets an unfinished sentence.
    void reset() { m_line.clear(); }
    void setChecksumRequired(bool isRequired) { m_isChecksumRequired = isRequired; }

    /// The next byte. \return whether it has ended a good sentence: sentence()
    bool feed(char byte);
    const NmeaSentence &sentence() const { return m_sentence; }

    quint64 bytes() const { return m_bytes; }
    quint64 sentences() const { return m_sentences; }  // good ones
    quint64 refused() const { return m_refused; }      // lines

private:
    bool end();

    QByteArray m_line;
    NmeaSentence m_sentence;
    bool m_isChecksumRequired = true;
    quint64 m_bytes = 0;
    quint64 m_sentences = 0;
    quint64 m_refused = 0;
};

}  // namespace qplc
