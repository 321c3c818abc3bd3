// SPDX-License-Identifier: Apache-2.0
#include "NmeaStream.h"
#include "NmeaWind.h"
#include "QPlcDriverSettings.h"
#include "QPlcReadChannel.h"
#include "SerialLine.h"
#include "hardware/Drivers.h"

#include <cerrno>

namespace qplc {

namespace {

using namespace std::chrono_literals;

constexpr qint64 LongestGarbage = std::chrono::nanoseconds(1s).count();
constexpr quint64 LeastGarbage = 20;  // [byte] less may be half a sentence of a sensor that was switched off
constexpr qint64 LongestSilence = std::chrono::nanoseconds(5s).count();
constexpr std::chrono::nanoseconds UsualTimeout = 2500ms;  // wind sensors talk once or several times a second
constexpr int MostBytesAtOnce = 4096;                      // in one call: a line that never rests must not hold us

void setOrLeave(QPlcReadChannel *channel, const std::optional<double> &value)
{
    if (value)
        channel->set(*value);
}

/// Kind `nmea-wind`: a wind sensor or weather station that speaks NMEA 0183 over a serial line. See
/// docs/hardware/serial.md.
class NmeaWindDriver final : public QPlcDriver
{
public:
    NmeaWindDriver()
        : QPlcDriver(OwnPace)
    {
    }

protected:
    void configure(QPlcDriverSettings &settings) override
    {
        m_device = settings.requiredText(QStringLiteral("device"), QStringLiteral("/dev/ttyUSB0"));
        settings.claim(QStringLiteral("device"), QStringLiteral("serial line ") + m_device);
        m_settings.baud = int(settings.integer(QStringLiteral("baud"), 4800, 1, 10000000));
        if (!SerialLine::isKnownRate(m_settings.baud))
            settings.addError(QStringLiteral("baud"),
                              QStringLiteral("%1 is not a rate of a serial line; there are %2")
                                  .arg(m_settings.baud)
                                  .arg(SerialLine::knownRates()));
        const QString format = settings.text(QStringLiteral("format"), QStringLiteral("8N1"));
        if (!m_settings.setFormat(format))
            settings.addError(QStringLiteral("format"),
                              QStringLiteral("'%1' is not a format of a serial line; it is data bits, "
                                             "parity (N, E, O) and stop bits: '8N1', '7E1'")
                                  .arg(format));
        m_stream.setChecksumRequired(
            settings.choice(QStringLiteral("checksum"), {QStringLiteral("required"), QStringLiteral("optional")}) == 0);
        configureTimeout(settings);
    }

    bool open() override
    {
        QString error;
        m_stream.reset();
        m_isFirstRead = true;
        m_bytesWithoutSentence = 0;
        m_otherType.clear();
        return m_line.open(m_device, m_settings, &error) || fail(error);
    }

    void close() override { m_line.close(); }
    bool read() override
    {
        if (m_isFirstRead)
            m_lastByte = m_lastSentence = m_lastWind = now();
        m_isFirstRead = false;
        return readLine() && judge();
    }

    QString remedy(int errorNumber) const override
    {
        const QString text = SerialLine::remedy(errorNumber);
        return text.isEmpty() ? QPlcDriver::remedy(errorNumber) : text;
    }

private:
    struct WindChannels
    {
        WindChannels(QPlcDriver *driver, const QString &prefix)
            : speed(driver, prefix + QStringLiteral("Speed"))
            , angle(driver, prefix + QStringLiteral("Angle"))
        {
        }
        QPlcReadChannel speed;  // [m/s]
        QPlcReadChannel angle;  // [rad]
    };

    void configureTimeout(QPlcDriverSettings &settings)
    {
        if (settings.has(QStringLiteral("timeout")))
            return;
        for (QPlcReadChannel *channel : {&m_relative.speed, &m_relative.angle, &m_true.speed, &m_true.angle,
                                         &m_direction, &m_temperature, &m_pressure, &m_humidity, &m_status})
            channel->setTimeout(UsualTimeout);
    }

