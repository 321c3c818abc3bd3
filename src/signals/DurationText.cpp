// SPDX-License-Identifier: Apache-2.0
#include "DurationText.h"

#include <QtCore/QHash>
#include <QtCore/QRegularExpression>

#include <cmath>

namespace qplc {

bool durationFromText(const QString &text, double *nanoseconds)
{
    static const QRegularExpression pattern(QStringLiteral(R"(^([0-9.eE+-]+)\s*(ns|us|ms|s|min|h)$)"));
    static const QHash<QString, double> units{{QStringLiteral("ns"), 1.0},   {QStringLiteral("us"), 1e3},
                                              {QStringLiteral("ms"), 1e6},   {QStringLiteral("s"), 1e9},
                                              {QStringLiteral("min"), 6e10}, {QStringLiteral("h"), 3.6e12}};
    const QRegularExpressionMatch match = pattern.match(text);
    bool isNumber = false;
    *nanoseconds = match.captured(1).toDouble(&isNumber) * units.value(match.captured(2));
    return match.hasMatch() && isNumber && std::isfinite(*nanoseconds);
}

QString durationText(std::chrono::nanoseconds duration)
{
    const auto count = duration.count();
    static constexpr struct
    {
        qint64 size;
        const char *unit;
    } units[]{{1'000'000'000, "s"}, {1'000'000, "ms"}, {1'000, "us"}, {1, "ns"}};
    for (const auto &unit : units) {
        if (count % unit.size == 0)
            return QStringLiteral("%1 %2").arg(count / unit.size).arg(QLatin1String(unit.unit));
    }
    return {};
}

}  // namespace qplc
