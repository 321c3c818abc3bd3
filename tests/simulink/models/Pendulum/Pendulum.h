/* SPDX-License-Identifier: Apache-2.0 */
/* Written by hand in the form of an export: global variables, continuous states with the solver ode3,
 * tunable parameters, an error status and a stop request. */
#ifndef RTW_HEADER_Pendulum_h_
#define RTW_HEADER_Pendulum_h_
#include <math.h>
#include <string.h>
#ifndef Pendulum_COMMON_INCLUDES_
#define Pendulum_COMMON_INCLUDES_
#include "rtwtypes.h"
#include "rtw_continuous.h"
#include "rtw_solver.h"
#endif /* Pendulum_COMMON_INCLUDES_ */

#include "Pendulum_types.h"

/* Macros for accessing real-time model data structure */
#ifndef rtmGetErrorStatus
#define rtmGetErrorStatus(rtm) ((rtm)->errorStatus)
#endif

#ifndef rtmSetErrorStatus
#define rtmSetErrorStatus(rtm, val) ((rtm)->errorStatus = (val))
#endif

#ifndef rtmGetStopRequested
#define rtmGetStopRequested(rtm) ((rtm)->Timing.stopRequestedFlag)
#endif

#ifndef rtmSetStopRequested
#define rtmSetStopRequested(rtm, val) ((rtm)->Timing.stopRequestedFlag = (val))
#endif

#ifndef rtmGetTFinal
#define rtmGetTFinal(rtm) ((rtm)->Timing.tFinal)
#endif

/* Continuous states (default storage) */
typedef struct {
  real_T Angle_CSTATE;                 /* '<Root>/Angle' */
  real_T Speed_CSTATE;                 /* '<Root>/Speed' */
} X_Pendulum_T;

/* External inputs (root inport signals with default storage) */
typedef struct {
  real_T torque;                       /* '<Root>/torque' */
  boolean_T stop;                      /* '<Root>/stop' */
} ExtU_Pendulum_T;

/* External outputs (root outports fed by signals with default storage) */
typedef struct {
  real_T angle;                        /* '<Root>/angle' */
  real_T speed;                        /* '<Root>/speed' */
  real_T power;                        /* '<Root>/power' */
} ExtY_Pendulum_T;

/* Parameters (default storage) */
struct P_Pendulum_T_ {
  real_T length;                       /* Variable: length
                                        * Referenced by: '<Root>/Gain'
                                        */
  real_T initial[2];                   /* Variable: initial */
  int16_T turns;                       /* Variable: turns */
};

/* Real-time Model Data Structure */
struct tag_RTM_Pendulum_T {
  const char_T *errorStatus;
  RTWSolverInfo solverInfo;
  X_Pendulum_T *contStates;
  real_T *derivs;
  real_T odeY[2];
  real_T odeF[3][2];

  /*
   * Timing:
   * The following substructure contains information regarding
   * the timing information for the model.
   */
  struct {
    uint32_T clockTick0;
    time_T stepSize0;
    time_T tFinal;
    SimTimeStep simTimeStep;
    boolean_T stopRequestedFlag;
    time_T *t;
    time_T tArray[1];
  } Timing;
};

/* Block parameters (default storage) */
extern P_Pendulum_T Pendulum_P;

/* Continuous states (default storage) */
extern X_Pendulum_T Pendulum_X;

/* External inputs (root inport signals with default storage) */
extern ExtU_Pendulum_T Pendulum_U;

/* External outputs (root outports fed by signals with default storage) */
extern ExtY_Pendulum_T Pendulum_Y;

/* Model entry point functions */
extern void Pendulum_initialize(void);
extern void Pendulum_step(void);
extern void Pendulum_terminate(void);

/* Real-time Model object */
extern RT_MODEL_Pendulum_T *const Pendulum_M;

#endif /* RTW_HEADER_Pendulum_h_ */
