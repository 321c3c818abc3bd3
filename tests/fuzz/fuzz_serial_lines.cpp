// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "hardware/serial/LineTemplate.h"
#include "hardware/serial/LineText.h"

#include <cmath>
#include <limits>

namespace {

// A template that is accepted makes lines between its two lengths of all numbers that are finite.
void checkTemplate(const QByteArray &bytes)
{
    qplc::LineTemplate line;
    if (!qplc::LineTemplate::parse(bytes, &line).isEmpty())
        return;
    const auto count = std::size_t(line.names().size());
    fuzz::check(count > 0 && line.shortest() <= qplc::LineTemplate::MaximumLength, "a template has a number and room");
    for (const double value : {0.0, -0.001, 12345.678, -1e15}) {
        const QByteArray text = line.text(std::vector<double>(count, value));
        fuzz::check(text.size() <= qplc::LineTemplate::MaximumLength, "a line is not too long");
        fuzz::check(text.isEmpty() || text.size() >= line.shortest(), "a line is not shorter than the shortest");
    }
    std::vector<double> values(count);
    values.back() = std::numeric_limits<double>::quiet_NaN();
    fuzz::check(line.text(values).isEmpty(), "what is not finite is not sent");
}

}  // namespace

// Input: what comes from a serial line, or the template of a line that is sent. Lines are short and
// have no end inside; numbers are finite.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    static const qplc::LinePattern pattern = [] {
        qplc::LinePattern result;
        fuzz::check(qplc::LinePattern::parse(QStringLiteral("(?<first>[-+0-9.eE ]+),(?<second>.*)"), &result).isEmpty(),
                    "the pattern is right");
        return result;
    }();
    qplc::LineStream stream;
    for (std::size_t i = 0; i < size; ++i) {
        if (!stream.feed(char(data[i])))
            continue;
        const QByteArray line = stream.line();
        fuzz::check(!line.isEmpty() && line.size() <= qplc::LineStream::MaximumLength, "a line has its size");
        fuzz::check(!line.contains('\r') && !line.contains('\n'), "a line ends at its end");
        for (const std::optional<double> &value : pattern.match(line))
            fuzz::check(!value || std::isfinite(*value), "a number is finite");
    }
    bool hasLine = false;
    for (const char byte : QByteArray("\r\n1.5,2\r\n"))
        hasLine = stream.feed(byte) || hasLine;
    fuzz::check(hasLine && stream.line() == "1.5,2", "a good line is found behind everything");

    QByteArray bytes;
    const QString text = QString::fromLatin1(reinterpret_cast<const char *>(data), int(size));
    fuzz::check(!qplc::bytesOfText(text, &bytes) || bytes.size() <= int(size), "a text does not grow");
    checkTemplate(QByteArray(reinterpret_cast<const char *>(data), int(size)));
    return 0;
}
