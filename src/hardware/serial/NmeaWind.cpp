// SPDX-License-Identifier: Apache-2.0
#include "NmeaWind.h"

#include "NmeaUnits.h"

#include <cmath>

namespace qplc {

namespace {

constexpr double MetresPerSecondOfMph = 0.44704;
constexpr double PascalOfBar = 1e5;
constexpr double TwoPi = 2 * 3.14159265358979323846;

std::optional<double> numberAt(const NmeaSentence &sentence, int index)
{
    double number = 0.0;
    return sentence.number(index, &number) ? std::optional<double>(number) : std::nullopt;
}

/// \param letter  that has to stand behind the number
std::optional<double> numberAt(const NmeaSentence &sentence, int index, char letter)
{
    return sentence.isLetter(index + 1, letter) ? numberAt(sentence, index) : std::nullopt;
}

/// [rad] of degrees, brought to one turn
std::optional<double> angleOf(std::optional<double> degrees)
{
    if (!degrees || std::abs(*degrees) > 360.0)
        return std::nullopt;
    const double angle = *degrees / 360.0 * TwoPi;
    return angle < 0.0 ? angle + TwoPi : angle >= TwoPi ? 0.0 : angle;
}

std::optional<double> speedOf(std::optional<double> number, double factor)
{
    return number && *number >= 0.0 ? std::optional<double>(*number * factor) : std::nullopt;
}

std::optional<double> speedOfLetter(const NmeaSentence &sentence, int index)
{
    const std::optional<double> number = numberAt(sentence, index);
    const QByteArray unit = sentence.field(index + 1);
    if (unit == "M")
        return speedOf(number, 1.0);
    if (unit == "N")
        return speedOf(number, MetresPerSecondOfKnot);
    if (unit == "K")
        return speedOf(number, MetresPerSecondOfKmh);
    if (unit == "S")
        return speedOf(number, MetresPerSecondOfMph);
    return std::nullopt;
}

/// angle, R or T, speed, unit, A or V
void readMwv(const NmeaSentence &sentence, NmeaWind *result)
{
    const bool isRelative = sentence.isLetter(1, 'R');
    if (!isRelative && !sentence.isLetter(1, 'T'))
        return;
    result->isValid = sentence.isLetter(4, 'A');
    if (!*result->isValid)
        return;
    NmeaWind::Wind &wind = isRelative ? result->relative : result->theoretical;
    wind.angle = angleOf(numberAt(sentence, 0));
    wind.speed = speedOfLetter(sentence, 2);
}

/// angle to the left or right, and the speed in knots, m/s, km/h
void readVwr(const NmeaSentence &sentence, NmeaWind::Wind *wind)
{
    const std::optional<double> angle = numberAt(sentence, 0);
    if (angle && *angle >= 0.0 && *angle <= 180.0) {
        if (sentence.isLetter(1, 'L'))
            wind->angle = angleOf(-*angle);
        else if (sentence.isLetter(1, 'R'))
            wind->angle = angleOf(*angle);
    }
    for (const int index : {4, 2, 6}) {
        if (!wind->speed)
            wind->speed = speedOfLetter(sentence, index);
    }
}

/// The weather as a whole: each value has its place, and its unit behind it.
void readMda(const NmeaSentence &sentence, NmeaWind *result)
{
    if (const auto bars = numberAt(sentence, 2, 'B'))
        result->pressure = *bars * PascalOfBar;
    result->temperature = numberAt(sentence, 4, 'C');
    if (const auto percent = numberAt(sentence, 8))
        result->humidity = *percent / 100.0;
    result->direction = angleOf(numberAt(sentence, 12, 'T'));
    result->theoretical.speed = speedOf(numberAt(sentence, 18, 'M'), 1.0);
    if (!result->theoretical.speed)
        result->theoretical.speed = speedOf(numberAt(sentence, 16, 'N'), MetresPerSecondOfKnot);
}

/// Groups of kind, value, unit, name of the transducer. The first one of each kind counts.
void readXdr(const NmeaSentence &sentence, NmeaWind *result)
{
    for (int i = 0; i + 2 < sentence.fieldCount(); i += 4) {
        const std::optional<double> number = numberAt(sentence, i + 1);
        if (!number)
            continue;
        if (sentence.isLetter(i, 'C') && sentence.isLetter(i + 2, 'C') && !result->temperature)
            result->temperature = number;
        else if (sentence.isLetter(i, 'H') && sentence.isLetter(i + 2, 'P') && !result->humidity)
            result->humidity = *number / 100.0;
        else if (sentence.isLetter(i, 'P') && sentence.isLetter(i + 2, 'B') && !result->pressure)
            result->pressure = *number * PascalOfBar;
        else if (sentence.isLetter(i, 'P') && sentence.isLetter(i + 2, 'P') && !result->pressure)
            result->pressure = number;
    }
}

}  // namespace

NmeaWind NmeaWind::read(const NmeaSentence &sentence)
{
    NmeaWind result;
    result.isOfWind = true;
    const QByteArray type = sentence.talker() == "P" ? QByteArray() : sentence.type();
    if (type == "MWV")
        readMwv(sentence, &result);
    else if (type == "VWR")
        readVwr(sentence, &result.relative);
    else if (type == "VWT")
        readVwr(sentence, &result.theoretical);
    else if (type == "MDA")
        readMda(sentence, &result);
    else if (type == "XDR")
        readXdr(sentence, &result);
    else
        result.isOfWind = false;
    return result;
}

}  // namespace qplc
