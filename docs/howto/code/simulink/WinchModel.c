// SPDX-License-Identifier: Apache-2.0
// Stands for the exported source: an integrator with the sample time 0.01 s.
#include "WinchModel.h"

#include <string.h>

ExtU_WinchModel_T WinchModel_U;
ExtY_WinchModel_T WinchModel_Y;

static struct {
    real_T Length_DSTATE; /* '<Root>/Length' */
} WinchModel_DW;

void WinchModel_initialize(void)
{
    (void)memset(&WinchModel_U, 0, sizeof(ExtU_WinchModel_T));
    (void)memset(&WinchModel_Y, 0, sizeof(ExtY_WinchModel_T));
    WinchModel_DW.Length_DSTATE = 300.0;
}

void WinchModel_step(void)
{
    WinchModel_Y.tetherLength = WinchModel_DW.Length_DSTATE;
    WinchModel_DW.Length_DSTATE += 0.01 * WinchModel_U.tetherSpeed;
}

void WinchModel_terminate(void)
{
}
