// SPDX-License-Identifier: Apache-2.0
#include "NmeaDriver.h"

#include "QPlcDriverSettings.h"
#include "QPlcReadChannel.h"

#include <cerrno>

namespace qplc {

namespace {

using namespace std::chrono_literals;

constexpr qint64 LongestGarbage = std::chrono::nanoseconds(1s).count();
constexpr quint64 LeastGarbage = 20;  // [byte] less may be half a sentence of a sensor that was switched off
constexpr qint64 LongestSilence = std::chrono::nanoseconds(5s).count();
constexpr std::chrono::nanoseconds UsualTimeout = 2500ms;  // instruments talk once or several times a second

}  // namespace

void NmeaDriver::setOrLeave(QPlcReadChannel *channel, const std::optional<double> &value)
{
    if (value)
        channel->set(*value);
}

void NmeaDriver::configure(QPlcDriverSettings &settings)
{
    m_keys.read(settings, m_instrument.usualBaud);
    m_stream.setChecksumRequired(
        settings.choice(QStringLiteral("checksum"), {QStringLiteral("required"), QStringLiteral("optional")}) == 0);
    if (settings.has(QStringLiteral("timeout")))
        return;
    for (QPlcReadChannel *channel : values())
        channel->setTimeout(UsualTimeout);
}

bool NmeaDriver::open()
{
    QString error;
    m_stream.reset();
    m_isFirstRead = true;
    m_bytesWithoutSentence = 0;
    m_otherType.clear();
    return m_line.open(m_keys.device, m_keys.line, &error) || fail(error);
}

bool NmeaDriver::read()
{
    if (m_isFirstRead)
        m_lastByte = m_lastValue = now();
    m_isFirstRead = false;
    return readLine() && judge();
}

QString NmeaDriver::remedy(int errorNumber) const
{
    const QString text = SerialLine::remedy(errorNumber);
    return text.isEmpty() ? QPlcDriver::remedy(errorNumber) : text;
}

bool NmeaDriver::readLine()
{
    const int taken = m_line.readEach([this](char byte) {
        if (m_bytesWithoutSentence++ == 0)
            m_firstWithout = now();
        if (m_stream.feed(byte))
            take(m_stream.sentence());
    });
    if (taken < 0)
        return fail(QStringLiteral("cannot read from the serial line '%1': %2; %3")
                        .arg(m_keys.device, qt_error_string(errno), remedy(errno)));
    if (taken > 0)
        m_lastByte = now();
    return true;
}

void NmeaDriver::take(const NmeaSentence &sentence)
{
    m_bytesWithoutSentence = 0;
    if (apply(sentence))
        m_lastValue = now();
    else
        m_otherType = sentence.talker() + sentence.type();
}

// What a person who wires a sensor does wrong: another rate, another device, nothing at all.
bool NmeaDriver::judge()
{
    if (m_bytesWithoutSentence >= LeastGarbage && now() - m_firstWithout > LongestGarbage)
        return fail(
            QStringLiteral("what comes from '%1' at %2 is not NMEA 0183: not one sentence in a second; look for the "
                           "sensor's rate and format, and set 'baud' (usual are 4800, 9600, 38400) and 'format'; "
                           "when it sends no checksums, 'checksum = optional'")
                .arg(m_keys.device, m_keys.line.toString()));
    if (now() - m_lastByte > LongestSilence)
        return fail(
            QStringLiteral("nothing comes from '%1'; look at the sensor's power, at its wires (its TX is our RX), "
                           "and whether it has to be switched to sending")
                .arg(m_keys.device));
    if (!m_otherType.isEmpty() && now() - m_lastValue > LongestSilence)
        return fail(
            QStringLiteral("'%1' sends NMEA 0183, for example %2, but no %3; set the sensor up to send %4, or "
                           "take another 'device'")
                .arg(m_keys.device, QString::fromLatin1(m_otherType), m_instrument.quantity, m_instrument.sentences));
    return true;
}

}  // namespace qplc
