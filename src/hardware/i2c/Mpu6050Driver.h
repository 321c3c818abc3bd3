// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "I2cBus.h"
#include "QPlcDriver.h"
#include "QPlcReadChannel.h"

#include <memory>

namespace qplc {

/// Kind `mpu6050`: the inertial sensor MPU-6050 and its like: MPU-9150, which has one inside,
/// MPU-6500, and MPU-9250 and 9255, which have that one. See docs/hardware/i2c.md.
///
/// Axes are those that are printed on the chip.
class Mpu6050Driver : public QPlcDriver
{
public:
    Mpu6050Driver();

protected:
    void configure(QPlcDriverSettings &settings) override;
    bool open() override;
    void close() override { m_bus.reset(); }
    bool read() override;
    QString remedy(int errorNumber) const override;

private:
    bool checkIdentity();
    bool wakeUp();
    void setUpRates(QPlcDriverSettings &settings);
    bool failToTalk();

    QString m_device;
    int m_address = 0;
    bool m_isMpu6500 = false;  // or one that has it inside
    quint8 m_filter = 0;       // register CONFIG
    quint8 m_divider = 0;      // register SMPLRT_DIV
    quint8 m_rateRange = 0;
    quint8 m_accelerationRange = 0;
    std::unique_ptr<I2cBus> m_bus;
    qint64 m_lastSample = 0;  // when it came [ns]; 0: the device has just been opened

    QPlcReadChannel m_acceleration[3] = {
        {this, QStringLiteral("accelerationX")},
        {this, QStringLiteral("accelerationY")},
        {this, QStringLiteral("accelerationZ")},
    };  // [m/s^2]
    QPlcReadChannel m_rate[3] = {
        {this, QStringLiteral("rateX")},
        {this, QStringLiteral("rateY")},
        {this, QStringLiteral("rateZ")},
    };                                                                   // [rad/s]
    QPlcReadChannel m_temperature{this, QStringLiteral("temperature")};  // of the chip [degC]
};

}  // namespace qplc
