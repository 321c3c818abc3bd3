// SPDX-License-Identifier: Apache-2.0
#include "CanOpenEmergency.h"

#include <QtCore/QStringList>

#include <algorithm>
#include <iterator>

namespace qplc {

namespace {

struct EmergencyName
{
    quint16 code;
    const char *text;
};

// CiA 301, and CiA 402 for drives (IEC 61800-7-201). In the order of their codes.
constexpr EmergencyName emergencyNames[] = {
    {0x1000, "generic error"},
    {0x2110, "short circuit or earth leakage, at the input side"},
    {0x2120, "earth leakage, at the input side"},
    {0x2130, "short circuit, at the input side"},
    {0x2211, "current 1 inside of the device"},
    {0x2212, "current 2 inside of the device"},
    {0x2213, "over-current in the ramp function"},
    {0x2214, "over-current in the sequence"},
    {0x2220, "continuous over-current, inside of the device"},
    {0x2230, "short circuit or earth leakage, inside of the device"},
    {0x2240, "earth leakage, inside of the device"},
    {0x2250, "short circuit, inside of the device"},
    {0x2310, "continuous over-current, at the output side"},
    {0x2320, "short circuit or earth leakage, at the motor"},
    {0x2330, "earth leakage, at the motor"},
    {0x2340, "short circuit, at the motor"},
    {0x3110, "over-voltage of the mains"},
    {0x3120, "under-voltage of the mains"},
    {0x3130, "a phase of the mains is missing"},
    {0x3134, "sequence of the phases of the mains"},
    {0x3140, "frequency of the mains"},
    {0x3210, "over-voltage of the DC link"},
    {0x3220, "under-voltage of the DC link"},
    {0x3230, "load error"},
    {0x3310, "over-voltage at the output"},
    {0x3320, "armature circuit"},
    {0x3330, "field circuit"},
    {0x4110, "ambient temperature too high"},
    {0x4120, "ambient temperature too low"},
    {0x4210, "temperature of the device too high"},
    {0x4220, "temperature of the device too low"},
    {0x4310, "temperature of the drive too high"},
    {0x4320, "temperature of the drive too low"},
    {0x4410, "temperature of the supply too high"},
    {0x4420, "temperature of the supply too low"},
    {0x5110, "low voltage of the supply"},
    {0x5111, "supply of 15 V"},
    {0x5112, "supply of 24 V"},
    {0x5113, "supply of 5 V"},
    {0x5210, "measuring circuit of the control"},
    {0x5220, "computing circuit of the control"},
    {0x5410, "output stages"},
    {0x5420, "chopper"},
    {0x5430, "input stages"},
    {0x5440, "contacts"},
    {0x5450, "fuses"},
    {0x5510, "working memory"},
    {0x5520, "program memory"},
    {0x5530, "non-volatile memory"},
    {0x6010, "watchdog of the software"},
    {0x6310, "parameters are lost"},
    {0x6320, "error in the parameters"},
    {0x7110, "brake chopper"},
    {0x7111, "failure of the brake chopper"},
    {0x7112, "over-current of the brake chopper"},
    {0x7113, "protection of the brake chopper"},
    {0x7120, "motor"},
    {0x7121, "motor blocked"},
    {0x7122, "motor error, or commutation"},
    {0x7123, "motor tilted"},
    {0x7301, "tachometer"},
    {0x7302, "tachometer, wrong polarity"},
    {0x7303, "resolver 1"},
    {0x7304, "resolver 2"},
    {0x7305, "incremental encoder 1"},
    {0x7306, "incremental encoder 2"},
    {0x7310, "speed sensor"},
    {0x7320, "position sensor"},
    {0x8110, "CAN overrun: objects were lost"},
    {0x8120, "CAN in error passive mode"},
    {0x8130, "the heartbeat of the master was missing"},
    {0x8140, "recovered from bus-off"},
    {0x8150, "two devices have one CAN id"},
    {0x8210, "a PDO was too short"},
    {0x8220, "a PDO was too long"},
    {0x8230, "a multiplexed PDO found no object"},
    {0x8240, "the length of a SYNC was wrong"},
    {0x8250, "a PDO came too late"},
    {0x8311, "torque too high"},
    {0x8312, "difficult start"},
    {0x8313, "torque at standstill"},
    {0x8321, "torque too low"},
    {0x8331, "torque fault"},
    {0x8611, "following error"},
    {0x8612, "limit of the reference position"},
    {0xF001, "deceleration"},
    {0xF002, "sub-synchronous run"},
    {0xF003, "stroke operation"},
    {0xF004, "control"},
};

struct EmergencyClass
{
    quint16 mask;
    quint16 code;
    const char *text;
};

// The narrow classes come first.
constexpr EmergencyClass emergencyClasses[] = {
    {0xFF00, 0x2100, "current, at the input side"},
    {0xFF00, 0x2200, "current, inside of the device"},
    {0xFF00, 0x2300, "current, at the output side"},
    {0xFF00, 0x3100, "mains voltage"},
    {0xFF00, 0x3200, "voltage inside of the device"},
    {0xFF00, 0x3300, "output voltage"},
    {0xFF00, 0x4100, "ambient temperature"},
    {0xFF00, 0x4200, "temperature of the device"},
    {0xFF00, 0x4300, "temperature of the drive"},
    {0xFF00, 0x4400, "temperature of the supply"},
    {0xFF00, 0x5100, "supply of the device"},
    {0xFF00, 0x5200, "control of the device"},
    {0xFF00, 0x5400, "power section"},
    {0xFF00, 0x5500, "memory of the device"},
    {0xFF00, 0x6100, "internal software"},
    {0xFF00, 0x6200, "user software"},
    {0xFF00, 0x6300, "data set"},
    {0xFF00, 0x7100, "power"},
    {0xFF00, 0x7300, "sensor"},
    {0xFF00, 0x8100, "communication"},
    {0xFF00, 0x8200, "protocol"},
    {0xFF00, 0x8300, "torque controller"},
    {0xFF00, 0x8400, "speed controller"},
    {0xFF00, 0x8500, "position controller"},
    {0xFF00, 0x8600, "positioning controller"},
    {0xFF00, 0x0000, "no error"},
    {0xF000, 0x1000, "generic error"},
    {0xF000, 0x2000, "current"},
    {0xF000, 0x3000, "voltage"},
    {0xF000, 0x4000, "temperature"},
    {0xF000, 0x5000, "hardware of the device"},
    {0xF000, 0x6000, "software of the device"},
    {0xF000, 0x7000, "additional modules"},
    {0xF000, 0x8000, "monitoring"},
    {0xFF00, 0x9000, "an external error"},
    {0xFF00, 0xF000, "additional functions"},
};

// The bits of an error register, the lowest one first.
constexpr const char *registerBits[]
    = {"generic", "current", "voltage", "temperature", "communication", "profile", "reserved", "manufacturer"};

QString hexOf(unsigned number, int digits)
{
    return QString::asprintf("%0*X", digits, number);
}

}  // namespace

CanOpenEmergency CanOpenEmergency::fromFrame(const CanFrame &frame) noexcept
{
    quint64 bits = 0;
    for (int i = 0; i < Size; ++i)
        bits |= quint64(frame.data[std::size_t(i)]) << (8 * i);
    return fromBits(bits);
}

CanOpenEmergency CanOpenEmergency::fromBits(quint64 bits) noexcept
{
    CanOpenEmergency emergency;
    emergency.code = quint16(bits);
    emergency.errorRegister = quint8(bits >> 16);
    for (std::size_t i = 0; i < emergency.manufacturer.size(); ++i)
        emergency.manufacturer[i] = quint8(bits >> (24 + 8 * i));
    return emergency;
}

quint64 CanOpenEmergency::toBits() const noexcept
{
    quint64 bits = code | quint64(errorRegister) << 16;
    for (std::size_t i = 0; i < manufacturer.size(); ++i)
        bits |= quint64(manufacturer[i]) << (24 + 8 * i);
    return bits;
}

QString CanOpenEmergency::text() const
{
    QStringList bytes;
    for (const quint8 byte : manufacturer)
        bytes << hexOf(byte, 2);
    return QStringLiteral("emergency %1 (%2), error register %3 (%4), bytes of the manufacturer %5")
        .arg(hexOf(code, 4), emergencyText(code), hexOf(errorRegister, 2), errorRegisterText(errorRegister),
             bytes.join(QLatin1Char(' ')));
}

QString emergencyText(quint16 code)
{
    const auto *const name = std::find_if(std::begin(emergencyNames), std::end(emergencyNames),
                                          [code](const EmergencyName &one) { return one.code == code; });
    if (name != std::end(emergencyNames))
        return QLatin1String(name->text);
    for (const EmergencyClass &one : emergencyClasses) {
        if ((code & one.mask) == one.code)
            return QLatin1String(one.text);
    }
    return QStringLiteral("an error of the manufacturer");
}

QString errorRegisterText(quint8 errorRegister)
{
    QStringList errors;
    for (std::size_t bit = 0; bit < std::size(registerBits); ++bit) {
        if (errorRegister & (1U << bit))
            errors << QLatin1String(registerBits[bit]);
    }
    return errors.isEmpty() ? QStringLiteral("none") : errors.join(QStringLiteral(", "));
}

}  // namespace qplc
