// SPDX-License-Identifier: Apache-2.0
#include "NmeaStream.h"

namespace qplc {

bool NmeaStream::feed(char byte)
{
    ++m_bytes;
    if (byte == '\r' || byte == '\n')
        return end();
    const bool begins = byte == '$' || byte == '!';
    if (begins && !m_line.isEmpty()) {  // the end of the last one was lost
        ++m_refused;
        m_line.clear();
    }
    // One byte more than is allowed is kept, so that the end of the line sees it; without a begin
    // the line is nothing.
    if ((begins || !m_line.isEmpty()) && m_line.size() <= NmeaSentence::MaximumLength)
        m_line.append(byte);
    return false;
}

bool NmeaStream::end()
{
    if (m_line.isEmpty())
        return false;
    const bool isGood = NmeaSentence::parse(m_line, &m_sentence) == NmeaSentence::Good
        && (m_sentence.hasChecksum() || !m_isChecksumRequired);
    ++(isGood ? m_sentences : m_refused);
    m_line.clear();
    return isGood;
}

}  // namespace qplc
