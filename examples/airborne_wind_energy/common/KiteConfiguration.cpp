// SPDX-License-Identifier: Apache-2.0
#include "KiteConfiguration.h"

#include "AngleMath.h"
#include "SectionKeys.h"

#include <cmath>

namespace awe {

double downwindAzimuth(const WindParameters &wind)
{
    return std::atan2(wind.meanVelocity.y(), wind.meanVelocity.x()) * degreesPerRadian;
}

QString KiteConfiguration::set(const QString &key, const QString &value)
{
    SectionKeys keys(QStringLiteral("kite"));
    keys.addChoice<FlightMode>("mode", &mode, {{"pumping", FlightMode::Pumping}, {"drag", FlightMode::Drag}});
    keys.addConstants(&plant);
    keys.addChoice<AngleOfAttackRange>("angleOfAttack", &plant.angleOfAttackRange,
                                       {{"folded", AngleOfAttackRange::Folded}, {"full", AngleOfAttackRange::Full}});
    keys.addChoice<GroundContact>("ground", &plant.groundContact,
                                  {{"hold", GroundContact::Hold}, {"ignore", GroundContact::Ignore}});
    keys.addInteger("substeps", &substeps, 1, 100);
    keys.addVector("wind", &wind.meanVelocity, 100.0);
    keys.addConstants(&wind);
    keys.addChoice<TurbulenceModel>(
        "turbulenceModel", &wind.turbulenceModel,
        {{"first-order", TurbulenceModel::FirstOrder}, {"kaimal", TurbulenceModel::Kaimal}});
    keys.addSeed("seed", &wind.seed);
    keys.addNumber("elevation", &elevation, -90.0, 90.0, "deg");
    keys.addNumber("azimuth", &azimuth, -360.0, 360.0, "deg");
    keys.addNumber("distance", &distance, 1e-3, 1e6, "m");
    keys.addNumber("tetherLength", &tetherLength, 1e-3, 1e6, "m");
    keys.addNumber("pitchAngle", &pitchAngle, -360.0, 360.0, "deg");
    keys.addNumber("yawAngle", &yawAngle, -360.0, 360.0, "deg");
    keys.addVector("velocity", &velocity, 1000.0);
    return keys.set(key, value);
}

bool KiteConfiguration::setMode(const QString &word)
{
    return set(QStringLiteral("mode"), word).isEmpty();
}

PlantParameters KiteConfiguration::plantIn(const WindParameters &windNow) const
{
    PlantParameters parameters = plant;
    parameters.initialState
        = PlantParameters::stateAtRest(elevation, std::isnan(azimuth) ? downwindAzimuth(windNow) : azimuth, distance);
    parameters.initialState.velocity = velocity;
    parameters.initialState.pitchAngle = pitchAngle;
    parameters.initialState.yawAngle = yawAngle;
    if (!std::isnan(tetherLength))
        parameters.initialState.tetherLength = tetherLength;
    return parameters;
}

}  // namespace awe
