// SPDX-License-Identifier: Apache-2.0
#include "KiteConfiguration.h"

#include "AngleMath.h"

#include <QtPlcCore>

#include <cmath>
#include <functional>

namespace awe {

namespace {

constexpr double mostSeed = 9007199254740992.0;  // 2^53: every integer up to it is a double

/// One key of the section: how its text becomes a value. The function returns empty, or what to
/// use.
struct KiteKey
{
    QString name;
    std::function<QString(const QString &text)> take;
};

QString withUnit(const QString &text, const char *unit)
{
    return *unit == '\0' ? text : text + QLatin1Char(' ') + QString::fromUtf8(unit);
}

QString rangeOf(double smallest, double largest, const char *unit)
{
    return withUnit(QStringLiteral("from %1 to %2").arg(smallest).arg(largest), unit);
}

KiteKey numberKey(const char *name, double *value, double smallest, double largest, const char *unit)
{
    return {QString::fromLatin1(name), [=](const QString &text) {
                bool isNumber = false;
                const double number = text.toDouble(&isNumber);
                if (!isNumber || !(number >= smallest && number <= largest))  // NaN fails
                    return QStringLiteral("use a number ") + rangeOf(smallest, largest, unit);
                *value = number;
                return QString();
            }};
}

template<typename Integer>
KiteKey integerKey(const char *name, Integer *value, double smallest, double largest)
{
    return {QString::fromLatin1(name), [=](const QString &text) {
                bool isInteger = false;
                const qlonglong number = text.toLongLong(&isInteger);
                if (!isInteger || double(number) < smallest || double(number) > largest)
                    return QStringLiteral("use a whole number from %1 to %2")
                        .arg(smallest, 0, 'f', 0)
                        .arg(largest, 0, 'f', 0);
                *value = Integer(number);
                return QString();
            }};
}

KiteKey vectorKey(const char *name, Eigen::Vector3d *value, double largest)
{
    return {QString::fromLatin1(name), [=](const QString &text) {
                const QPlcValue read = QPlcValue::fromString(QPlcSignalType(QPlcSignalType::Real64, 3), text);
                const auto isIn = [&](int i) { return std::abs(read.toReal(i)) <= largest; };
                if (!read.isValid() || text.count(QLatin1Char(',')) != 2 || !isIn(0) || !isIn(1) || !isIn(2))
                    return QStringLiteral("use three numbers X,Y,Z (east, north, up), each ")
                        + rangeOf(-largest, largest, "m/s");
                *value = Eigen::Vector3d(read.toReal(0), read.toReal(1), read.toReal(2));
                return QString();
            }};
}

template<typename Choice>
KiteKey choiceKey(const char *name, Choice *value, const char *first, Choice firstChoice, const char *second,
                  Choice secondChoice)
{
    return {QString::fromLatin1(name), [=](const QString &text) {
                if (text != QLatin1String(first) && text != QLatin1String(second))
                    return QStringLiteral("use %1 or %2").arg(QLatin1String(first), QLatin1String(second));
                *value = text == QLatin1String(first) ? firstChoice : secondChoice;
                return QString();
            }};
}

/// All keys of the section, bound to \a kite.
QVector<KiteKey> keysOf(KiteConfiguration *kite)
{
    QVector<KiteKey> keys;
    const auto addNumber = [&keys](const char *name, double &value, double smallest, double largest, const char *unit) {
        keys.append(numberKey(name, &value, smallest, largest, unit));
    };
    PlantParameters::visitConstants(kite->plant, addNumber);
    keys.append(choiceKey("angleOfAttack", &kite->plant.angleOfAttackRange, "folded", AngleOfAttackRange::Folded,
                          "full", AngleOfAttackRange::Full));
    keys.append(
        choiceKey("ground", &kite->plant.groundContact, "hold", GroundContact::Hold, "ignore", GroundContact::Ignore));
    keys.append(integerKey("substeps", &kite->substeps, 1.0, 100.0));
    keys.append(vectorKey("wind", &kite->wind.meanVelocity, 100.0));
    WindParameters::visitConstants(kite->wind, addNumber);
    keys.append(choiceKey("turbulenceModel", &kite->wind.turbulenceModel, "first-order", TurbulenceModel::FirstOrder,
                          "kaimal", TurbulenceModel::Kaimal));
    keys.append(integerKey("seed", &kite->wind.seed, 0.0, mostSeed));
    addNumber("elevation", kite->elevation, -90.0, 90.0, "deg");
    addNumber("azimuth", kite->azimuth, -360.0, 360.0, "deg");
    addNumber("distance", kite->distance, 1e-3, 1e6, "m");
    addNumber("tetherLength", kite->tetherLength, 1e-3, 1e6, "m");
    addNumber("pitchAngle", kite->pitchAngle, -360.0, 360.0, "deg");
    addNumber("yawAngle", kite->yawAngle, -360.0, 360.0, "deg");
    keys.append(vectorKey("velocity", &kite->velocity, 1000.0));
    return keys;
}

}  // namespace

QString KiteConfiguration::set(const QString &key, const QString &value)
{
    QPlcSignalTable known;  // it finds names that look alike
    const QVector<KiteKey> keys = keysOf(this);
    for (const KiteKey &candidate : keys) {
        if (candidate.name == key) {
            const QString remedy = candidate.take(value);
            return remedy.isEmpty() ? QString() : QStringLiteral("%1 = %2: %3").arg(key, value, remedy);
        }
        QPlcSignalDefinition name;
        name.name = candidate.name;
        name.type = QPlcSignalType(QPlcSignalType::Real64);
        known.append(name);
    }
    const QString close = known.closeNames(key, 1).join(QString());
    if (!close.isEmpty())
        return QStringLiteral("'%1' is not a key of [kite]; did you mean '%2'?").arg(key, close);
    QStringList names;
    for (const KiteKey &candidate : keys)
        names << candidate.name;
    return QStringLiteral("'%1' is not a key of [kite]; use one of %2").arg(key, names.join(QStringLiteral(", ")));
}

PlantParameters KiteConfiguration::plantIn(const WindParameters &windNow) const
{
    PlantParameters parameters = plant;
    const Eigen::Vector3d &mean = windNow.meanVelocity;
    const double downwind = std::atan2(mean.y(), mean.x()) * degreesPerRadian;
    parameters.initialState
        = PlantParameters::stateAtRest(elevation, std::isnan(azimuth) ? downwind : azimuth, distance);
    parameters.initialState.velocity = velocity;
    parameters.initialState.pitchAngle = pitchAngle;
    parameters.initialState.yawAngle = yawAngle;
    if (!std::isnan(tetherLength))
        parameters.initialState.tetherLength = tetherLength;
    return parameters;
}

}  // namespace awe
