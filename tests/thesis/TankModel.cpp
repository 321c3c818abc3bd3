// SPDX-License-Identifier: Apache-2.0
#include "TankModel.h"

TankModel_Inputs TankModel_U;
TankModel_Outputs TankModel_Y;
TankModel_States TankModel_DW;

namespace {

const real_T stepSize = 0.01;     // [s]
const real_T groundArea = 0.5;    // of each tank [m^2]
const real_T pumpVolume = 0.004;  // of a turn [m^3]
const real_T pipeFlow = 0.02;     // flow per height [m^2/s]

}  // namespace

void TankModel_initialize()
{
    TankModel_U = TankModel_Inputs();
    TankModel_DW = TankModel_States();
    TankModel_DW.level[0] = 1.0;
    TankModel_DW.level[1] = 0.5;
    TankModel_DW.level[2] = 0.25;
}

void TankModel_step()
{
    const real_T openings[3] = {1.0, 1.0, TankModel_U.valve};
    real_T inflow = pumpVolume * TankModel_U.speed;
    TankModel_Y.volume = 0.0;
    for (int i = 0; i < 3; ++i) {
        const real_T outflow = openings[i] * pipeFlow * TankModel_DW.level[i];
        TankModel_DW.level[i] += stepSize / groundArea * (inflow - outflow);
        TankModel_Y.level[i] = TankModel_DW.level[i];
        TankModel_Y.flow[i] = outflow;
        TankModel_Y.volume += groundArea * TankModel_DW.level[i];
        inflow = outflow;
    }
    TankModel_DW.steps += 1.0;
    TankModel_Y.time = stepSize * TankModel_DW.steps;
#ifdef QT_NO_KEYWORDS
    TankModel_DW.signals[0] = pumpVolume * TankModel_U.speed;
    TankModel_DW.signals[1] = TankModel_Y.flow[2];
    TankModel_DW.signals[2] = TankModel_DW.signals[0] - TankModel_DW.signals[1];
#endif
}
