// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "hardware/sysfs/SysfsText.h"

#include <cmath>

// Input: a byte for the size of a count, and what a file of sysfs says. Whatever it is, a value is
// a finite number in its range, and a temperature comes only with a right checksum.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    using qplc::SysfsText;
    fuzz::Input input(data, size);
    const int bits = 8 + input.number<quint8>() % 57;
    const QByteArray text = input.bytes(size);

    const std::optional<double> number = SysfsText::number(text);
    fuzz::check(!number || std::isfinite(*number), "a number is finite");
    const std::optional<double> count = SysfsText::count(text, bits, true);
    fuzz::check(!count || std::abs(*count) <= std::ldexp(1.0, bits - 1), "a signed count fits into its bits");
    const std::optional<double> positive = SysfsText::count(text, bits, false);
    fuzz::check(!positive || (*positive >= 0.0 && *positive <= std::ldexp(1.0, bits)), "a count fits into its bits");
    fuzz::check(count.has_value() == positive.has_value(), "a sign does not decide what is a count");

    const SysfsText::Thermometer reading = SysfsText::thermometer(text);
    fuzz::check(reading.problem || (reading.temperature >= -55.0 && reading.temperature <= 125.0),
                "a temperature is one that the sensor can measure");
    fuzz::check(reading.problem || text.contains("YES"), "the checksum of a temperature is right");
    fuzz::check(!reading.problem || QByteArray(reading.problem).contains("; "), "a problem has a remedy");

    const QByteArrayList files = SysfsText::iioFiles("in_", text, "scale");
    fuzz::check(!files.isEmpty() && files.size() <= 4 && files.last() == "scale", "an attribute has few files");
    fuzz::check(std::isfinite(SysfsText::iioUnit(text)) && SysfsText::iioUnit(text) > 0.0, "a unit is positive");
    fuzz::check(SysfsText::hwmonUnit(text) > 0.0, "a unit is positive");
    return 0;
}
