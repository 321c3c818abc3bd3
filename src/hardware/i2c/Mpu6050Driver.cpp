// SPDX-License-Identifier: Apache-2.0
#include "I2cBus.h"
#include "QPlcDriverSettings.h"
#include "QPlcReadChannel.h"
#include "hardware/Drivers.h"
#include "hardware/RegisterDevice.h"

#include <cerrno>
#include <chrono>
#include <cmath>

namespace qplc {

namespace {

using namespace std::chrono_literals;

enum Mpu6050Register : quint8 {
    SampleRateDivider = 0x19,
    Configuration = 0x1a,  // low-pass filter; of the rate only in an MPU-6500 and its like
    RateConfiguration = 0x1b,
    AccelerationConfiguration = 0x1c,
    AccelerationFilter = 0x1d,  // of an MPU-6500 and its like
    InterruptEnable = 0x38,
    InterruptStatus = 0x3a,  // and behind it acceleration, temperature, rate
    UserControl = 0x6a,
    PowerManagement = 0x6b,
    AxesManagement = 0x6c,
    WhoAmI = 0x75
};
constexpr int SampleBytes = 15;       // from InterruptStatus on
constexpr quint8 DataReady = 0x01;    // in InterruptEnable and InterruptStatus
constexpr quint8 ClockOfGyro = 0x01;  // in PowerManagement; and awake

constexpr double StandardGravity = 9.80665;                            // [m/s^2]
constexpr double AccelerationPerRange = StandardGravity * 2 / 32768;   // [m/s^2] a count in the range of 2 g
constexpr double RatePerRange = 3.14159265358979323846 / 180.0 / 131;  // [rad/s] a count in the range of 250 deg/s

double countsAt(const quint8 *bytes)
{
    return qint16(quint16(bytes[0] << 8 | bytes[1]));
}

bool isKnownIdentity(quint8 identity)
{
    for (const int known : {0x68, 0x70, 0x71, 0x73}) {  // MPU-6050 and 9150, 6500, 9250, 9255
        if (identity == known)
            return true;
    }
    return false;
}

/// Kind `mpu6050`: the inertial sensor MPU-6050 and its like: MPU-9150, which has one inside,
/// MPU-6500, and MPU-9250 and 9255, which have that one. See docs/hardware/i2c.md.
///
/// Axes are those that are printed on the chip.
class Mpu6050Driver final : public QPlcDriver
{
public:
    Mpu6050Driver()
        : QPlcDriver(OwnPace)
    {
    }

protected:
    void configure(QPlcDriverSettings &settings) override
    {
        m_device = settings.requiredText(QStringLiteral("device"), QStringLiteral("/dev/i2c-1"));
        m_address = int(settings.integer(QStringLiteral("address"), 0x68, I2cBus::FirstAddress, I2cBus::LastAddress));
        m_accelerationRange = quint8(settings.choice(
            QStringLiteral("accelerationRange"),
            {QStringLiteral("2 g"), QStringLiteral("4 g"), QStringLiteral("8 g"), QStringLiteral("16 g")}, 1));
        m_rateRange = quint8(settings.choice(QStringLiteral("rateRange"),
                                             {QStringLiteral("250 deg/s"), QStringLiteral("500 deg/s"),
                                              QStringLiteral("1000 deg/s"), QStringLiteral("2000 deg/s")},
                                             1));
        setUpRates(settings);
        claimI2cAddress(m_device, m_address, settings);
        m_bus.configure(settings);
    }

    bool open() override
    {
        QString error;
        if (!m_bus.open(I2cBus::open(m_device, m_address, &error)))
            return fail(error);
        return checkIdentity() && wakeUp();
    }

