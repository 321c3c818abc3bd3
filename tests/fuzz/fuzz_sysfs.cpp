// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "hardware/sysfs/IioScan.h"
#include "hardware/sysfs/SysfsText.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

// Lines of an index and a type, an empty line, and the bytes of a scan.
void readScan(const QByteArray &text)
{
    using qplc::IioElement;
    using qplc::IioScan;
    const int end = text.indexOf("\n\n");
    IioScan scan;
    int sum = 0;
    std::vector<int> numbers;
    for (const QByteArray &line : text.left(end).split('\n')) {
        const int space = line.indexOf(' ');
        const std::optional<IioElement> element = IioElement::fromText(line.mid(space + 1));
        if (!element)
            continue;
        fuzz::check(element->storage == 1 || element->storage == 2 || element->storage == 4 || element->storage == 8,
                    "a value is stored in 8, 16, 32 or 64 bits");
        fuzz::check(element->number.bits >= 1 && element->shift >= 0
                        && element->number.bits + element->shift <= 8 * element->storage,
                    "a value fits into its bytes");
        sum += element->bytes();
        numbers.push_back(scan.add(std::abs(line.left(space).toInt() % IioScan::Last), *element));
    }
    const char *problem = scan.layOut();
    fuzz::check(!problem || QByteArray(problem).contains("; "), "a problem has a remedy");
    if (problem)
        return;
    fuzz::check(scan.size() >= sum && scan.size() <= IioScan::MostBytes, "the elements fit into a scan");
    const QByteArray rest = end < 0 ? QByteArray() : text.mid(end + 2);
    std::vector<quint8> bytes(std::size_t(scan.size()), 0xff);  // a read behind its end is seen
    std::copy_n(rest.cbegin(), std::min(rest.size(), scan.size()), bytes.begin());
    for (const int number : numbers) {
        const qplc::RawNumber &kind = scan.element(number).number;
        const qplc::RawNumber::Limits limits = kind.limits(1.0, 0.0);
        const double value = scan.value(number, bytes.data());
        // The highest number of 64 bits is rounded up.
        fuzz::check(kind.kind == qplc::RawNumber::Float || (value >= limits.lowest && value <= limits.highest + 1.0),
                    "a value fits into its bits");
        scan.integer(number, bytes.data());
    }
}

}  // namespace

// Input: a byte for the size of a count, and what a file of sysfs says, or a scan of IIO. Whatever
// it is, a value is a finite number in its range, and a temperature comes only with a right
// checksum.
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
    readScan(text);
    return 0;
}
