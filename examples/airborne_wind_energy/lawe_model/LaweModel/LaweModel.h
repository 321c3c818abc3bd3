/* SPDX-License-Identifier: Apache-2.0 */
/* The kite on its tether in the form in which Simulink exports a model, with the names of the thesis.
 * Written by hand; the equations are those of plant/KitePlant.h, with a constant wind. */
#ifndef RTW_HEADER_LaweModel_h_
#define RTW_HEADER_LaweModel_h_
#include <math.h>
#include <string.h>
#ifndef LaweModel_COMMON_INCLUDES_
#define LaweModel_COMMON_INCLUDES_
#include "rtwtypes.h"
#endif /* LaweModel_COMMON_INCLUDES_ */

#include "LaweModel_types.h"

/* Macros for accessing real-time model data structure */
#ifndef rtmGetErrorStatus
#define rtmGetErrorStatus(rtm) ((rtm)->errorStatus)
#endif

#ifndef rtmSetErrorStatus
#define rtmSetErrorStatus(rtm, val) ((rtm)->errorStatus = (val))
#endif

/* Continuous states (default storage) */
typedef struct {
  real_T bodyPosition_CSTATE[3];       /* '<S3>/Integrator1' [m] */
  real_T bodyVelocity_CSTATE[3];       /* '<S3>/Integrator' [m/s] */
  real_T pitch_CSTATE;                 /* '<Root>/Integrator' [deg] */
  real_T yaw_CSTATE;                   /* '<Root>/Integrator1' [deg] */
  real_T tetherLength_CSTATE;          /* '<S4>/Integrator' [m] */
  real_T averagePower_CSTATE;          /* '<Root>/Low pass' [W] */
  real_T energy_CSTATE;                /* '<Root>/Integrator2' [J] */
} X_LaweModel_T;

/* Block states (default storage) for system '<Root>' */
typedef struct {
  boolean_T crashed_DSTATE;            /* '<Root>/Memory' */
} DW_LaweModel_T;

/* External inputs (root inport signals with default storage) */
typedef struct {
  real_T bodyControlPitchSpeed;        /* '<Root>/bodyControlPitchSpeed' */
  real_T bodyControlYawSpeed;          /* '<Root>/bodyControlYawSpeed' */
  real_T tetherSpeed;                  /* '<Root>/tetherSpeed' */
} ExtU_LaweModel_T;

/* External outputs (root outports fed by signals with default storage) */
typedef struct {
  real_T bodyPosition_earth[3];        /* '<Root>/bodyPosition_earth' */
  real_T bodyVelocity_earth[3];        /* '<Root>/bodyVelocity_earth' */
  real_T windVelocity_earth[3];        /* '<Root>/windVelocity_earth' */
  real_T bodyControlOrientation[3];    /* '<Root>/bodyControlOrientation' */
  real_T bodyPositionOrientation[3];   /* '<Root>/bodyPositionOrientation' */
  real_T angleOfAttack;                /* '<Root>/angleOfAttack' */
  real_T dragCoefficient;              /* '<Root>/dragCoefficient' */
  real_T liftCoefficient;              /* '<Root>/liftCoefficient' */
  real_T aweCoefficient;               /* '<Root>/aweCoefficient' */
  real_T gravitationalForce_earth[3];  /* '<Root>/gravitationalForce_earth' */
  real_T aerodynamicForce_earth[3];    /* '<Root>/aerodynamicForce_earth' */
  real_T tetherForce_earth[3];         /* '<Root>/tetherForce_earth' */
  real_T tetherLength;                 /* '<Root>/tetherLength' */
  real_T power;                        /* '<Root>/power' */
  real_T averagePower;                 /* '<Root>/averagePower' */
  real_T energy;                       /* '<Root>/energy' */
  boolean_T crashed;                   /* '<Root>/crashed' */
} ExtY_LaweModel_T;

/* Parameters (default storage) */
struct P_LaweModel_T_ {
  real_T mass;                         /* [kg] */
  real_T area;                         /* [m^2] */
  real_T airDensity;                   /* [kg/m^3] */
  real_T tetherStiffness;              /* [N/m] */
  real_T gravity;                      /* [m/s^2] */
  real_T averagePowerTime;             /* [s] */
  real_T windVelocity[3];              /* [m/s] */
  real_T initialPosition[3];           /* [m] */
  real_T initialPitch;                 /* [deg] */
  real_T initialTetherLength;          /* [m] */
};

/* Real-time Model Data Structure */
struct tag_RTM_LaweModel_T {
  const char_T *errorStatus;

  /*
   * Timing:
   * The following substructure contains information regarding
   * the timing information for the model.
   */
  struct {
    uint32_T clockTick0;
    time_T stepSize0;
  } Timing;
};

/* Block parameters (default storage) */
extern P_LaweModel_T LaweModel_P;

/* Continuous states (default storage) */
extern X_LaweModel_T LaweModel_X;

/* Block states (default storage) */
extern DW_LaweModel_T LaweModel_DW;

/* External inputs (root inport signals with default storage) */
extern ExtU_LaweModel_T LaweModel_U;

/* External outputs (root outports fed by signals with default storage) */
extern ExtY_LaweModel_T LaweModel_Y;

/* Model entry point functions */
extern void LaweModel_initialize(void);
extern void LaweModel_step(void);
extern void LaweModel_terminate(void);

/* Real-time Model object */
extern RT_MODEL_LaweModel_T *const LaweModel_M;

#endif /* RTW_HEADER_LaweModel_h_ */
