/* SPDX-License-Identifier: Apache-2.0 */
/* Stands for the header of MATLAB that comes with exported code. */
#ifndef RTWTYPES_H
#define RTWTYPES_H
#include "tmwtypes.h"
#endif
