// SPDX-License-Identifier: Apache-2.0
// Stands for the exported source: an integrator with the sample time 0.01 s.
#include "ReelModel.h"

#include <string.h>

void ReelModel_initialize(RT_MODEL_ReelModel_T *const ReelModel_M)
{
    ReelModel_M->errorStatus = NULL;
    (void)memset(ReelModel_M->inputs, 0, sizeof(ExtU_ReelModel_T));
    (void)memset(ReelModel_M->outputs, 0, sizeof(ExtY_ReelModel_T));
    ReelModel_M->dwork->Length_DSTATE = 300.0;
}

void ReelModel_step(RT_MODEL_ReelModel_T *const ReelModel_M)
{
    ReelModel_M->outputs->tetherLength = ReelModel_M->dwork->Length_DSTATE;
    ReelModel_M->dwork->Length_DSTATE += 0.01 * ReelModel_M->inputs->tetherSpeed;
}

void ReelModel_terminate(RT_MODEL_ReelModel_T *const ReelModel_M) { (void)ReelModel_M; }
