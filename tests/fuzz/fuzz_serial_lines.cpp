// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "hardware/serial/LineText.h"

#include <cmath>

// Input: what comes from a serial line. Lines are short and have no end inside; numbers are finite.
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
    return 0;
}
