// SPDX-License-Identifier: Apache-2.0
// A header in the form that Embedded Coder exports: root inports, root outports, three functions.
#ifndef RTW_HEADER_WinchModel_h_
#define RTW_HEADER_WinchModel_h_

#include "rtwtypes.h"

/* External inputs (root inport signals with default storage) */
typedef struct
{
    real_T tetherSpeed; /* '<Root>/tetherSpeed' */
} ExtU_WinchModel_T;

/* External outputs (root outports fed by signals with default storage) */
typedef struct
{
    real_T tetherLength; /* '<Root>/tetherLength' */
} ExtY_WinchModel_T;

extern ExtU_WinchModel_T WinchModel_U;
extern ExtY_WinchModel_T WinchModel_Y;

extern void WinchModel_initialize(void);
extern void WinchModel_step(void);
extern void WinchModel_terminate(void);

#endif
