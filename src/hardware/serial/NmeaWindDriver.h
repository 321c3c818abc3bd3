// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NmeaStream.h"
#include "NmeaWind.h"
#include "QPlcDriver.h"
#include "QPlcReadChannel.h"
#include "SerialLine.h"

namespace qplc {

/// Kind `nmea-wind`: a wind sensor or weather station that speaks NMEA 0183 over a serial line. See
/// docs/hardware/serial.md.
class NmeaWindDriver : public QPlcDriver
{
public:
    NmeaWindDriver();

protected:
    void configure(QPlcDriverSettings &settings) override;
    bool open() override;
    void close() override { m_line.close(); }
    bool read() override;
    QString remedy(int errorNumber) const override;

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

    void configureTimeout(QPlcDriverSettings &settings);
    bool readLine();
    void apply(const NmeaSentence &sentence);
    void publish(const NmeaWind &wind, const NmeaSentence &sentence);
    bool judge();

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

}  // namespace qplc
