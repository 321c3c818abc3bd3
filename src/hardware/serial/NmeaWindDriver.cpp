// SPDX-License-Identifier: Apache-2.0
#include "NmeaDriver.h"
#include "NmeaWind.h"
#include "QPlcReadChannel.h"
#include "hardware/Drivers.h"

namespace qplc {

namespace {

/// Kind `nmea-wind`: a wind sensor or weather station that speaks NMEA 0183 over a serial line. See
/// docs/hardware/serial.md.
class NmeaWindDriver final : public NmeaDriver
{
public:
    NmeaWindDriver()
        : NmeaDriver({4800, QStringLiteral("wind"), QStringLiteral("MWV (or VWR, VWT, MDA, XDR)")})
    {
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

    std::vector<QPlcReadChannel *> values() override
    {
        return {&m_relative.speed, &m_relative.angle, &m_true.speed, &m_true.angle, &m_direction,
                &m_temperature,    &m_pressure,       &m_humidity,   &m_status};
    }

    bool apply(const NmeaSentence &sentence) override
    {
        const NmeaWind wind = NmeaWind::read(sentence);
        if (!wind.isOfWind)
            return false;
        setOrLeave(&m_relative.speed, wind.relative.speed);
        setOrLeave(&m_relative.angle, wind.relative.angle);
        setOrLeave(&m_true.speed, wind.theoretical.speed);
        setOrLeave(&m_true.angle, wind.theoretical.angle);
        setOrLeave(&m_direction, wind.direction);
        setOrLeave(&m_temperature, wind.temperature);
        setOrLeave(&m_pressure, wind.pressure);
        setOrLeave(&m_humidity, wind.humidity);
        if (!wind.isValid)
            return true;
        m_status.set(*wind.isValid ? 1.0 : 0.0);
        if (!*wind.isValid) {  // the sensor says so itself: its last value counts no more
            WindChannels &channels = sentence.isLetter(1, 'R') ? m_relative : m_true;
            channels.speed.invalidate();
            channels.angle.invalidate();
        }
        return true;
    }

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
