/* SPDX-License-Identifier: Apache-2.0 */
/* Stands for the header of MATLAB that comes with exported code. */
#ifndef RTW_CONTINUOUS_H
#define RTW_CONTINUOUS_H
#include "rtwtypes.h"

typedef enum { MINOR_TIME_STEP = 0, MAJOR_TIME_STEP } SimTimeStep;

#endif
