// SPDX-License-Identifier: Apache-2.0
// A header in the form that Embedded Coder exports as "reusable function": all data of the model
// are behind one structure.
#ifndef RTW_HEADER_ReelModel_h_
#define RTW_HEADER_ReelModel_h_

#include "rtwtypes.h"

/* External inputs (root inport signals with default storage) */
typedef struct
{
    real_T tetherSpeed; /* '<Root>/tetherSpeed' */
} ExtU_ReelModel_T;

/* External outputs (root outports fed by signals with default storage) */
typedef struct
{
    real_T tetherLength; /* '<Root>/tetherLength' */
} ExtY_ReelModel_T;

/* Block states (default storage) for system '<Root>' */
typedef struct
{
    real_T Length_DSTATE; /* '<Root>/Length' */
} DW_ReelModel_T;

/* Real-time Model Data Structure */
typedef struct tag_RTM_ReelModel_T
{
    const char *errorStatus;
    ExtU_ReelModel_T *inputs;
    ExtY_ReelModel_T *outputs;
    DW_ReelModel_T *dwork;
} RT_MODEL_ReelModel_T;

#define rtmGetErrorStatus(rtm) ((rtm)->errorStatus)

extern void ReelModel_initialize(RT_MODEL_ReelModel_T *const ReelModel_M);
extern void ReelModel_step(RT_MODEL_ReelModel_T *const ReelModel_M);
extern void ReelModel_terminate(RT_MODEL_ReelModel_T *const ReelModel_M);

#endif
