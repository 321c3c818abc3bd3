// SPDX-License-Identifier: Apache-2.0
// A kite on a tether in the manner of a model that was exported as C: globals for inputs and
// outputs, two functions.
#pragma once

typedef double real_T;

struct LaweModel_Inputs
{
    real_T bodyControlPitchSpeed;  // [deg/s]
    real_T bodyControlYawSpeed;    // [deg/s]
    real_T tetherSpeed;            // [m/s], > 0 reels out
};

struct LaweModel_Outputs
{
    real_T bodyPosition_earth[3];        // [m]
    real_T bodyVelocity_earth[3];        // [m/s]
    real_T windVelocity_earth[3];        // [m/s]
    real_T bodyControlOrientation[3];    // [deg]
    real_T bodyPositionOrientation[3];   // [deg]
    real_T angleOfAttack;                // [deg]
    real_T dragCoefficient;              // [1]
    real_T liftCoefficient;              // [1]
    real_T aweCoefficient;               // [1]
    real_T aerodynamicForce_earth[3];    // [N]
    real_T tetherForce_earth[3];         // [N]
    real_T gravitationalForce_earth[3];  // [N]
    real_T tetherLength;                 // [m]
    real_T power;                        // [W]
    real_T averagePower;                 // [W]
    real_T energy;                       // [J]
};

#ifdef QT_NO_KEYWORDS
struct LaweModel_States
{
    real_T signals[3];  // what acts on the kite: a name that Qt has for itself otherwise
};
extern LaweModel_States LaweModel_DW;
#endif

extern LaweModel_Inputs LaweModel_U;
extern LaweModel_Outputs LaweModel_Y;

// Sets inputs and states to their first values. Outputs follow with the first step only.
void LaweModel_initialize();
// One step of 10 ms.
void LaweModel_step();
