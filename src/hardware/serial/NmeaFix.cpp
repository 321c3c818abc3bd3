// SPDX-License-Identifier: Apache-2.0
#include "NmeaFix.h"

#include "NmeaUnits.h"

#include <QtCore/QDateTime>

#include <cmath>

namespace qplc {

namespace {

constexpr double RadiansOfDegree = 3.14159265358979323846 / 180.0;
constexpr int FirstYear = 1980;  // of two digits: the receivers are younger

std::optional<double> numberAt(const NmeaSentence &sentence, int index, double lowest, double highest)
{
    double number = 0.0;
    const bool isRight = sentence.number(index, &number) && number >= lowest && number <= highest;
    return isRight ? std::optional<double>(number) : std::nullopt;
}

std::optional<double> scaledAt(const NmeaSentence &sentence, int index, double factor)
{
    const std::optional<double> number = numberAt(sentence, index, 0.0, 1e6);
    return number ? std::optional<double>(*number * factor) : std::nullopt;
}

/// 0 ... 360 degrees
std::optional<double> courseAt(const NmeaSentence &sentence, int index)
{
    const std::optional<double> degrees = numberAt(sentence, index, 0.0, 360.0);
    return degrees ? std::optional<double>(*degrees == 360.0 ? 0.0 : *degrees * RadiansOfDegree) : std::nullopt;
}

/// Degrees and minutes in one number ("4807.038"), and behind it the half of the world.
std::optional<double> angleAt(const NmeaSentence &sentence, int index, double most, char positive, char negative)
{
    const std::optional<double> number = numberAt(sentence, index, 0.0, most * 100.0);
    const bool isNegative = sentence.isLetter(index + 1, negative);
    if (!number || (!isNegative && !sentence.isLetter(index + 1, positive)))
        return std::nullopt;
    const double degrees = std::floor(*number / 100.0);
    const double minutes = *number - degrees * 100.0;
    if (minutes >= 60.0)
        return std::nullopt;
    const double angle = (degrees + minutes / 60.0) * RadiansOfDegree;
    return isNegative ? -angle : angle;
}

void readPosition(const NmeaSentence &sentence, int index, NmeaFix *fix)
{
    fix->latitude = angleAt(sentence, index, 90.0, 'N', 'S');
    fix->longitude = angleAt(sentence, index + 2, 180.0, 'E', 'W');
}

int digitsAt(const QByteArray &text, int place)
{
    const QByteArray digits = text.mid(place, 2);
    const bool isRight
        = digits.size() == 2 && digits[0] >= '0' && digits[0] <= '9' && digits[1] >= '0' && digits[1] <= '9';
    return isRight ? digits.toInt() : -1;
}

/// "123519.25" and "230394"
std::optional<double> timeOf(const NmeaSentence &sentence, int timeIndex, int dateIndex)
{
    const QByteArray time = sentence.field(timeIndex);
    const QByteArray date = sentence.field(dateIndex);
    double number = 0.0;
    if (!sentence.number(timeIndex, &number) || date.size() != 6)
        return std::nullopt;
    const int hours = digitsAt(time, 0);
    const int minutes = digitsAt(time, 2);
    const double seconds = number - std::floor(number / 100.0) * 100.0;
    const int year = digitsAt(date, 4);
    const QDate day(year + (year < FirstYear % 100 ? 2000 : 1900), digitsAt(date, 2), digitsAt(date, 0));
    const bool isRight = hours >= 0 && hours < 24 && minutes >= 0 && minutes < 60 && digitsAt(time, 4) >= 0
        && seconds < 61.0 && year >= 0 && day.isValid();
    if (!isRight)
        return std::nullopt;
    const qint64 midnight = QDateTime(day, QTime(0, 0), Qt::UTC).toSecsSinceEpoch();
    return double(midnight + hours * 3600 + minutes * 60) + seconds;
}

/// A letter that says how a value came about: autonomous, differential, precise, RTK with integers
/// or without. The others are estimated, typed in, simulated, or none. Older receivers have none.
bool isMeasured(const NmeaSentence &sentence, int index)
{
    const QByteArray mode = sentence.field(index);
    return mode.isEmpty() || (mode.size() == 1 && QByteArray("ADPRF").contains(mode));
}

/// time, position, quality, satellites, HDOP, altitude, M, separation, M, age of corrections
void readGga(const NmeaSentence &sentence, NmeaFix *fix)
{
    fix->quality = numberAt(sentence, 5, 0.0, 8.0);
    if (fix->quality && *fix->quality != std::floor(*fix->quality))
        fix->quality.reset();
    fix->satellites = numberAt(sentence, 6, 0.0, 200.0);
    fix->hdop = numberAt(sentence, 7, 0.0, 1e3);
    fix->hasPosition = fix->quality && *fix->quality >= 1.0 && *fix->quality <= 5.0;
    if (!*fix->hasPosition)
        return;
    readPosition(sentence, 1, fix);
    if (sentence.isLetter(9, 'M'))
        fix->altitude = numberAt(sentence, 8, -1e4, 1e6);
    if (sentence.isLetter(11, 'M'))
        fix->geoidSeparation = numberAt(sentence, 10, -1e3, 1e3);
    fix->correctionAge = numberAt(sentence, 12, 0.0, 1e6);
}

/// time, A or V, position, knots, course, date, variation, its half, mode
void readRmc(const NmeaSentence &sentence, NmeaFix *fix)
{
    fix->hasPosition = sentence.isLetter(1, 'A') && isMeasured(sentence, 11);
    fix->hasMotion = fix->hasPosition;
    if (!*fix->hasPosition)
        return;
    readPosition(sentence, 2, fix);
    fix->speed = scaledAt(sentence, 6, MetresPerSecondOfKnot);
    fix->course = courseAt(sentence, 7);
    fix->time = timeOf(sentence, 0, 8);
}

/// course, T, magnetic course, M, knots, N, km/h, K, mode
void readVtg(const NmeaSentence &sentence, NmeaFix *fix)
{
    fix->hasMotion = isMeasured(sentence, 8);
    if (!*fix->hasMotion)
        return;
    if (sentence.isLetter(1, 'T'))
        fix->course = courseAt(sentence, 0);
    if (sentence.isLetter(5, 'N'))
        fix->speed = scaledAt(sentence, 4, MetresPerSecondOfKnot);
    if (!fix->speed && sentence.isLetter(7, 'K'))
        fix->speed = scaledAt(sentence, 6, MetresPerSecondOfKmh);
}

}  // namespace

NmeaFix NmeaFix::read(const NmeaSentence &sentence)
{
    NmeaFix fix;
    fix.isOfFix = true;
    const QByteArray type = sentence.talker() == "P" ? QByteArray() : sentence.type();
    if (type == "GGA")
        readGga(sentence, &fix);
    else if (type == "RMC")
        readRmc(sentence, &fix);
    else if (type == "VTG")
        readVtg(sentence, &fix);
    else
        fix.isOfFix = false;
    return fix;
}

}  // namespace qplc
