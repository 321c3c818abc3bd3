// SPDX-License-Identifier: Apache-2.0
#include "SysfsText.h"

#include "hardware/RawNumber.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr int ScratchpadBytes = 9;
constexpr double LowestTemperature = -55.0;  // [degC] of all sensors of this kind
constexpr double HighestTemperature = 125.0;

struct Unit
{
    const char *type;
    double factor;
};

/// Letters at the beginning: "voltage" of "voltage0-voltage1", "accel" of "accel_x".
QByteArray typeOf(const QByteArray &channel)
{
    const auto end = std::find_if_not(channel.cbegin(), channel.cend(),
                                      [](char character) { return character >= 'a' && character <= 'z'; });
    return channel.left(int(end - channel.cbegin()));
}

template<std::size_t Count>
double unitOf(const QByteArray &channel, const Unit (&units)[Count])
{
    const QByteArray type = typeOf(channel);
    for (const Unit &unit : units) {
        if (type == unit.type)
            return unit.factor;
    }
    return 1.0;
}

bool readScratchpad(const QByteArray &line, quint8 *bytes)
{
    const QByteArrayList words = line.simplified().split(' ');
    if (words.size() < ScratchpadBytes)
        return false;
    for (int i = 0; i < ScratchpadBytes; ++i) {
        bool isNumber = false;
        bytes[i] = quint8(words[i].toUInt(&isNumber, 16));
        if (!isNumber || words[i].size() != 2)
            return false;
    }
    return true;
}

/// A sensor holds 85 degC before its first measurement and after its power has failed. A measured
/// 85 degC has another byte 6.
bool isOfPowerOn(const quint8 *bytes)
{
    return bytes[0] == 0x50 && bytes[1] == 0x05 && bytes[6] == 0x0c;
}

}  // namespace

std::optional<double> SysfsText::number(const QByteArray &text)
{
    bool isNumber = false;
    const double number = text.trimmed().toDouble(&isNumber);
    return isNumber && std::isfinite(number) ? std::optional<double>(number) : std::nullopt;
}

std::optional<double> SysfsText::count(const QByteArray &text, int bits, bool isSigned)
{
    bool isNumber = false;
    const quint64 number = text.trimmed().toULongLong(&isNumber);
    if (!isNumber)
        return std::nullopt;
    return RawNumber{isSigned ? RawNumber::Signed : RawNumber::Unsigned, bits}.decode(number);
}

SysfsText::Thermometer SysfsText::thermometer(const QByteArray &text)
{
    const QByteArrayList lines = text.split('\n');
    quint8 bytes[ScratchpadBytes] = {};
    const int place = lines.value(1).indexOf("t=");
    const std::optional<double> thousandths = place < 0 ? std::nullopt : number(lines[1].mid(place + 2));
    if (!readScratchpad(lines.first(), bytes) || !thousandths)
        return {"it does not contain a temperature; check that the device is a thermometer (its id begins with 10, 22, "
                "28, 3b or 42)"};
    if (!lines.first().trimmed().endsWith("YES"))
        return {"its checksum is wrong; look at the wires, the pull-up resistor (4.7 kOhm) and the length of the bus"};
    // Zeros alone have the right checksum.
    if (std::all_of(std::begin(bytes), std::end(bytes), [](quint8 byte) { return byte == 0; }))
        return {"its data line stays low; look for a short circuit"};
    if (isOfPowerOn(bytes))
        return {"it has not measured, its power has failed; look at its supply (without a wire for it, the bus needs "
                "a strong pull-up)"};
    const double temperature = *thousandths * 1e-3;
    if (temperature < LowestTemperature || temperature > HighestTemperature)
        return {"the temperature is outside of -55 to 125 degC; replace the sensor"};
    return {nullptr, temperature};
}

QByteArrayList SysfsText::iioFiles(const QByteArray &direction, const QByteArray &channel, const QByteArray &attribute)
{
    QByteArray shared;  // by all channels of the type
    for (const char character : channel) {
        if (character == '_')
            break;
        if (character < '0' || character > '9')
            shared += character;
    }
    QByteArrayList files;
    for (const QByteArray &name : {direction + channel + '_', direction + shared + '_', direction, QByteArray()}) {
        if (!files.contains(name + attribute))
            files << name + attribute;
    }
    return files;
}

double SysfsText::iioUnit(const QByteArray &channel)
{
    constexpr Unit units[] = {
        {"voltage", 1e-3},           // mV
        {"altvoltage", 1e-3},        // mV
        {"current", 1e-3},           // mA
        {"altcurrent", 1e-3},        // mA
        {"power", 1e-3},             // mW
        {"temp", 1e-3},              // thousandths of degC
        {"humidityrelative", 1e-5},  // thousandths of a percent
        {"pressure", 1e3},           // kPa
        {"capacitance", 1e-9},       // nF
        {"magn", 1e-4},              // gauss
        {"incli", 3.14159265358979323846 / 180.0},
    };
    return unitOf(channel, units);
}

double SysfsText::hwmonUnit(const QByteArray &channel)
{
    constexpr Unit units[] = {
        {"in", 1e-3},        // mV
        {"curr", 1e-3},      // mA
        {"power", 1e-6},     // uW
        {"energy", 1e-6},    // uJ
        {"temp", 1e-3},      // thousandths of degC
        {"humidity", 1e-5},  // thousandths of a percent
    };
    return unitOf(channel, units);
}

}  // namespace qplc
