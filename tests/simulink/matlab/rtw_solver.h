/* SPDX-License-Identifier: Apache-2.0 */
/* Stands for the header of MATLAB that comes with exported code: what solvers of fixed step use. */
#ifndef RTW_SOLVER_H
#define RTW_SOLVER_H
#include "rtw_continuous.h"

typedef struct
{
    SimTimeStep *simTimeStep;
    time_T **t;
    time_T *stepSize;
    time_T solverStopTime;
    real_T **dX;
    real_T **contStates;
    void *solverData;
    const char_T **errorStatus;
    void *model;
    const char_T *solverName;
    int_T *numContStates;
} RTWSolverInfo;

#define rtsiSetSimTimeStepPtr(S, p)              ((S)->simTimeStep = (p))
#define rtsiSetSimTimeStep(S, v)                 (*(S)->simTimeStep = (v))
#define rtsiSetTPtr(S, p)                        ((S)->t = (p))
#define rtsiSetT(S, v)                           ((*(S)->t)[0] = (v))
#define rtsiGetT(S)                              ((*(S)->t)[0])
#define rtsiSetStepSizePtr(S, p)                 ((S)->stepSize = (p))
#define rtsiGetStepSize(S)                       (*(S)->stepSize)
#define rtsiSetSolverStopTime(S, v)              ((S)->solverStopTime = (v))
#define rtsiGetSolverStopTime(S)                 ((S)->solverStopTime)
#define rtsiSetdXPtr(S, p)                       ((S)->dX = (p))
#define rtsiSetdX(S, v)                          (*(S)->dX = (v))
#define rtsiSetContStatesPtr(S, p)               ((S)->contStates = (p))
#define rtsiGetContStates(S)                     (*(S)->contStates)
#define rtsiSetNumContStatesPtr(S, p)            ((S)->numContStates = (p))
#define rtsiSetNumPeriodicContStatesPtr(S, p)    ((void)(p))
#define rtsiSetPeriodicContStateIndicesPtr(S, p) ((void)(p))
#define rtsiSetPeriodicContStateRangesPtr(S, p)  ((void)(p))
#define rtsiSetErrorStatusPtr(S, p)              ((S)->errorStatus = (p))
#define rtsiSetRTModelPtr(S, p)                  ((S)->model = (p))
#define rtsiSetSolverData(S, p)                  ((S)->solverData = (p))
#define rtsiGetSolverData(S)                     ((S)->solverData)
#define rtsiSetSolverName(S, p)                  ((S)->solverName = (p))

#endif