    bool readLine()
    {
        char bytes[256];
        int taken = 0;
        for (int count = 1; count > 0 && taken < MostBytesAtOnce; taken += count) {
            count = m_line.read(bytes, sizeof bytes);
            if (count < 0)
                return fail(QStringLiteral("cannot read from the serial line '%1': %2; %3")
                                .arg(m_device, qt_error_string(errno), remedy(errno)));
            for (int i = 0; i < count; ++i) {
                if (m_bytesWithoutSentence++ == 0)
                    m_firstWithout = now();
                if (m_stream.feed(bytes[i]))
                    apply(m_stream.sentence());
            }
        }
        if (taken > 0)
            m_lastByte = now();
        return true;
    }

    void apply(const NmeaSentence &sentence)
    {
        m_lastSentence = now();
        m_bytesWithoutSentence = 0;
        const NmeaWind wind = NmeaWind::read(sentence);
        if (!wind.isOfWind) {
            m_otherType = sentence.talker() + sentence.type();
            return;
        }
        m_lastWind = now();
        publish(wind, sentence);
    }

    void publish(const NmeaWind &wind, const NmeaSentence &sentence)
    {
        setOrLeave(&m_relative.speed, wind.relative.speed);
        setOrLeave(&m_relative.angle, wind.relative.angle);
        setOrLeave(&m_true.speed, wind.theoretical.speed);
        setOrLeave(&m_true.angle, wind.theoretical.angle);
        setOrLeave(&m_direction, wind.direction);
        setOrLeave(&m_temperature, wind.temperature);
        setOrLeave(&m_pressure, wind.pressure);
        setOrLeave(&m_humidity, wind.humidity);
        if (!wind.isValid)
            return;
        m_status.set(*wind.isValid ? 1.0 : 0.0);
        if (!*wind.isValid) {  // the sensor says so itself: its last value counts no more
            WindChannels &channels = sentence.isLetter(1, 'R') ? m_relative : m_true;
            channels.speed.invalidate();
            channels.angle.invalidate();
        }
    }

    // What a person who wires a sensor does wrong: another rate, another device, nothing at all.
    bool judge()
    {
        if (m_bytesWithoutSentence >= LeastGarbage && now() - m_firstWithout > LongestGarbage)
            return fail(QStringLiteral(
                            "what comes from '%1' at %2 is not NMEA 0183: not one sentence in a second; look for the "
                            "sensor's rate and format, and set 'baud' (usual are 4800, 9600, 38400) and 'format'; "
                            "when it sends no checksums, 'checksum = optional'")
                            .arg(m_device, m_settings.toString()));
        if (now() - m_lastByte > LongestSilence)
            return fail(
                QStringLiteral("nothing comes from '%1'; look at the sensor's power, at its wires (its TX is our RX), "
                               "and whether it has to be switched to sending")
                    .arg(m_device));
        if (!m_otherType.isEmpty() && now() - m_lastWind > LongestSilence)
            return fail(
                QStringLiteral("'%1' sends NMEA 0183, for example %2, but no wind; set the sensor up to send MWV "
                               "(or VWR, VWT, MDA, XDR), or take another 'device'")
                    .arg(m_device, QString::fromLatin1(m_otherType)));
        return true;
    }

    QString m_device;
    SerialSettings m_settings;
    SerialLine m_line;
    NmeaStream m_stream;

    // when it happened last [ns]
    bool m_isFirstRead = true;
    qint64 m_lastByte = 0;
    qint64 m_lastSentence = 0;
    qint64 m_lastWind = 0;
    quint64 m_bytesWithoutSentence = 0;
    qint64 m_firstWithout = 0;  // when the first of them came
    QByteArray m_otherType;     // of a sentence that is not about wind

    WindChannels m_relative{this, QStringLiteral("relative")};
    WindChannels m_true{this, QStringLiteral("true")};
    QPlcReadChannel m_direction{this, QStringLiteral("direction")};      // [rad]
    QPlcReadChannel m_temperature{this, QStringLiteral("temperature")};  // [degC]
    QPlcReadChannel m_pressure{this, QStringLiteral("pressure")};        // [Pa]
    QPlcReadChannel m_humidity{this, QStringLiteral("humidity")};        // 0 ... 1
    QPlcReadChannel m_status{this, QStringLiteral("status")};            // 1: the sensor calls its wind valid
};

}  // namespace

std::unique_ptr<QPlcDriver> createNmeaWindDriver()
{
    return std::make_unique<NmeaWindDriver>();
}

}  // namespace qplc
