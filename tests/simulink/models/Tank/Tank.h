/* SPDX-License-Identifier: Apache-2.0 */
/* Written by hand in the form of an export: output and update are functions of their own. */
#ifndef RTW_HEADER_Tank_h_
#define RTW_HEADER_Tank_h_
#include "rtwtypes.h"

/* Block signals (default storage) */
typedef struct {
  real_T Balance;                      /* '<Root>/Sum' */
} B_Tank_T;

/* External inputs (root inport signals with default storage) */
typedef struct {
  real_T inflow;                       /* '<Root>/inflow' */
} ExtU_Tank_T;

/* External outputs (root outports fed by signals with default storage) */
typedef struct {
  real_T level;                        /* '<Root>/level' */
} ExtY_Tank_T;

extern ExtU_Tank_T Tank_U;
extern ExtY_Tank_T Tank_Y;

/* Model entry point functions */
extern void Tank_initialize(void);
extern void Tank_output(void);
extern void Tank_update(void);
extern void Tank_terminate(void);

#endif