    void close() override { m_bus.close(); }
    bool read() override
    {
        quint8 bytes[SampleBytes] = {};
        if (m_lastSample == 0)
            m_lastSample = now();
        if (!m_bus.read(InterruptStatus, bytes, SampleBytes)) {
            failToTalk();
            return m_bus.keep(now(), timeout().count());
        }
        m_bus.succeed(now());
        if (!(bytes[0] & DataReady)) {
            const bool isLate = now() - m_lastSample > std::chrono::nanoseconds(1s + timeout()).count();
            return !isLate
                || fail(QStringLiteral("the MPU-6050 at %1 of %2 gives no samples any more: it has lost its settings, "
                                       "probably its power; look at its supply")
                            .arg(RegisterBus::byteText(m_address), m_device));
        }
        m_lastSample = now();
        const double acceleration = AccelerationPerRange * double(1 << m_accelerationRange);
        const double rate = RatePerRange * double(1 << m_rateRange);
        for (int axis = 0; axis < 3; ++axis) {
            m_acceleration[axis].set(acceleration * countsAt(bytes + 1 + 2 * axis));
            m_rate[axis].set(rate * countsAt(bytes + 9 + 2 * axis));
        }
        const double counts = countsAt(bytes + 7);
        m_temperature.set(m_isMpu6500 ? counts / 333.87 + 21.0 : counts / 340.0 + 36.53);
        return true;
    }

    QString remedy(int errorNumber) const override
    {
        const QString text = i2cRemedy(errorNumber);
        return text.isEmpty() ? QPlcDriver::remedy(errorNumber) : text;
    }

private:
    bool checkIdentity()
    {
        quint8 identity = 0;
        if (!m_bus.read(WhoAmI, &identity, 1))
            return failToTalk();
        m_isMpu6500 = identity != 0x68;
        return isKnownIdentity(identity)
            || fail(QStringLiteral(
                        "the device at %1 of %2 is not an MPU-6050: its register WHO_AM_I (0x75) is %3, and not 0x68; "
                        "the sensor answers at 0x68, or at 0x69 when its pin AD0 is high: look at 'address'")
                        .arg(RegisterBus::byteText(m_address), m_device, RegisterBus::byteText(identity)));
    }

    bool wakeUp()
    {
        struct Order
        {
            quint8 reg;
            quint8 value;
        };
        const Order orders[] = {
            {PowerManagement, ClockOfGyro},
            {AxesManagement, 0},  // none is asleep
            {UserControl, 0},     // no queue: newest sample only
            {SampleRateDivider, m_divider},
            {Configuration, m_filter},
            {RateConfiguration, quint8(m_rateRange << 3)},
            {AccelerationConfiguration, quint8(m_accelerationRange << 3)},
            {AccelerationFilter, m_filter},
            {InterruptEnable, DataReady},
        };
        for (const Order &order : orders) {
            if ((m_isMpu6500 || order.reg != AccelerationFilter) && !m_bus.write(order.reg, &order.value, 1))
                return failToTalk();
        }
        m_lastSample = 0;
        return true;
    }

    void setUpRates(QPlcDriverSettings &settings)
    {
        // The index is that of the register, where 0 switches the filter off; its clock is 1 kHz
        // with a filter.
        const QStringList bandwidths{QStringLiteral("188 Hz"), QStringLiteral("98 Hz"), QStringLiteral("42 Hz"),
                                     QStringLiteral("20 Hz"),  QStringLiteral("10 Hz"), QStringLiteral("5 Hz")};
        m_filter = quint8(1 + settings.choice(QStringLiteral("bandwidth"), bandwidths, 2));
        const QString key = QStringLiteral("sampleRate");
        const double rate = settings.number(key, 200.0, 4.0, 1000.0);
        const double divider = 1000.0 / rate;
        if (std::abs(divider - std::round(divider)) > 1e-6 * divider)
            settings.addError(
                key,
                QStringLiteral("the device takes 1000 Hz divided by a whole number; near are %1 Hz and %2 Hz")
                    .arg(1000.0 / std::ceil(divider))
                    .arg(1000.0 / std::floor(divider)));
        m_divider = quint8(std::lround(divider) - 1);
    }

    bool failToTalk()
    {
        const int errorNumber = errno;
        return fail(
            QStringLiteral("cannot talk to the MPU-6050 at %1 of %2: %3; %4")
                .arg(RegisterBus::byteText(m_address), m_device, qt_error_string(errorNumber), remedy(errorNumber)));
    }

    QString m_device;
    int m_address = 0;
    bool m_isMpu6500 = false;  // or one that has it inside
    quint8 m_filter = 0;       // register CONFIG
    quint8 m_divider = 0;      // register SMPLRT_DIV
    quint8 m_rateRange = 0;
    quint8 m_accelerationRange = 0;
    RegisterDevice m_bus{this};
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

}  // namespace

std::unique_ptr<QPlcDriver> createMpu6050Driver()
{
    return std::make_unique<Mpu6050Driver>();
}

}  // namespace qplc
