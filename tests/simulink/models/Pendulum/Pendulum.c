/* SPDX-License-Identifier: Apache-2.0 */
#include "Pendulum.h"

X_Pendulum_T Pendulum_X;
ExtU_Pendulum_T Pendulum_U;
ExtY_Pendulum_T Pendulum_Y;
static RT_MODEL_Pendulum_T Pendulum_M_;
RT_MODEL_Pendulum_T *const Pendulum_M = &Pendulum_M_;

static void Pendulum_derivatives(void)
{
  real_T *dx = Pendulum_M->derivs;
  dx[0] = Pendulum_X.Speed_CSTATE;
  dx[1] = Pendulum_U.torque - 9.81 / Pendulum_P.length * sin(Pendulum_X.Angle_CSTATE);
}

/* The fixed-step solver ODE3. */
static void rt_ertODEUpdateContinuousStates(RTWSolverInfo *si)
{
  static const real_T A[3] = { 1.0/2.0, 3.0/4.0, 1.0 };
  static const real_T B[3][3] = { { 1.0/2.0, 0.0, 0.0 }, { 0.0, 3.0/4.0, 0.0 }, { 2.0/9.0, 1.0/3.0, 4.0/9.0 } };
  time_T t = rtsiGetT(si);
  time_T h = rtsiGetStepSize(si);
  real_T *x = rtsiGetContStates(si);
  real_T *y = Pendulum_M->odeY;
  int_T stage, i, k;
  rtsiSetSimTimeStep(si, MINOR_TIME_STEP);
  (void)memcpy(y, x, sizeof(Pendulum_M->odeY));
  for (stage = 0; stage < 3; stage++) {
    rtsiSetdX(si, Pendulum_M->odeF[stage]);
    Pendulum_derivatives();
    for (i = 0; i < 2; i++) {
      x[i] = y[i];
      for (k = 0; k <= stage; k++) {
        x[i] += Pendulum_M->odeF[k][i] * (h * B[stage][k]);
      }
    }
    rtsiSetT(si, t + h * A[stage]);
  }
  rtsiSetSimTimeStep(si, MAJOR_TIME_STEP);
}

void Pendulum_step(void)
{
  Pendulum_Y.angle = Pendulum_X.Angle_CSTATE;
  Pendulum_Y.speed = Pendulum_X.Speed_CSTATE;
  Pendulum_Y.power = Pendulum_U.torque * Pendulum_X.Speed_CSTATE;
  rtsiSetSolverStopTime(&Pendulum_M->solverInfo, (Pendulum_M->Timing.clockTick0 + 1) * Pendulum_M->Timing.stepSize0);
  rt_ertODEUpdateContinuousStates(&Pendulum_M->solverInfo);
  Pendulum_M->Timing.clockTick0++;
  if (rtmGetTFinal(Pendulum_M) >= 0.0 &&
      Pendulum_M->Timing.clockTick0 * Pendulum_M->Timing.stepSize0 > rtmGetTFinal(Pendulum_M)) {
    rtmSetErrorStatus(Pendulum_M, "Simulation finished");
  }
  if (fabs(Pendulum_X.Angle_CSTATE) > 6.283185307179586 * Pendulum_P.turns) {
    rtmSetErrorStatus(Pendulum_M, "the pendulum has turned too often");
  }
  if (Pendulum_U.stop) {
    rtmSetStopRequested(Pendulum_M, 1);
  }
}

void Pendulum_initialize(void)
{
  (void)memset((void *)Pendulum_M, 0, sizeof(RT_MODEL_Pendulum_T));
  rtsiSetSimTimeStepPtr(&Pendulum_M->solverInfo, &Pendulum_M->Timing.simTimeStep);
  rtsiSetTPtr(&Pendulum_M->solverInfo, &Pendulum_M->Timing.t);
  rtsiSetStepSizePtr(&Pendulum_M->solverInfo, &Pendulum_M->Timing.stepSize0);
  rtsiSetdXPtr(&Pendulum_M->solverInfo, &Pendulum_M->derivs);
  rtsiSetContStatesPtr(&Pendulum_M->solverInfo, (real_T **)&Pendulum_M->contStates);
  rtsiSetErrorStatusPtr(&Pendulum_M->solverInfo, (&rtmGetErrorStatus(Pendulum_M)));
  rtsiSetSimTimeStep(&Pendulum_M->solverInfo, MAJOR_TIME_STEP);
  Pendulum_M->contStates = &Pendulum_X;
  Pendulum_M->Timing.t = &Pendulum_M->Timing.tArray[0];
  rtmGetTFinal(Pendulum_M) = 1.0;
  Pendulum_M->Timing.stepSize0 = 0.01;
  (void)memset((void *)&Pendulum_U, 0, sizeof(ExtU_Pendulum_T));
  (void)memset((void *)&Pendulum_Y, 0, sizeof(ExtY_Pendulum_T));
  Pendulum_X.Angle_CSTATE = Pendulum_P.initial[0];
  Pendulum_X.Speed_CSTATE = Pendulum_P.initial[1];
}

void Pendulum_terminate(void)
{
  /* (no terminate code required) */
}
