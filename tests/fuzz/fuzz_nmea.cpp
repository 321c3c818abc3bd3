// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
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

}  // namespace

// Input: what comes from a serial line. What is found in it are sentences, and their wind is wind.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    qplc::NmeaStream stream;
    stream.setChecksumRequired(size % 2 == 0);
    for (std::size_t i = 0; i < size; ++i) {
        if (!stream.feed(char(data[i])))
            continue;
        const qplc::NmeaSentence &sentence = stream.sentence();
        fuzz::check(!sentence.talker().isEmpty() && !sentence.type().isEmpty(), "a sentence has a talker and a type");
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
