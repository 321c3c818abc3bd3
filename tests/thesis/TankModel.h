// SPDX-License-Identifier: Apache-2.0
// Three tanks in a row, in the manner of a model that was exported as C: globals for inputs and outputs, two functions.
#pragma once

typedef double real_T;

struct TankModel_Inputs
{
    real_T speed;  // of the pump [1/s]
    real_T valve;  // opening of the drain, 0 ... 1
};

struct TankModel_Outputs
{
    real_T level[3];  // [m]
    real_T flow[3];   // out of each tank [m^3/s]
    real_T volume;    // in all tanks [m^3]
    real_T time;      // [s]
};

struct TankModel_States
{
    real_T level[3];
    real_T steps;
#ifdef QT_NO_KEYWORDS
    real_T signals[3];  // the pump, the drain, the sum: a name that Qt has for itself otherwise
#endif
};

extern TankModel_Inputs TankModel_U;
extern TankModel_Outputs TankModel_Y;
extern TankModel_States TankModel_DW;

// Sets inputs and states to their first values. Outputs follow with the first step only.
void TankModel_initialize();
// One step of 10 ms.
void TankModel_step();
