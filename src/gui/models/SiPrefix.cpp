// SPDX-License-Identifier: Apache-2.0
#include "SiPrefix.h"

#include "ValueFormat.h"

#include <QtCore/QStringList>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr double smallestPlain = 0.1;
constexpr double largestPlain = 1e4;
constexpr double smallestSteady = 1e-3;

struct Prefix
{
    const char *text;
    int exponent;
};
constexpr Prefix prefixes[] = {{"n", -9}, {"µ", -6}, {"m", -3}, {"", 0}, {"k", 3}, {"M", 6}, {"G", 9}, {"T", 12}};

const QStringList &bases()
{
    static const QStringList all{QStringLiteral("s"), QStringLiteral("m"),  QStringLiteral("N"),  QStringLiteral("Nm"),
                                 QStringLiteral("J"), QStringLiteral("W"),  QStringLiteral("Wh"), QStringLiteral("V"),
                                 QStringLiteral("A"), QStringLiteral("VA"), QStringLiteral("Hz"), QStringLiteral("Pa"),
                                 QStringLiteral("F"), QStringLiteral("H"),  QStringLiteral("C"),  QStringLiteral("Ohm"),
                                 QStringLiteral("Ω")};
    return all;
}

QString textOf(const Prefix &prefix)
{
    return QString::fromUtf8(prefix.text);
}

/// A unit in its parts.
struct Parts
{
    explicit Parts(const QString &unit)
    {
        if (bases().contains(unit)) {
            base = unit;
            return;
        }
        const QString first = unit.startsWith(QLatin1Char('u')) ? QStringLiteral("µ") : unit.left(1);
        for (const Prefix &prefix : prefixes) {
            if (prefix.exponent != 0 && textOf(prefix) == first && bases().contains(unit.mid(1))) {
                base = unit.mid(1);
                exponent = prefix.exponent;
            }
        }
    }
    QString base;  // empty: the unit takes no prefix
    int exponent = 0;
};

}  // namespace

QString SiPrefix::unitText(const QString &unit)
{
    if (unit == QLatin1String("1"))
        return {};
    const bool isMicro = unit.startsWith(QLatin1Char('u')) && !Parts(unit).base.isEmpty();
    return isMicro ? QStringLiteral("µ") + unit.mid(1) : unit;
}

bool SiPrefix::isTakenBy(const QString &unit)
{
    return !Parts(unit).base.isEmpty();
}

SiPrefix SiPrefix::fitting(const QString &unit, double size)
{
    SiPrefix plain(unit);
    size = std::abs(size);
    if (!(size > 0.0) || !std::isfinite(size) || (size >= smallestPlain && size < largestPlain))
        return plain;
    const Parts parts(unit);
    if (parts.base.isEmpty())
        return plain;
    const double decades = std::log10(size) + parts.exponent + 1e-9;
    const int wanted = std::clamp(3 * int(std::floor(decades / 3.0)), std::begin(prefixes)->exponent,
                                  std::prev(std::end(prefixes))->exponent);
    for (const Prefix &prefix : prefixes) {
        if (prefix.exponent == wanted) {
            plain.m_shown = textOf(prefix) + parts.base;
            plain.m_factor = std::pow(10.0, parts.exponent - wanted);
        }
    }
    return plain;
}

SiPrefix SiPrefix::kept(double size) const
{
    const double seen = std::abs(size * m_factor);
    const bool isGood = !(seen > 0.0) || (seen >= smallestPlain && seen < largestPlain);
    return isGood ? *this : fitting(m_table, size);
}

QString steadyNumberText(double value, int digits)
{
    const double size = std::abs(value);
    if (size == 0.0)
        return QString::number(0.0, 'f', digits - 1);
    if (!(size >= smallestSteady && size < std::pow(10.0, digits + 2)))
        return numberText(value, digits);
    const int decimals = digits - 1 - std::max(0, int(std::floor(std::log10(size) + 1e-9)));
    return QString::number(value, 'f', std::max(0, decimals));
}

}  // namespace qplc
