/* SPDX-License-Identifier: Apache-2.0 */
#include "LaweModel.h"

#define LaweModel_radiansPerDegree 0.017453292519943295769
#define LaweModel_degreesPerRadian 57.295779513082320877

/* What acts on the wing, and what is shown of it. */
typedef struct {
  real_T angleOfAttack;                /* [deg] */
  real_T drag;
  real_T lift;
  real_T air[3];                       /* [N] */
  real_T tether[3];                    /* [N] */
  real_T tension;                      /* [N] */
} Forces_LaweModel;

X_LaweModel_T LaweModel_X;
DW_LaweModel_T LaweModel_DW;
ExtU_LaweModel_T LaweModel_U;
ExtY_LaweModel_T LaweModel_Y;
static RT_MODEL_LaweModel_T LaweModel_M_;
RT_MODEL_LaweModel_T *const LaweModel_M = &LaweModel_M_;

static real_T LaweModel_dot(const real_T a[3], const real_T b[3])
{
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

/* MATLAB Function: a curve of cubic pieces; each has its begin, and a, b, c and d. */
static real_T LaweModel_spline(const real_T pieces[][5], int_T count, real_T end, real_T last, real_T x)
{
  int_T i;
  if (!(x > pieces[0][0])) {
    return pieces[0][4];
  }

  for (i = 0; i < count; i++) {
    if (x <= (i + 1 < count ? pieces[i + 1][0] : end)) {
      real_T s = x - pieces[i][0];
      return ((pieces[i][1] * s + pieces[i][2]) * s + pieces[i][3]) * s + pieces[i][4];
    }
  }

  return last;
}

/* MATLAB Function: '<S2>/drag' */
static real_T LaweModel_drag(real_T angleOfAttack)
{
  static const real_T pieces[4][5] = {
    { -180.0, -1.7832647462277093e-06, 0.00022222222222222223, 0.0, 0.5 },
    { -90.0, 2.05761316872428e-06, -0.00025925925925925921, -0.003333333333333334, 1.0 },
    { 0.0, -2.05761316872428e-06, 0.00029629629629629629, -1.0842021724855044e-19, 0.1 },
    { 90.0, 1.7832647462277093e-06, -0.00025925925925925926, 0.003333333333333334, 1.0 }
  };

  return LaweModel_spline(pieces, 4, 180.0, 0.5, angleOfAttack);
}

/* MATLAB Function: '<S2>/lift' */
static real_T LaweModel_lift(real_T angleOfAttack)
{
  static const real_T pieces[6][5] = {
    { -180.0, -1.0794375549853597e-05, 0.00080677502199414384, 0.0, 0.0 },
    { -140.0, 2.750781937316997e-06, -0.00048855004398828776, 0.012728999120234242, 0.6 },
    { -60.0, 2.0349270731494383e-06, 0.00017163762096779144, -0.012623994721405461, -0.1 },
    { 0.0, -1.8236551260977129e-05, 0.00053792449413469069, 0.029949732184743439, 0.2 },
    { 25.0, 4.4509240865808439e-06, -0.00082981685043859469, 0.022652423277145856, 1.0 },
    { 140.0, -1.3509399492897456e-05, 0.0007057519594317965, 0.0083849608113640683, -0.6 }
  };

  return LaweModel_spline(pieces, 6, 180.0, 0.0, angleOfAttack);
}

/* '<Root>/aerodynamics': side and top are axes of the wing. */
static void LaweModel_aerodynamics(const real_T velocity[3], const real_T side[3], const real_T top[3],
  Forces_LaweModel *forces)
{
  real_T dynamicArea = 0.5 * LaweModel_P.airDensity * LaweModel_P.area;
  real_T wind[3];
  real_T direction[3];
  real_T speed;
  real_T length;
  int_T i;
  for (i = 0; i < 3; i++) {
    wind[i] = LaweModel_P.windVelocity[i] - velocity[i];
  }

  speed = sqrt(LaweModel_dot(wind, wind));
  forces->angleOfAttack = 0.0;
  if (speed > 0.0) {
    real_T sine = LaweModel_dot(wind, top) / speed;
    sine = sine < -1.0 ? -1.0 : 1.0 < sine ? 1.0 : sine;
    forces->angleOfAttack = asin(sine) * LaweModel_degreesPerRadian;
  }

  forces->drag = LaweModel_drag(forces->angleOfAttack);
  forces->lift = LaweModel_lift(forces->angleOfAttack);
  direction[0] = wind[1] * side[2] - wind[2] * side[1];
  direction[1] = wind[2] * side[0] - wind[0] * side[2];
  direction[2] = wind[0] * side[1] - wind[1] * side[0];
  length = sqrt(LaweModel_dot(direction, direction));
  for (i = 0; i < 3; i++) {
    forces->air[i] = dynamicArea * speed * forces->drag * wind[i];
    if (length > 0.0) {
      forces->air[i] += dynamicArea * speed * speed * forces->lift / length * direction[i];
    }
  }
}

/* All forces but gravity, in the state \a x. */
static void LaweModel_forces(const X_LaweModel_T *x, Forces_LaweModel *forces)
{
  const real_T *r = x->bodyPosition_CSTATE;
  real_T horizontal = sqrt(r[0] * r[0] + r[1] * r[1]);
  real_T distance = sqrt(LaweModel_dot(r, r));
  real_T cosElevation = 1.0, sinElevation = 0.0, cosAzimuth = 1.0, sinAzimuth = 0.0;
  real_T pitch = x->pitch_CSTATE * LaweModel_radiansPerDegree;
  real_T yaw = x->yaw_CSTATE * LaweModel_radiansPerDegree;
  real_T sinPitch = sin(pitch), cosPitch = cos(pitch), sinYaw = sin(yaw), cosYaw = cos(yaw);
  real_T outwards[3], zenithwards[3], azimuthwards[3], side[3], top[3];
  real_T stretch;
  int_T i;
  if (horizontal > 0.0) {
    cosAzimuth = r[0] / horizontal;
    sinAzimuth = r[1] / horizontal;
  }

  if (distance > 0.0) {
    cosElevation = horizontal / distance;
    sinElevation = r[2] / distance;
  }

  outwards[0] = cosElevation * cosAzimuth;
  outwards[1] = cosElevation * sinAzimuth;
  outwards[2] = sinElevation;
  zenithwards[0] = -sinElevation * cosAzimuth;
  zenithwards[1] = -sinElevation * sinAzimuth;
  zenithwards[2] = cosElevation;
  azimuthwards[0] = -sinAzimuth;
  azimuthwards[1] = cosAzimuth;
  azimuthwards[2] = 0.0;
  for (i = 0; i < 3; i++) {
    real_T tail = sinYaw * azimuthwards[i] - cosYaw * zenithwards[i];
    side[i] = sinYaw * zenithwards[i] + cosYaw * azimuthwards[i];
    top[i] = sinPitch * tail + cosPitch * outwards[i];
  }

  LaweModel_aerodynamics(x->bodyVelocity_CSTATE, side, top, forces);
  stretch = distance - x->tetherLength_CSTATE;
  forces->tension = stretch > 0.0 ? LaweModel_P.tetherStiffness * stretch : 0.0;
  for (i = 0; i < 3; i++) {
    forces->tether[i] = -forces->tension * outwards[i];
  }
}

/* Derivatives for root system: '<Root>' */
static void LaweModel_derivatives(const X_LaweModel_T *x, X_LaweModel_T *dx)
{
  Forces_LaweModel forces;
  int_T i;
  LaweModel_forces(x, &forces);
  for (i = 0; i < 3; i++) {
    dx->bodyPosition_CSTATE[i] = x->bodyVelocity_CSTATE[i];
    dx->bodyVelocity_CSTATE[i] = (forces.air[i] + forces.tether[i]) / LaweModel_P.mass;
  }

  dx->bodyVelocity_CSTATE[2] -= LaweModel_P.gravity;
  dx->pitch_CSTATE = LaweModel_U.bodyControlPitchSpeed;
  dx->yaw_CSTATE = LaweModel_U.bodyControlYawSpeed;
  dx->tetherLength_CSTATE = LaweModel_U.tetherSpeed;
  dx->energy_CSTATE = LaweModel_U.tetherSpeed * forces.tension;
  dx->averagePower_CSTATE = (dx->energy_CSTATE - x->averagePower_CSTATE) / LaweModel_P.averagePowerTime;
}

/* One step of a solver: *to = LaweModel_X + h * *dx. */
static void LaweModel_move(real_T h, const X_LaweModel_T *dx, X_LaweModel_T *to)
{
  const real_T *from = (const real_T *)&LaweModel_X;
  const real_T *slope = (const real_T *)dx;
  real_T *moved = (real_T *)to;
  uint32_T i;
  for (i = 0U; i < sizeof(X_LaweModel_T) / sizeof(real_T); i++) {
    moved[i] = from[i] + h * slope[i];
  }
}

/* The fixed-step solver ODE4. */
static void rt_ertODEUpdateContinuousStates(void)
{
  time_T h = LaweModel_M->Timing.stepSize0;
  X_LaweModel_T f[4];
  X_LaweModel_T x;
  X_LaweModel_T mean;
  uint32_T i;
  LaweModel_derivatives(&LaweModel_X, &f[0]);
  LaweModel_move(0.5 * h, &f[0], &x);
  LaweModel_derivatives(&x, &f[1]);
  LaweModel_move(0.5 * h, &f[1], &x);
  LaweModel_derivatives(&x, &f[2]);
  LaweModel_move(h, &f[2], &x);
  LaweModel_derivatives(&x, &f[3]);
  for (i = 0U; i < sizeof(X_LaweModel_T) / sizeof(real_T); i++) {
    const real_T *f0 = (const real_T *)&f[0], *f1 = (const real_T *)&f[1];
    const real_T *f2 = (const real_T *)&f[2], *f3 = (const real_T *)&f[3];
    ((real_T *)&mean)[i] = (f0[i] + 2.0 * (f1[i] + f2[i]) + f3[i]) / 6.0;
  }

  mean.pitch_CSTATE = LaweModel_U.bodyControlPitchSpeed;
  mean.yaw_CSTATE = LaweModel_U.bodyControlYawSpeed;
  mean.tetherLength_CSTATE = LaweModel_U.tetherSpeed;
  LaweModel_move(h, &mean, &LaweModel_X);
}

/* The wing stays where it comes down. */
static void LaweModel_noticeGround(void)
{
  if (LaweModel_X.bodyPosition_CSTATE[2] <= 0.0 && !LaweModel_DW.crashed_DSTATE) {
    LaweModel_DW.crashed_DSTATE = 1U;
    (void)memset(LaweModel_X.bodyVelocity_CSTATE, 0, sizeof(LaweModel_X.bodyVelocity_CSTATE));
  }
}

static void LaweModel_output(void)
{
  const real_T *r = LaweModel_X.bodyPosition_CSTATE;
  real_T isFree = LaweModel_DW.crashed_DSTATE ? 0.0 : 1.0;
  Forces_LaweModel forces;
  real_T resultant;
  int_T i;
  LaweModel_forces(&LaweModel_X, &forces);
  for (i = 0; i < 3; i++) {
    LaweModel_Y.bodyPosition_earth[i] = r[i];
    LaweModel_Y.bodyVelocity_earth[i] = LaweModel_X.bodyVelocity_CSTATE[i];
    LaweModel_Y.windVelocity_earth[i] = LaweModel_P.windVelocity[i];
    LaweModel_Y.aerodynamicForce_earth[i] = isFree > 0.0 ? forces.air[i] : 0.0;
    LaweModel_Y.tetherForce_earth[i] = isFree > 0.0 ? forces.tether[i] : 0.0;
  }

  LaweModel_Y.bodyControlOrientation[0] = 0.0;
  LaweModel_Y.bodyControlOrientation[1] = LaweModel_X.pitch_CSTATE;
  LaweModel_Y.bodyControlOrientation[2] = LaweModel_X.yaw_CSTATE;
  LaweModel_Y.bodyPositionOrientation[0] = 0.0;
  LaweModel_Y.bodyPositionOrientation[1] =
    90.0 - atan2(r[2], sqrt(r[0] * r[0] + r[1] * r[1])) / LaweModel_radiansPerDegree;
  LaweModel_Y.bodyPositionOrientation[2] = atan2(r[1], r[0]) / LaweModel_radiansPerDegree;
  LaweModel_Y.angleOfAttack = forces.angleOfAttack;
  LaweModel_Y.dragCoefficient = forces.drag;
  LaweModel_Y.liftCoefficient = forces.lift;
  resultant = sqrt(forces.drag * forces.drag + forces.lift * forces.lift);
  LaweModel_Y.aweCoefficient = resultant * resultant * resultant / (forces.drag * forces.drag);
  LaweModel_Y.gravitationalForce_earth[0] = 0.0;
  LaweModel_Y.gravitationalForce_earth[1] = 0.0;
  LaweModel_Y.gravitationalForce_earth[2] = -LaweModel_P.mass * LaweModel_P.gravity;
  LaweModel_Y.tetherLength = LaweModel_X.tetherLength_CSTATE;
  LaweModel_Y.power = isFree > 0.0 ? LaweModel_U.tetherSpeed * forces.tension : 0.0;
  LaweModel_Y.averagePower = LaweModel_X.averagePower_CSTATE;
  LaweModel_Y.energy = LaweModel_X.energy_CSTATE;
  LaweModel_Y.crashed = LaweModel_DW.crashed_DSTATE;
}

/* Model step function */
void LaweModel_step(void)
{
  const real_T *v = LaweModel_X.bodyVelocity_CSTATE;
  LaweModel_output();
  if (!LaweModel_DW.crashed_DSTATE) {
    rt_ertODEUpdateContinuousStates();
    LaweModel_noticeGround();
  }

  LaweModel_M->Timing.clockTick0++;
  if (!(LaweModel_dot(v, v) < 1.0E+6)) {
    rtmSetErrorStatus(LaweModel_M, "the simulation has diverged: the kite is faster than 1000 m/s");
  }
}

/* Model initialize function */
void LaweModel_initialize(void)
{
  (void)memset((void *)LaweModel_M, 0, sizeof(RT_MODEL_LaweModel_T));
  LaweModel_M->Timing.stepSize0 = 0.01;
  (void)memset((void *)&LaweModel_X, 0, sizeof(X_LaweModel_T));
  (void)memset((void *)&LaweModel_DW, 0, sizeof(DW_LaweModel_T));
  (void)memset((void *)&LaweModel_U, 0, sizeof(ExtU_LaweModel_T));
  (void)memset((void *)&LaweModel_Y, 0, sizeof(ExtY_LaweModel_T));
  (void)memcpy(LaweModel_X.bodyPosition_CSTATE, LaweModel_P.initialPosition, sizeof(LaweModel_P.initialPosition));
  LaweModel_X.pitch_CSTATE = LaweModel_P.initialPitch;
  LaweModel_X.tetherLength_CSTATE = LaweModel_P.initialTetherLength;
  LaweModel_noticeGround();
}

/* Model terminate function */
void LaweModel_terminate(void)
{
  /* (no terminate code required) */
}
