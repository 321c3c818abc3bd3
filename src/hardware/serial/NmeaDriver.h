// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NmeaStream.h"
#include "QPlcDriver.h"
#include "SerialKeys.h"

#include <optional>

namespace qplc {

/// An instrument on a serial line that speaks NMEA 0183. The driver reads the line, and its errors
/// name mistakes of wiring and set-up. See docs/hardware/serial.md.
class NmeaDriver : public QPlcDriver
{
public:
    /// For keys and messages.
    struct Instrument
    {
        int usualBaud;
        QString quantity;   // "wind"
        QString sentences;  // "MWV (or VWR, VWT, MDA, XDR)"
    };

protected:
    explicit NmeaDriver(const Instrument &instrument)
        : QPlcDriver(OwnPace)
        , m_instrument(instrument)
    {
    }

    /// Channels that get values from the instrument.
    virtual std::vector<QPlcReadChannel *> values() = 0;
    /// \return false when the sentence says nothing about the quantity of the instrument
    virtual bool apply(const NmeaSentence &sentence) = 0;
    static void setOrLeave(QPlcReadChannel *channel, const std::optional<double> &value);

    void configure(QPlcDriverSettings &settings) override;
    bool open() override;
    void close() override { m_line.close(); }
    bool read() override;
    QString remedy(int errorNumber) const override;

private:
    bool readLine();
    void take(const NmeaSentence &sentence);
    bool judge();

    const Instrument m_instrument;
    SerialKeys m_keys;
    SerialLine m_line;
    NmeaStream m_stream;

    // when it happened last [ns]
    bool m_isFirstRead = true;
    qint64 m_lastByte = 0;
    qint64 m_lastValue = 0;
    quint64 m_bytesWithoutSentence = 0;
    qint64 m_firstWithout = 0;  // when the first of them came
    QByteArray m_otherType;     // of a sentence about something else
};

}  // namespace qplc
