// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "hardware/serial/NmeaFix.h"
#include "hardware/serial/NmeaStream.h"
#include "hardware/serial/NmeaWind.h"

#include <cmath>
#include <optional>

namespace {

void checkNumber(const std::optional<double> &value, double lowest, double highest, const char *sentence)
{
    fuzz::check(!value || (std::isfinite(*value) && *value >= lowest && *value <= highest), sentence);
}

void checkWind(const qplc::NmeaWind::Wind &wind)
{
    checkNumber(wind.speed, 0.0, 1e300, "a speed is finite and not negative");
    checkNumber(wind.angle, 0.0, 6.2831853072, "an angle is one of a turn");
}

void checkFix(const qplc::NmeaFix &fix)
{
    constexpr double halfTurn = 3.1415926536;
    checkNumber(fix.latitude, -halfTurn / 2, halfTurn / 2, "a latitude is on the globe");
    checkNumber(fix.longitude, -halfTurn, halfTurn, "a longitude is on the globe");
    checkNumber(fix.altitude, -1e4, 1e6, "an altitude is one of a vehicle");
    checkNumber(fix.speed, 0.0, 1e6, "a speed over ground is not negative");
    checkNumber(fix.course, 0.0, 2 * halfTurn, "a course is one of a turn");
    checkNumber(fix.time, 315532800.0, 3471292801.0, "a time is one of the years 1980 to 2079");
    checkNumber(fix.quality, 0.0, 8.0, "a quality is one of those that there are");
    fuzz::check(!fix.latitude || fix.hasPosition.value_or(false), "a position was measured");
    fuzz::check(!fix.course || fix.hasMotion.value_or(false), "a course was measured");
}

}  // namespace

// Input: what comes from a serial line. What is found in it are sentences, their wind is wind, and
// their position is one.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    qplc::NmeaStream stream;
    stream.setChecksumRequired(size % 2 == 0);
    for (std::size_t i = 0; i < size; ++i) {
        if (!stream.feed(char(data[i])))
            continue;
        const qplc::NmeaSentence &sentence = stream.sentence();
        fuzz::check(!sentence.talker().isEmpty() && !sentence.type().isEmpty(), "a sentence has a talker and a type");
        checkFix(qplc::NmeaFix::read(sentence));
        const qplc::NmeaWind wind = qplc::NmeaWind::read(sentence);
        checkWind(wind.relative);
        checkWind(wind.theoretical);
        checkNumber(wind.direction, 0.0, 6.2831853072, "a direction is one of a turn");
        checkNumber(wind.pressure, -1e300, 1e300, "a pressure is finite");
    }
    fuzz::check(stream.bytes() == size, "every byte is counted");

    const quint64 before = stream.sentences();
    for (const char byte : QByteArray("\r\n$WIMWV,214.8,R,5.1,M,A*2B\r\n"))
        stream.feed(byte);
    fuzz::check(stream.sentences() == before + 1 || (size > 0 && stream.sentences() == before + 2),
                "a good sentence is found behind everything");
    return 0;
}
