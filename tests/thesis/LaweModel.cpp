// SPDX-License-Identifier: Apache-2.0
#include "LaweModel.h"

#include "KitePlant.h"

#include <algorithm>

LaweModel_Inputs LaweModel_U;
LaweModel_Outputs LaweModel_Y;
#ifdef QT_NO_KEYWORDS
LaweModel_States LaweModel_DW;
#endif

namespace {

awe::KitePlant &plant()
{
    static awe::KitePlant kite;
    return kite;
}

void copy(const Eigen::Vector3d &from, real_T (&to)[3])
{
    std::copy(from.data(), from.data() + 3, to);
}

}  // namespace

void LaweModel_initialize()
{
    LaweModel_U = LaweModel_Inputs();
    plant().reset();
}

void LaweModel_step()
{
    awe::PlantInputs inputs;
    inputs.pitchSpeed = LaweModel_U.bodyControlPitchSpeed;
    inputs.yawSpeed = LaweModel_U.bodyControlYawSpeed;
    inputs.tetherSpeed = LaweModel_U.tetherSpeed;
    inputs.windVelocity = Eigen::Vector3d(5.0, 3.0, 0.0);
    const awe::PlantOutputs outputs = plant().outputs(inputs);
    copy(outputs.position, LaweModel_Y.bodyPosition_earth);
    copy(outputs.velocity, LaweModel_Y.bodyVelocity_earth);
    copy(inputs.windVelocity, LaweModel_Y.windVelocity_earth);
    copy(outputs.bodyControlOrientation, LaweModel_Y.bodyControlOrientation);
    copy(outputs.bodyPositionOrientation, LaweModel_Y.bodyPositionOrientation);
    LaweModel_Y.angleOfAttack = outputs.angleOfAttack;
    LaweModel_Y.dragCoefficient = outputs.dragCoefficient;
    LaweModel_Y.liftCoefficient = outputs.liftCoefficient;
    LaweModel_Y.aweCoefficient = outputs.aweCoefficient;
    copy(outputs.aerodynamicForce, LaweModel_Y.aerodynamicForce_earth);
    copy(outputs.tetherForce, LaweModel_Y.tetherForce_earth);
    copy(outputs.gravitationalForce, LaweModel_Y.gravitationalForce_earth);
    LaweModel_Y.tetherLength = outputs.tetherLength;
    LaweModel_Y.power = outputs.power;
    LaweModel_Y.averagePower = outputs.averagePower;
    LaweModel_Y.energy = outputs.energy;
#ifdef QT_NO_KEYWORDS
    copy(outputs.aerodynamicForce + outputs.tetherForce + outputs.gravitationalForce, LaweModel_DW.signals);
#endif
    plant().step(inputs);
}
