// SPDX-License-Identifier: Apache-2.0
#include "SectionKeys.h"

#include <QtPlcCore>

#include <cmath>

namespace awe {

namespace {

constexpr double mostSeed = 9007199254740992.0;  // 2^53: every integer up to it is a double

QString withUnit(const QString &text, const char *unit)
{
    return *unit == '\0' ? text : text + QLatin1Char(' ') + QString::fromUtf8(unit);
}

QString rangeOf(double smallest, double largest, const char *unit)
{
    return withUnit(QStringLiteral("from %1 to %2").arg(smallest).arg(largest), unit);
}

/// \return empty, or what to use
template<typename Integer>
QString readInteger(const QString &text, double smallest, double largest, Integer *value)
{
    bool isInteger = false;
    const qlonglong number = text.toLongLong(&isInteger);
    if (!isInteger || double(number) < smallest || double(number) > largest)
        return QStringLiteral("use a whole number from %1 to %2").arg(smallest, 0, 'f', 0).arg(largest, 0, 'f', 0);
    *value = Integer(number);
    return {};
}

}  // namespace

void SectionKeys::addNumber(const char *name, double *value, double smallest, double largest, const char *unit)
{
    add(name, [=](const QString &text) {
        bool isNumber = false;
        const double number = text.toDouble(&isNumber);
        if (!isNumber || !(number >= smallest && number <= largest))  // NaN fails
            return QStringLiteral("use a number ") + rangeOf(smallest, largest, unit);
        *value = number;
        return QString();
    });
}

void SectionKeys::addInteger(const char *name, int *value, int smallest, int largest)
{
    add(name, [=](const QString &text) { return readInteger(text, smallest, largest, value); });
}

void SectionKeys::addSeed(const char *name, std::uint64_t *value)
{
    add(name, [=](const QString &text) { return readInteger(text, 0.0, mostSeed, value); });
}

void SectionKeys::addVector(const char *name, Eigen::Vector3d *value, double largest)
{
    add(name, [=](const QString &text) {
        const QPlcValue read = QPlcValue::fromString(QPlcSignalType(QPlcSignalType::Real64, 3), text);
        const auto isIn = [&](int i) { return std::abs(read.toReal(i)) <= largest; };
        if (!read.isValid() || text.count(QLatin1Char(',')) != 2 || !isIn(0) || !isIn(1) || !isIn(2))
            return QStringLiteral("use three numbers X,Y,Z (east, north, up), each ")
                + rangeOf(-largest, largest, "m/s");
        *value = Eigen::Vector3d(read.toReal(0), read.toReal(1), read.toReal(2));
        return QString();
    });
}

QString SectionKeys::set(const QString &key, const QString &value) const
{
    QPlcSignalTable known;  // it finds names that look alike
    for (const auto &[name, take] : m_keys) {
        if (name == key) {
            const QString remedy = take(value);
            return remedy.isEmpty() ? QString() : QStringLiteral("%1 = %2: %3").arg(key, value, remedy);
        }
        QPlcSignalDefinition definition;
        definition.name = name;
        definition.type = QPlcSignalType(QPlcSignalType::Real64);
        known.append(definition);
    }
    const QString close = known.closeNames(key, 1).join(QString());
    if (!close.isEmpty())
        return QStringLiteral("'%1' is not a key of [%2]; did you mean '%3'?").arg(key, m_section, close);
    QStringList names;
    for (const auto &each : m_keys)
        names << each.first;
    return QStringLiteral("'%1' is not a key of [%2]; use one of %3")
        .arg(key, m_section, names.join(QStringLiteral(", ")));
}

}  // namespace awe
