// SPDX-License-Identifier: Apache-2.0
#include "NmeaDriver.h"
#include "NmeaFix.h"
#include "QPlcReadChannel.h"
#include "hardware/Drivers.h"

namespace qplc {

namespace {

/// Kind `nmea-gnss`: a receiver for satellite navigation that speaks NMEA 0183 over a serial line.
/// See docs/hardware/serial.md.
class NmeaGnssDriver final : public NmeaDriver
{
public:
    NmeaGnssDriver()
        : NmeaDriver({9600, QStringLiteral("position"), QStringLiteral("GGA and RMC (or VTG)")})
    {
    }

private:
    std::vector<QPlcReadChannel *> values() override
    {
        return {&m_latitude, &m_longitude, &m_altitude,   &m_separation, &m_speed,         &m_course,
                &m_time,     &m_quality,   &m_satellites, &m_hdop,       &m_correctionAge, &m_status};
    }

    bool apply(const NmeaSentence &sentence) override
    {
        const NmeaFix fix = NmeaFix::read(sentence);
        setOrLeave(&m_quality, fix.quality);
        setOrLeave(&m_satellites, fix.satellites);
        setOrLeave(&m_hdop, fix.hdop);
        if (fix.hasPosition)
            setPosition(fix);
        if (fix.hasMotion)
            setMotion(fix);
        return fix.isOfFix;
    }

    // What the receiver does not call measured counts no more, at once.
    void setPosition(const NmeaFix &fix)
    {
        m_status.set(*fix.hasPosition ? 1.0 : 0.0);
        setOrLeave(&m_latitude, fix.latitude);
        setOrLeave(&m_longitude, fix.longitude);
        setOrLeave(&m_altitude, fix.altitude);
        setOrLeave(&m_separation, fix.geoidSeparation);
        setOrLeave(&m_correctionAge, fix.correctionAge);
        setOrLeave(&m_time, fix.time);
        if (*fix.hasPosition)
            return;
        for (QPlcReadChannel *channel :
             {&m_latitude, &m_longitude, &m_altitude, &m_separation, &m_correctionAge, &m_time})
            channel->invalidate();
    }

    void setMotion(const NmeaFix &fix)
    {
        setOrLeave(&m_speed, fix.speed);
        setOrLeave(&m_course, fix.course);
        if (*fix.hasMotion)
            return;
        m_speed.invalidate();
        m_course.invalidate();
    }

    QPlcReadChannel m_latitude{this, QStringLiteral("latitude")};            // [rad]
    QPlcReadChannel m_longitude{this, QStringLiteral("longitude")};          // [rad]
    QPlcReadChannel m_altitude{this, QStringLiteral("altitude")};            // [m]
    QPlcReadChannel m_separation{this, QStringLiteral("geoidSeparation")};   // [m]
    QPlcReadChannel m_speed{this, QStringLiteral("speed")};                  // [m/s]
    QPlcReadChannel m_course{this, QStringLiteral("course")};                // [rad]
    QPlcReadChannel m_time{this, QStringLiteral("time")};                    // [s]
    QPlcReadChannel m_quality{this, QStringLiteral("fixQuality")};           // 0 ... 8
    QPlcReadChannel m_satellites{this, QStringLiteral("satellites")};        //
    QPlcReadChannel m_hdop{this, QStringLiteral("hdop")};                    //
    QPlcReadChannel m_correctionAge{this, QStringLiteral("correctionAge")};  // [s]
    QPlcReadChannel m_status{this, QStringLiteral("status")};                // 1: the receiver has a position
};

}  // namespace

std::unique_ptr<QPlcDriver> createNmeaGnssDriver()
{
    return std::make_unique<NmeaGnssDriver>();
}

}  // namespace qplc
