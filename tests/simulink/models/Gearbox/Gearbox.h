/* SPDX-License-Identifier: Apache-2.0 */
/* Written by hand in the form of an export: reusable functions, nested buses, arrays, fixed point, an
 * enum, truth values, a matrix. */
#ifndef RTW_HEADER_Gearbox_h_
#define RTW_HEADER_Gearbox_h_
#ifndef Gearbox_COMMON_INCLUDES_
#define Gearbox_COMMON_INCLUDES_
#include "rtwtypes.h"
#endif

#include "Gearbox_types.h"

/* Macros for accessing real-time model data structure */
#ifndef rtmGetErrorStatus
#define rtmGetErrorStatus(rtm) ((rtm)->errorStatus)
#endif

#define Gearbox_rows 2

/* Block states (default storage) for system '<Root>' */
typedef struct {
  uint32_T Count_DSTATE;               /* '<Root>/Count' */
} DW_Gearbox_T;

/* External inputs (root inport signals with default storage) */
typedef struct {
  DriveBus drive;                      /* '<Root>/drive' */
  Gear gear;                           /* '<Root>/gear' */
  real_T inertia[6];                   /* '<Root>/inertia' */
  boolean_T locks[3];                  /* '<Root>/locks' */
} ExtU_Gearbox_T;

/* External outputs (root outports fed by signals with default storage) */
typedef struct {
  DriveBus driveOut;                   /* '<Root>/drive out' */
  Gear gear;                           /* '<Root>/gear' */
  real_T inertia[6];                   /* '<Root>/inertia' */
  real_T map[Gearbox_rows][3];         /* '<Root>/map' */
  boolean_T locks[3];                  /* '<Root>/locks' */
  boolean_T moving;                    /* '<Root>/moving' */
  uint32_T count;                      /* '<Root>/count' */
} ExtY_Gearbox_T;

/* Real-time Model Data Structure */
struct tag_RTM_Gearbox_T {
  const char_T * volatile errorStatus;
  ExtU_Gearbox_T *inputs;
  ExtY_Gearbox_T *outputs;
  DW_Gearbox_T *dwork;
};

/* Model entry point functions */
extern void Gearbox_initialize(RT_MODEL_Gearbox_T *const Gearbox_M);
extern void Gearbox_step(RT_MODEL_Gearbox_T *const Gearbox_M);
extern void Gearbox_terminate(RT_MODEL_Gearbox_T *const Gearbox_M);

#endif
